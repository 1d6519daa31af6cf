// The subdivision as a tree of boxes: it tiles, its leaves say why, it is reproducible, and it
// stops when its budget is spent.

#include <gtest/gtest.h>

#include "blum/kernel/inside.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

using test::Scene;
using test::seeded;
using test::Subdivided;

double volume(const Box3& b) { return (b.hi.x - b.lo.x) * (b.hi.y - b.lo.y) * (b.hi.z - b.lo.z); }

bool strictly_in(const Box3& b, const Point3& p) {
  for (int k = 0; k < 3; ++k)
    if (!(p[k] > b.lo[k] && p[k] < b.hi[k])) return false;
  return true;
}

/// Trees of some hundred leaves.
double fine(const PolygonMesh& mesh) { return 0.2 * test::extent(mesh.points); }

/// Does the triangle, clipped by the box shrunk by `margin`, keep a corner?
bool meets(const std::array<Point3, 3>& triangle, const Box3& box, double margin) {
  std::vector<test::LongPoint> polygon;
  for (const Point3& p : triangle) polygon.push_back(test::wide(p));
  for (int k = 0; k < 3; ++k)
    for (const int sign : {-1, 1}) {
      const long double level = sign < 0 ? -(box.lo[k] + margin) : box.hi[k] - margin;
      std::vector<test::LongPoint> kept;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const auto &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const long double ha = sign * a[k] - level, hb = sign * b[k] - level;
        if (ha <= 0) kept.push_back(a);
        if ((ha < 0) != (hb < 0) && ha != hb) {
          const long double t = ha / (ha - hb);
          test::LongPoint c;
          for (int j = 0; j < 3; ++j) c[j] = a[j] + t * (b[j] - a[j]);
          kept.push_back(c);
        }
      }
      polygon = std::move(kept);
      if (polygon.empty()) return false;
    }
  return true;
}

void check_tiling(const Subdivision& s) {
  double sum = 0;
  std::vector<int> seen(s.leaf.size(), 0);
  std::size_t reached = 0;
  std::vector<std::uint32_t> stack{0};
  int depth = 0;
  while (!stack.empty()) {
    const CellNode& n = s.node[stack.back()];
    stack.pop_back();
    ++reached;
    for (int k = 0; k < 3; ++k) ASSERT_LT(n.box.lo[k], n.box.hi[k]);
    if (n.axis < 0) {
      ASSERT_LT(n.leaf, s.leaf.size());
      EXPECT_EQ(++seen[n.leaf], 1);
      EXPECT_TRUE(s.leaf[n.leaf].box == n.box);
      sum += volume(n.box);
      depth = std::max(depth, int{n.depth});
      continue;
    }
    ASSERT_LT(n.child + 1, s.node.size());
    const CellNode &low = s.node[n.child], &high = s.node[n.child + 1];
    Box3 expected_low = n.box, expected_high = n.box;
    expected_low.hi[n.axis] = n.cut;
    expected_high.lo[n.axis] = n.cut;
    EXPECT_TRUE(low.box == expected_low);
    EXPECT_TRUE(high.box == expected_high);
    EXPECT_GT(n.cut, n.box.lo[n.axis]);
    EXPECT_LT(n.cut, n.box.hi[n.axis]);
    EXPECT_EQ(low.depth, n.depth + 1);
    EXPECT_EQ(high.depth, n.depth + 1);
    stack.push_back(n.child);
    stack.push_back(n.child + 1);
  }
  EXPECT_EQ(reached, s.node.size());
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), std::ssize(s.leaf));
  EXPECT_NEAR(sum, volume(s.node[0].box), 1e-12 * volume(s.node[0].box));
  EXPECT_EQ(depth, s.stats.max_depth);
}

