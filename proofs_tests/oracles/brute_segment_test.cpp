// The oracle's segment diagrams against diagrams worked out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "blum/arrangement/brute_engine.hpp"
#include "blum/kernel/shapes.hpp"
#include "blum/kernel/site_geometry.hpp"

namespace blum {
namespace {

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
  std::optional<SegmentDiagram> segment(int axis, double u, double v, double t0, double t1) const {
    return brute_segment(solid,
                         {axis, working(u_axis(axis), u), working(v_axis(axis), v),
                          working(axis, t0), working(axis, t1)},
                         candidates, triangles);
  }
};

using Kind = Breakpoint::Kind;

TEST(BruteSegment, AcrossACuboid_HasTheTieInTheMiddle) {
  const Scene s(shapes::cuboid(4, 4, 1));
  const auto d = s.segment(2, 1.5, 1.25, -1, 2);
  ASSERT_TRUE(d);
  ASSERT_EQ(d->breakpoint.size(), 3u);
  EXPECT_EQ(d->breakpoint[0].kind, Kind::kBoundary);
  EXPECT_EQ(d->breakpoint[1].kind, Kind::kTie);
  EXPECT_EQ(d->breakpoint[2].kind, Kind::kBoundary);
  const double expected[] = {0, 0.5, 1};
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(d->breakpoint[k].lo, s.working(2, expected[k]));  // doubles are found exactly
    EXPECT_EQ(d->breakpoint[k].hi, s.working(2, expected[k]));
  }
  EXPECT_FALSE(d->interval[0].inside);
  EXPECT_TRUE(d->interval[1].inside);
  EXPECT_TRUE(d->interval[2].inside);
  EXPECT_FALSE(d->interval[3].inside);
  EXPECT_EQ(d->breakpoint[1].below, d->interval[1].witness);
  EXPECT_EQ(d->breakpoint[1].above, d->interval[2].witness);
}

TEST(BruteSegment, CoplanarTriangles_GiveNoBreakpoint) {
  const Scene s(shapes::cuboid(4, 4, 1));
  const auto d = s.segment(0, 1.25, 0.25, 0.5, 3.5);  // crosses the diagonal of the bottom
  ASSERT_TRUE(d);
  EXPECT_TRUE(d->breakpoint.empty());
}

TEST(BruteSegment, ReflexEdge_BreaksAtTheIrrationalPoint) {
  // From the face x = 0 to the reflex edge (1, 1) at height y = 0.25 above y = 0: the governor
  // changes from x = 0 to y = 0 at x = 0.25, and stays y = 0. At y = 0.4375 the edge governs where
  // (x - 1)^2 + (y - 1)^2 < min(x, y)^2.
  const Scene s(shapes::lbracket(4, 3, 1, 8));
  const auto low = s.segment(0, 0.25, 4.5, 0.125, 1.875);
  ASSERT_TRUE(low);
  ASSERT_EQ(low->breakpoint.size(), 1u);
  EXPECT_EQ(low->breakpoint[0].lo, s.working(0, 0.25));
  const double y = 0.375;
  const auto high = s.segment(0, y, 4.5, 0.125, 1.875);
  ASSERT_TRUE(high);
  ASSERT_EQ(high->breakpoint.size(), 1u);
  const double y2 = 0.46875;  // the parabola y^2 = (x-1)^2 + (y-1)^2 has y >= 1/2
  const auto below_vertex = s.segment(0, y2, 4.5, 0.125, 1.875);
  ASSERT_TRUE(below_vertex);
  EXPECT_EQ(below_vertex->breakpoint.size(), 1u);
  const double y3 = 0.5625;
  const auto cut = s.segment(0, y3, 4.5, 0.125, 0.875);
  ASSERT_TRUE(cut);
  ASSERT_EQ(cut->breakpoint.size(), 2u);  // x = 0 | y = 0 | edge
  const double x = 1 - std::sqrt(y3 * y3 - (y3 - 1) * (y3 - 1));
  EXPECT_EQ(cut->breakpoint[0].lo, s.working(0, 0.5625));
  EXPECT_NEAR(cut->breakpoint[1].lo, s.working(0, x), 1e-15);
  EXPECT_LT(cut->breakpoint[1].lo, cut->breakpoint[1].hi);
  EXPECT_EQ(std::nextafter(cut->breakpoint[1].lo, 1), cut->breakpoint[1].hi);
  EXPECT_EQ(SiteIndex(s.solid).kind(cut->interval[2].witness), SiteKind::kEdge);
}

