// The oracle's rectangle diagrams against diagrams worked out by hand, and their degenerate cases
// with neighbours one step away.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "blum/arrangement/brute_engine.hpp"
#include "blum/kernel/shapes.hpp"
#include "blum/kernel/site_geometry.hpp"

namespace blum {
namespace {

using NodeKind = FaceNode::Kind;

/// A solid in model units: all its triangles, all sites that can govern.
struct Scene {
  Solid solid;
  std::vector<SiteId> candidates;
  std::vector<std::uint32_t> triangles;

  explicit Scene(const PolygonMesh& mesh) : solid(build_solid(mesh).value()) {
    const SiteGeometry geometry(solid);
    candidates.assign(geometry.candidates().begin(), geometry.candidates().end());
    triangles.resize(solid.triangle.size());
    std::iota(triangles.begin(), triangles.end(), 0u);
  }
  double working(int axis, double x) const {
    return std::ldexp(x - solid.frame.origin[axis], -solid.frame.exponent);
  }
  Rect rect(int axis, double level, double u0, double u1, double v0, double v1) const {
    const int u = u_axis(axis), v = v_axis(axis);
    return {axis,           working(axis, level), working(u, u0),
            working(u, u1), working(v, v0),       working(v, v1)};
  }
  FaceDiagram face(const Rect& r) const { return brute_face({&solid, r, candidates, triangles}); }
  FaceDiagram face(int axis, double level, double u0, double u1, double v0, double v1) const {
    return face(rect(axis, level, u0, u1, v0, v1));
  }
  SiteKind kind(SiteId s) const { return SiteIndex(solid).kind(s); }
};

long count(const FaceDiagram& d, NodeKind kind) {
  return std::count_if(d.node.begin(), d.node.end(),
                       [&](const FaceNode& n) { return n.kind == kind; });
}

std::size_t degree(const FaceDiagram& d, std::size_t node) {
  std::size_t n = 0;
  for (const FaceArc& a : d.arc) n += (a.from == node ? 1u : 0u) + (a.to == node ? 1u : 0u);
  return n;
}

/// What holds for every diagram; the checks of a decided one.
void expect_sound(const FaceDiagram& d) {
  ASSERT_EQ(d.status, FaceStatus::kDecided) << d.reason;
  for (int side = 0; side < 4; ++side) {
    const auto k = static_cast<std::size_t>(side);
    ASSERT_EQ(d.side_region[k].size(), d.side[k]->interval.size());
    for (std::size_t i = 0; i < d.side_region[k].size(); ++i) {
      const auto& interval = d.side[k]->interval[i];
      ASSERT_EQ(d.side_region[k][i] != FaceDiagram::kOutside, interval.inside);
      if (!interval.inside) continue;
      const auto& labels = d.region[d.side_region[k][i]].labels;
      EXPECT_TRUE(std::binary_search(labels.begin(), labels.end(), interval.witness));
    }
  }
  for (std::size_t n = 0; n < d.node.size(); ++n) {
    const FaceNode& node = d.node[n];
    EXPECT_TRUE(node.exact);
    EXPECT_LE(node.u0, node.u1);
    EXPECT_LE(node.v0, node.v1);
    EXPECT_TRUE(std::is_sorted(node.governors.begin(), node.governors.end()));
    if (node.kind != NodeKind::kEvent) {
      EXPECT_EQ(degree(d, n), 1u) << n;
    }
  }
  for (const FaceNode& n : d.node) EXPECT_LT(n.piece, d.piece.size());
  for (const FaceArc& a : d.arc) {
    EXPECT_NE(a.left, a.right);
    for (const std::uint32_t r : a.region) {
      ASSERT_LT(r, d.region.size());
      EXPECT_EQ(d.region[r].piece, d.node[a.from].piece);
    }
    const auto has = [&](int k, SiteId s) {
      const auto& labels = d.region[a.region[static_cast<std::size_t>(k)]].labels;
      return std::binary_search(labels.begin(), labels.end(), s);
    };
    EXPECT_TRUE((has(0, a.left) && has(1, a.right)) || (has(1, a.left) && has(0, a.right)));
  }
  for (const FaceTrace& t : d.trace) EXPECT_LT(t.region, d.region.size());
}

TEST(BruteFace, CuboidSection_IsItsRectangleWithRoof) {
  const Scene s(shapes::cuboid(4, 3, 2));
  const FaceDiagram d = s.face(2, 0.75, -0.5, 4.5, -0.5, 3.5);
  expect_sound(d);
  EXPECT_EQ(count(d, NodeKind::kEvent), 4);
  EXPECT_EQ(count(d, NodeKind::kConvexEdge), 4);
  EXPECT_EQ(d.node.size(), 8u);
  EXPECT_EQ(d.arc.size(), 8u);
  EXPECT_EQ(d.region.size(), 5u);
  ASSERT_EQ(d.piece.size(), 1u);
  EXPECT_EQ(d.piece[0].boundary_circles, 1u);
  EXPECT_EQ(d.trace.size(), 8u);        // two triangles a wall
  EXPECT_EQ(d.trace_point.size(), 8u);  // four edges, four diagonals
  for (const FaceNode& n : d.node)
    EXPECT_EQ(n.governors.size(), n.kind == NodeKind::kEvent ? 3 : 2);
}

TEST(BruteFace, RectangleInside_HasSideNodes) {
  const Scene s(shapes::cuboid(4, 3, 2));
  const FaceDiagram d = s.face(2, 0.75, 0.5, 3.6875, 0.4375, 2.625);
  expect_sound(d);
  EXPECT_EQ(count(d, NodeKind::kEvent), 4);
  EXPECT_EQ(count(d, NodeKind::kSide), 4);
  EXPECT_EQ(d.arc.size(), 8u);
  EXPECT_EQ(d.region.size(), 5u);
  EXPECT_TRUE(d.trace.empty());
}

TEST(BruteFace, RectangleWithoutTies_HasOneRegion) {
  const Scene s(shapes::cuboid(4, 3, 2));
  const FaceDiagram d = s.face(2, 0.25, 1, 2, 1, 2);  // crosses the diagonal of the floor
  expect_sound(d);
  EXPECT_TRUE(d.node.empty());
  ASSERT_EQ(d.region.size(), 1u);
  EXPECT_EQ(d.region[0].labels.size(), 2u);
}

TEST(BruteFace, RectangleOutside_IsEmpty) {
  const Scene s(shapes::cuboid(4, 3, 2));
  const FaceDiagram d = s.face(2, 0.25, 5, 6, 1, 2);
  expect_sound(d);
  EXPECT_TRUE(d.node.empty() && d.region.empty() && d.piece.empty());
  for (const auto& side : d.side_region)
    EXPECT_EQ(side, std::vector<std::uint32_t>{FaceDiagram::kOutside});
}

TEST(BruteFace, SquareSection_HasOneEventOfFourFaces) {
  const Scene s(shapes::cuboid(4, 2, 2));
  const FaceDiagram d = s.face(0, 1.75, 0.25, 1.625, 0.3125, 1.8125);
  expect_sound(d);
  ASSERT_EQ(count(d, NodeKind::kEvent), 1);
  const auto event = std::find_if(d.node.begin(), d.node.end(),
                                  [](const FaceNode& n) { return n.kind == NodeKind::kEvent; });
  EXPECT_EQ(event->governors.size(), 4u);
  EXPECT_LE(event->u0, s.working(1, 1));
  EXPECT_GE(event->u1, s.working(1, 1));
  EXPECT_EQ(d.arc.size(), 4u);
  EXPECT_EQ(d.region.size(), 4u);
}

TEST(BruteFace, NearlySquareSection_HasTwoEvents) {
  for (const double ulps : {-1.0, 1.0}) {
    const Scene s(shapes::cuboid(4, 2, 2 + std::ldexp(ulps, -51)));
    const FaceDiagram d = s.face(0, 1.75, 0.25, 1.625, 0.3125, 1.8125);
    expect_sound(d);
    EXPECT_EQ(count(d, NodeKind::kEvent), 2);
    EXPECT_EQ(d.arc.size(), 5u);
    EXPECT_EQ(d.region.size(), 4u);
  }
}

TEST(BruteFace, SheetInThePlane_IsBadPositionAndItsNeighboursAreNot) {
  const Scene s(shapes::cuboid(4, 3, 2));
  EXPECT_EQ(s.face(2, 1, 1.5, 2.5, 1.25, 1.75).status, FaceStatus::kBadPosition);
  EXPECT_EQ(s.face(2, 1, 0.5, 3.6875, 0.4375, 2.625).status, FaceStatus::kBadPosition);
  for (const double e : {-0x1p-52, 0x1p-52}) {
    const FaceDiagram d = s.face(2, 1 + e, 0.5, 3.6875, 0.4375, 2.625);
    expect_sound(d);
    EXPECT_EQ(count(d, NodeKind::kEvent), 4);
  }
}

TEST(BruteFace, BadPositions_AreSeen) {
  const Scene s(shapes::cuboid(4, 3, 2));
  EXPECT_EQ(s.face(2, 0, 1, 2, 1, 2).status, FaceStatus::kBadPosition) << "in a face";
  EXPECT_EQ(s.face(2, 0, -1, 5, -1, 4).status, FaceStatus::kBadPosition) << "in a face, around it";
  EXPECT_EQ(s.face(2, 0.5, 0, 2, 1, 2).status, FaceStatus::kBadPosition) << "side in a face";
  EXPECT_EQ(s.face(2, 0.5, 0.25, 2, 0.25, 2).status, FaceStatus::kBadPosition) << "corner on a tie";
  EXPECT_EQ(s.face(2, 0.5, -1, 0.25, 0, 2).status, FaceStatus::kBadPosition) << "edge on a side";
  EXPECT_EQ(s.face(2, 0.5, -1, 0.5, 0.25, 2.75).status, FaceStatus::kBadPosition)
      << "event on side";
  EXPECT_EQ(s.face(2, 0.5, -1, 0.5 + 0x1p-52, 0.25, 2.75).status, FaceStatus::kDecided);
}

TEST(BruteFace, ReflexEdge_HasParabolaArcsFromIrrationalEvent) {
  const Scene s(shapes::lbracket());
  const FaceDiagram d = s.face(2, 0.875, 0.3, 1.3, 0.4, 1.45);
  expect_sound(d);
  ASSERT_EQ(count(d, NodeKind::kEvent), 1);
  ASSERT_EQ(count(d, NodeKind::kSide), 3);
  const auto event = std::find_if(d.node.begin(), d.node.end(),
                                  [](const FaceNode& n) { return n.kind == NodeKind::kEvent; });
  const double x = s.working(0, 2 - std::sqrt(2.0));
  EXPECT_NEAR(event->u0, x, 1e-15);
  EXPECT_LT(event->u1 - event->u0, 1e-15);
  EXPECT_EQ(event->governors.size(), 3u);
  EXPECT_EQ(d.arc.size(), 3u);
  EXPECT_EQ(d.region.size(), 3u);
  ASSERT_EQ(d.piece.size(), 1u);
  EXPECT_EQ(d.trace.size(), 2u);
  EXPECT_EQ(d.trace_point.size(), 1u);  // the reflex edge; no node of G there
}

TEST(BruteFace, PocketRim_IsANodeOfDegreeOne) {
  const Scene s(shapes::lpocket());
  const FaceDiagram d = s.face(2, 0.875, 1.25, 2.75, 1.375, 2.6875);
  expect_sound(d);
  ASSERT_EQ(count(d, NodeKind::kRim), 1);
  ASSERT_EQ(count(d, NodeKind::kSide), 1);
  EXPECT_EQ(d.arc.size(), 1u);
  ASSERT_EQ(d.region.size(), 1u);
  for (const FaceNode& n : d.node)
    if (n.kind == NodeKind::kRim) {
      EXPECT_LE(n.u0, s.working(0, 2));
      EXPECT_GE(n.u1, s.working(0, 2));
      EXPECT_LT(n.u1 - n.u0, 1e-15);
      EXPECT_GE(n.governors.size(), 3u);  // two edges and a floor face
    }
  EXPECT_EQ(d.side_region[kHighU].size() + d.side_region[kHighV].size(), 3u);
}

TEST(BruteFace, RimInThePlaneOrOnASide_IsBadPosition) {
  const Scene s(shapes::lpocket());
  EXPECT_EQ(s.face(0, 2, 1.5, 2.5, 0.8125, 0.9375).status, FaceStatus::kBadPosition);
  EXPECT_EQ(s.face(2, 0.875, 1.25, 2, 1.375, 2.6875).status, FaceStatus::kBadPosition);
  const FaceDiagram behind = s.face(0, 2 + 0x1p-40, 1.5, 2.5, 0.8125, 0.9375);
  expect_sound(behind);
  EXPECT_EQ(behind.arc.size(), 1u);
  const FaceDiagram before = s.face(0, 2 - 0x1p-40, 1.5, 2.5, 0.8125, 0.9375);
  expect_sound(before);
  EXPECT_TRUE(before.arc.empty());
}

TEST(BruteFace, PocketSection_HasSixGovernorsAtOneEvent) {
  // Above the floor the pocket's section is an L; by symmetry two walls, two ends of its arms and
  // two of its edges tie on the diagonal.
  const Scene s(shapes::lpocket());
  const FaceDiagram d = s.face(2, 1.40625, 2.5, 3.75, 2.3125, 3.8125);
  expect_sound(d);
  std::size_t most = 0;
  for (const FaceNode& n : d.node) most = std::max(most, n.governors.size());
  EXPECT_GE(most, 6u);
}

TEST(BruteFace, HoleInAPlate_GivesTwoCirclesAndALoop) {
  const Scene s(shapes::plate(1, 4, 4, 1));
  const FaceDiagram d = s.face(2, 0.25, -1, 5, -1, 5);
  expect_sound(d);
  ASSERT_EQ(d.piece.size(), 1u);
  EXPECT_EQ(d.piece[0].boundary_circles, 2u);
  EXPECT_EQ(count(d, NodeKind::kConvexEdge), 4);
  EXPECT_EQ(count(d, NodeKind::kEvent), 5);  // four corners and one on the loop
  EXPECT_EQ(d.region.size(), 6u);            // four walls, the floor, the hole's wall
  EXPECT_EQ(d.arc.size(), 9u);
}

/// The box [-4,4]^2 x [0,2] with a pyramid pit of depth 1 in its top, apex in (0,0,1).
PolygonMesh pyramid_pit() {
  PolygonMesh m;
  m.points = {{-4, -4, 0}, {4, -4, 0},   {4, 4, 0},  {-4, 4, 0},    {-4, -4, 2},
              {4, -4, 2},  {4, 4, 2},    {-4, 4, 2}, {-.5, -.5, 2}, {.5, -.5, 2},
              {.5, .5, 2}, {-.5, .5, 2}, {0, 0, 1}};
  m.faces = {{3, 2, 1, 0}, {0, 1, 5, 4},  {1, 2, 6, 5},   {2, 3, 7, 6},  {3, 0, 4, 7},
             {4, 5, 9, 8}, {5, 6, 10, 9}, {6, 7, 11, 10}, {7, 4, 8, 11}, {8, 9, 12},
             {9, 10, 12},  {10, 11, 12},  {11, 8, 12}};
  return m;
}

TEST(BruteFace, SheetTouchingThePlane_IsAnIsolatedNodeBetweenNoneAndALoop) {
  // The sheet of the apex and the bottom is z = (1 + r^2) / 2.
  const Scene s(pyramid_pit());
  const FaceDiagram below = s.face(2, 0.5 - 0x1p-50, -0.25, 0.3125, -0.28125, 0.34375);
  expect_sound(below);
  EXPECT_TRUE(below.node.empty());
  EXPECT_EQ(below.region.size(), 1u);

  const FaceDiagram at = s.face(2, 0.5, -0.25, 0.3125, -0.28125, 0.34375);
  ASSERT_EQ(at.status, FaceStatus::kDecided) << at.reason;
  ASSERT_EQ(at.node.size(), 1u);
  EXPECT_EQ(at.node[0].kind, NodeKind::kEvent);
  EXPECT_GE(at.node[0].governors.size(), 2u);
  EXPECT_TRUE(at.arc.empty());
  EXPECT_EQ(at.region.size(), 1u);

  const FaceDiagram above = s.face(2, 0.5 + 0x1p-50, -0.25, 0.3125, -0.28125, 0.34375);
  expect_sound(above);
  ASSERT_EQ(above.node.size(), 1u);
  ASSERT_EQ(above.arc.size(), 1u);
  EXPECT_EQ(above.arc[0].from, above.arc[0].to);
  EXPECT_EQ(above.region.size(), 2u);
}

/// A box with a V-groove along y from above (ridge z = 2) and one along x from below (z = 0).
PolygonMesh crossed_grooves() {
  PolygonMesh m;
  m.points = {// y = -8: outline of the upper part with the notch; then y = 8
              {-8, -8, 6},
              {-2, -8, 6},
              {0, -8, 2},
              {2, -8, 6},
              {8, -8, 6},
              {-8, 8, 6},
              {-2, 8, 6},
              {0, 8, 2},
              {2, 8, 6},
              {8, 8, 6},
              // x = -8: the lower notch; then x = 8
              {-8, -8, -4},
              {-8, -2, -4},
              {-8, 0, 0},
              {-8, 2, -4},
              {-8, 8, -4},
              {8, -8, -4},
              {8, -2, -4},
              {8, 0, 0},
              {8, 2, -4},
              {8, 8, -4}};
  m.faces = {{0, 10, 15, 4, 3, 2, 1},
             {9, 19, 14, 5, 6, 7, 8},  // y = -8, 8
             {0, 5, 14, 13, 12, 11, 10},
             {4, 15, 16, 17, 18, 19, 9},  // x = -8, 8
             {0, 1, 6, 5},
             {1, 2, 7, 6},
             {2, 3, 8, 7},
             {3, 4, 9, 8},  // top
             {10, 11, 16, 15},
             {11, 12, 17, 16},
             {12, 13, 18, 17},
             {13, 14, 19, 18}};
  return m;
}

TEST(BruteFace, SaddleTangency_IsACrossingOfTwoGovernors) {
  // Two skew edges: d^2 = x^2 + (2-z)^2 and y^2 + z^2; at z = 1 the tie is y^2 = x^2.
  const Scene s(crossed_grooves());
  const FaceDiagram at = s.face(2, 1, -0.25, 0.3125, -0.28125, 0.34375);
  expect_sound(at);
  ASSERT_EQ(count(at, NodeKind::kEvent), 1);
  EXPECT_EQ(count(at, NodeKind::kSide), 4);
  EXPECT_EQ(at.arc.size(), 4u);
  EXPECT_EQ(at.region.size(), 4u);
  for (const FaceNode& n : at.node) EXPECT_EQ(n.governors.size(), 2u);
  for (const double e : {-0x1p-49, 0x1p-49}) {
    const FaceDiagram beside = s.face(2, 1 + e, -0.25, 0.3125, -0.28125, 0.34375);
    expect_sound(beside);
    EXPECT_EQ(count(beside, NodeKind::kEvent), 0);
    EXPECT_EQ(beside.arc.size(), 2u);
    EXPECT_EQ(beside.region.size(), 3u);
  }
}

TEST(BruteFace, PlaneThroughTheHole_CutsTwoPieces) {
  const Scene s(shapes::plate(1, 4, 4, 1));  // the hole is the square with corners (1,1), (3,3)
  const FaceDiagram d = s.face(0, 2.0625, -0.5, 4.5, -0.5, 1.5);
  expect_sound(d);
  EXPECT_EQ(d.piece.size(), 2u);
  for (const FacePiece& p : d.piece) EXPECT_EQ(p.boundary_circles, 1u);
  EXPECT_EQ(count(d, NodeKind::kConvexEdge), 8);
}

TEST(BruteFace, AllSitesAsCandidates_GiveTheSameMap) {
  Scene s(shapes::lbracket());
  const Rect r = s.rect(2, 0.875, 0.3, 1.3, 0.4, 1.45);
  const FaceDiagram few = s.face(r);
  s.candidates.clear();
  for (std::uint32_t k = 0; k < SiteIndex(s.solid).size(); ++k) s.candidates.push_back({k});
  const FaceDiagram all = s.face(r);
  expect_sound(all);
  EXPECT_EQ(few.side_region, all.side_region);
  EXPECT_EQ(few.arc.size(), all.arc.size());
  ASSERT_EQ(few.region.size(), all.region.size());
  for (std::size_t k = 0; k < few.region.size(); ++k)
    EXPECT_EQ(few.region[k].labels, all.region[k].labels);
}

TEST(BruteFace, RotatedCuboid_HasNearlyCoplanarTrianglesApart) {
  // Rounding makes every facet two triangles with a dihedral defect of about 1e-16; the tie across
  // such a convex diagonal is a sheet of its own.
  const Scene s(shapes::rotate_rounded(shapes::cuboid(4, 3, 2), 1));
  const FaceDiagram d = s.face(2, 0.25, -3, 3, -3, 3.5);
  expect_sound(d);
  EXPECT_GE(d.region.size(), 4u);
}

}  // namespace
}  // namespace blum
