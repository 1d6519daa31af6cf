// Points of a box in a site's domain lie in the hull of what domain_part gives.

#include "domain_part.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "blum/kernel/predicates.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

double inner(const Point3& a, const Point3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// How far x is beyond the hull in the direction r, at least.
double beyond(const std::vector<RoundedVector>& hull, const Point3& x, const Point3& r) {
  const double length = std::sqrt(inner(r, r));
  double most = -std::numeric_limits<double>::infinity();
  for (const RoundedVector& p : hull) most = std::max(most, inner(p.mid, r) + p.rad * length);
  return inner(x, r) - most;
}

struct Figures {
  std::size_t points = 0, cut = 0, empty = 0, smaller = 0;
};

void check(const SiteGeometry& geometry, Predicates& exact, SiteId s, const Box3& box,
           std::mt19937_64& random, Figures& figures) {
  const auto hull = domain_part(geometry, s, box);
  figures.empty += hull.empty() ? 1 : 0;
  std::uniform_real_distribution<double> unit(0, 1), sign(-1, 1);
  std::vector<Point3> directions;
  for (int k = 0; k < 20; ++k) directions.push_back({sign(random), sign(random), sign(random)});
  for (const HalfSpace& h : geometry.domain(s))
    directions.push_back({h.w[0].mid, h.w[1].mid, h.w[2].mid});
  for (const Point3& r : directions) {
    double corner = -std::numeric_limits<double>::infinity();
    for (int c = 0; c < 8; ++c)
      corner = std::max(corner, inner({(c & 1) ? box.hi.x : box.lo.x, (c & 2) ? box.hi.y : box.lo.y,
                                       (c & 4) ? box.hi.z : box.lo.z},
                                      r));
    double most = -std::numeric_limits<double>::infinity();
    for (const auto& p : hull) most = std::max(most, inner(p.mid, r));
    figures.smaller += most < corner - 1e-9 ? 1 : 0;
    EXPECT_LE(most, corner + 1e-12);  // it stays in the box
  }
  for (int k = 0; k < 12; ++k) {
    Point3 x;
    for (int i = 0; i < 3; ++i) {
      const double t = k < 6 ? unit(random) : std::round(unit(random));
      x[i] = std::clamp(box.lo[i] + t * (box.hi[i] - box.lo[i]), box.lo[i], box.hi[i]);
    }
    if (!exact.in_domain(x, s)) {
      ++figures.cut;
      continue;
    }
    ++figures.points;
    ASSERT_FALSE(hull.empty());
    for (const Point3& r : directions) EXPECT_LE(beyond(hull, x, r), 1e-15);
  }
}

TEST(DomainPart, PointsOfTheDomain_AreInTheHull) {
  std::mt19937_64 random(7);
  Figures figures;
  for (const auto& scene : test::scenes()) {
    SCOPED_TRACE(scene.name);
    const Solid solid = test::solid_of(scene.mesh);
    const SiteGeometry geometry(solid);
    Predicates exact(geometry);
    std::uniform_real_distribution<double> unit(0, 1);
    const auto candidates = geometry.candidates();
    for (int k = 0; k < 120; ++k) {
      const SiteId s = candidates[random() % candidates.size()];
      // Boxes anywhere, and with a corner on the site, or one ulp beside: on borders of the domain.
      const Point3& p = geometry.base(s);
      const double size = std::pow(10.0, -8 * unit(random));
      Box3 box;
      for (int i = 0; i < 3; ++i) {
        double from = k % 3 == 0 ? 2 * unit(random) - 1 : p[i];
        if (k % 3 == 2) from = std::nextafter(from, unit(random) < 0.5 ? -2.0 : 2.0);
        const double other = random() % 8 == 0 ? from : from + size * (2 * unit(random) - 1);
        box.lo[i] = std::min(from, other);
        box.hi[i] = std::max(from, other);
      }
      check(geometry, exact, s, box, random, figures);
    }
  }
  EXPECT_GT(figures.points, 3000u);
  EXPECT_GT(figures.cut, 3000u);
  EXPECT_GT(figures.empty, 100u);
  EXPECT_GT(figures.smaller, 3000u);
}

}  // namespace
}  // namespace blum