TEST(SubdivisionTree, AnySolid_LeavesTileTheBox) {
  for (const Scene& scene : test::scenes())
    for (const std::uint64_t seed : {1, 2}) {
      SCOPED_TRACE(scene.name + ", seed " + std::to_string(seed));
      const Subdivided run(scene.mesh, seeded(seed, seed == 1 ? 0 : fine(scene.mesh)));
      ASSERT_TRUE(run.result.ok());
      check_tiling(run.tree());
      for (const Point3& p : run.solid.point)
        EXPECT_TRUE(strictly_in(run.tree().node[0].box, p)) << "a vertex outside the box";
    }
}

TEST(SubdivisionTree, CertifiedLeaf_HasWhatItsTheoremAsksFor) {
  for (const Scene& scene : test::scenes()) {
    SCOPED_TRACE(scene.name);
    const Subdivided run(scene.mesh, seeded(3, fine(scene.mesh)));
    ASSERT_TRUE(run.result.ok());
    const InsideOracle inside(run.solid);
    std::mt19937_64 random(7);
    for (const Leaf& leaf : run.tree().leaf) {
      EXPECT_NE(leaf.theorem, LeafTheorem::kUndecided);
      std::set<std::uint32_t> vertices;
      for (std::uint32_t v = 0; v < run.solid.point.size(); ++v)
        if (strictly_in(leaf.box, run.solid.point[v])) vertices.insert(v);
      for (std::uint32_t t = 0; t < run.solid.triangle.size(); ++t) {
        const auto& v = run.solid.triangle[t].vertex;
        const std::array<Point3, 3> corners{run.solid.point[v[0]], run.solid.point[v[1]],
                                            run.solid.point[v[2]]};
        if (meets(corners, leaf.box, 1e-12)) {
          EXPECT_NE(leaf.theorem, LeafTheorem::kOutside);
          EXPECT_TRUE(std::binary_search(leaf.triangles.begin(), leaf.triangles.end(), t));
        }
      }
      if (leaf.theorem == LeafTheorem::kOutside) {
        EXPECT_FALSE(leaf.has_axis);
        EXPECT_TRUE(vertices.empty());
        for (int k = 0; k < 20; ++k) {
          Point3 p;
          for (int a = 0; a < 3; ++a)
            p[a] = std::uniform_real_distribution(leaf.box.lo[a], leaf.box.hi[a])(random);
          EXPECT_EQ(inside.locate_brute_force(p), InsideOracle::Where::kOutside);
        }
      }
      if (leaf.theorem == LeafTheorem::kConical) {
        EXPECT_EQ(vertices, std::set<std::uint32_t>{leaf.boundary_vertex});
        for (const SiteId s : leaf.candidates) {
          int count = 0;
          const auto corner = run.geometry.corners(s, count);
          EXPECT_NE(std::find(corner.begin(), corner.begin() + count, leaf.boundary_vertex),
                    corner.begin() + count);
        }
      } else {
        EXPECT_EQ(leaf.boundary_vertex, Leaf::kNone);
      }
    }
  }
}

TEST(SubdivisionTree, LeafDiameterAskedFor_HoldsWhereTheAxisIs) {
  for (const Scene& scene : test::scenes()) {
    SCOPED_TRACE(scene.name);
    const double bound = fine(scene.mesh);
    const Subdivided run(scene.mesh, seeded(3, bound));
    ASSERT_TRUE(run.result.ok());
    for (const Leaf& leaf : run.tree().leaf) {
      const Point3 d{leaf.box.hi.x - leaf.box.lo.x, leaf.box.hi.y - leaf.box.lo.y,
                     leaf.box.hi.z - leaf.box.lo.z};
      if (leaf.has_axis)
        EXPECT_LE(run.solid.frame.length_to_model(std::hypot(d.x, d.y, d.z)), bound * (1 + 1e-14));
    }
  }
}

bool same_tree(const Subdivision& a, const Subdivision& b) {
  if (a.node.size() != b.node.size() || a.leaf.size() != b.leaf.size()) return false;
  for (std::size_t k = 0; k < a.node.size(); ++k) {
    const CellNode &m = a.node[k], &n = b.node[k];
    if (!(m.box == n.box) || m.axis != n.axis || m.cut != n.cut || m.child != n.child ||
        m.leaf != n.leaf || m.depth != n.depth)
      return false;
  }
  for (std::size_t k = 0; k < a.leaf.size(); ++k) {
    const Leaf &m = a.leaf[k], &n = b.leaf[k];
    if (!(m.box == n.box) || m.theorem != n.theorem || m.boundary_vertex != n.boundary_vertex ||
        m.has_axis != n.has_axis || m.candidates != n.candidates || m.triangles != n.triangles)
      return false;
  }
  return true;
}

