#include "blum/subdivision/cell_test.hpp"

#include <algorithm>
#include <unordered_map>

#include "blum/arrangement/flow.hpp"
#include "blum/kernel/check.hpp"
#include "box_edges.hpp"
#include "cell_surface.hpp"
#include "graph_parts.hpp"

namespace blum {

bool CellSurface::pieces_are_separate() {
  // Theorem A' (docs/proofs.md). The flow takes a piece W of R \ M into one component of the
  // surface minus the graph. A component with a point where the flow leaves the cell takes its own
  // piece, so two such components never share one; boundary triangles are such points. A component
  // where no such point is known must not share a governor with any other.
  std::unordered_map<std::uint32_t, bool> leaves;  // component -> a leaving point is certain
  for (const auto& [t, element] : triangle_) leaves[cut_.find(element)] = true;
  for (int f = 0; f < 6; ++f) {
    const FaceDiagram& d = *face_[f];
    const int outward = f % 2 == 0 ? -1 : 1;
    for (int s = 0; s < 4; ++s)
      for (std::size_t k = 0; k < d.side_region[s].size(); ++k) {
        const auto r = d.side_region[s][k];
        if (r == FaceDiagram::kOutside) continue;
        bool& known = leaves[cut_.find(region(f, r))];
        known = known || never_leaves(geometry_, d.side[s]->interval[k].witness, d.rect, -outward);
      }
  }
  struct Governed {
    std::uint32_t component;
    bool hidden;  // no leaving point is known in one of its components
    bool shared;  // it governs more than one
  };
  std::unordered_map<std::uint64_t, Governed> governed;  // by surface and site
  const auto separate = [&](SiteId label, std::uint32_t element) {
    const std::uint64_t key =
        (std::uint64_t{surface_.find(element)} << 32) | std::uint64_t{label.value};
    const auto component = cut_.find(element);
    const bool hidden = !leaves[component];
    const auto [it, fresh] = governed.try_emplace(key, Governed{component, hidden, false});
    Governed& g = it->second;
    if (fresh || (!g.shared && g.component == component)) return true;
    // The site governs a second component.
    g.shared = true;
    g.hidden = g.hidden || hidden;
    return !g.hidden;
  };
  for (int f = 0; f < 6; ++f)
    for (std::uint32_t i = 0; i < face_[f]->region.size(); ++i)
      for (const SiteId label : face_[f]->region[i].labels)
        if (!separate(label, region(f, i))) return false;
  const SiteIndex& index = geometry_.index();
  for (const auto& [t, element] : triangle_)
    if (!separate(index.face(t), element)) return false;
  for (const auto& [e, nodes] : edge_)
    if (solid_.edge[e].kind == EdgeKind::kReflex &&
        !separate(index.edge(e), triangle_.at(solid_.edge[e].triangle[0])))
      return false;
  for (const auto v : vertex_) {
    if (const auto it = axis_at_.find(v); it != axis_at_.end()) {
      // The points that v governs are in the one region beside the chains that it has merged.
      if (!separate(index.vertex(v), triangle_.at(it->second->merged.front()))) return false;
      continue;
    }
    // Convex edges at v part its triangles; the flow of points that v governs ends at v, on the
    // graph, so v counts as governor of every component that it touches.
    for (const auto t : solid_.triangles_at(v))
      if (!separate(index.vertex(v), triangle_.at(t))) return false;
  }
  return true;
}

CellAnswer CellSurface::conical(std::uint32_t vertex) {
  CellAnswer r;
  r.conical = true;
  r.vertex = vertex;
  // Theorem B: components of G (without the convex edges inside the cell) are trees.
  UnionFind g;
  g.resize(node_base_[5] + static_cast<std::uint32_t>(face_[5]->node.size()));
  std::size_t arcs = 0, merges = 0;
  for (const auto& a : arc_) {
    if (a[0] >= g.size() || a[1] >= g.size()) continue;
    ++arcs;
    if (g.find(a[0]) != g.find(a[1])) ++merges;
    g.unite(a[0], a[1]);
  }
  r.has_axis = arcs > 0;
  r.verdict = arcs == merges ? CellVerdict::kAccepted : CellVerdict::kGraph;
  return r;
}

CellVerdict CellSurface::are_balls() {
  // Euler characteristic of each closed surface from its open cells.
  std::unordered_map<std::uint32_t, long> euler;
  std::unordered_map<std::uint32_t, bool> has_face;
  const auto add = [&](std::uint32_t element, long n) { euler[surface_.find(element)] += n; };
  for (int f = 0; f < 6; ++f) {
    const FaceDiagram& d = *face_[f];
    std::vector<bool> counted(d.piece.size(), false);
    for (std::uint32_t i = 0; i < d.region.size(); ++i) {
      const auto p = d.region[i].piece;
      has_face[surface_.find(region(f, i))] = true;
      if (counted[p]) continue;
      counted[p] = true;
      add(region(f, i), 2 - static_cast<long>(d.piece[p].boundary_circles));
    }
    for (const FaceTrace& t : d.trace) add(triangle_.at(t.triangle), -1);
    for (const FaceTracePoint& p : d.trace_point)
      add(triangle_.at(solid_.edge[p.boundary_edge].triangle[0]), +1);
  }
  for (const auto& [t, element] : triangle_) add(element, +1);
  for (const auto& [e, nodes] : edge_) add(triangle_.at(solid_.edge[e].triangle[0]), -1);
  for (const auto v : vertex_) add(triangle_.at(solid_.triangles_at(v).front()), +1);
  const std::vector<EdgePair>& pairs = edge_pairs();
  // Edges of the cell: open stretches inside O, and crossings of ∂O; ends at corners.
  std::map<std::array<double, 3>, std::uint32_t> corner;
  for (const EdgePair& p : pairs) {
    const FaceDiagram& d = *face_[p.face[0]];
    const SegmentDiagram& s = *d.side[p.side[0]];
    const auto& regions = d.side_region[p.side[0]];
    bool open = false;
    for (std::size_t k = 0; k < regions.size(); ++k) {
      if (k > 0 && s.breakpoint[k - 1].kind == Breakpoint::Kind::kBoundary) {
        open = false;
        add(triangle_.at(s.breakpoint[k - 1].triangle), +1);
      }
      if (regions[k] == FaceDiagram::kOutside) continue;
      if (!open) add(region(p.face[0], regions[k]), -1);
      open = true;
    }
    const auto corner_at = [&](double t, std::uint32_t r) {
      if (r == FaceDiagram::kOutside) return;
      const Point3 x = point_on(s.segment.axis, t, s.segment.u, s.segment.v);
      corner.try_emplace({x.x, x.y, x.z}, region(p.face[0], r));
    };
    corner_at(s.segment.t0, regions.front());
    corner_at(s.segment.t1, regions.back());
  }
  for (const auto& [x, element] : corner) add(element, +1);
  for (const auto& [s, chi] : euler) {
    if (!has_face[s]) return CellVerdict::kShellInside;
    if (chi != 2) return CellVerdict::kEuler;
  }
  return CellVerdict::kAccepted;
}

CellAnswer CellSurface::test(bool resolve) {
  CellAnswer r;
  const auto verdict = [&](CellVerdict v) {
    r.verdict = v;
    return r;
  };
  if (!vertices_known_) return verdict(CellVerdict::kVertex);
  if (const CellVerdict v = are_balls(); v != CellVerdict::kAccepted) return verdict(v);
  r.has_axis = !arc_.empty();

  // (1) The graph of each surface is connected, or Theorem E makes up for it.
  Components component = components();
  const bool whole = connected(component);
  r.curved_cut = !whole && joined_by_flow(component);
  // (2) A piece of the solid minus the axis meets the surface in one component only.
  const bool separate = pieces_are_separate();
  if (!whole && !r.curved_cut && !(separate && parted_by_planes(component, r)))
    return verdict(CellVerdict::kGraph);
  if (!separate) return verdict(CellVerdict::kLabel);
  if (resolve && !shapes_are_simple(graph_, arc_)) return verdict(CellVerdict::kCluster);
  return verdict(CellVerdict::kAccepted);
}

Rect box_face(const Box3& box, int face) {
  const int axis = face / 2, u = u_axis(axis), v = v_axis(axis);
  return {axis,     face % 2 == 0 ? box.lo[axis] : box.hi[axis], box.lo[u], box.hi[u], box.lo[v],
          box.hi[v]};
}

CellAnswer test_cell(const SiteGeometry& geometry, const Box3& box,
                     std::span<const SiteId> candidates, std::span<const std::uint32_t> triangles,
                     const std::array<std::shared_ptr<const FaceDiagram>, 6>& face,
                     const CellOracles& oracles, bool resolve) {
  for ([[maybe_unused]] const auto& d : face) BLUM_REQUIRE(d && d->status == FaceStatus::kDecided);
  CellSurface surface(geometry, box, triangles, face, oracles);
  if (surface.vertices().size() == 1) {
    const auto v = surface.vertices().front();
    const bool incident =
        std::ranges::all_of(candidates, [&](SiteId s) { return geometry.has_corner(s, v); });
    if (incident) return surface.conical(v);
  }
  return surface.test(resolve);
}

}  // namespace blum
