#include "equal_distance.hpp"

#include <ceres/tiny_solver.h>

#include <cmath>

#include "blum/kernel/closest_point.hpp"
#include "blum/kernel/point_algebra.hpp"

namespace blum {
namespace {

/// Working units: the solid's extent is about 1.
constexpr double kTie = 1e-11;
constexpr double kDistinctFeet = 1e-9;

/// Differences of the distances from the first side to the others. The gradient of the distance to
/// a closed convex site is the unit vector from the foot.
struct Differences {
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = 3 };

  const SiteGeometry& geometry;
  std::span<const SiteGroup> sides;
  std::array<bool, 3> is_free;

  [[nodiscard]] int NumResiduals() const { return static_cast<int>(sides.size()) - 1; }

  bool operator()(const double* x, double* residual, double* jacobian) const {
    const Point3 p{x[0], x[1], x[2]};
    const NearestFoot first = nearest_foot(geometry, sides[0], p);
    const auto n = static_cast<std::size_t>(NumResiduals());
    for (std::size_t i = 0; i < n; ++i) {
      const NearestFoot other = nearest_foot(geometry, sides[i + 1], p);
      residual[i] = first.distance - other.distance;
      if (jacobian == nullptr) continue;
      for (int k = 0; k < 3; ++k) {
        const auto slope = [&](const NearestFoot& f) {
          return f.distance > 0 ? (p[k] - f.foot[k]) / f.distance : 0;
        };
        jacobian[static_cast<std::size_t>(k) * n + i] =
            is_free[static_cast<std::size_t>(k)] ? slope(first) - slope(other) : 0;
      }
    }
    return true;
  }
};

Point3 solved(const SiteGeometry& geometry, std::span<const SiteGroup> sides, const Box3& box,
              const Point3& start) {
  Differences differences{geometry, sides, {}};
  for (int k = 0; k < 3; ++k)
    differences.is_free[static_cast<std::size_t>(k)] = box.lo[k] < box.hi[k];
  ceres::TinySolver<Differences> solver;
  solver.options.max_num_iterations = 60;
  solver.options.gradient_tolerance = 1e-16;
  solver.options.parameter_tolerance = 1e-16;
  solver.options.function_tolerance = 1e-32;
  solver.options.cost_threshold = 1e-31;
  solver.options.initial_trust_region_radius = 1e8;
  Eigen::Matrix<double, 3, 1> x(start.x, start.y, start.z);
  solver.Solve(differences, &x);
  return {x[0], x[1], x[2]};
}

std::optional<EqualDistancePoint> checked(const SiteGeometry& geometry, const InsideOracle& inside,
                                          std::span<const SiteGroup> sides,
                                          std::span<const SiteId> candidates, const Point3& x) {
  EqualDistancePoint p;
  p.position = x;
  p.radius = nearest_foot(geometry, candidates, x).distance;
  std::vector<Point3> foot;
  for (const SiteGroup& side : sides) {
    const NearestFoot f = nearest_foot(geometry, side, x);
    if (!(f.distance <= p.radius + kTie)) return std::nullopt;
    for (const Point3& y : foot)
      if (distance_between(y, f.foot) < kDistinctFeet) return std::nullopt;
    foot.push_back(f.foot);
  }
  if (inside.locate(x) != InsideOracle::Where::kInside) return std::nullopt;
  for (const SiteId s : candidates)
    if (distance_estimate(geometry, s, x) <= p.radius + kTie) p.governors.push_back(s);
  return p;
}

}  // namespace

std::optional<EqualDistancePoint> equal_distance_point(const SiteGeometry& geometry,
                                                       const InsideOracle& inside,
                                                       std::span<const SiteGroup> sides,
                                                       std::span<const SiteId> candidates,
                                                       const Box3& box, const Point3& start) {
  if (sides.size() < 2) return std::nullopt;
  const Point3 center = middle(box.lo, box.hi);
  for (const double part : {0.0, 0.5, 1.0}) {
    Point3 from = (1 - part) * start + part * center;
    for (int k = 0; k < 3; ++k)
      if (box.lo[k] == box.hi[k]) from[k] = box.lo[k];
    const Point3 x = solved(geometry, sides, box, from);
    if (!contains(box, x)) continue;
    if (auto p = checked(geometry, inside, sides, candidates, x)) return p;
  }
  return std::nullopt;
}

}  // namespace blum
