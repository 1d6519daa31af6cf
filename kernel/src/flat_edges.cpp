#include "flat_edges.hpp"

#include <algorithm>
#include <cmath>

#include "blum/kernel/point_algebra.hpp"

namespace blum {
namespace {

Point3 normal(const Solid& solid, std::uint32_t triangle) {
  const auto& v = solid.triangle[triangle].vertex;
  const Point3& a = solid.point[v[0]];
  return cross(solid.point[v[1]] - a, solid.point[v[2]] - a);
}

/// How far a triangle with the vertex `on_plane` reaches off the plane.
double distance_off(const Solid& solid, std::uint32_t triangle, std::uint32_t on_plane,
                    const Point3& normal) {
  double most = 0;
  for (const std::uint32_t v : solid.triangle[triangle].vertex) {
    const Point3 to_v = solid.point[v] - solid.point[on_plane];
    most = std::max(most, std::abs(inner(normal, to_v)));
  }
  return most / length(normal);
}

}  // namespace

std::vector<bool> nearly_flat_edges(const Solid& solid, double tolerance) {
  std::vector<bool> nearly_flat;
  nearly_flat.reserve(solid.edge.size());
  for (const SolidEdge& e : solid.edge) {
    const Point3 n0 = normal(solid, e.triangle[0]), n1 = normal(solid, e.triangle[1]);
    const double off = std::max(distance_off(solid, e.triangle[0], e.vertex[0], n1),
                                distance_off(solid, e.triangle[1], e.vertex[0], n0));
    nearly_flat.push_back(e.kind != EdgeKind::kFlat && inner(n0, n1) > 0 &&
                          solid.frame.length_to_model(off) <= tolerance);
  }
  return nearly_flat;
}

}  // namespace blum
