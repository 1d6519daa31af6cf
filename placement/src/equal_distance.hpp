/// Points at the same distance from several sides, by non-linear least squares (Ceres).
#pragma once

#include <optional>
#include <span>

#include "blum/kernel/inside.hpp"
#include "blum/placement/leaf_sides.hpp"

namespace blum {

struct EqualDistancePoint {
  Point3 position;  ///< working frame
  double radius = 0;
  std::vector<SiteId> governors;  ///< candidates at that distance, to kTieTolerance (locate.hpp)
};

/// Looks for a point of the closed box (flat axes stay) inside the solid that lies on the axis: at
/// the same distance from all `sides` up to rounding, and no nearer to any other of `candidates`.
/// From `start`, and if that leads out of the box from points between it and the box' centre.
/// Working frame. nullopt: none was found.
[[nodiscard]] std::optional<EqualDistancePoint> equal_distance_point(
    const SiteGeometry& geometry, const InsideOracle& inside, std::span<const SiteGroup> sides,
    std::span<const SiteId> candidates, const Box3& box, const Point3& start);

}  // namespace blum
