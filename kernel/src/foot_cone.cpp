#include <vector>

#include "blum/kernel/predicates.hpp"
#include "exact_geometry.hpp"

namespace blum {

Predicates::FootCone Predicates::foot_cone(std::uint32_t vertex) const {
  const Solid& s = geometry_->solid();
  bool has_reflex = false;
  std::vector<Point3> tip;
  for (const auto e : s.edges_at(vertex)) {
    has_reflex |= s.edge[e].kind == EdgeKind::kReflex;
    const auto& ends = s.edge[e].vertex;
    tip.push_back(s.point[ends[0] == vertex ? ends[1] : ends[0]]);
  }
  bool has_convex = false;
  for (const auto e : s.edges_at(vertex)) has_convex |= s.edge[e].kind == EdgeKind::kConvex;
  if (!has_reflex && has_convex) return FootCone::kNone;  // see "Candidates" in docs/proofs.md
  if (!s.vertex_degenerate[vertex]) return FootCone::kWide;

  // The cone has no interior. If it is not the origin alone, it has an extreme ray e x f (or is a
  // line, the same product) for two edge directions e, f.
  const Point3& v = s.point[vertex];
  const std::size_t n = tip.size();
  std::vector<std::array<std::size_t, 2>> ray;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (i == j || exact::collinear(v, tip[i], tip[j])) continue;
      bool in_cone = true;
      for (std::size_t k = 0; k < n && in_cone; ++k)
        in_cone = k == i || k == j || exact::orient3d(v, tip[i], tip[j], tip[k]) <= 0;
      if (in_cone) ray.push_back({i, j});
    }
  if (ray.empty()) return FootCone::kNone;
  for (const auto& r : ray)
    for (const auto k : r)
      if (exact::orient3d(v, tip[ray[0][0]], tip[ray[0][1]], tip[k]) != 0) return FootCone::kWide;
  return FootCone::kRay;
}

int Predicates::side_of_line(int axis, std::uint32_t a, std::uint32_t b, std::uint32_t p) const {
  const Solid& s = geometry_->solid();
  return exact::orient2d_along(axis, s.point[a], s.point[b], s.point[p]);
}

}  // namespace blum
