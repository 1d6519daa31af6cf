// Bounds of parts whose leaves stay as they are, kept from one look to the next.

#include "angle_memo.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "blum/medial/medial_axis.hpp"
#include "part_angles.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

void expect_same(const std::vector<AngleInterval>& a, const std::vector<AngleInterval>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].lo, b[k].lo) << k;
    EXPECT_EQ(a[k].hi, b[k].hi) << k;
  }
}

std::uint64_t decisions(EngineSet& engines) {
  const StageCounts c = engines.stages();
  return c.filter + c.extended + c.exact;
}

// With every division of leaves: what is kept and what is bounded anew.
TEST(AngleMemo, LooksAtFinerLeaves_FindTheSameAsAnew) {
  AngleOptions wanted;
  wanted.wanted = true;
  const AngleLook looks[] = {{1, 400, true}, {1, 800, false}};
  std::array<AngleMemo, 2> kept;
  std::size_t rounds = 0, first = 0, later = 0;
  const AxisReview review = [&](const AssembledAxis& axis) {
    for (std::size_t k = 0; k < 2; ++k) {
      AngleMemo none;
      const auto at = [&](AngleMemo& memo) {
        return part_angles(axis.geometry, axis.subdivision, axis.engines, axis.complex, axis.parts,
                           looks[k], memo);
      };
      const std::uint64_t begin = decisions(axis.engines);
      const PartAngles anew = at(none);
      const std::uint64_t middle = decisions(axis.engines);
      const PartAngles again = at(kept[k]);
      const std::uint64_t end = decisions(axis.engines);
      expect_same(anew.sheet, again.sheet);
      expect_same(anew.seam, again.seam);
      expect_same(anew.vertex, again.vertex);
      EXPECT_EQ(anew.coarse_leaves, again.coarse_leaves);
      EXPECT_EQ(anew.boxes, again.boxes);
      if (rounds > 0) {
        first += middle - begin;
        later += end - middle;
      }
      (void)at(kept[k]);
      EXPECT_EQ(decisions(axis.engines), end) << "nothing is bounded twice";
    }
    ++rounds;
    return ReviewVerdict{};
  };
  const auto r =
      compute_medial_axis(test::solid_of(shapes::lpocket()), test::seeded(1), wanted, {}, review);
  ASSERT_TRUE(r && r.value().certified);
  EXPECT_GT(rounds, 1u);
  EXPECT_LT(later, first);
}

// Whatever bounds depend on makes another key.
TEST(AngleMemo, Key_HoldsEverythingThatBoundsDependOn) {
  const Solid solid = test::solid_of(shapes::lpocket());
  const SiteGeometry geometry(solid, DiagramKind::kMedial);
  MedialOptions options = test::seeded(1);
  RunWatch watch(options);
  EngineSet engines(geometry, options, watch);
  const auto subdivided = subdivide(geometry, options, engines);
  ASSERT_TRUE(subdivided);
  const Subdivision& whole = subdivided.value();
  std::size_t with_axis = 0;
  while (!whole.leaf[with_axis].has_axis) ++with_axis;

  LeafParts parts;
  parts.leaf = 0;
  parts.groups = LeafGroups(geometry, whole.leaf[with_axis]);
  parts.arc = {{1, 2, 5}};
  parts.seam = {{7, 7, 3, 3}};
  parts.node = {{LeafParts::kNone, {{0, 0, 0}, {1, 1, 0}}, 7, {3, 6, 5}}};
  parts.rest = 4;
  Subdivision subdivision;
  subdivision.leaf = {whole.leaf[with_axis]};
  std::vector<AngleTask> tasks = {{0, {AngleRole::Kind::kSeam, 7, 0, true}}};
  std::vector<AngleStart> starts = {{0, {0.5, 0.5, 0.5}, 0.1, SiteId{1}, SiteId{2}}};

  AngleMemo memo;
  const auto key = [&] {
    memo.number({parts}, subdivision);
    return memo.key(tasks, starts);
  };
  const AngleMemo::Key before = key();
  EXPECT_EQ(key(), before);
  parts.arc[0].sheet = 6;  // numbers of parts mean nothing
  parts.seam[0].seam = 9;
  EXPECT_EQ(key(), before);
  parts.rest = 3;
  EXPECT_EQ(key(), before);

  Leaf& leaf = subdivision.leaf[0];
  const auto changes = [&](auto& place, auto other, const char* what) {
    // A leaf that has been away for a look is a new one.
    const AngleMemo::Key whole_key = key();
    const auto was = place;
    place = other;
    EXPECT_NE(key(), whole_key) << what;
    place = was;
  };
  auto fewer = leaf.candidates;
  fewer.pop_back();
  changes(leaf.candidates, fewer, "candidates");
  changes(leaf.box.hi.y, std::nextafter(leaf.box.hi.y, 2.0), "box");
  changes(leaf.boundary_vertex, 1u, "boundary vertex");
  changes(parts.groups, LeafGroups(), "groups");
  changes(parts.conical, true, "conical");
  changes(parts.junction, true, "junction");
  changes(parts.rest, LeafParts::kNone, "rest");
  changes(parts.arc[0].a, GroupSet{4}, "side");
  changes(parts.arc[0].b, GroupSet{4}, "side");
  changes(parts.arc, std::vector<LeafParts::Arc>{}, "arcs");
  changes(parts.seam[0].groups, GroupSet{15}, "groups of a seam");
  changes(parts.seam[0].certain, GroupSet{3}, "certain groups");
  changes(parts.seam[0].arcs, 4u, "arcs of a seam");
  changes(parts.node[0].vertex, 2u, "vertex of a node");
  changes(parts.node[0].box.hi.x, 0.5, "box of a node");
  changes(parts.node[0].groups, GroupSet{15}, "groups of a node");
  changes(parts.node[0].arc[1], GroupSet{3}, "arc of a node");
  changes(tasks[0].role.kind, AngleRole::Kind::kArc, "role");
  changes(tasks[0].role.a, GroupSet{3}, "a");
  changes(tasks[0].role.b, GroupSet{3}, "b");
  changes(tasks[0].role.distinct, false, "distinct");
  changes(starts[0].x.z, 0.25, "start");
  changes(starts[0].reach, 0.2, "reach");
}

// A wide part is bounded again by a look that is more careful, a narrow one is not.
TEST(AngleMemo, WiderThanWanted_IsNotKept) {
  const AngleLook fast{1, 400, true}, careful{1, 10000, false}, finer{0.1, 400, true};
  AngleMemo memo;
  memo.keep({{{1}, {{10, 10.5}, 3, {}, fast}}, {{2}, {{10, 12}, 3, {0}, fast}}});
  EXPECT_NE(memo.find({1}, fast), nullptr);
  EXPECT_NE(memo.find({1}, careful), nullptr);
  EXPECT_EQ(memo.find({1}, finer), nullptr);
  EXPECT_NE(memo.find({2}, fast), nullptr);
  EXPECT_EQ(memo.find({2}, careful), nullptr);
  EXPECT_EQ(memo.find({3}, fast), nullptr);
}

}  // namespace
}  // namespace blum
