// Which arcs of a Voronoi diagram on a rectangle lie inside the solid: on diagrams of both engines,
// against the places of exact nodes.
#include "blum/subdivision/sided_face.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "blum/arrangement/brute_engine.hpp"
#include "oracles/voronoi_scenes.hpp"

namespace blum {
namespace {

using test::Random;
using test::Scene;

struct Tally {
  int faces = 0, undecided = 0, compared = 0, nodes = 0, crossings = 0, in_arcs = 0;
};

/// The side of all corners of a node's box, if they are on one.
std::optional<bool> side_of(const InsideOracle& inside, const FaceDiagram& d, const FaceNode& n) {
  std::set<InsideOracle::Where> seen;
  for (const double u : {n.u0, n.u1})
    for (const double v : {n.v0, n.v1})
      seen.insert(inside.locate(point_on(d.rect.axis, d.rect.level, u, v)));
  if (seen.size() != 1 || *seen.begin() == InsideOracle::Where::kBoundary) return std::nullopt;
  return *seen.begin() == InsideOracle::Where::kInside;
}

/// Nodes of the exact engine lie in boxes so small that their corners tell the side.
void check_places(const InsideOracle& inside, const FaceDiagram& d, const SidedFace& sides,
                  Tally& tally) {
  std::set<std::uint32_t> crossed;
  for (const auto& c : sides.crossing) crossed.insert(c.node);
  for (std::uint32_t k = 0; k < d.arc.size(); ++k)
    for (const int end : {0, 1}) {
      const auto n = end == 0 ? d.arc[k].from : d.arc[k].to;
      if (crossed.contains(n)) continue;
      const auto side = side_of(inside, d, d.node[n]);
      if (!side) continue;
      ++tally.nodes;
      EXPECT_EQ(sides.inside[k][end], *side);
    }
}

using Arcs = std::multiset<std::pair<std::set<SiteId>, std::multiset<bool>>>;

Arcs arcs_of(const FaceDiagram& d, const SidedFace& sides) {
  Arcs arcs;
  for (std::uint32_t k = 0; k < d.arc.size(); ++k)
    arcs.insert({{d.arc[k].left, d.arc[k].right}, {sides.inside[k][0], sides.inside[k][1]}});
  return arcs;
}

void compare(const Scene& scene, const Rect& r, Tally& tally) {
  const auto near = scene.near(r);
  if (near.size() > 9) return;
  const Solid& solid = *scene.solid;
  const FaceProblem problem{&solid, r, near, {}, true, DiagramKind::kVoronoi};
  ProductionEngine engine = scene.engine();
  const FaceDiagram fast = engine.face(problem), exact = brute_face(problem);
  if (fast.status != FaceStatus::kDecided || exact.status != FaceStatus::kDecided) return;
  const InsideOracle inside(solid);
  std::vector<std::uint32_t> triangles(solid.triangle.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) triangles[t] = t;
  Predicates& predicates = engine.predicates();
  const SidedFace a = sided_face(predicates, inside, fast, triangles),
                  b = sided_face(predicates, inside, exact, triangles);
  tally.faces += 2;
  tally.undecided += !a.decided + !b.decided;
  if (b.decided) check_places(inside, exact, b, tally);
  if (!a.decided || !b.decided) return;
  ASSERT_EQ(a.crossing.size(), b.crossing.size());
  // Over a flat edge the crossing may be taken to be in a node in whose coarse box it lies.
  bool placed_alike = true;
  for (std::size_t k = 0; k < a.crossing.size(); ++k) {
    EXPECT_EQ(a.crossing[k].edge, b.crossing[k].edge);
    const bool in_node = a.crossing[k].node != SidedFace::kNone;
    placed_alike = placed_alike && in_node == (b.crossing[k].node != SidedFace::kNone);
    if (solid.edge[a.crossing[k].edge].kind != EdgeKind::kFlat) {
      EXPECT_TRUE(in_node);
    }
  }
  tally.crossings += static_cast<int>(a.crossing.size());
  // A cluster hides arcs.
  if (placed_alike && std::ranges::all_of(fast.node, &FaceNode::exact)) {
    ++tally.compared;
    EXPECT_EQ(arcs_of(fast, a), arcs_of(exact, b)) << test::describe(scene, r);
  }
  for (const auto& [from, to] : a.inside) tally.in_arcs += from && to;
}

TEST(SidedFace, RandomRectangles_TellTheSideOfEveryExactNode) {
  Random random(5);
  Tally t;
  const auto scenes = test::voronoi_scenes();
  for (int round = 0; round < 60; ++round)
    for (const Scene& scene : scenes) compare(scene, test::voronoi_rect(random, scene), t);
  EXPECT_GT(t.compared, 100);
  EXPECT_GT(t.nodes, 100);
  EXPECT_GT(t.crossings, 20);
  EXPECT_GT(t.in_arcs, 20);
  EXPECT_LE(t.undecided, t.faces / 4);
  std::cout << t.faces << " faces, " << t.undecided << " undecided, " << t.compared << " compared, "
            << t.nodes << " nodes, " << t.crossings << " crossings\n";
}

TEST(SidedFace, RegionsOfEdgesAndVertices_LieInsideAtReflexOnesAlone) {
  const Scene scene("lbracket", shapes::lbracket(), DiagramKind::kVoronoi);
  ProductionEngine engine = scene.engine();
  const SiteGeometry& geometry = engine.predicates().geometry();
  int inside = 0;
  for (const SiteId s : geometry.candidates())
    if (geometry.index().kind(s) != SiteKind::kFace)
      inside += region_is_inside(engine.predicates(), s);
  EXPECT_EQ(inside, 1);  // its one reflex edge, whose ends have convex edges
}

}  // namespace
}  // namespace blum
