/// Where several groups of sites are equally far: positions of seams and junctions in double.
#pragma once

#include <span>
#include <vector>

#include "blum/kernel/point.hpp"
#include "blum/kernel/site_geometry.hpp"

namespace blum {

struct CommonPoint {
  Point3 point;
  double gap = 0;  ///< largest difference between the groups' distances there; infinite if lost
};

/// Looks for a point of the closed box [lo, hi] (axes with lo == hi are kept) at the same distance
/// from all groups, the nearest member of each counting, by Gauss-Newton from the centre.
/// Working frame. No topological decision depends on it.
[[nodiscard]] CommonPoint common_point(const SiteGeometry& geometry,
                                       std::span<const std::vector<SiteId>> groups,
                                       const Point3& lo, const Point3& hi);

/// Do the feet of x on the groups span space, clearly (volume above 1e-6 of the cubed distance)?
/// They do at an ordinary junction, not where seams touch.
[[nodiscard]] bool feet_span(const SiteGeometry& geometry,
                             std::span<const std::vector<SiteId>> groups, const Point3& x);

/// A gap this small says "one point" when clusters are read (working units: the extent is 1).
inline constexpr double kCommonTolerance = 1e-13;

}  // namespace blum
