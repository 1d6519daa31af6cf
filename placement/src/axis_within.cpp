// AxisDistance::is_within: whether the axis is near, from feet alone (docs/proofs.md, "Distance
// from the axis").

#include <algorithm>
#include <array>
#include <cmath>

#include "axis_distance.hpp"
#include "blum/kernel/point_algebra.hpp"

namespace blum {
namespace {

/// Relative error of a length of this file: a few roundings.
constexpr double kRelative = 1e-14;
/// A point whose feet are within this part of its distance has one direction.
constexpr double kOneFoot = 1e-4;
/// Where it has not, it is moved towards one of its feet by this part of what is asked for.
constexpr double kAside = 1e-3;
/// Points of a circle.
constexpr std::size_t kAround = 6;

}  // namespace

bool AxisDistance::ends_ahead(const Point3& p, const Feet& at_p, double reach) const {
  const double radius = distance_between(p, at_p.center);
  if (!(radius > 0) || !(at_p.radius <= kOneFoot * at_p.distance)) return false;
  const Point3 q = p + (reach / radius) * (p - at_p.center);
  // The direction errs by at most 2 |error of the foot| / distance, and distances by what q does.
  const double off = reach * (2.01 * at_p.radius / at_p.distance + kRelative) + kRelative;
  const double at_q = std::sqrt(tree_.squared_distance(q).hi) * (1 + kRelative);
  return at_q + off < (at_p.distance + reach) * (1 - kRelative);
}

bool AxisDistance::parts_around(const Point3& p, const Feet& at_p, const Point3& ray,
                                double radius) const {
  // Two directions across the ray.
  int least = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(ray[k]) < std::abs(ray[least])) least = k;
  Point3 e{0, 0, 0};
  e[least] = 1;
  Point3 u = cross(ray, e);
  const double size = length(u);
  if (!(size > 0)) return false;
  u = (1 / size) * u;
  const Point3 w = cross(ray, u);
  std::array<Point3, kAround + 1> point{p};
  std::array<Feet, kAround + 1> at{at_p};
  for (std::size_t n = 1; n <= kAround; ++n) {
    // Opposite points first: the order 0, 3, 1, 4, 2, 5 sixths of the circle.
    const double turn = M_PI / 3 * static_cast<double>((n - 1) / 2 + 3 * ((n - 1) % 2));
    point[n] = p + (radius * std::cos(turn)) * u + (radius * std::sin(turn)) * w;
    at[n] = feet(point[n]);
    for (std::size_t k = 0; k < n; ++k) {
      const double way = distance_between(point[k], point[n]) * (1 + kRelative);
      const double apart = distance_between(at[k].center, at[n].center) * (1 - kRelative);
      if (apart - at[k].radius - at[n].radius > way) return true;
    }
  }
  return false;
}

bool AxisDistance::is_within(const Point3& p, double most) const {
  if (!(most > 0) || inside_.locate(p) != InsideOracle::Where::kInside) return false;
  const double shy = most * (1 - 1e-9);  // for roundings of the points below
  Point3 from = p;
  Feet at = feet(p);
  double reach = shy;
  double radius = distance_between(p, at.center);
  if (!(radius > 0)) return false;
  if (at.radius > kOneFoot * at.distance) {
    // On the axis but for rounding, as a rule: from a point beside it, which has one foot.
    const double aside = std::min(kAside * most, 0.5 * at.distance);
    from = p + (aside / radius) * (at.center - p);
    at = feet(from);
    reach -= aside;
    radius = distance_between(from, at.center);
    if (!(radius > 0) || !(aside < at.distance)) return false;
  }
  if (ends_ahead(from, at, reach)) return true;
  const Point3 ray = (1 / radius) * (from - at.center);
  // Circles in the largest ball about the point, and, near the boundary, farther in.
  const double around = std::min(reach, 0.99 * at.distance);
  if (parts_around(from, at, ray, around)) return true;
  if (around >= 0.9 * reach) return false;
  const double in = 0.5 * reach;
  const Point3 center = from + in * ray;
  const Feet at_center = feet(center);
  if (inside_.locate(center) != InsideOracle::Where::kInside) return false;
  return parts_around(center, at_center, ray, std::min(0.86 * reach, 0.99 * at_center.distance));
}

}  // namespace blum
