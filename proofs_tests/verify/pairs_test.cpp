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
  std::vector<std::uint32_t> every(c.shape.triangle.size());
  std::iota(every.begin(), every.end(), 0u);
  EXPECT_TRUE(c.exclusion.governs_nothing(bottom, box, both, every, 1));
  EXPECT_FALSE(c.exclusion.governs_nothing(top, box, both, every, 1000));
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
