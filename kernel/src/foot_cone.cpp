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

/// Place of a triangle in triangles_at(vertex).
std::uint32_t place_at(const Solid& s, std::uint32_t vertex, std::uint32_t triangle) {
  const auto triangles = s.triangles_at(vertex);
  return static_cast<std::uint32_t>(std::ranges::find(triangles, triangle) - triangles.begin());
}

/// Convex edges part the triangles at a vertex into chains.
UnionFind chains_at(const Solid& s, std::uint32_t vertex) {
  UnionFind chain;
  chain.resize(static_cast<std::uint32_t>(s.triangles_at(vertex).size()));
  for (const auto e : s.edges_at(vertex))
    if (s.edge[e].kind != EdgeKind::kConvex)
      chain.unite(place_at(s, vertex, s.edge[e].triangle[0]),
                  place_at(s, vertex, s.edge[e].triangle[1]));
  return chain;
}

std::uint32_t tip_of(const Solid& s, std::uint32_t vertex, std::uint32_t edge) {
  const auto& ends = s.edge[edge].vertex;
  return ends[0] == vertex ? ends[1] : ends[0];
}

/// Into how many parts does the plane of edges e and f, which touches the boundary near the vertex
/// from outside, cut what it touches, faces and edges?
std::uint32_t parts_in_plane(const Solid& s, std::uint32_t vertex, std::uint32_t e,
                             std::uint32_t f) {
  std::vector<std::uint32_t> tip;
  for (const auto g : s.edges_at(vertex)) {
    const auto t = tip_of(s, vertex, g);
    if (g == e || g == f ||
        exact::orient3d(s.point[vertex], s.point[tip_of(s, vertex, e)],
                        s.point[tip_of(s, vertex, f)], s.point[t]) == 0)
      tip.push_back(t);
  }
  const auto place = [&](std::uint32_t v) {
    return static_cast<std::uint32_t>(std::ranges::find(tip, v) - tip.begin());
  };
  UnionFind part;
  part.resize(static_cast<std::uint32_t>(tip.size()));
  for (const auto t : s.triangles_at(vertex)) {
    std::vector<std::uint32_t> in_plane;
    for (const auto v : s.triangle[t].vertex)
      if (v != vertex && place(v) < tip.size()) in_plane.push_back(place(v));
    if (in_plane.size() == 2) part.unite(in_plane[0], in_plane[1]);
  }
  std::uint32_t count = 0;
  for (std::uint32_t k = 0; k < tip.size(); ++k) count += part.find(k) == k;
  return count;
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
  const auto triangles = s.triangles_at(vertex);
  const auto edges = s.edges_at(vertex);
  UnionFind chain = chains_at(s, vertex);
  const auto place = [&](std::uint32_t t) { return place_at(s, vertex, t); };

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

std::optional<Predicates::VertexLink> Predicates::vertex_link(std::uint32_t vertex) const {
  const Solid& s = geometry_->solid();
  const FootCone cone = foot_cone(vertex);
  if (cone == FootCone::kRay || (cone == FootCone::kWide && s.vertex_degenerate[vertex]))
    return std::nullopt;
  VertexLink r;
  UnionFind chain = chains_at(s, vertex);
  const auto n = static_cast<std::uint32_t>(s.triangles_at(vertex).size());
  std::vector<std::uint32_t> number(n, n);
  for (std::uint32_t k = 0; k < n; ++k) {
    auto& c = number[chain.find(k)];
    if (c == n) c = r.chains++;
    r.chain.push_back(c);
  }
  r.merged.assign(r.chains, false);
  if (cone == FootCone::kNone) return r;
  const auto bounding = bounding_edges(s, vertex);
  for (std::size_t k = 0; k < bounding.size(); ++k) {
    const auto e = bounding[k], f = bounding[(k + 1) % bounding.size()];
    r.merged[r.chain[place_at(s, vertex, s.edge[e].triangle[0])]] = true;
    const auto parts = parts_in_plane(s, vertex, e, f);
    if (parts > 2) return std::nullopt;
    r.ray.push_back({{e, f}, parts == 2});
  }
  return r;
}

std::optional<bool> Predicates::passes(std::uint32_t vertex, const VertexLink::Ray& ray, int axis,
                                       double level, const Point3& lo, const Point3& hi) {
  const Solid& s = geometry_->solid();
  const int forward =
      side_of_line(axis, vertex, tip_of(s, vertex, ray.edge[0]), tip_of(s, vertex, ray.edge[1]));
  if (forward != (level > s.point[vertex][axis] ? 1 : -1)) return false;
  bool on_border = false;
  for (int along = 0; along < 3; ++along) {
    if (along == axis) continue;
    const int
        low = compare_rim(vertex, ray.edge[0], ray.edge[1], axis, level, along, lo[along]).value(),
        high = compare_rim(vertex, ray.edge[0], ray.edge[1], axis, level, along, hi[along]).value();
    if (low < 0 || high > 0) return false;
    on_border |= low == 0 || high == 0;
  }
  if (on_border) return std::nullopt;
  return true;
}

int Predicates::side_of_line(int axis, std::uint32_t a, std::uint32_t b, std::uint32_t p) const {
  const Solid& s = geometry_->solid();
  return exact::orient2d_along(axis, s.point[a], s.point[b], s.point[p]);
}

}  // namespace blum
