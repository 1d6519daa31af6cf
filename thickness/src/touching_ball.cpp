#include "blum/thickness/touching_ball.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "blum/kernel/check.hpp"
#include "blum/kernel/closest_point.hpp"
#include "blum/kernel/point_algebra.hpp"

namespace blum {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// The solid's coordinates are at most 1, so no ball inside is larger.
constexpr double kMostRadius = 2;
/// Triangles are looked for in a ball larger by this: what is lost by rounding stays inside.
constexpr double kSlack = 0x1p-30;

Touch touch_point(const Point3& q, const Point3& p, const Point3& n) {
  const Point3 d = q - p;
  const double height = inner(n, d);
  return {height > 0 ? inner(d, d) / (2 * height) : kInfinity, q};
}

/// The quotient's derivative vanishes where (alpha + beta t)^2 = alpha^2 - beta f; of the two roots
/// the one with the height alpha + beta t > 0 counts, in the form that does not cancel.
Touch touch_segment(const Point3& a, const Point3& b, const Point3& p, const Point3& n) {
  const Point3 u = b - a, w = a - p;
  const double uu = inner(u, u), wu = inner(w, u), ww = inner(w, w);
  const double alpha = inner(n, w), beta = inner(n, u);
  const double f = (2 * wu * alpha - ww * beta) / uu;
  const double height = std::sqrt(std::max(0.0, alpha * alpha - beta * f));
  double t = alpha >= 0 ? -f / (alpha + height) : (height - alpha) / beta;
  if (!std::isfinite(t)) t = 0;
  Touch best = touch_point(a + std::clamp(t, 0.0, 1.0) * u, p, n);
  for (const Point3& end : {a, b}) {
    const Touch other = touch_point(end, p, n);
    if (other.radius < best.radius) best = other;
  }
  return best;
}

/// The least over a triangle, and on which part of it.
struct TriangleTouch {
  Touch touch{kInfinity, {}};
  int edge = -1, corner = -1;  ///< both -1: inside
};

TriangleTouch touch_triangle(const std::array<Point3, 3>& corner, const Point3& p,
                             const Point3& n) {
  const Point3 normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double size = length(normal);
  if (size > 0) {
    // Of the two sides the one on which p is.
    double height = inner(normal, p - corner[0]) / size;
    const double sign = height < 0 ? -1 : 1;
    height *= sign;
    const double closing = 1 - sign * inner(normal, n) / size;
    if (closing > 0 && height > 0) {
      const double r = height / closing;
      const Point3 q = p + r * n + -sign * r / size * normal;
      bool is_inside = true;
      for (int k = 0; k < 3; ++k) {
        const Point3 e = corner[(k + 1) % 3] - corner[k];
        is_inside &= inner(cross(e, q - corner[k]), normal) >= 0;
      }
      if (is_inside && r < kMostRadius) return {{r, q}, -1, -1};
    }
  }
  TriangleTouch best;
  for (int k = 0; k < 3; ++k) {
    const Point3 &a = corner[k], &b = corner[(k + 1) % 3];
    const Touch touch = touch_segment(a, b, p, n);
    if (!(touch.radius < best.touch.radius)) continue;
    best = {touch, k, touch.foot == a ? k : touch.foot == b ? (k + 1) % 3 : -1};
  }
  return best;
}

/// What of the solid that is.
SiteId site_of(const SiteIndex& index, const SolidTriangle& t, std::uint32_t number,
               const TriangleTouch& touch) {
  if (touch.corner >= 0) return index.vertex(t.vertex[touch.corner]);
  if (touch.edge >= 0) return index.edge(t.edge[touch.edge]);
  return index.face(number);
}

std::array<Point3, 3> corners(const Solid& solid, std::uint32_t triangle) {
  const auto& v = solid.triangle[triangle].vertex;
  return {solid.point[v[0]], solid.point[v[1]], solid.point[v[2]]};
}

BallVector about(const Point3& p, double error) {
  return {Ball(p.x, error), Ball(p.y, error), Ball(p.z, error)};
}

/// Upper bound: the radius for a point of the solid within kOnSite of `foot`.
double radius_bound(const Point3& foot, const Point3& p, const BallVector& inward) {
  const BallVector q = about(foot, kOnSite), s = about(p, kOnSite);
  BallVector d;
  for (int k = 0; k < 3; ++k) d[k] = q[k] - s[k];
  const Ball height = dot(inward, d);
  if (height.sign() != 1) return kInfinity;
  return divide(dot(d, d), Ball(2) * height).high();
}

struct Candidate {
  std::uint32_t triangle;
  TriangleTouch found;
};

}  // namespace