TEST(SubdivisionTree, SameSeed_GivesTheSameTree) {
  for (const Scene& scene : test::scenes())
    for (const std::uint64_t seed : {0ull, 1ull, 0xffffffffffffffffull}) {
      SCOPED_TRACE(scene.name);
      const Subdivided a(scene.mesh, seeded(seed)), b(scene.mesh, seeded(seed));
      ASSERT_TRUE(a.result.ok() && b.result.ok());
      EXPECT_TRUE(same_tree(a.tree(), b.tree()));
    }
}

TEST(SubdivisionTree, AnyNumberOfThreads_GivesTheSameTree) {
  for (const Scene& scene : test::scenes()) {
    SCOPED_TRACE(scene.name);
    SubdivisionOptions o = seeded(1, fine(scene.mesh));
    const Subdivided one(scene.mesh, o);
    o.threads = 4;
    const Subdivided four(scene.mesh, o);
    ASSERT_TRUE(one.result.ok() && four.result.ok());
    EXPECT_TRUE(same_tree(one.tree(), four.tree()));
    const SubdivisionStats &a = one.tree().stats, &b = four.tree().stats;
    EXPECT_EQ(a.cells_tested, b.cells_tested);
    EXPECT_EQ(a.planes_moved, b.planes_moved);
    EXPECT_EQ(a.max_depth, b.max_depth);
    EXPECT_EQ(a.rejected, b.rejected);
  }
}

TEST(SubdivisionTree, OtherSeeds_GiveOtherPlanes) {
  for (const Scene& scene : test::scenes()) {
    SCOPED_TRACE(scene.name);
    std::array<std::set<double>, 6> side;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const Subdivided run(scene.mesh, seeded(seed));
      ASSERT_TRUE(run.result.ok());
      const Box3& box = run.tree().node[0].box;
      for (int k = 0; k < 3; ++k) {
        side[static_cast<std::size_t>(k)].insert(box.lo[k]);
        side[static_cast<std::size_t>(k + 3)].insert(box.hi[k]);
      }
    }
    for (const auto& s : side) EXPECT_EQ(s.size(), 5u);
  }
}

TEST(SubdivisionTree, CuttingPlanes_MissAllVertices) {
  for (const Scene& scene : test::scenes())
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      SCOPED_TRACE(scene.name);
      const Subdivided run(scene.mesh, seeded(seed, fine(scene.mesh)));
      ASSERT_TRUE(run.result.ok());
      std::array<std::set<double>, 3> taken;
      for (const Point3& p : run.solid.point)
        for (std::size_t k = 0; k < 3; ++k) taken[k].insert(p[static_cast<int>(k)]);
      for (const CellNode& n : run.tree().node) {
        if (n.axis >= 0) EXPECT_FALSE(taken[static_cast<std::size_t>(n.axis)].contains(n.cut));
        for (std::size_t k = 0; k < 3; ++k) {
          EXPECT_FALSE(taken[k].contains(n.box.lo[static_cast<int>(k)]));
          EXPECT_FALSE(taken[k].contains(n.box.hi[static_cast<int>(k)]));
        }
      }
    }
}

std::map<UndecidedReason, std::size_t> undecided(const Subdivision& s) {
  std::map<UndecidedReason, std::size_t> count;
  for (const Leaf& l : s.leaf)
    if (l.theorem == LeafTheorem::kUndecided) ++count[l.reason];
  return count;
}

