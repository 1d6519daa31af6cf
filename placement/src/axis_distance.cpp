#include "axis_distance.hpp"

#include <algorithm>
#include <cmath>

#include "blum/kernel/closest_point.hpp"
#include "blum/kernel/point_algebra.hpp"

namespace blum {
namespace {

constexpr int kSteps = 8;
/// Half the length of the segments tried, as parts of the radius: above rounding, and more where a
/// tie is flat.
constexpr double kReach[] = {1e-9, 1e-7, 1e-5, 1e-3, 1e-2};
/// Relative error of a length of this file: a few roundings.
constexpr double kRelative = 1e-14;

}  // namespace

AxisDistance::Feet AxisDistance::feet(const Point3& p) const {
  const SquaredDistanceBounds least = tree_.squared_distance(p);
  Feet f;
  f.distance = std::sqrt(least.lo) * (1 - kRelative);
  bool first = true;
  for (const auto t : tree_.within(p, least.hi)) {
    const Solid& solid = geometry_.solid();
    std::array<Point3, 3> corner;
    for (std::size_t k = 0; k < 3; ++k)
      corner[k] = solid.point[solid.triangle[t].vertex[static_cast<int>(k)]];
    const SquaredDistanceBounds bounds = squared_distance_to_triangle(p, corner);
    if (bounds.lo > least.hi) continue;
    const Point3 y = closest_point(geometry_, geometry_.index().face(t), p);
    // The triangle is convex: |y - foot|^2 <= |y - p|^2 - |foot - p|^2 for a point y of it.
    const double reach = distance_between(p, y) * (1 + kRelative) + kOnSite;
    const double off =
        std::sqrt(std::max(0.0, reach * reach - bounds.lo) + kRelative * reach * reach) + kOnSite;
    if (first) f.center = y;
    f.radius = std::max(f.radius, (distance_between(f.center, y) + off) * (1 + kRelative));
    first = false;
  }
  return f;
}

bool AxisDistance::parts(const Point3& p, const Point3& q) const {
  const double length = distance_between(p, q) * (1 + kRelative);
  const Feet at_p = feet(p);
  if (!(length < at_p.distance)) return false;  // the segment might leave the solid
  const Feet at_q = feet(q);
  const double apart = distance_between(at_p.center, at_q.center) * (1 - kRelative);
  return apart - at_p.radius - at_q.radius > length &&
         inside_.locate(p) == InsideOracle::Where::kInside;
}

std::optional<double> AxisDistance::at_most(const Point3& p, const SiteGroup& a, const SiteGroup& b) const {
  Point3 x = p, across;
  double radius = 0;
  for (int step = 0; step < kSteps; ++step) {
    const NearestFoot to_a = nearest_foot(geometry_, a, x), to_b = nearest_foot(geometry_, b, x);
    if (!(to_a.distance > 0) || !(to_b.distance > 0)) return std::nullopt;
    const Point3 w = (1 / to_a.distance) * (x - to_a.foot) - (1 / to_b.distance) * (x - to_b.foot);
    const double slope = inner(w, w), gap = to_a.distance - to_b.distance;
    if (!(slope > 1e-20)) return std::nullopt;
    radius = to_a.distance;
    across = (1 / std::sqrt(slope)) * w;
    const double move = gap / std::sqrt(slope);
    if (std::abs(move) <= 1e-15) break;
    x = x - move * across;
  }
  for (const double reach : kReach) {
    const Point3 on_a = x - (reach * radius) * across, on_b = x + (reach * radius) * across;
    if (parts(on_a, on_b))
      return std::max(distance_between(p, on_a), distance_between(p, on_b)) * (1 + kRelative);
  }
  return std::nullopt;
}

}  // namespace blum
