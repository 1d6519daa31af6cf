// Touching balls against the shrinking-ball algorithm and against the least over all sites.

#include "blum/thickness/touching_ball.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "blum/kernel/closest_point.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

struct Sample {
  std::uint32_t face = 0;
  Point3 p, n;
};

/// Points well inside random faces.
class Samples {
 public:
  Samples(const Solid& solid, const SiteGeometry& geometry, unsigned seed)
      : solid_(solid), geometry_(geometry), random_(seed) {}
  Sample next() {
    std::uniform_int_distribution<std::uint32_t> face(
        0, static_cast<std::uint32_t>(solid_.triangle.size()) - 1);
    std::uniform_real_distribution<double> weight(0.05, 1);
    Sample s;
    s.face = face(random_);
    const double a = weight(random_), b = weight(random_), c = weight(random_);
    const auto& v = solid_.triangle[s.face].vertex;
    const BallVector& unit = geometry_.unit(geometry_.index().face(s.face));
    for (int k = 0; k < 3; ++k) {
      s.p[k] = (a * solid_.point[v[0]][k] + b * solid_.point[v[1]][k] + c * solid_.point[v[2]][k]) /
               (a + b + c);
      s.n[k] = -unit[k].mid;
    }
    return s;
  }

 private:
  const Solid& solid_;
  const SiteGeometry& geometry_;
  std::mt19937 random_;
};

/// Ma, Bae and Choi 2012: shrink the ball to its centre's nearest boundary point until that is p.
double shrinking_ball(const SiteTree& tree, const Sample& s) {
  double r = 2;
  for (int step = 0; step < 200; ++step) {
    const Point3 c{s.p.x + r * s.n.x, s.p.y + r * s.n.y, s.p.z + r * s.n.z};
    const NearestTriangle nearest = tree.nearest(c);
    const double d = std::sqrt(nearest.squared_distance.hi);
    if (d >= r * (1 - 1e-13)) return r;
    const Point3& q = nearest.foot;
    const Point3 w{q.x - s.p.x, q.y - s.p.y, q.z - s.p.z};
    const double height = w.x * s.n.x + w.y * s.n.y + w.z * s.n.z;
    const double smaller = (w.x * w.x + w.y * w.y + w.z * w.z) / (2 * height);
    // Where the nearest point is p's own face again, rounding alone is left.
    if (!(height > 0 && smaller < r)) return r;
    if (smaller > r * (1 - 1e-13)) return smaller;
    r = smaller;
  }
  return r;
}

TEST(TouchingBall, ScenesOfSolids_AgreesWithShrinkingBalls) {
  for (const auto& scene : test::scenes()) {
    SCOPED_TRACE(scene.name);
    const Solid solid = test::solid_of(scene.mesh);
    const SiteGeometry geometry(solid);
    const SiteTree tree(solid);
    Samples samples(solid, geometry, 7);
    for (int i = 0; i < 60; ++i) {
      const Sample s = samples.next();
      const TouchingBall ball = touching_ball(geometry, tree, s.face, s.p, {});
      EXPECT_LE(ball.lower, ball.radius);
      EXPECT_LE(ball.radius, ball.upper);
      // The oracle's steps end within 1e-13; its feet are rounded, which matters for flat contacts.
      const double wrong = 1e-11 * (1 + 1 / std::pow(std::sin(ball.angle_deg * M_PI / 360), 2));
      EXPECT_NEAR(shrinking_ball(tree, s), ball.radius, wrong * (1 + ball.radius))
          << "face " << s.face << " angle " << ball.angle_deg;
    }
  }
}

TEST(TouchingBall, ScenesOfSolids_IsTheLeastOverAllSitesOffThePlane) {
  for (const auto& scene : test::scenes()) {
    SCOPED_TRACE(scene.name);
    const Solid solid = test::solid_of(scene.mesh);
    const SiteGeometry geometry(solid);
    const SiteTree tree(solid);
    Samples samples(solid, geometry, 11);
    for (int i = 0; i < 40; ++i) {
      const Sample s = samples.next();
      double least = 2;
      for (std::uint32_t t = 0; t < solid.triangle.size(); ++t) {
        if (solid.triangle[t].facet == solid.triangle[s.face].facet) continue;
        least = std::min(least, touch_site(geometry, geometry.index().face(t), s.p, s.n).radius);
      }
      EXPECT_DOUBLE_EQ(touching_ball(geometry, tree, s.face, s.p, {}).radius, least);
    }
  }
}

