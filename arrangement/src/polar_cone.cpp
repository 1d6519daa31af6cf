#include "blum/arrangement/polar_cone.hpp"

#include <gmpxx.h>

#include <array>
#include <vector>

#include "blum/kernel/check.hpp"

namespace blum {

bool meets_polar_cone(const Solid& solid, std::uint32_t vertex, const Point3& lo,
                      const Point3& hi) {
  using Vector = std::array<mpq_class, 3>;
  const auto exact = [](const Point3& p) { return Vector{p.x, p.y, p.z}; };
  std::vector<int> free;
  for (int k = 0; k < 3; ++k)
    if (lo[k] != hi[k]) free.push_back(k);
  BLUM_CHECK(free.size() <= 2);
  // The corners of the box in order; a convex polygon, cut by one half-space after the other.
  std::vector<Vector> polygon{exact(lo)};
  if (!free.empty()) {
    Point3 p = lo;
    p[free[0]] = hi[free[0]];
    polygon.push_back(exact(p));
  }
  if (free.size() == 2) {
    Point3 p = lo;
    p[free[1]] = hi[free[1]];
    polygon.push_back(exact(hi));
    polygon.push_back(exact(p));
  }
  const Vector v = exact(solid.point[vertex]);
  std::vector<mpq_class> height;
  std::vector<Vector> kept;
  for (const auto e : solid.edges_at(vertex)) {
    const auto& ends = solid.edge[e].vertex;
    Vector w = exact(solid.point[ends[0] == vertex ? ends[1] : ends[0]]);
    for (std::size_t k = 0; k < 3; ++k) w[k] -= v[k];
    const std::size_t n = polygon.size();
    height.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      height[i] = 0;
      for (std::size_t k = 0; k < 3; ++k) height[i] += w[k] * (polygon[i][k] - v[k]);
    }
    kept.clear();
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = (i + 1) % n;
      if (height[i] <= 0) kept.push_back(polygon[i]);
      if (sgn(height[i]) * sgn(height[j]) >= 0) continue;
      const mpq_class s = height[i] / (height[i] - height[j]);
      Vector x;
      for (std::size_t k = 0; k < 3; ++k)
        x[k] = polygon[i][k] + s * (polygon[j][k] - polygon[i][k]);
      kept.push_back(x);
    }
    polygon.swap(kept);
    if (polygon.empty()) return false;
  }
  return true;
}

}  // namespace blum
