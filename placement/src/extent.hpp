/// The size of a solid.
#pragma once

#include <algorithm>

#include "blum/kernel/point_algebra.hpp"
#include "blum/kernel/solid.hpp"

namespace blum {

/// Diagonal of the bounding box, working units.
[[nodiscard]] inline double extent_of(const Solid& solid) {
  Box3 box{solid.point.front(), solid.point.front()};
  for (const Point3& p : solid.point)
    for (int k = 0; k < 3; ++k) {
      box.lo[k] = std::min(box.lo[k], p[k]);
      box.hi[k] = std::max(box.hi[k], p[k]);
    }
  return diameter(box);
}

}  // namespace blum
