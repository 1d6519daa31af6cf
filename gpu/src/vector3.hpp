/// Small vector operations in double; each says what it rounds. A namespace of their own: other
/// modules have operations of the same names with other roundings.
#pragma once

#include <cmath>

#include "blum/kernel/point.hpp"

namespace blum::detail::inline gpu_vectors {

[[nodiscard]] inline Point3 minus(const Point3& a, const Point3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] inline Point3 scaled(double s, const Point3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
[[nodiscard]] inline double dot(const Point3& a, const Point3& b) {
  return a.x * b.x + (a.y * b.y + a.z * b.z);
}
[[nodiscard]] inline Point3 cross(const Point3& a, const Point3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Does not overflow or underflow for lengths between 2^-1000 and 2^1000.
[[nodiscard]] inline double length(const Point3& a) { return std::hypot(a.x, a.y, a.z); }
/// Each component errs by at most 6u, relatively, u = 2^-53, beside the errors of `a`.
[[nodiscard]] inline Point3 unit(const Point3& a) {
  const double l = length(a);
  return {a.x / l, a.y / l, a.z / l};
}

}  // namespace blum::detail::inline gpu_vectors
