/// Comparing complexes, and distance hints that are right.
#pragma once

#include <string>

#include "blum/medial/medial_axis.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum::test {

/// What is not the same in two complexes; empty: they are equal bit by bit.
inline std::string difference(const CellComplex& a, const CellComplex& b) {
  if (a.vertex.size() != b.vertex.size() || a.edge.size() != b.edge.size() ||
      a.triangle.size() != b.triangle.size() || a.cone.size() != b.cone.size())
    return "numbers of cells";
  for (std::size_t k = 0; k < a.vertex.size(); ++k) {
    const ComplexVertex &v = a.vertex[k], &w = b.vertex[k];
    const auto at = "of vertex " + std::to_string(k);
    if (!(v.position == w.position)) return "position " + at;
    if (v.radius != w.radius) return "radius " + at;
    if (v.on_axis != w.on_axis) return "on_axis " + at;
    if (v.kind != w.kind) return "kind " + at;
    if (v.governors != w.governors) return "governors " + at;
  }
  for (std::size_t k = 0; k < a.edge.size(); ++k)
    if (a.edge[k].vertex != b.edge[k].vertex || a.edge[k].kind != b.edge[k].kind ||
        a.edge[k].leaf != b.edge[k].leaf || a.edge[k].governors != b.edge[k].governors)
      return "edge " + std::to_string(k);
  for (std::size_t k = 0; k < a.triangle.size(); ++k)
    if (a.triangle[k].edge != b.triangle[k].edge || a.triangle[k].cone != b.triangle[k].cone ||
        a.triangle[k].governors != b.triangle[k].governors)
      return "triangle " + std::to_string(k);
  for (std::size_t k = 0; k < a.cone.size(); ++k)
    if (a.cone[k].leaf != b.cone[k].leaf || a.cone[k].apex != b.cone[k].apex ||
        a.cone[k].boundary_vertex != b.cone[k].boundary_vertex || a.cone[k].ring != b.cone[k].ring)
      return "cone " + std::to_string(k);
  return "";
}

/// Requires: no error.
inline MedialResult voronoi_of(const Solid& solid, const MedialOptions& options) {
  auto r = compute_voronoi_diagram(solid, options);
  if (!r) throw std::runtime_error(r.error().message);
  return std::move(r).value();
}

/// True distances times factors >= 1, the same for the same point; now and then nothing is known.
inline DistanceHint true_distance_hint(const Solid& solid, double spread) {
  return [&solid, spread](const Point3& x) {
    std::seed_seq seq{std::hash<double>{}(x.x), std::hash<double>{}(x.y), std::hash<double>{}(x.z)};
    std::mt19937 random(seq);
    const double u = std::uniform_real_distribution(0.0, 1.0)(random);
    if (spread > 0 && u < 0.1) return std::numeric_limits<double>::infinity();
    return test::boundary_distance(solid, solid.point, x) * (1 + 1e-14 + spread * u * u) + 1e-16;
  };
}

}  // namespace blum::test
