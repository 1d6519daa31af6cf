/// Points of regular polygons, with the symmetries of the square exact in doubles.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace blum::shapes {

/// Corner k of the regular n-gon on the unit circle. Reduced to the first octant, so that
/// reflections and quarter turns that map the n-gon to itself map the doubles to each other.
inline std::array<double, 2> unit_circle(int k, int n) {
  k = (k % n + n) % n;
  const int quarter = 4 * k / n;
  const int rest = 4 * k - quarter * n;  // the angle within the quarter is (pi/2) rest / n
  const auto angle = [n](int i) { return std::numbers::pi / 2 * i / n; };
  double c, s;
  if (2 * rest == n) {
    c = s = std::numbers::sqrt2 / 2;
  } else if (2 * rest < n) {
    c = std::cos(angle(rest)), s = std::sin(angle(rest));
  } else {
    c = std::sin(angle(n - rest)), s = std::cos(angle(n - rest));
  }
  for (int q = 0; q < quarter; ++q) c = std::exchange(s, c) * -1.0;
  return {c == 0 ? 0 : c, s == 0 ? 0 : s};  // no negative zeros
}

}  // namespace blum::shapes
