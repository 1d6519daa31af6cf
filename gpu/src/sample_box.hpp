/// The box of some samples of a grid, and distances to it. All rounding (a few 2^-53 of the
/// distances involved) is left to the slack that every comparison has.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "blum/gpu/grid.hpp"
#include "vector3.hpp"

namespace blum::detail {

struct SampleBox {
  Point3 centre, half;
  double radius = 0;
};

[[nodiscard]] inline SampleBox sample_box(const std::array<std::uint32_t, 3>& begin,
                                          const std::array<std::uint32_t, 3>& end,
                                          const VoxelGrid& grid) {
  SampleBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const double lo = grid.coordinate(axis, begin[axis]);
    const double hi = grid.coordinate(axis, end[axis] - 1);
    box.half[axis] = 0.5 * (hi - lo);
    box.centre[axis] = lo + box.half[axis];
  }
  box.radius = length(box.half);
  return box;
}

/// Largest distance from p to a sample of the box.
[[nodiscard]] inline double farthest_squared(const SampleBox& b, const Point3& p) {
  const double x = std::abs(p.x - b.centre.x) + b.half.x, y = std::abs(p.y - b.centre.y) + b.half.y,
               z = std::abs(p.z - b.centre.z) + b.half.z;
  return x * x + (y * y + z * z);
}

/// Least distance from p to the box.
[[nodiscard]] inline double nearest_squared(const SampleBox& b, const Point3& p) {
  const double x = std::max(0.0, std::abs(p.x - b.centre.x) - b.half.x),
               y = std::max(0.0, std::abs(p.y - b.centre.y) - b.half.y),
               z = std::max(0.0, std::abs(p.z - b.centre.z) - b.half.z);
  return x * x + (y * y + z * z);
}

/// Least distance between two boxes.
[[nodiscard]] inline double between_squared(const SampleBox& b, const Box3& other) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double gap = std::max({0.0, other.lo[axis] - (b.centre[axis] + b.half[axis]),
                                 (b.centre[axis] - b.half[axis]) - other.hi[axis]});
    sum += gap * gap;
  }
  return sum;
}

/// Half of the box's width along the unit vector w.
[[nodiscard]] inline double extent_along(const SampleBox& b, const Point3& w) {
  return std::abs(w.x) * b.half.x + (std::abs(w.y) * b.half.y + std::abs(w.z) * b.half.z);
}

}  // namespace blum::detail
