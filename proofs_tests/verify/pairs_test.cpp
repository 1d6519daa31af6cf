// What the checker says of pairs of sites on a box and its halves, at points of the box.
#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "certificates.hpp"
#include "gains.hpp"

namespace blum::test {
namespace {

using verify::Rational;
using verify::Site;
using verify::Vec;

struct Checked {
  Solid solid;
  verify::Shape shape;
  verify::Sites sites;
  verify::Exclusion exclusion;
  explicit Checked(const PolygonMesh& mesh)
      : solid(build_solid(mesh).value()),
        shape(solid.point, triangles(solid)),
        sites(shape),
        exclusion(sites) {}
  [[nodiscard]] std::vector<std::uint32_t> every_triangle() const {
    std::vector<std::uint32_t> every(shape.triangle.size());
    std::iota(every.begin(), every.end(), 0u);
    return every;
  }
  [[nodiscard]] bool governs_nothing(Site s, const Box3& box, std::span<const Site> against,
                                     std::span<const std::uint32_t> every, int most) const {
    return exclusion.may_govern({&s, 1}, box, against, every, most).empty();
  }
  static std::vector<std::array<std::uint32_t, 3>> triangles(const Solid& s) {
    std::vector<std::array<std::uint32_t, 3>> t;
    for (const SolidTriangle& x : s.triangle) t.push_back(x.vertex);
    return t;
  }
};

/// Two faces at a distance, a rectangle that crosses the one, and the points between them.
TEST(VerifyExclusion, FarWallOfAThinPlate_OneLookTellsAcrossTheNearOne) {
  const Checked c(shapes::cuboid(1, 1, 1e-4));
  double high = 0;
  for (const Point3& p : c.solid.point) high = std::max(high, p.z);
  const double thick = high, x = 0.31, y = 0.37;
  Site bottom = 0, top = 0;
  const Box3 box{{x, y, 0.7 * thick}, {x + 0.01, y, 60 * thick}};
  for (std::uint32_t t = 0; t < c.shape.triangle.size(); ++t) {
    const Site s = c.shape.face_site(t);
    if (!c.sites.covers(s, box)) continue;
    const double z = c.shape.point[c.shape.triangle[t].vertex[0]].z;
    if (z == 0 && c.shape.normal<Rational>(t)[2] != 0) bottom = s;
    if (z == high && c.shape.normal<Rational>(t)[2] != 0) top = s;
  }
  ASSERT_NE(bottom, top);
  const std::vector<Site> both{bottom, top};
  const auto every = c.every_triangle();
  EXPECT_TRUE(c.governs_nothing(bottom, box, both, every, 1));
  EXPECT_FALSE(c.governs_nothing(top, box, both, every, 1000));
}

/// A hall with a flat roof, and a box below the ridge, nearer to the roof than to the floor by less
/// than its own size: neither half of the roof covers it.
TEST(VerifyExclusion, FloorOfAHallBelowItsRidge_OneLookTells) {
  PolygonMesh hall;
  for (const double y : {-2.0, 2.0})
    for (const auto& [x, z] :
         {std::pair{-2.0, 0.0}, {2.0, 0.0}, {2.0, 0.9}, {0.0, 1.0}, {-2.0, 0.9}})
      hall.points.push_back({x, y, z});
  hall.faces = {{0, 1, 2, 3, 4}, {9, 8, 7, 6, 5}, {0, 5, 6, 1}, {1, 6, 7, 2},
                {2, 7, 8, 3},    {3, 8, 9, 4},    {4, 9, 5, 0}};
  const Checked c(hall);
  const auto below_ridge = [&](double z) {
    return Box3{c.solid.frame.to_working({-0.15, 1.2, z - 0.01}),
                c.solid.frame.to_working({0.15, 1.5, z + 0.01})};
  };
  const double floor = c.solid.frame.to_working({0, 0, 0}).z;
  std::vector<Site> under, every_site;
  for (std::uint32_t t = 0; t < c.shape.triangle.size(); ++t) {
    every_site.push_back(c.shape.face_site(t));
    bool flat = true;
    for (const auto v : c.shape.triangle[t].vertex) flat &= c.shape.point[v].z == floor;
    if (flat && !c.sites.beyond(every_site.back(), below_ridge(0.55)))
      under.push_back(every_site.back());
  }
  ASSERT_FALSE(under.empty());
  const auto every = c.every_triangle();
  for (const Site s : under) {
    EXPECT_TRUE(c.governs_nothing(s, below_ridge(0.55), every_site, every, 1));
    EXPECT_FALSE(c.governs_nothing(s, below_ridge(0.45), every_site, every, 1000));
  }
}

/// A vertex in the middle of an edge that is straight but for rounding: its polar cone is thinner
/// than doubles tell apart, and passes the box.
TEST(VerifyExclusion, ThinPolarConeBesideABox_GovernsNothing) {
  const Checked c(shapes::rotate_rounded(
      shapes::triangulate_facets(shapes::split_edges(shapes::plate(2, 6), 1), 3), 6));
  const Box3 box{{0.002125608380334043, 0.5282404857001551, 0.7755378672136367},
                 {0.049573750823581876, 0.5574165571757196, 0.8036905573913511}};
  const Site s = c.shape.vertex_site(43);
  ASSERT_EQ(c.shape.point.size(), 55u);
  ASSERT_TRUE(std::ranges::binary_search(c.shape.candidates(), s));
  const auto every = c.every_triangle();
  EXPECT_FALSE(c.sites.beyond(s, box));
  EXPECT_TRUE(c.governs_nothing(s, box, {}, every, 2000));
}

/// Domains are convex: one meets a box iff it meets a half of it, and where a point is in both.
TEST(VerifySites, DomainAndBox_MeetIffDomainAndAHalfDo) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> one(0, 1);
  std::array<std::size_t, 2> found{};
  std::size_t by_one = 0;
  for (const PolygonMesh& mesh :
       {shapes::lpocket(), shapes::rotate_rounded(shapes::lpocket(), 3), shapes::plate(2, 5),
        shapes::rotate_rounded(shapes::split_edges(shapes::plate(2, 6), 1), 2)}) {
    const Checked c(mesh);
    const auto& all = c.shape.candidates();
    for (int k = 0; k < 1500; ++k) {
      const Point3& near = c.solid.point[random() % c.solid.point.size()];
      const std::size_t flat = random() % 4;  // 3: not flat
      Box3 box;
      for (int i = 0; i < 3; ++i) {
        box.lo[i] = near[i] + 0.3 * (2 * one(random) - 1);
        box.hi[i] = std::cmp_equal(flat, i) ? box.lo[i] : box.lo[i] + 0.2 * one(random);
      }
      const Site s = all[random() % all.size()];
      const bool meets = c.sites.domain_meets(s, box);
      ++found[meets ? 1 : 0];
      const auto half = verify::halved(box);
      ASSERT_TRUE(half);
      EXPECT_EQ(meets, c.sites.domain_meets(s, (*half)[0]) || c.sites.domain_meets(s, (*half)[1]));
      const bool beyond = c.sites.beyond(s, box);
      EXPECT_FALSE(beyond && meets);
      by_one += beyond;
      for (int n = 0; n < 10; ++n) {
        Point3 x;
        for (int i = 0; i < 3; ++i) x[i] = box.lo[i] + (box.hi[i] - box.lo[i]) * one(random);
        EXPECT_TRUE(meets || !c.sites.in_domain(x, s));
      }
    }
  }
  EXPECT_GT(found[1], 300u);
  EXPECT_GT(found[0], by_one + 50);
}

/// Of sites whose domains are convex: where they never tie one is the nearer in all of them, and
/// where the first gains along w it stays the nearer one.
TEST(VerifyGains, OnHalvesOfABox_TrueAtItsPoints) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> signed_one(-1, 1);
  std::size_t apart = 0, by_halves = 0, gain = 0, compared = 0;
  for (const PolygonMesh& mesh :
       {shapes::lpocket(), shapes::rotate_rounded(shapes::lpocket(), 3), shapes::plate(2, 5),
        shapes::rotate_rounded(shapes::torus(8, 4, 2, 0.75), 1)}) {
    const Checked c(mesh);
    const auto& all = c.shape.candidates();
    for (int k = 0; k < 800; ++k) {
      const Point3& near = c.solid.point[random() % c.solid.point.size()];
      Box3 box;
      const int flat = static_cast<int>(random() % 3);
      for (int i = 0; i < 3; ++i) {
        box.lo[i] = near[i] + 0.2 * signed_one(random);
        box.hi[i] = i == flat ? box.lo[i] : box.lo[i] + 0.1 * (1 + signed_one(random));
      }
      // Every other pair is of sites that may govern there.
      const std::vector<Site> some = k % 2 == 0 ? all : c.exclusion.remaining(all, box);
      if (some.empty()) continue;
      const Site a = some[random() % some.size()], b = some[random() % some.size()];
      if (c.sites.never_essential(a, b)) continue;
      const verify::SharedFeet feet(c.exclusion, all, box);
      Vec<Rational> w{};
      for (int i = 0; i < 3; ++i)
        if (i != flat) w[i] = signed_one(random);
      if (c.sites.slope(box.lo, a, b, w) > 0) w = verify::times(w, Rational(-1));
      int looks = 200, more_looks = 200;
      const bool never = gains_where_both_govern(c.exclusion, box, feet, a, b, {}, looks);
      const bool gains = gains_where_both_govern(c.exclusion, box, feet, a, b, w, more_looks);
      EXPECT_TRUE(gains || !never);
      if (!gains) continue;
      apart += never;
      by_halves += never && verify::may_both_govern(c.exclusion, box, a, b);
      gain += !never;
      const auto both = [&](const Point3& x) {
        return c.sites.in_domain(x, a) && c.sites.in_domain(x, b);
      };
      int sign = 0;
      for (int n = 0; n < 30; ++n) {
        Point3 x, y;
        const double step = 0.05 * (1 + signed_one(random));
        bool within = true;
        for (int i = 0; i < 3; ++i) {
          x[i] = box.lo[i] + (box.hi[i] - box.lo[i]) * (0.5 + 0.5 * signed_one(random));
          y[i] = x[i] + step * w[i].get_d();
          within &= y[i] >= box.lo[i] && y[i] <= box.hi[i];
        }
        if (!both(x)) continue;
        const int here = c.sites.compare(x, a, b);
        if (never) {
          ++compared;
          EXPECT_NE(here, 0);
          EXPECT_TRUE(sign == 0 || here == sign);
          sign = here;
        } else if (within && here <= 0 && both(y)) {
          ++compared;
          EXPECT_LT(c.sites.compare(y, a, b), 0);
        }
      }
    }
  }
  EXPECT_GT(apart, 100u);
  EXPECT_GT(by_halves, 10u);
  EXPECT_GT(gain, 100u);
  EXPECT_GT(compared, 100u);
}

}  // namespace
}  // namespace blum::test
