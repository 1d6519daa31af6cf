// Tubes around closed curves, faceted. Their quadrilaterals are never planar in doubles, so they
// are triangles from the start.
#include <cmath>

#include "blum/kernel/check.hpp"
#include "blum/kernel/shapes.hpp"
#include "shapes_circle.hpp"

namespace blum::shapes {
namespace {

/// Triangles of a grid of n x m points that closes up in both directions; point (i, j) has index
/// i * m + j, and (direction of i) x (direction of j) points outwards.
std::vector<std::vector<std::uint32_t>> closed_grid(int n, int m) {
  std::vector<std::vector<std::uint32_t>> faces;
  const auto at = [n, m](int i, int j) { return static_cast<std::uint32_t>(i % n * m + j % m); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return faces;
}

using Vector = std::array<double, 3>;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector normalized(const Vector& a) {
  const double length = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  return {a[0] / length, a[1] / length, a[2] / length};
}

}  // namespace

PolygonMesh torus(int n, int m, double R, double r) {
  BLUM_CHECK(n >= 3 && m >= 3 && r > 0 && R > r);
  PolygonMesh mesh;
  for (int i = 0; i < n; ++i) {
    const auto [cu, su] = unit_circle(i, n);
    for (int j = 0; j < m; ++j) {
      const auto [cv, sv] = unit_circle(j, m);
      mesh.points.push_back({(R + r * cv) * cu, (R + r * cv) * su, r * sv});
    }
  }
  mesh.faces = closed_grid(n, m);
  return mesh;
}

PolygonMesh planar_torus(int n, int m, double R, double r) {
  BLUM_CHECK(n >= 3 && m >= 3 && r > 0 && R > r);
  // Products of 20-bit numbers are exact, so the four corners stay in one plane.
  const auto rounded = [](double x, double scale) {
    const double unit = std::ldexp(1.0, std::ilogb(scale) - 19);
    return std::nearbyint(x / unit) * unit;
  };
  PolygonMesh mesh;
  for (int i = 0; i < n; ++i) {
    const auto [cu, su] = unit_circle(i, n);
    for (int j = 0; j < m; ++j) {
      const auto [cv, sv] = unit_circle(j, m);
      const double ring = rounded(R + r * cv, R + r);
      mesh.points.push_back({ring * rounded(cu, 1), ring * rounded(su, 1), rounded(r * sv, r)});
    }
  }
  const auto at = [n, m](int i, int j) { return static_cast<std::uint32_t>(i % n * m + j % m); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j)
      mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  return mesh;
}

PolygonMesh knot(const KnotShape& shape) {
  BLUM_CHECK(shape.n >= 3 && shape.sides >= 3 && shape.p >= 1 && shape.q >= 1);
  BLUM_CHECK(shape.tube > 0 && shape.r > 0 && shape.R > shape.r);
  PolygonMesh mesh;
  for (int i = 0; i < shape.n; ++i) {
    const auto [cp, sp] = unit_circle(shape.p * i, shape.n);
    const auto [cq, sq] = unit_circle(shape.q * i, shape.n);
    const double ring = shape.R + shape.r * cq;
    const Vector center{ring * cp, ring * sp, shape.r * sq};
    // The frame comes from the torus the knot lies on, so it closes up without twist.
    const Vector outward{cq * cp, cq * sp, sq};
    const double p = shape.p, q_r = shape.q * shape.r;
    const Vector tangent =
        normalized({-q_r * sq * cp - p * ring * sp, -q_r * sq * sp + p * ring * cp, q_r * cq});
    const Vector sideways = cross(outward, tangent);
    for (int j = 0; j < shape.sides; ++j) {
      const auto [c, s] = unit_circle(j, shape.sides);
      Point3 point;
      for (int axis = 0; axis < 3; ++axis) {
        point[axis] = center[axis] + shape.tube * (c * outward[axis] + s * sideways[axis]);
      }
      mesh.points.push_back(point);
    }
  }
  mesh.faces = closed_grid(shape.n, shape.sides);
  return mesh;
}

}  // namespace blum::shapes
