#include "common_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "blum/kernel/closest_point.hpp"

namespace blum {
namespace {

struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  Point3 foot;
};

Nearest nearest(const SiteGeometry& geometry, std::span<const SiteId> sites, const Point3& x) {
  Nearest best;
  for (const SiteId s : sites) {
    const Point3 y = closest_point(geometry, s, x);
    const double d = std::hypot(y.x - x.x, y.y - x.y, y.z - x.z);
    if (d < best.distance) best = {d, y};
  }
  return best;
}

/// Solves the symmetric 3x3 system a s = r, damped; false if singular.
bool solve(std::array<std::array<double, 3>, 3> a, std::array<double, 3> r,
           std::array<double, 3>& s) {
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

std::optional<Point3> common_point(const SiteGeometry& geometry,
                                   std::span<const std::vector<SiteId>> groups, const Box3& box) {
  if (groups.size() < 2) return std::nullopt;
  Point3 x;
  for (int k = 0; k < 3; ++k) x[k] = 0.5 * (box.lo[k] + box.hi[k]);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const Nearest first = nearest(geometry, groups[0], x);
    if (!(first.distance > 0)) return std::nullopt;
    std::array<std::array<double, 3>, 3> normal{};
    std::array<double, 3> rhs{}, step{};
    double worst = 0;
    for (std::size_t g = 1; g < groups.size(); ++g) {
      const Nearest other = nearest(geometry, groups[g], x);
      if (!(other.distance > 0)) return std::nullopt;
      const double gap = first.distance - other.distance;
      worst = std::max(worst, std::abs(gap));
      std::array<double, 3> gradient;
      for (int k = 0; k < 3; ++k)
        gradient[k] =
            (x[k] - first.foot[k]) / first.distance - (x[k] - other.foot[k]) / other.distance;
      for (int i = 0; i < 3; ++i) {
        rhs[i] += gradient[i] * gap;
        for (int j = 0; j < 3; ++j) normal[i][j] += gradient[i] * gradient[j];
      }
    }
    if (worst <= kCommonTolerance) {
      for (int k = 0; k < 3; ++k)
        if (x[k] < box.lo[k] || x[k] > box.hi[k]) return std::nullopt;
      return x;
    }
    if (!solve(normal, rhs, step)) return std::nullopt;
    for (int k = 0; k < 3; ++k) {
      // Leaving the box by more than its size means that no common point is near.
      const double size = box.hi[k] - box.lo[k];
      x[k] = std::clamp(x[k] - step[k], box.lo[k] - size, box.hi[k] + size);
    }
  }
  return std::nullopt;
}

}  // namespace blum
