#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "blum/kernel/check.hpp"
#include "blum/kernel/shapes.hpp"
#include "exact_geometry.hpp"
#include "shapes_random.hpp"

namespace blum::shapes {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Polygon = std::vector<std::uint32_t>;

/// The axis along which the polygon projects with the largest area (any axis that keeps it
/// non-degenerate would do).
int projection_axis(const std::vector<Point3>& points, const Polygon& polygon) {
  Point3 normal;
  const Point3& origin = points[polygon[0]];
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Point3 &p = points[polygon[i]], &q = points[polygon[i + 1]];
    for (int axis = 0; axis < 3; ++axis) {
      const int u = u_axis(axis), v = v_axis(axis);
      normal[axis] +=
          (p[u] - origin[u]) * (q[v] - origin[v]) - (p[v] - origin[v]) * (q[u] - origin[u]);
    }
  }
  const auto size = [&](int axis) { return std::abs(normal[axis]); };
  int best = size(0) >= size(1) ? 0 : 1;
  return size(best) >= size(2) ? best : 2;
}

/// Cuts ears in random order. An ear's closed triangle holds no other corner, so that collinear
/// corners never give a degenerate triangle.
class EarCutter {
 public:
  EarCutter(const std::vector<Point3>& points, const Polygon& polygon, Random& random)
      : points_(points), left_(polygon), random_(random), axis_(projection_axis(points, polygon)) {
    turn_ = orientation();
  }

  void cut(std::vector<Triangle>& triangles) {
    while (left_.size() > 3) {
      const std::size_t n = left_.size(), start = random_.below(n);
      std::size_t step = 0;
      while (step < n && !is_ear((start + step) % n)) ++step;
      BLUM_CHECK(step < n);  // a simple polygon has two ears
      const std::size_t i = (start + step) % n;
      triangles.push_back({left_[(i + n - 1) % n], left_[i], left_[(i + 1) % n]});
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(i));
    }
    triangles.push_back({left_[0], left_[1], left_[2]});
  }

 private:
  [[nodiscard]] int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return exact::orient2d_along(axis_, points_[a], points_[b], points_[c]);
  }

  /// +1 if the projection runs counter-clockwise: the turn at its lexicographically least corner.
  [[nodiscard]] int orientation() const {
    const int u = u_axis(axis_), v = v_axis(axis_);
    const auto least = std::min_element(left_.begin(), left_.end(), [&](auto a, auto b) {
      return std::pair(points_[a][u], points_[a][v]) < std::pair(points_[b][u], points_[b][v]);
    });
    const auto i = static_cast<std::size_t>(least - left_.begin()), n = left_.size();
    const int sign = turn(left_[(i + n - 1) % n], left_[i], left_[(i + 1) % n]);
    BLUM_CHECK(sign != 0);  // else the polygon is degenerate or not simple
    return sign;
  }

  [[nodiscard]] bool is_ear(std::size_t i) const {
    const std::size_t n = left_.size();
    const std::uint32_t a = left_[(i + n - 1) % n], b = left_[i], c = left_[(i + 1) % n];
    if (turn(a, b, c) != turn_) return false;
    return std::none_of(left_.begin(), left_.end(), [&](std::uint32_t p) {
      return p != a && p != b && p != c && turn(a, b, p) != -turn_ && turn(b, c, p) != -turn_ &&
             turn(c, a, p) != -turn_;
    });
  }

  const std::vector<Point3>& points_;
  Polygon left_;
  Random& random_;
  int axis_;
  int turn_;
};

/// Flips edges between exactly coplanar triangles whose union is a strictly convex quadrilateral.
class Flipper {
 public:
  Flipper(const std::vector<Point3>& points, std::vector<Triangle>& triangles)
      : points_(points), triangles_(triangles) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) enter(t);
  }

  /// Flips edge k of triangle t where that is possible.
  void try_flip(std::uint32_t t, int k) {
    const Triangle& triangle = triangles_[t];
    const std::uint32_t a = triangle[k], b = triangle[(k + 1) % 3], c = triangle[(k + 2) % 3];
    const auto twin = half_edge_.find(key(b, a));
    if (twin == half_edge_.end()) return;
    const std::uint32_t other = twin->second;
    const std::uint32_t d = apex(triangles_[other], a, b);
    if (exact::orient3d(points_[a], points_[b], points_[c], points_[d]) != 0) return;
    const int axis = projection_axis(points_, {a, b, c});
    const auto turn = [&](std::uint32_t p, std::uint32_t q, std::uint32_t r) {
      return exact::orient2d_along(axis, points_[p], points_[q], points_[r]);
    };
    if (turn(a, b, c) * turn(a, b, d) >= 0 || turn(c, d, a) * turn(c, d, b) >= 0) return;
    half_edge_.erase(key(a, b));
    half_edge_.erase(key(b, a));
    triangles_[t] = {a, d, c};
    triangles_[other] = {d, b, c};
    enter(t);
    enter(other);
  }

 private:
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; }
  static std::uint32_t apex(const Triangle& triangle, std::uint32_t a, std::uint32_t b) {
    return *std::find_if(triangle.begin(), triangle.end(),
                         [=](std::uint32_t v) { return v != a && v != b; });
  }
  void enter(std::uint32_t t) {
    const Triangle& triangle = triangles_[t];
    for (int k = 0; k < 3; ++k) half_edge_[key(triangle[k], triangle[(k + 1) % 3])] = t;
  }

  const std::vector<Point3>& points_;
  std::vector<Triangle>& triangles_;
  std::unordered_map<std::uint64_t, std::uint32_t> half_edge_;
};

}  // namespace

PolygonMesh triangulate_facets(const PolygonMesh& mesh, std::uint64_t seed) {
  Random random(seed);
  std::vector<Triangle> triangles;
  for (const Polygon& face : mesh.faces) EarCutter(mesh.points, face, random).cut(triangles);
  // Flips also cross the cuts that facets with holes need, so that no edge of a facet's inside is
  // the same in every triangulation.
  Flipper flipper(mesh.points, triangles);
  for (std::size_t i = 0; i < 8 * triangles.size(); ++i) {
    const auto t = static_cast<std::uint32_t>(random.below(triangles.size()));
    flipper.try_flip(t, static_cast<int>(random.below(3)));
  }
  PolygonMesh result{mesh.points, {}};
  for (const Triangle& triangle : triangles) {
    result.faces.emplace_back(triangle.begin(), triangle.end());
  }
  return result;
}

}  // namespace blum::shapes