TEST(SubdivisionBudget, DepthSpent_LeavesUndecidedCellsOfThatDepth) {
  const PolygonMesh mesh = shapes::torus(8, 4, 2, 0.75);
  for (const int depth : {0, 1, 4}) {
    SubdivisionOptions o = seeded(1, 0.5);
    o.max_depth = depth;
    const Subdivided run(mesh, o);
    ASSERT_TRUE(run.result.ok());
    check_tiling(run.tree());
    const auto count = undecided(run.tree());
    ASSERT_EQ(count.size(), 1u) << depth;
    EXPECT_EQ(count.begin()->first, UndecidedReason::kDepth);
    EXPECT_LE(run.tree().stats.max_depth, depth);
    for (const CellNode& n : run.tree().node)
      if (n.axis < 0 && run.tree().leaf[n.leaf].theorem == LeafTheorem::kUndecided)
        EXPECT_EQ(n.depth, depth);
  }
}

TEST(SubdivisionBudget, CellsSpent_LeavesUndecidedCells) {
  const PolygonMesh mesh = shapes::torus(8, 4, 2, 0.75);
  for (const std::size_t cells : {1u, 2u, 10u, 101u}) {
    SubdivisionOptions o = seeded(1, 0.5);
    o.max_cells = cells;
    const Subdivided run(mesh, o);
    ASSERT_TRUE(run.result.ok());
    check_tiling(run.tree());
    EXPECT_LE(run.tree().node.size(), std::max<std::size_t>(cells, 1));
    const auto count = undecided(run.tree());
    ASSERT_EQ(count.size(), 1u);
    EXPECT_EQ(count.begin()->first, UndecidedReason::kCells);
  }
}

TEST(SubdivisionBudget, TimeSpent_LeavesUndecidedCells) {
  const PolygonMesh mesh = shapes::torus(8, 4, 2, 0.75);
  for (const double limit : {1e-12, 0.01}) {
    SubdivisionOptions o = seeded(1, 0.05);
    o.time_limit_s = limit;
    const Subdivided run(mesh, o);
    ASSERT_TRUE(run.result.ok());
    check_tiling(run.tree());
    const auto count = undecided(run.tree());
    ASSERT_EQ(count.size(), 1u);
    EXPECT_EQ(count.begin()->first, UndecidedReason::kTime);
  }
}

TEST(SubdivisionBudget, ProgressRefused_Interrupts) {
  int calls = 0;
  SubdivisionOptions o = seeded(1, 0.2);
  o.on_progress = [&](const Progress&) { return ++calls < 3; };
  const Subdivided run(shapes::torus(8, 4, 2, 0.75), o);
  ASSERT_FALSE(run.result.ok());
  EXPECT_EQ(run.result.error().code, ErrorCode::kInterrupted);
  EXPECT_EQ(calls, 3);
}

TEST(SubdivisionBudget, Progress_RisesToTheWholeBox) {
  std::vector<Progress> seen;
  SubdivisionOptions o = seeded(1, 0.5);
  o.on_progress = [&](const Progress& p) {
    seen.push_back(p);
    return true;
  };
  const Subdivided run(shapes::torus(8, 4, 2, 0.75), o);
  ASSERT_TRUE(run.result.ok());
  ASSERT_GT(seen.size(), 10u);
  for (std::size_t k = 1; k < seen.size(); ++k) {
    EXPECT_GE(seen[k].leaves, seen[k - 1].leaves);
    EXPECT_GE(seen[k].volume_fraction, seen[k - 1].volume_fraction);
  }
  EXPECT_LE(seen.back().volume_fraction, 1 + 1e-9);
  EXPECT_GT(seen.back().volume_fraction, 0.5);
}

TEST(SubdivisionBudget, ReasonNames_AreDistinct) {
  std::set<std::string> names;
  for (const auto r : {UndecidedReason::kDepth, UndecidedReason::kCells, UndecidedReason::kTime,
                       UndecidedReason::kFaceUndecided, UndecidedReason::kMemory})
    names.insert(undecided_reason_name(r));
  EXPECT_EQ(names.size(), 5u);
  EXPECT_FALSE(names.contains("unknown"));
}

}  // namespace
}  // namespace blum
