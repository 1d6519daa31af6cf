// The mesh predicates against exact arithmetic, across every border by one ulp.
#include "../../kernel/src/exact_geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "../../kernel/src/exact_geometry_number.hpp"

namespace blum::exact {
namespace {

double up(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }
double down(double x) { return std::nextafter(x, -std::numeric_limits<double>::infinity()); }

TEST(Dyadic, ArithmeticBeyondDoubles_IsExact) {
  const Dyadic tiny = 0x1p-1000, huge = 0x1p1000;
  EXPECT_EQ((huge + tiny - huge - tiny).sign(), 0);
  EXPECT_EQ((huge * tiny - Dyadic(1)).sign(), 0);
  EXPECT_EQ(((huge + tiny) * (huge - tiny) - huge * huge).sign(), -1);
}

TEST(Orient2d, OneUlpBesideALine_HasTheRightSign) {
  const double x = 0.1 + 0.2;
  EXPECT_EQ(orient2d(0, 0, 1, 1, x, x), 0);
  EXPECT_EQ(orient2d(0, 0, 1, 1, x, up(x)), 1);
  EXPECT_EQ(orient2d(0, 0, 1, 1, x, down(x)), -1);
  EXPECT_EQ(orient2d(-1e16, -1e16, 1e-3, 1e-3, 0.5, up(0.5)), 1);
}

TEST(Orient2d, GridAroundASlantedLine_AgreesWithExactTwin) {
  for (int i = -64; i <= 64; ++i) {
    for (int j = -64; j <= 64; ++j) {
      const double x = 0.5 + i * 0x1p-53, y = 0.5 + j * 0x1p-53;
      ASSERT_EQ(orient2d(x, y, 12, 12, 24, 24), orient2d_exact(x, y, 12, 12, 24, 24));
    }
  }
}

TEST(Orient3d, OneUlpBesideAPlane_HasTheRightSign) {
  const Point3 a{0, 0, 0.1}, b{1, 0, 0.1}, c{0, 1, 0.1};
  EXPECT_EQ(orient3d(a, b, c, {0.3, 0.3, 0.1}), 0);
  EXPECT_EQ(orient3d(a, b, c, {0.3, 0.3, up(0.1)}), 1);
  EXPECT_EQ(orient3d(a, b, c, {0.3, 0.3, down(0.1)}), -1);
  const Point3 p{1, 0, 0}, q{0, 1, 0}, r{0, 0, 1};
  EXPECT_EQ(orient3d(p, q, r, {0.25, 0.25, 0.5}), 0);
  EXPECT_EQ(orient3d(p, q, r, {0.25, 0.25, up(0.5)}), 1);
  EXPECT_EQ(orient3d(p, q, r, {0.25, down(0.25), 0.5}), -1);
}

TEST(Orient3d, RandomNearlyCoplanarPoints_AgreesWithExactTwinAndIsAntisymmetric) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 20000; ++i) {
    const double scale = std::ldexp(1.0, static_cast<int>(random() % 300) - 150);
    const auto point = [&] { return Point3{scale * unit(random), scale * unit(random), 0}; };
    Point3 a = point(), b = point(), c = point(), d = point();
    for (Point3* p : {&a, &b, &c, &d}) {
      p->z = p->x * 0.3 + p->y * 0.7;
      if (random() % 2) p->z = up(p->z);
    }
    const int s = orient3d(a, b, c, d);
    ASSERT_EQ(s, orient3d_exact(a, b, c, d));
    ASSERT_EQ(s, -orient3d(b, a, c, d));
    ASSERT_EQ(s, -orient3d(a, b, d, c));
  }
}

TEST(Orient3d, UnderflowingCoordinates_AreDecidedExactly) {
  const double t = 0x1p-1000;
  EXPECT_EQ(orient3d({0, 0, 0}, {t, 0, 0}, {0, t, 0}, {0, 0, t}), 1);
  EXPECT_EQ(orient3d({0, 0, 0}, {t, 0, 0}, {0, t, 0}, {t, t, -t}), -1);
  EXPECT_EQ(orient2d(0, 0, t, 0, 0, t), 1);
}

