#include "blum/arrangement/common_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "blum/kernel/closest_point.hpp"

namespace blum {
namespace {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;

/// Solves the symmetric system a s = r, damped by a little of its trace.
bool solve(Matrix a, Vector r, Vector& s) {
  const double damping = 1e-13 * (a[0][0] + a[1][1] + a[2][2]) + 1e-300;
  for (int k = 0; k < 3; ++k) a[k][k] += damping;
  for (int k = 0; k < 3; ++k) {
    if (!(a[k][k] > 0)) return false;
    for (int i = k + 1; i < 3; ++i) {
      const double f = a[i][k] / a[k][k];
      for (int j = k; j < 3; ++j) a[i][j] -= f * a[k][j];
      r[i] -= f * r[k];
    }
  }
  for (int k = 2; k >= 0; --k) {
    s[k] = r[k];
    for (int j = k + 1; j < 3; ++j) s[k] -= a[k][j] * s[j];
    s[k] /= a[k][k];
  }
  return true;
}

}  // namespace

CommonPoint common_point(const SiteGeometry& geometry, std::span<const std::vector<SiteId>> groups,
                         const Point3& lo, const Point3& hi) {
  constexpr double kLost = std::numeric_limits<double>::infinity();
  constexpr int kIterations = 60;
  CommonPoint best{{}, kLost};
  if (groups.size() < 2) return best;
  Point3 x;
  for (int k = 0; k < 3; ++k) x[k] = 0.5 * lo[k] + 0.5 * hi[k];
  best.point = x;
  for (int iteration = 0; iteration < kIterations && best.gap > 0; ++iteration) {
    const NearestFoot first = nearest_foot(geometry, groups[0], x);
    if (!(first.distance > 0)) break;
    Matrix normal{};
    Vector rhs{}, step{};
    double gap = 0;
    for (std::size_t g = 1; g < groups.size(); ++g) {
      const NearestFoot other = nearest_foot(geometry, groups[g], x);
      if (!(other.distance > 0)) return best;
      const double difference = first.distance - other.distance;
      gap = std::max(gap, std::abs(difference));
      Vector gradient{};
      for (int k = 0; k < 3; ++k)
        if (lo[k] < hi[k])
          gradient[k] =
              (x[k] - first.foot[k]) / first.distance - (x[k] - other.foot[k]) / other.distance;
      for (int i = 0; i < 3; ++i) {
        rhs[i] += gradient[i] * difference;
        for (int j = 0; j < 3; ++j) normal[i][j] += gradient[i] * gradient[j];
      }
    }
    bool within = true;
    for (int k = 0; k < 3; ++k) within &= x[k] >= lo[k] && x[k] <= hi[k];
    if (within && gap < best.gap) best = {x, gap};
    if (!solve(normal, rhs, step)) break;
    for (int k = 0; k < 3; ++k) {
      if (lo[k] == hi[k]) continue;
      const double size = hi[k] - lo[k];
      x[k] = std::clamp(x[k] - step[k], lo[k] - size, hi[k] + size);
    }
  }
  return best;
}

bool feet_span(const SiteGeometry& geometry, std::span<const std::vector<SiteId>> groups,
               const Point3& x) {
  std::vector<Vector> direction;
  for (const auto& g : groups) {
    const NearestFoot n = nearest_foot(geometry, g, x);
    direction.push_back({(n.foot.x - x.x) / n.distance, (n.foot.y - x.y) / n.distance,
                         (n.foot.z - x.z) / n.distance});
  }
  const auto minus = [&](std::size_t i) {
    return Vector{direction[i][0] - direction[0][0], direction[i][1] - direction[0][1],
                  direction[i][2] - direction[0][2]};
  };
  for (std::size_t i = 1; i < direction.size(); ++i)
    for (std::size_t j = i + 1; j < direction.size(); ++j)
      for (std::size_t k = j + 1; k < direction.size(); ++k) {
        const Vector a = minus(i), b = minus(j), c = minus(k);
        const double volume = a[0] * (b[1] * c[2] - b[2] * c[1]) -
                              a[1] * (b[0] * c[2] - b[2] * c[0]) +
                              a[2] * (b[0] * c[1] - b[1] * c[0]);
        if (std::abs(volume) > 1e-6) return true;
      }
  return false;
}

}  // namespace blum