Touch touch_site(const SiteGeometry& geometry, SiteId site, const Point3& p, const Point3& n) {
  int count = 0;
  const auto at = geometry.corners(site, count);
  const std::vector<Point3>& point = geometry.solid().point;
  if (count == 1) return touch_point(point[at[0]], p, n);
  if (count == 2) return touch_segment(point[at[0]], point[at[1]], p, n);
  return touch_triangle({point[at[0]], point[at[1]], point[at[2]]}, p, n).touch;
}

TouchingBall touching_ball(const SiteGeometry& geometry, const SiteTree& tree, std::uint32_t face,
                           const Point3& p, std::span<const SiteId> partners) {
  const Solid& solid = geometry.solid();
  const std::uint32_t facet = solid.triangle[face].facet;
  BallVector inward = geometry.unit(geometry.index().face(face));
  for (Ball& c : inward) c = -c;
  const Point3 n = {inward[0].mid, inward[1].mid, inward[2].mid};

  TouchingBall ball;
  double from_axis = kMostRadius;
  for (const SiteId site : partners) {
    from_axis = std::min(from_axis, touch_site(geometry, site, p, n).radius);
  }
  std::vector<Candidate> candidates;
  const Candidate* best = nullptr;
  // Whatever meets a smaller ball meets this one. A second time only if a partner in the plane of
  // the face has given a radius that is noise.
  for (double reach = from_axis; best == nullptr; reach = kMostRadius) {
    candidates.clear();
    const double most = reach * (1 + kSlack) + kSlack;
    for (const std::uint32_t t : tree.within(p + reach * n, most * most)) {
      if (solid.triangle[t].facet == facet) continue;
      candidates.push_back({t, touch_triangle(corners(solid, t), p, n)});
    }
    for (const Candidate& c : candidates) {
      if (c.found.touch.radius <= most &&
          (best == nullptr || c.found.touch.radius < best->found.touch.radius)) {
        best = &c;
      }
    }
    BLUM_CHECK(best != nullptr || reach < kMostRadius);
  }
  const double r = best->found.touch.radius;
  ball.radius = r;
  ball.foot = best->found.touch.foot;
  ball.site =
      site_of(geometry.index(), solid.triangle[best->triangle], best->triangle, best->found);
  ball.centre = p + r * n;
  const double half_chord = std::min(1.0, distance_between(ball.foot, p) / (2 * r));
  ball.angle_deg = 2 * std::asin(half_chord) * 180 / M_PI;
  ball.upper = std::max(r, radius_bound(ball.foot, p, inward));

  // Error of the computed centre: that of p, of n, and of three products and sums.
  const double wrong =
      kOnSite + r * (inward[0].rad + inward[1].rad + inward[2].rad) + 8 * Ball::kUnit * (2 + r);
  ball.lower = r;
  for (const Candidate& c : candidates) {
    const auto triangle = corners(solid, c.triangle);
    const auto distance = [&](const Point3& q) {
      return std::sqrt(std::max(0.0, squared_distance_to_triangle(q, triangle).lo)) *
             (1 - 4 * Ball::kUnit);
    };
    const double s = std::max(0.0, distance(ball.centre) - wrong);
    if (s >= r) continue;
    const double near = std::max(0.0, distance(p) - kOnSite);
    // R >= r - (r^2 - s^2) r / near^2 for every point of the triangle (docs/thickness.md).
    const double bound = r - (r - s) * (r + s) * r / (near * near) * (1 + 16 * Ball::kUnit);
    ball.lower = std::min(ball.lower, std::isfinite(bound) ? std::max(0.0, bound) : 0.0);
  }
  return ball;
}

}  // namespace blum
