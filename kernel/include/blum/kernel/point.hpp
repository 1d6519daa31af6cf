/// Points, boxes and axis-parallel rectangles with double coordinates. Coordinates are exact
/// dyadic rationals, never approximations of something else.
#pragma once

#include <array>
#include <cstddef>

namespace blum {

struct Point3 {
  double x = 0, y = 0, z = 0;
  [[nodiscard]] constexpr double operator[](int axis) const {
    return axis == 0 ? x : axis == 1 ? y : z;
  }
  constexpr double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  friend constexpr bool operator==(const Point3&, const Point3&) = default;
};

/// Closed axis-parallel box; empty when lo > hi on some axis.
struct Box3 {
  Point3 lo, hi;
  friend constexpr bool operator==(const Box3&, const Box3&) = default;
};

/// The two axes that span a plane orthogonal to `axis`, in the cyclic order (axis, u, v).
[[nodiscard]] constexpr int u_axis(int axis) { return (axis + 1) % 3; }
[[nodiscard]] constexpr int v_axis(int axis) { return (axis + 2) % 3; }

/// Closed axis-parallel rectangle {x : x[axis] = level, u0 <= x[u] <= u1, v0 <= x[v] <= v1} with
/// u = u_axis(axis), v = v_axis(axis).
struct Rect {
  int axis = 0;
  double level = 0;
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  friend constexpr bool operator==(const Rect&, const Rect&) = default;
};

/// Closed segment parallel to `axis`: x[axis] in [t0, t1], x[u] = u, x[v] = v.
struct Segment {
  int axis = 0;
  double u = 0, v = 0;
  double t0 = 0, t1 = 0;
  friend constexpr bool operator==(const Segment&, const Segment&) = default;
};

[[nodiscard]] constexpr Point3 point_on(int axis, double along, double u, double v) {
  Point3 p;
  p[axis] = along;
  p[u_axis(axis)] = u;
  p[v_axis(axis)] = v;
  return p;
}

}  // namespace blum
