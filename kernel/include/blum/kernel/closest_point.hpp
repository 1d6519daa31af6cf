/// Closest points in double, for positions and first guesses: no decision depends on them.
#pragma once

#include <limits>
#include <span>

#include "blum/kernel/point.hpp"
#include "blum/kernel/site_geometry.hpp"

namespace blum {

/// A point of the closed site near the point of it closest to x. Working frame. It is a convex
/// combination of corners with coordinates of at most 1 computed in double, so it lies within
/// kOnSite of the site; how close to the closest point depends on the site's shape (slivers).
[[nodiscard]] Point3 closest_point(const SiteGeometry& geometry, SiteId site, const Point3& x);
inline constexpr double kOnSite = 0x1p-48;

/// Distance from x to closest_point.
[[nodiscard]] double distance_estimate(const SiteGeometry& geometry, SiteId site, const Point3& x);

struct NearestFoot {
  double distance = std::numeric_limits<double>::infinity();
  Point3 foot;
};
/// The nearest of the closest points on several sites; infinitely far if there is none.
[[nodiscard]] NearestFoot nearest_foot(const SiteGeometry& geometry, std::span<const SiteId> sites,
                                       const Point3& x);

}  // namespace blum
