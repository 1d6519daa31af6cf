// A third face that is nearer wherever two others tie: against ties found by sampling.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "../../arrangement/src/slope.hpp"
#include "face_scenes.hpp"

namespace blum {
namespace {

using test::Random;
using test::Scene;
using test::uniform;

/// The point nearest to `x` where the two planes are at one distance; `x` if they are parallel.
Point3 tie_near(const SiteGeometry& geometry, SiteId a, SiteId c, const Point3& x) {
  std::array<double, 3> w{};
  double value = 0, square = 0;
  for (int k = 0; k < 3; ++k) {
    w[static_cast<std::size_t>(k)] = geometry.unit(a)[k].mid - geometry.unit(c)[k].mid;
    value += geometry.unit(a)[k].mid * (x[k] - geometry.base(a)[k]) -
             geometry.unit(c)[k].mid * (x[k] - geometry.base(c)[k]);
    square += w[static_cast<std::size_t>(k)] * w[static_cast<std::size_t>(k)];
  }
  Point3 y = x;
  for (int k = 0; k < 3 && square > 1e-24; ++k)
    y[k] -= w[static_cast<std::size_t>(k)] * value / square;
  return y;
}

double depth(const SiteGeometry& geometry, SiteId s, const Point3& x) {
  double h = 0;
  for (int k = 0; k < 3; ++k) h -= geometry.unit(s)[k].mid * (x[k] - geometry.base(s)[k]);
  return h;
}

TEST(PartedBy, NoTieOfTheTwoIsAsNearAsTheThird) {
  Random random(7);
  long parted = 0, tried = 0, behind = 0;
  for (const double by : {0.0, 1e-12, 1e-2}) {
    const Scene scene("pyramid", test::pyramid(random, 12, 2, by));
    const SiteGeometry& geometry = *scene.geometry;
    for (int round = 0; round < 60'000; ++round) {
      SiteId site[3];
      for (SiteId& s : site)
        s = geometry.index().face(
            static_cast<std::uint32_t>(random() % scene.solid->triangle.size()));
      if (site[0] == site[1] || site[1] == site[2] || site[0] == site[2]) continue;
      Point3 x;
      for (int k = 0; k < 3; ++k) x[k] = uniform(random, scene.bounds.lo[k], scene.bounds.hi[k]);
      x = tie_near(geometry, site[0], site[2], x);
      const double size = std::exp(uniform(random, std::log(1e-6), std::log(0.3)));
      Point3 lo, hi;
      for (int k = 0; k < 3; ++k) {
        const double share = uniform(random, 0, 1);
        lo[k] = x[k] - size * share;
        hi[k] = x[k] + size * (1 - share);
      }
      const Range range = Range::of(lo, hi);
      LocalForm a, b, c;
      if (!local_form(geometry, site[0], range, a) || !local_form(geometry, site[1], range, b) ||
          !local_form(geometry, site[2], range, c))
        continue;
      const double ahead = depth(geometry, site[0], x) - depth(geometry, site[1], x);
      ++tried;
      behind += ahead < 0;
      if (!parted_by(geometry, a, c, b, range)) continue;
      ++parted;
      ASSERT_TRUE(b.covers_side);
      ASSERT_GT(ahead, -1e-14);
    }
  }
  std::cout << parted << " of " << tried << " parted; at " << behind
            << " ties the third is farther\n";
  EXPECT_GT(parted, 500);
  EXPECT_GT(behind, 500);
}

}  // namespace
}  // namespace blum