/// The bounds hold for the closed form in a box: the exact radius is a minimum of coordinates.
TEST(TouchingBall, Box_BoundsEncloseTheExactRadius) {
  const Solid solid = test::solid_of(shapes::cuboid(1, 0.75, 0.5));
  const SiteGeometry geometry(solid);
  const SiteTree tree(solid);
  Point3 lo = solid.point[0], hi = lo;
  for (const Point3& p : solid.point) {
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  }
  Samples samples(solid, geometry, 3);
  double widest = 0;
  for (int i = 0; i < 500; ++i) {
    const Sample s = samples.next();
    double exact = 2;
    for (int k = 0; k < 3; ++k) {
      if (std::abs(s.n[k]) > 0.5) {
        exact = std::min(exact, (hi[k] - lo[k]) / 2);
      } else {
        exact = std::min({exact, s.p[k] - lo[k], hi[k] - s.p[k]});
      }
    }
    const TouchingBall ball = touching_ball(geometry, tree, s.face, s.p, {});
    EXPECT_LE(ball.lower, exact);
    EXPECT_GE(ball.upper, exact);
    widest = std::max(widest, ball.upper - ball.lower);
  }
  EXPECT_LT(widest, 1e-11);
  EXPECT_GT(widest, 0);
}

TEST(TouchingBall, PartnersRightOrWrong_ChangeNothing) {
  const Solid solid = test::solid_of(shapes::lbracket());
  const SiteGeometry geometry(solid);
  const SiteTree tree(solid);
  Samples samples(solid, geometry, 5);
  for (int i = 0; i < 200; ++i) {
    const Sample s = samples.next();
    const TouchingBall alone = touching_ball(geometry, tree, s.face, s.p, {});
    for (std::uint32_t site = 0; site < geometry.index().size(); ++site) {
      const SiteId partner{site};
      if (partner == geometry.index().face(s.face)) continue;
      const TouchingBall ball = touching_ball(geometry, tree, s.face, s.p, {&partner, 1});
      EXPECT_EQ(ball.radius, alone.radius);
      EXPECT_EQ(ball.site, alone.site);
    }
  }
}

/// The closed form over a segment against many of its points.
TEST(TouchSite, RandomSegments_IsTheLeastOverItsPoints) {
  std::mt19937 random(1);
  const Solid solid = test::solid_of(shapes::torus(8, 5, 2, 0.75));
  const SiteGeometry geometry(solid);
  std::uniform_real_distribution<double> at(-1, 1);
  int finite = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto e = static_cast<std::uint32_t>(random() % solid.edge.size());
    const Point3 p{at(random), at(random), at(random)};
    Point3 n{at(random), at(random), at(random)};
    const double size = std::hypot(n.x, n.y, n.z);
    for (int k = 0; k < 3; ++k) n[k] /= size;
    const Point3 &a = solid.point[solid.edge[e].vertex[0]],
                 &b = solid.point[solid.edge[e].vertex[1]];
    double least = std::numeric_limits<double>::infinity();
    constexpr int kSteps = 400;
    for (int k = 0; k <= kSteps; ++k) {
      const double t = static_cast<double>(k) / kSteps;
      const Point3 d{a.x + t * (b.x - a.x) - p.x, a.y + t * (b.y - a.y) - p.y,
                     a.z + t * (b.z - a.z) - p.z};
      const double height = n.x * d.x + n.y * d.y + n.z * d.z;
      if (height > 0) least = std::min(least, (d.x * d.x + d.y * d.y + d.z * d.z) / (2 * height));
    }
    const double radius = touch_site(geometry, geometry.index().edge(e), p, n).radius;
    if (!(least < 100)) continue;
    ++finite;
    EXPECT_LE(radius, least * (1 + 1e-12));
    EXPECT_GE(radius, least * 0.99);
  }
  EXPECT_GT(finite, 300);
}

}  // namespace
}  // namespace blum