TEST(BruteSegment, EndOnTie_IsBadPosition) {
  const Scene s(shapes::cuboid(4, 4, 1));
  EXPECT_FALSE(s.segment(2, 1.5, 1.25, 0.5, 0.75));
  EXPECT_FALSE(s.segment(2, 1.5, 1.25, 0.25, 0.5));
  EXPECT_TRUE(s.segment(2, 1.5, 1.25, 0.25, 0.5 - 0x1p-40));
}

TEST(BruteSegment, EndOnBoundary_IsBadPosition) {
  const Scene s(shapes::cuboid(4, 4, 1));
  EXPECT_FALSE(s.segment(2, 1.5, 1.25, 0, 0.25));
  EXPECT_FALSE(s.segment(2, 1.5, 1.25, -1, 0));
  EXPECT_TRUE(s.segment(2, 1.5, 1.25, 0x1p-60, 0.25));
  EXPECT_TRUE(s.segment(2, 1.5, 1.25, -0x1p-60, 0.25));
}

TEST(BruteSegment, AlongTieOrFaceOrThroughEdge_IsBadPosition) {
  const Scene s(shapes::cuboid(4, 4, 1));
  EXPECT_FALSE(s.segment(0, 1.25, 0.5, 1.5, 1.75)) << "in the middle sheet";
  EXPECT_FALSE(s.segment(0, 1.25, 0, 1.5, 1.75)) << "in the bottom face";
  EXPECT_FALSE(s.segment(0, 0, 0.25, -1, 5)) << "in the side face";
  EXPECT_FALSE(s.segment(2, 0, 1.5, -1, 2)) << "in the side face, vertical";
  EXPECT_FALSE(s.segment(0, 0, 0, -1, 5)) << "along an edge";
}

TEST(BruteSegment, ThroughSeam_IsBadPositionAndItsNeighboursAreNot) {
  const Scene s(shapes::cuboid(4, 4, 1));
  // Along x at height 0.25 and y = 0.25: bottom, side y = 0 tie all along.
  EXPECT_FALSE(s.segment(0, 0.25, 0.25, 0.0625, 1));
  // Along z at x = 0.25, y = 1: side x = 0 against bottom at z = 0.25, against top at z = 0.75.
  const auto d = s.segment(2, 0.25, 1, 0.125, 0.875);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->breakpoint.size(), 2u);
  // At x = 0.5 all three meet in z = 0.5; an ulp beside there are two ties or one.
  EXPECT_FALSE(s.segment(2, 0.5, 1, 0.125, 0.875));
  const auto left = s.segment(2, 0.5 - 0x1p-51, 1, 0.125, 0.875);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->breakpoint.size(), 2u);
  const auto right = s.segment(2, 0.5 + 0x1p-51, 1, 0.125, 0.875);
  ASSERT_TRUE(right);
  EXPECT_EQ(right->breakpoint.size(), 1u);
}

TEST(BruteSegment, RimCrossing_IsBadPosition) {
  // Below the reflex corner (2, 2, 1) of the floor of an L pocket, see lpocket().
  const Scene s(shapes::lpocket());
  EXPECT_FALSE(s.segment(0, 2, 0.9375, 1.75, 2.25));
  const auto before = s.segment(0, 2 - 0x1p-20, 0.9375, 1.75, 2.25);
  ASSERT_TRUE(before);
  EXPECT_TRUE(before->breakpoint.empty());
  const auto behind = s.segment(0, 2 + 0x1p-20, 0.9375, 1.75, 2.25);
  ASSERT_TRUE(behind);
  EXPECT_EQ(behind->breakpoint.size(), 1u);
}

TEST(BruteSegment, RayWhereFourRedundantRegionsMeet_IsBadPosition) {
  // Along z = 1 beside the pocket's wall x = 1: wall and floor edge govern up to y = 3, the corner
  // (1, 3, 1) and its vertical edge behind. Floor edge and vertical edge are no redundant pair, but
  // all feet meet in the corner: no sheet is there.
  const Scene s(shapes::lpocket());
  EXPECT_FALSE(s.segment(1, 1, 0.875, 2.25, 3.125));
  for (const double e : {-0x1p-30, 0x1p-30}) {
    const auto d = s.segment(1, 1 + e, 0.875, 2.25, 3.125);
    ASSERT_TRUE(d);
    EXPECT_TRUE(d->breakpoint.empty());
  }
}

}  // namespace
}  // namespace blum
