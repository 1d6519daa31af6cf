#include <algorithm>
#include <array>
#include <vector>

#include "blum/kernel/predicates.hpp"
#include "blum/kernel/union_find.hpp"
#include "exact_geometry.hpp"

namespace blum {

namespace {

std::vector<Point3> tips_at(const Solid& s, std::uint32_t vertex) {
  std::vector<Point3> tip;
  for (const auto e : s.edges_at(vertex)) {
    const auto& ends = s.edge[e].vertex;
    tip.push_back(s.point[ends[0] == vertex ? ends[1] : ends[0]]);
  }
  return tip;
}

bool has_edge(const Solid& s, std::uint32_t vertex, EdgeKind kind) {
  return std::ranges::any_of(s.edges_at(vertex), [&](auto e) { return s.edge[e].kind == kind; });
}

/// The edges that bound the polar cone of a vertex that is not degenerate.
std::vector<std::uint32_t> bounding_edges(const Solid& s, std::uint32_t vertex) {
  std::vector<std::uint32_t> edges;
  for (const auto k : exact::polar_cone_sides(s.point[vertex], tips_at(s, vertex)))
    edges.push_back(s.edges_at(vertex)[k]);
  return edges;
}

}  // namespace

Predicates::FootCone Predicates::foot_cone(std::uint32_t vertex) const {
  const Solid& s = geometry_->solid();
  if (!has_edge(s, vertex, EdgeKind::kReflex) && has_edge(s, vertex, EdgeKind::kConvex))
    return FootCone::kNone;  // see "Candidates" in docs/proofs.md
  if (!s.vertex_degenerate[vertex]) {
    // The cone lies inside the solid or outside. Beyond its faces feet lie on the edges that bound
    // it, and no foot of a point inside lies on a convex edge.
    return std::ranges::any_of(bounding_edges(s, vertex),
                               [&](auto e) { return s.edge[e].kind == EdgeKind::kConvex; })
               ? FootCone::kNone
               : FootCone::kWide;
  }

  // The cone has no interior. If it is not the origin alone, it has an extreme ray e x f (or is a
  // line, the same product) for two edge directions e, f.
  const Point3& v = s.point[vertex];
  const std::vector<Point3> tip = tips_at(s, vertex);
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
  const auto across = [&](std::size_t k) {
    return std::ranges::all_of(
        ray, [&](const auto& r) { return exact::orient3d(v, tip[r[0]], tip[r[1]], tip[k]) == 0; });
  };
  const bool parallel = std::ranges::all_of(ray, [&](const auto& r) {
    return std::ranges::all_of(
        r, [&](auto k) { return exact::orient3d(v, tip[ray[0][0]], tip[ray[0][1]], tip[k]) == 0; });
  });
  if (parallel) return FootCone::kRay;
  // A plane sector: two edges go straight on across its plane, and bound it.
  for (std::size_t k = 0; k < n; ++k)
    if (across(k) && s.edge[s.edges_at(vertex)[k]].kind == EdgeKind::kConvex)
      return FootCone::kNone;
  return FootCone::kWide;
}

std::optional<Predicates::AxisAtVertex> Predicates::axis_at(std::uint32_t vertex) const {
  const Solid& s = geometry_->solid();
  const bool wide = foot_cone(vertex) == FootCone::kWide;
  if (wide && s.vertex_degenerate[vertex]) return std::nullopt;
  // Convex edges part the triangles at the vertex into chains.
  const auto triangles = s.triangles_at(vertex);
  const auto edges = s.edges_at(vertex);
  UnionFind chain;
  chain.resize(static_cast<std::uint32_t>(triangles.size()));
  const auto place = [&](std::uint32_t t) {
    return static_cast<std::uint32_t>(std::ranges::find(triangles, t) - triangles.begin());
  };
  for (const auto e : edges)
    if (s.edge[e].kind != EdgeKind::kConvex)
      chain.unite(place(s.edge[e].triangle[0]), place(s.edge[e].triangle[1]));

  AxisAtVertex r;
  std::vector<bool> merges(triangles.size(), false);  // by the root of a chain
  if (wide)
    for (const auto e : bounding_edges(s, vertex)) {
      const auto t = s.edge[e].triangle[0];
      const auto root = chain.find(place(t));
      if (!merges[root]) r.merged.push_back(t);
      merges[root] = true;
    }
  // Two convex edges are in one tree if a chain between them lies beside a region of its own.
  UnionFind same;
  same.resize(static_cast<std::uint32_t>(edges.size()));
  std::vector<std::uint32_t> beside(triangles.size(), same.size());
  for (std::uint32_t k = 0; k < edges.size(); ++k) {
    if (s.edge[edges[k]].kind != EdgeKind::kConvex) continue;
    for (const auto t : s.edge[edges[k]].triangle) {
      const auto root = chain.find(place(t));
      if (merges[root]) continue;
      if (beside[root] < same.size()) same.unite(beside[root], k);
      beside[root] = k;
    }
  }
  std::vector<std::uint32_t> number(edges.size(), same.size());
  r.tree.assign(edges.size(), 0);
  for (std::uint32_t k = 0; k < edges.size(); ++k) {
    if (s.edge[edges[k]].kind != EdgeKind::kConvex) continue;
    auto& n = number[same.find(k)];
    if (n == same.size()) n = r.trees++;
    r.tree[k] = n;
  }
  return r;
}

int Predicates::side_of_line(int axis, std::uint32_t a, std::uint32_t b, std::uint32_t p) const {
  const Solid& s = geometry_->solid();
  return exact::orient2d_along(axis, s.point[a], s.point[b], s.point[p]);
}

}  // namespace blum
