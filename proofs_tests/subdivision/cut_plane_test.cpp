// Planes with few bits: sides and enclosures against rational arithmetic, proposals against both
// sets of points.

#include "blum/subdivision/cut_plane.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace blum {
namespace {

mpq_class height(const CutPlane& plane, const Point3& x) {
  mpq_class h = -mpq_class(plane.offset);
  for (int k = 0; k < 3; ++k) h += plane.normal[static_cast<std::size_t>(k)] * mpq_class(x[k]);
  return h;
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  int whole(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(engine_); }
  double real() { return std::uniform_real_distribution<double>(-1, 1)(engine_); }
  /// Every second coordinate is a small dyadic number: coincidences are met.
  double coordinate() { return whole(0, 1) == 0 ? real() : whole(-8, 8) / 8.0; }
  Point3 point() { return {coordinate(), coordinate(), coordinate()}; }
  CutPlane plane() {
    const int size = 1 << whole(0, 6);
    CutPlane p;
    do {
      for (int& n : p.normal) n = whole(0, 2) == 0 ? 0 : whole(-size, size);
    } while (p.normal == std::array<int, 3>{});
    p.offset = coordinate();
    return p;
  }
  Box3 box() {
    Box3 b{point(), point()};
    for (int k = 0; k < 3; ++k) {
      if (whole(0, 4) == 0) b.hi[k] = b.lo[k];
      if (b.lo[k] > b.hi[k]) std::swap(b.lo[k], b.hi[k]);
    }
    return b;
  }

 private:
  std::mt19937 engine_;
};

std::vector<Point3> corners(const Box3& b) {
  std::vector<Point3> all;
  for (int c = 0; c < 8; ++c)
    all.push_back({(c & 1) != 0 ? b.hi.x : b.lo.x, (c & 2) != 0 ? b.hi.y : b.lo.y,
                   (c & 4) != 0 ? b.hi.z : b.lo.z});
  return all;
}

TEST(CutPlane, Sides_AreThoseOfAllCornersExactly) {
  Random random(1);
  int certain = 0, touched = 0, points = 0, on_plane = 0;
  for (int i = 0; i < 20000; ++i) {
    const CutPlane plane = random.plane();
    const Box3 box = random.box();
    const int s = side_of(plane, box);
    certain += s == 1 || s == -1;
    int low = 1, high = -1;
    for (const Point3& c : corners(box)) {
      const int exact = sgn(height(plane, c));
      low = std::min(low, exact);
      high = std::max(high, exact);
      const int at_corner = side_of(plane, c);
      ++points;
      if (exact == 0) {
        ++on_plane;
        EXPECT_TRUE(at_corner == 0 || at_corner == 2);
      } else {
        EXPECT_EQ(at_corner, exact);  // these points are far enough from the plane
      }
    }
    touched += low <= 0 && high >= 0;
    if (s == 1) EXPECT_EQ(low, 1);
    if (s == -1) EXPECT_EQ(high, -1);
    if (low <= 0 && high >= 0) EXPECT_TRUE(s == 0 || s == 2);
  }
  EXPECT_GT(certain, 3000);
  EXPECT_GT(touched, 3000);
  EXPECT_GT(on_plane, 300);
}

TEST(CutPlane, BoxAroundASection_HoldsItAndIsTight) {
  Random random(2);
  int met = 0, tighter = 0;
  for (int i = 0; i < 5000; ++i) {
    const CutPlane plane = random.plane();
    const Box3 box = random.box();
    const auto around = around_section(plane, box);
    // Points of the section: where the plane meets segments between corners.
    const std::vector<Point3> corner = corners(box);
    bool meets = false;
    for (std::size_t a = 0; a < 8; ++a)
      for (std::size_t b = 0; b <= a; ++b) {
        const mpq_class ha = height(plane, corner[a]), hb = height(plane, corner[b]);
        if (sgn(ha) * sgn(hb) > 0) continue;
        meets = true;
        const mpq_class s = ha == hb ? mpq_class(0) : mpq_class(ha / (ha - hb));
        if (ha == hb && ha != 0) continue;
        ASSERT_TRUE(around);
        for (int k = 0; k < 3; ++k) {
          const mpq_class x =
              mpq_class(corner[a][k]) + s * (mpq_class(corner[b][k]) - mpq_class(corner[a][k]));
          ASSERT_TRUE(x >= around->lo[k] && x <= around->hi[k]);
        }
      }
    met += meets;
    if (around)
      for (int k = 0; k < 3; ++k) {
        EXPECT_GE(around->lo[k], box.lo[k]);
        EXPECT_LE(around->hi[k], box.hi[k]);
        tighter += around->hi[k] - around->lo[k] < 0.99 * (box.hi[k] - box.lo[k]);
      }
  }
  EXPECT_GT(met, 1000);
  EXPECT_GT(tighter, 1000);
}

TEST(CutPlane, SectionParallelToTheAxes_IsFlat) {
  const auto around = around_section({{0, 1, 0}, 0.3}, {{0, 0, 0}, {1, 1, 1}});
  ASSERT_TRUE(around);
  EXPECT_LE(around->lo.y, 0.3);
  EXPECT_GE(around->hi.y, 0.3);
  EXPECT_LT(around->hi.y - around->lo.y, 1e-15);
  EXPECT_FALSE(around_section({{0, 1, 0}, 1.5}, {{0, 0, 0}, {1, 1, 1}}));
}

TEST(CutPlane, BetweenSeparableSets_LeavesThemOnTheirSides) {
  Random random(3);
  int parted = 0, axis_parallel = 0;
  for (int i = 0; i < 3000; ++i) {
    // Points on both sides of a hidden plane, a tenth away from it.
    const double n[] = {random.real(), random.real(), random.real()};
    const double length = std::hypot(n[0], n[1], n[2]);
    std::array<std::vector<Point3>, 2> set;
    while (set[0].size() < 6 || set[1].size() < 6) {
      const Point3 p{random.real(), random.real(), random.real()};
      const double h = (n[0] * p.x + n[1] * p.y + n[2] * p.z) / length;
      if (std::abs(h) > 0.1) set[h > 0 ? 1 : 0].push_back(p);
    }
    const auto between = plane_between(set[0], set[1]);
    ASSERT_TRUE(between);
    ++parted;
    for (int side = 0; side < 2; ++side)
      for (const Point3& p : set[static_cast<std::size_t>(side)])
        EXPECT_EQ(side_of(between->plane, p), side == 0 ? -1 : 1);
    EXPECT_GT(between->gap, 0);
    axis_parallel += std::ranges::count(between->plane.normal, 0) == 2;
  }
  EXPECT_EQ(parted, 3000);
  EXPECT_GT(axis_parallel, 0);
}

TEST(CutPlane, BetweenSetsWithACommonPoint_IsNone) {
  const std::vector<Point3> a{{0, 0, 0}, {1, 0, 0}}, b{{0.5, -1, 0}, {0.5, 1, 0}};
  EXPECT_FALSE(plane_between(a, b));
  EXPECT_FALSE(plane_between(a, a));
}

}  // namespace
}  // namespace blum
