/// Vectors in double, for positions and first guesses: rounded, and no decision depends on them
/// unless its bound says how much.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "blum/kernel/point.hpp"

namespace blum {

[[nodiscard]] inline Point3 operator+(const Point3& a, const Point3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[nodiscard]] inline Point3 operator-(const Point3& a, const Point3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] inline Point3 operator*(double s, const Point3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
[[nodiscard]] inline double inner(const Point3& a, const Point3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[nodiscard]] inline Point3 cross(const Point3& a, const Point3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] inline double length(const Point3& a) { return std::hypot(a.x, a.y, a.z); }
[[nodiscard]] inline double distance_between(const Point3& a, const Point3& b) {
  return length(a - b);
}
[[nodiscard]] inline Point3 middle(const Point3& a, const Point3& b) {
  return {0.5 * a.x + 0.5 * b.x, 0.5 * a.y + 0.5 * b.y, 0.5 * a.z + 0.5 * b.z};
}
[[nodiscard]] inline double diameter(const Box3& b) { return distance_between(b.lo, b.hi); }
/// The smallest box that holds the points, of which there is one at least.
[[nodiscard]] inline Box3 bounds_of(std::span<const Point3> points) {
  Box3 b{points.front(), points.front()};
  for (const Point3& p : points)
    for (int k = 0; k < 3; ++k) {
      b.lo[k] = std::min(b.lo[k], p[k]);
      b.hi[k] = std::max(b.hi[k], p[k]);
    }
  return b;
}
/// Borders included.
[[nodiscard]] inline bool contains(const Box3& b, const Point3& p) {
  for (int k = 0; k < 3; ++k)
    if (!(p[k] >= b.lo[k] && p[k] <= b.hi[k])) return false;
  return true;
}

}  // namespace blum