TEST(Collinear, OneUlpBesideALine_IsSeen) {
  EXPECT_TRUE(collinear({0, 0, 0}, {1, 1, 1}, {0.3, 0.3, 0.3}));
  EXPECT_FALSE(collinear({0, 0, 0}, {1, 1, 1}, {0.3, 0.3, up(0.3)}));
  EXPECT_TRUE(collinear({1, 2, 3}, {1, 2, 3}, {4, 5, 6}));
  EXPECT_EQ(projection_axis({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), 2);
}

TEST(SegmentMeetsTriangle, Touching_IsMeetingAndOneUlpAwayIsNot) {
  const Triangle t = {Point3{0, 0, 0}, Point3{1, 0, 0}, Point3{0, 1, 0}};
  EXPECT_TRUE(segment_meets_triangle({0.25, 0.25, 1}, {0.25, 0.25, -1}, t));
  EXPECT_TRUE(segment_meets_triangle({0.25, 0.25, 1}, {0.25, 0.25, 0}, t));
  EXPECT_FALSE(segment_meets_triangle({0.25, 0.25, 1}, {0.25, 0.25, 5e-324}, t));
  EXPECT_TRUE(segment_meets_triangle({0.5, 0.5, 1}, {0.5, 0.5, -1}, t));  // through an edge
  EXPECT_FALSE(segment_meets_triangle({0.5, up(0.5), 1}, {0.5, up(0.5), -1}, t));
  EXPECT_TRUE(segment_meets_triangle({1, 0, 1}, {1, 0, -1}, t));  // through a vertex
  EXPECT_FALSE(segment_meets_triangle({up(1), 0, 1}, {up(1), 0, -1}, t));
}

TEST(SegmentMeetsTriangle, Coplanar_IsDecidedInThePlane) {
  const Triangle t = {Point3{0, 0, 0}, Point3{1, 0, 0}, Point3{0, 1, 0}};
  EXPECT_TRUE(segment_meets_triangle({0.1, 0.1, 0}, {0.2, 0.2, 0}, t));  // inside
  EXPECT_TRUE(segment_meets_triangle({-1, 0.25, 0}, {2, 0.25, 0}, t));   // across
  EXPECT_TRUE(segment_meets_triangle({-1, 0, 0}, {0, 0, 0}, t));         // end at a vertex
  EXPECT_TRUE(segment_meets_triangle({-1, 0, 0}, {2, 0, 0}, t));         // over an edge
  EXPECT_FALSE(segment_meets_triangle({-1, 0, 0}, {-5e-324, 0, 0}, t));  // in line, before it
  EXPECT_FALSE(segment_meets_triangle({0.5, up(0.5), 0}, {1, 1, 0}, t));
}

using Ids = std::array<std::uint32_t, 3>;

TEST(TrianglesMeetImproperly, CommonEdge_OnlyWhenFolded) {
  const std::vector<Point3> p = {{0, 0, 0},  {1, 0, 0},   {0, 1, 0},
                                 {0, -1, 0}, {0.2, 1, 0}, {0.2, 1, 5e-324}};
  EXPECT_FALSE(triangles_meet_improperly(p, Ids{0, 1, 2}, Ids{1, 0, 3}));
  EXPECT_TRUE(triangles_meet_improperly(p, Ids{0, 1, 2}, Ids{1, 0, 4}));
  EXPECT_FALSE(triangles_meet_improperly(p, Ids{0, 1, 2}, Ids{1, 0, 5}));
  EXPECT_TRUE(triangles_meet_improperly(p, Ids{0, 1, 2}, Ids{2, 0, 1}));
}

TEST(TrianglesMeetImproperly, CommonVertex_OnlyBeyondIt) {
  const std::vector<Point3> p = {
      {0, 0, 0},     {1, 0, 0},   {0, 1, 0}, {-1, 0, 0},  {0, -1, 0},   {1, 1, 1},       {1, 1, -1},
      {0.5, 0.5, 0}, {2, 0.5, 0}, {1, 2, 0}, {-1, -1, 1}, {-1, -1, -1}, {0.25, 0.25, 0}, {0, 0, 1}};
  EXPECT_FALSE(triangles_meet_improperly(p, Ids{0, 1, 2}, Ids{0, 3, 4}));  // coplanar, opposite
  EXPECT_FALSE(triangles_meet_improperly(p, Ids{0, 1, 2}, Ids{0, 2, 3}));  // common edge, flat
  EXPECT_TRUE(triangles_meet_improperly(p, Ids{0, 1, 2}, Ids{0, 5, 6}));   // cuts through
  EXPECT_FALSE(triangles_meet_improperly(p, Ids{0, 1, 2}, Ids{0, 10, 11}));
  EXPECT_TRUE(triangles_meet_improperly(p, Ids{0, 1, 2}, Ids{0, 8, 9}));    // coplanar, over it
  EXPECT_TRUE(triangles_meet_improperly(p, Ids{0, 1, 2}, Ids{0, 12, 13}));  // one edge in it
  EXPECT_TRUE(triangles_meet_improperly(p, Ids{0, 12, 13}, Ids{0, 1, 2}));
  EXPECT_FALSE(triangles_meet_improperly(p, Ids{0, 1, 2}, Ids{0, 13, 4}));
}

TEST(TrianglesMeetImproperly, NoCommonVertex_AllDegenerateTouchesAreMeetings) {
  const auto meet = [](const Triangle& s, const Triangle& t) {
    const std::vector<Point3> p = {s[0], s[1], s[2], t[0], t[1], t[2]};
    const bool a = triangles_meet_improperly(p, Ids{0, 1, 2}, Ids{3, 4, 5});
    EXPECT_EQ(a, triangles_meet_improperly(p, Ids{4, 3, 5}, Ids{2, 1, 0}));
    return a;
  };
  const Triangle t = {Point3{0, 0, 0}, Point3{4, 0, 0}, Point3{0, 4, 0}};
  EXPECT_TRUE(meet(t, {Point3{1, 1, 0}, Point3{1, 1, 1}, Point3{2, 1, 1}}));  // vertex in face
  EXPECT_FALSE(meet(t, {Point3{1, 1, 5e-324}, Point3{1, 1, 1}, Point3{2, 1, 1}}));
  EXPECT_TRUE(meet(t, {Point3{1, 1, 0}, Point3{2, 1, 0}, Point3{1, 2, 0}}));    // inside, coplanar
  EXPECT_TRUE(meet(t, {Point3{0, 0, 0}, Point3{-1, 0, 0}, Point3{0, -1, 0}}));  // vertex on vertex
  EXPECT_TRUE(meet(t, {Point3{2, 0, 1}, Point3{2, 0, -1}, Point3{2, -1, 0}}));  // edge on edge
  EXPECT_FALSE(meet(t, {Point3{2, -5e-324, 1}, Point3{2, -5e-324, -1}, Point3{2, -1, 0}}));
  EXPECT_TRUE(meet(t, {Point3{2, 2, 0}, Point3{4, 2, 0}, Point3{4, 4, 0}}));  // coplanar touch
  EXPECT_FALSE(meet(t, {Point3{2, up(2), 0}, Point3{4, up(2), 0}, Point3{4, 4, 0}}));
  EXPECT_FALSE(meet(t, {Point3{0, 0, 1}, Point3{4, 0, 1}, Point3{0, 4, 1}}));       // parallel
  EXPECT_TRUE(meet(t, {Point3{-8, -8, 0}, Point3{32, -8, 0}, Point3{-8, 32, 0}}));  // contains
}

TEST(PointInTriangle, BordersCountAndUlpsDecide) {
  const Triangle t = {Point3{1, 0, 0}, Point3{0, 1, 0}, Point3{0, 0, 1}};
  EXPECT_TRUE(point_in_triangle({0.25, 0.25, 0.5}, t));
  EXPECT_TRUE(point_in_triangle({0.5, 0.5, 0}, t));
  EXPECT_TRUE(point_in_triangle({0, 0, 1}, t));
  EXPECT_FALSE(point_in_triangle({0.25, 0.25, up(0.5)}, t));
  EXPECT_FALSE(point_in_triangle({1, 1, -1}, t));
}

TEST(PolarCone, CornersAreSharpAndSaddlesAreFlat) {
  const Point3 o{0, 0, 0};
  const auto flat = [&](std::vector<Point3> tips) { return polar_cone_sides(o, tips).empty(); };
  EXPECT_FALSE(flat({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_FALSE(flat({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {1, 1, 0}}));
  EXPECT_TRUE(flat({{1, 0, 0}, {0, 1, 0}, {-1, -1, 0}}));            // inside a facet
  EXPECT_TRUE(flat({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));  // on a straight edge
  EXPECT_TRUE(flat({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0.5}, {0, -1, -0.5}, {0, 0, -1}}));
  // A flat cap of a cone, lifted or sunk by the least number.
  EXPECT_FALSE(flat({{1, 0, -5e-324}, {-1, 1, -5e-324}, {-1, -1, -5e-324}}));
  EXPECT_TRUE(flat({{1, 0, 0}, {-1, 1, -1}, {-1, -1, 1}, {0, 0, 1}}));
  EXPECT_FALSE(flat({{1, 0, 0}, {-1, 1, 1}, {-1, -1, 1}, {0, 0, 1}, {0, 0.1, 1}}));
}

TEST(PolarCone, RandomDirections_AgreesWithSearchOverAllPairs) {
  std::mt19937 random(3);
  const auto det = [](const Point3& a, const Point3& b, const Point3& c) {
    return orient3d({0, 0, 0}, a, b, c);
  };
  int flats = 0;
  for (int round = 0; round < 4000; ++round) {
    std::vector<Point3> e;
    const int n = 3 + static_cast<int>(random() % 6);
    const int bias = static_cast<int>(random() % 4);
    while (static_cast<int>(e.size()) < n) {
      const auto c = [&] { return static_cast<double>(static_cast<int>(random() % 5) - 2); };
      Point3 p{c(), c(), c() + bias};
      if (!(p == Point3{0, 0, 0})) e.push_back(p);
    }
    bool spans = false;
    for (const Point3& a : e)
      for (const Point3& b : e)
        for (const Point3& c : e) spans |= det(a, b, c) != 0;
    if (!spans) continue;  // outside the contract
    // The closed cone is spanned by its extreme rays +-(a x b); it has an interior iff for each c
    // one of them is strictly inside.
    std::vector<bool> strict(e.size(), false);
    for (const Point3& a : e) {
      for (const Point3& b : e) {
        if (collinear({0, 0, 0}, a, b)) continue;
        for (const int sign : {1, -1}) {
          bool in = true;
          for (const Point3& c : e) in &= sign * det(a, b, c) <= 0;
          if (!in) continue;
          for (std::size_t k = 0; k < e.size(); ++k) {
            strict[k] = strict[k] || sign * det(a, b, e[k]) < 0;
          }
        }
      }
    }
    const bool flat = std::find(strict.begin(), strict.end(), false) != strict.end();
    flats += flat;
    ASSERT_EQ(polar_cone_sides({0, 0, 0}, e).empty(), flat) << "round " << round;
  }
  EXPECT_GT(flats, 500);
  EXPECT_LT(flats, 3500);
}

TEST(VolumeSign, ThinShell_IsDecidedExactly) {
  const Point3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, d{0.3, 0.3, 5e-324};
  EXPECT_EQ(volume_sign(std::vector<Triangle>{{a, c, b}, {a, b, d}, {b, c, d}, {c, a, d}}), 1);
  EXPECT_EQ(volume_sign(std::vector<Triangle>{{a, b, c}, {a, d, b}, {b, d, c}, {c, d, a}}), -1);
}

}  // namespace
}  // namespace blum::exact
