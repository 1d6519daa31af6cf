/// Vectors in plain double arithmetic: for measures that are reported, never for decisions that
/// have to be exact.
#pragma once

#include <cmath>

#include "blum/kernel/point.hpp"

namespace blum {

inline Point3 difference(const Point3& a, const Point3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Point3 cross(const Point3& a, const Point3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double dot(const Point3& a, const Point3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double norm(const Point3& a) { return std::hypot(a.x, a.y, a.z); }

}  // namespace blum
