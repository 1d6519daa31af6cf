#pragma once

#include <cmath>

#include "blum/kernel/point.hpp"

namespace blum::detail {

inline Point3 minus(const Point3& a, const Point3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Point3 along(const Point3& a, double t, const Point3& u) {
  return {a.x + t * u.x, a.y + t * u.y, a.z + t * u.z};
}
inline double dot(const Point3& a, const Point3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Point3 cross(const Point3& a, const Point3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Point3& a) { return std::hypot(a.x, a.y, a.z); }

}  // namespace blum::detail
