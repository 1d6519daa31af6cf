/// Directions in a plane, in doubles: for proposals that something exact checks.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace blum {

struct AngularSpan {
  double low = 0, high = 0;  ///< radians, counted from the first vector
};

/// Of the directions of some vectors, none of them zero. Requires one at least. Means something
/// where they span less than pi.
[[nodiscard]] inline AngularSpan angular_span(std::span<const std::array<double, 2>> vectors) {
  const auto& first = vectors.front();
  AngularSpan span;
  for (const auto& x : vectors) {
    const double angle =
        std::atan2(first[0] * x[1] - first[1] * x[0], first[0] * x[0] + first[1] * x[1]);
    span.low = std::min(span.low, angle);
    span.high = std::max(span.high, angle);
  }
  return span;
}

}  // namespace blum
