/// Rotations that keep short coordinates exact.
#pragma once

#include <array>

#include "blum/kernel/mesh.hpp"

namespace blum::test {

/// Rotation by an integer quaternion times its squared norm: exact where coordinates have few
/// digits; else facets are planar up to rounding only.
inline PolygonMesh turn_by_quaternion(PolygonMesh m, const std::array<int, 4>& q) {
  const auto [a, b, c, d] = q;
  const int r[3][3] = {{a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)},
                       {2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)},
                       {2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d}};
  for (Point3& p : m.points) {
    const Point3 x = p;
    for (int k = 0; k < 3; ++k) p[k] = r[k][0] * x.x + r[k][1] * x.y + r[k][2] * x.z;
  }
  return m;
}

}  // namespace blum::test
