/// Plain computations about axes, in long double and over all triangles, to compare with.
#pragma once

#include <optional>
#include <random>

#include "blum/kernel/inside.hpp"
#include "blum/kernel/point_algebra.hpp"
#include "blum/placement/placement.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum::test {

/// A run with its placement. Immovable, as the parts point at each other.
struct PlacedRun {
  PlacedRun(const PolygonMesh& mesh, double epsilon_part, double edge_part = 0,
            std::uint64_t seed = 1)
      : solid(solid_of(mesh)), points(model_points(solid)), diagonal(extent(points)) {
    placement = std::make_unique<AxisPlacement>(
        solid, PlacementOptions{epsilon_part * diagonal, edge_part * diagonal});
    auto r = compute_medial_axis(solid, seeded(seed), {}, {}, placement->review());
    if (!r) throw std::runtime_error(r.error().message);
    result = std::move(r).value();
  }
  PlacedRun(const PlacedRun&) = delete;

  Solid solid;
  std::vector<Point3> points;  // of the solid, model units
  double diagonal = 1;
  std::unique_ptr<AxisPlacement> placement;
  MedialResult result;
};

struct PlainFoot {
  LongPoint foot{};
  long double distance = 0;
};

/// On each triangle of the solid.
inline std::vector<PlainFoot> feet_on_all(const Solid& solid, const std::vector<Point3>& points,
                                          const Point3& q) {
  std::vector<PlainFoot> all;
  for (const SolidTriangle& t : solid.triangle) {
    PlainFoot f;
    f.foot = nearest_on_triangle(
        wide(q), {wide(points[t.vertex[0]]), wide(points[t.vertex[1]]), wide(points[t.vertex[2]])});
    const LongPoint w = minus(f.foot, wide(q));
    f.distance = std::sqrt(dot(w, w));
    all.push_back(f);
  }
  return all;
}

inline PlainFoot plain_foot(const Solid& solid, const std::vector<Point3>& points,
                            const Point3& q) {
  const auto all = feet_on_all(solid, points, q);
  return *std::min_element(all.begin(), all.end(),
                           [](const auto& a, const auto& b) { return a.distance < b.distance; });
}

/// A point of the axis between p and q, which are inside, by bisection: of the two halves the one
/// whose ends' feet are farther apart for its length. nullopt: feet do not jump.
inline std::optional<Point3> axis_point_between(const Solid& solid,
                                                const std::vector<Point3>& points, Point3 p,
                                                Point3 q) {
  LongPoint at_p = plain_foot(solid, points, p).foot, at_q = plain_foot(solid, points, q).foot;
  const auto apart = [](const LongPoint& a, const LongPoint& b) {
    return std::sqrt(dot(minus(a, b), minus(a, b)));
  };
  for (int step = 0; step < 60; ++step) {
    const Point3 m = middle(p, q);
    if (m == p || m == q) break;
    const LongPoint at_m = plain_foot(solid, points, m).foot;
    if (apart(at_p, at_m) > apart(at_m, at_q)) {
      q = m;
      at_q = at_m;
    } else {
      p = m;
      at_p = at_m;
    }
    if (distance_between(p, q) < 1e-12) break;
  }
  return apart(at_p, at_q) > 1e-4L ? std::optional(p) : std::nullopt;
}

/// About how far q is from the axis: the nearest bisector of its foot and another site's, to first
/// order.
inline double plain_distance_to_axis(const Solid& solid, const std::vector<Point3>& points,
                                     const Point3& q) {
  const auto all = feet_on_all(solid, points, q);
  PlainFoot first = all.front();
  for (const auto& f : all)
    if (f.distance < first.distance) first = f;
  long double least = std::numeric_limits<long double>::infinity();
  for (const auto& f : all) {
    const LongPoint w = minus(f.foot, first.foot);
    const long double apart = std::sqrt(dot(w, w));
    if (apart < 1e-9L) continue;
    least =
        std::min(least, (f.distance * f.distance - first.distance * first.distance) / (2 * apart));
  }
  return static_cast<double>(least);
}

inline double distance_to_mesh(const CellComplex& c, const Point3& q) {
  long double least = std::numeric_limits<long double>::infinity();
  for (const ComplexTriangle& t : c.triangle) {
    const auto v = corners(c, t);
    least = std::min(least, triangle_distance(wide(q), {wide(c.vertex[v[0]].position),
                                                        wide(c.vertex[v[1]].position),
                                                        wide(c.vertex[v[2]].position)}));
  }
  return static_cast<double>(least);
}

}  // namespace blum::test
