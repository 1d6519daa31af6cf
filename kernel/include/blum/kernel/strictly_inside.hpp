/// Open boxes.
#pragma once

#include "blum/kernel/point.hpp"

namespace blum {

/// Is it inside, not on the box's surface?
[[nodiscard]] constexpr bool strictly_inside(const Point3& p, const Box3& box) {
  for (int k = 0; k < 3; ++k)
    if (!(p[k] > box.lo[k] && p[k] < box.hi[k])) return false;
  return true;
}

/// Of a box that is not empty.
[[nodiscard]] constexpr bool strictly_inside(const Box3& inner, const Box3& outer) {
  return strictly_inside(inner.lo, outer) && strictly_inside(inner.hi, outer);
}

}  // namespace blum
