/// Planes that cut a leaf where the axis is certain not to be (docs/proofs.md, Theorem E).
#pragma once

#include <array>
#include <optional>
#include <span>

#include "blum/kernel/point.hpp"

namespace blum {

/// The plane {x : normal . x = offset}, exactly. Working frame.
struct CutPlane {
  std::array<int, 3> normal{};
  double offset = 0;
  friend constexpr bool operator==(const CutPlane&, const CutPlane&) = default;
};

/// Certain sign of normal . x - offset for all x of the closed box; 2: undecided, or both occur.
/// Requires: |normal[k]| <= 2^20; finite coordinates.
[[nodiscard]] int side_of(const CutPlane& plane, const Box3& box);
[[nodiscard]] inline int side_of(const CutPlane& plane, const Point3& p) {
  return side_of(plane, Box3{p, p});
}

/// The smallest box of doubles known to hold the part of the plane in the box; nullopt: there is
/// none for certain.
[[nodiscard]] std::optional<Box3> around_section(const CutPlane& plane, const Box3& box);

struct PlaneBetween {
  CutPlane plane;
  double gap = 0;  ///< width of the slab about the plane that holds none of the points, about
};
/// A plane with few bits about midway between the convex hulls of two sets of points, `a` on its
/// negative side; nullopt if none was found. Computed in double: a proposal, which decides nothing.
/// Depends on the order of the points only by rounding. Requires: both sets not empty.
[[nodiscard]] std::optional<PlaneBetween> plane_between(std::span<const Point3> a,
                                                        std::span<const Point3> b);

}  // namespace blum
