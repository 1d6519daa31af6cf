#include "blum/subdivision/cell_test.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "blum/arrangement/flow.hpp"
#include "blum/kernel/check.hpp"
#include "blum/kernel/union_find.hpp"
#include "box_edges.hpp"
#include "graph_parts.hpp"

namespace blum {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

/// The closed surface of the components of cell ∩ O, cut along the graph.
class CellSurface {
 public:
  CellSurface(const SiteGeometry& geometry, const Box3& box,
              std::span<const std::uint32_t> triangles,
              const std::array<std::shared_ptr<const FaceDiagram>, 6>& face,
              const ConnectedAtVertex& connected_at)
      : geometry_(geometry),
        solid_(geometry.solid()),
        box_(box),
        face_(face),
        connected_at_(connected_at) {
    number_elements(triangles);
    glue();
  }

  [[nodiscard]] CellAnswer conical(std::uint32_t vertex, bool resolve);
  [[nodiscard]] CellAnswer test(bool resolve);
  [[nodiscard]] const std::vector<std::uint32_t>& vertices() const { return vertex_; }

 private:
  void number_elements(std::span<const std::uint32_t> triangles);
  void glue();
  [[nodiscard]] bool strictly_inside(const Point3& p) const {
    for (int k = 0; k < 3; ++k)
      if (!(p[k] > box_.lo[k] && p[k] < box_.hi[k])) return false;
    return true;
  }
  [[nodiscard]] std::uint32_t region(int f, std::uint32_t r) const { return region_base_[f] + r; }
  [[nodiscard]] std::uint32_t node(int f, std::uint32_t n) const { return node_base_[f] + n; }
  [[nodiscard]] bool joined_by_flow();
  [[nodiscard]] bool pieces_are_separate();

  const SiteGeometry& geometry_;
  const Solid& solid_;
  const Box3& box_;
  const std::array<std::shared_ptr<const FaceDiagram>, 6>& face_;
  const ConnectedAtVertex& connected_at_;

  // Elements of the surface: regions of the six diagrams, then triangles that meet the cell.
  std::array<std::uint32_t, 6> region_base_{}, node_base_{};
  std::map<std::uint32_t, std::uint32_t> triangle_;           // triangle -> element
  std::map<std::uint32_t, std::vector<std::uint32_t>> edge_;  // boundary edge in the cell -> nodes
  std::vector<std::uint32_t> vertex_;                         // boundary vertices in the cell
  std::map<std::uint32_t, std::uint32_t> vertex_node_;        // those with convex edges
  UnionFind cut_;      // components of the surface minus the graph
  UnionFind surface_;  // components of the surface
  UnionFind graph_;
  std::vector<std::uint32_t> node_element_;  // some element beside each node
  std::vector<std::array<std::uint32_t, 2>> arc_;
  std::vector<bool> node_merged_;  // second name of a node on a cell edge
};

void CellSurface::number_elements(std::span<const std::uint32_t> triangles) {
  std::uint32_t regions = 0, nodes = 0;
  for (int f = 0; f < 6; ++f) {
    region_base_[f] = regions;
    node_base_[f] = nodes;
    regions += static_cast<std::uint32_t>(face_[f]->region.size());
    nodes += static_cast<std::uint32_t>(face_[f]->node.size());
  }
  std::uint32_t elements = regions;
  for (int f = 0; f < 6; ++f)
    for (const FaceTrace& t : face_[f]->trace)
      if (triangle_.try_emplace(t.triangle, elements).second) ++elements;
  std::map<std::uint32_t, bool> seen;
  for (const auto t : triangles)
    for (const auto v : solid_.triangle[t].vertex) {
      const auto [it, fresh] = seen.try_emplace(v, false);
      if (fresh) it->second = strictly_inside(solid_.point[v]);
      if (it->second && triangle_.try_emplace(t, elements).second) ++elements;
    }
  for (const auto& [v, inside] : seen)
    if (inside) vertex_.push_back(v);
  for (int f = 0; f < 6; ++f)
    for (const FaceTracePoint& p : face_[f]->trace_point) edge_[p.boundary_edge];
  for (const auto v : vertex_)
    for (const auto e : solid_.edges_at(v)) edge_[e];
  for (const auto v : vertex_)
    for (const auto e : solid_.edges_at(v))
      if (solid_.edge[e].kind == EdgeKind::kConvex && vertex_node_.try_emplace(v, nodes).second)
        ++nodes;
  cut_.resize(elements);
  surface_.resize(elements);
  graph_.resize(nodes);
  node_element_.assign(nodes, kNone);
  node_merged_.assign(nodes, false);
}

void CellSurface::glue() {
  for (int f = 0; f < 6; ++f) {
    const FaceDiagram& d = *face_[f];
    std::vector<std::uint32_t> of_piece(d.piece.size(), kNone);
    for (std::uint32_t r = 0; r < d.region.size(); ++r) {
      auto& first = of_piece[d.region[r].piece];
      if (first == kNone) first = region(f, r);
      surface_.unite(first, region(f, r));
    }
    for (const FaceTrace& t : d.trace) {
      cut_.unite(region(f, t.region), triangle_.at(t.triangle));
      surface_.unite(region(f, t.region), triangle_.at(t.triangle));
    }
    for (std::uint32_t n = 0; n < d.node.size(); ++n) {
      node_element_[node(f, n)] = of_piece[d.node[n].piece];
      if (d.node[n].kind == FaceNode::Kind::kConvexEdge)
        edge_.at(d.node[n].boundary_edge).push_back(node(f, n));
    }
    for (const FaceArc& a : d.arc) {
      arc_.push_back({node(f, a.from), node(f, a.to)});
      graph_.unite(arc_.back()[0], arc_.back()[1]);
    }
  }
  const std::vector<EdgePair>& pairs = edge_pairs();
  for (const EdgePair& p : pairs) {
    const auto &a = face_[p.face[0]]->side_region[p.side[0]],
               &b = face_[p.face[1]]->side_region[p.side[1]];
    BLUM_CHECK(a.size() == b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      BLUM_CHECK((a[k] == FaceDiagram::kOutside) == (b[k] == FaceDiagram::kOutside));
      if (a[k] == FaceDiagram::kOutside) continue;
      cut_.unite(region(p.face[0], a[k]), region(p.face[1], b[k]));
      surface_.unite(region(p.face[0], a[k]), region(p.face[1], b[k]));
    }
    for (std::uint32_t i = 0; i < face_[p.face[0]]->node.size(); ++i) {
      const FaceNode& m = face_[p.face[0]]->node[i];
      if (m.kind != FaceNode::Kind::kSide || m.side != p.side[0]) continue;
      for (std::uint32_t j = 0; j < face_[p.face[1]]->node.size(); ++j) {
        const FaceNode& n = face_[p.face[1]]->node[j];
        if (n.kind != FaceNode::Kind::kSide || n.side != p.side[1] || n.breakpoint != m.breakpoint)
          continue;
        // One node, two names.
        graph_.unite(node(p.face[0], i), node(p.face[1], j));
        arc_.push_back({node(p.face[0], i), node(p.face[1], j)});
      }
    }
  }
  for (auto& [e, nodes] : edge_) {
    const SolidEdge& edge = solid_.edge[e];
    const auto a = triangle_.at(edge.triangle[0]), b = triangle_.at(edge.triangle[1]);
    surface_.unite(a, b);
    if (edge.kind != EdgeKind::kConvex) {
      cut_.unite(a, b);
      continue;
    }
    for (const auto v : edge.vertex)
      if (const auto it = vertex_node_.find(v); it != vertex_node_.end()) {
        nodes.push_back(it->second);
        node_element_[it->second] = a;
      }
    // A convex edge has exactly two ends in the closed cell.
    BLUM_CHECK(nodes.size() == 2);
    graph_.unite(nodes[0], nodes[1]);
    arc_.push_back({nodes[0], nodes[1]});
  }
}

bool CellSurface::joined_by_flow() {
  // Regions through which no segment to a foot leaves the cell: a path in such a region, from one
  // component of the graph to another, is never met by the flow.
  const auto regions = cut_.size() - static_cast<std::uint32_t>(triangle_.size());
  std::vector<bool> closed(regions, false);
  UnionFind joined;
  joined.resize(graph_.size() + regions);  // nodes, then regions
  for (int f = 0; f < 6; ++f) {
    const FaceDiagram& d = *face_[f];
    for (std::uint32_t i = 0; i < d.region.size(); ++i)
      closed[region(f, i)] = std::ranges::all_of(d.region[i].labels, [&](SiteId label) {
        return never_leaves(geometry_, label, d.rect, f % 2 == 0 ? -1 : 1);
      });
    for (const FaceArc& a : d.arc)
      for (const auto r : a.region)
        if (r != FaceArc::kUnknown && closed[region(f, r)])
          joined.unite(node(f, a.from), graph_.size() + region(f, r));
  }
  const std::vector<EdgePair>& pairs = edge_pairs();
  for (const EdgePair& p : pairs) {
    const auto &a = face_[p.face[0]]->side_region[p.side[0]],
               &b = face_[p.face[1]]->side_region[p.side[1]];
    for (std::size_t k = 0; k < a.size(); ++k) {
      if (a[k] == FaceDiagram::kOutside) continue;
      const auto ra = region(p.face[0], a[k]), rb = region(p.face[1], b[k]);
      if (closed[ra] && closed[rb]) joined.unite(graph_.size() + ra, graph_.size() + rb);
    }
  }
  for (const auto& a : arc_) joined.unite(a[0], a[1]);
  std::unordered_map<std::uint32_t, std::uint32_t> joined_of;
  for (const auto& a : arc_) {
    const auto [it, fresh] =
        joined_of.try_emplace(surface_.find(node_element_[a[0]]), joined.find(a[0]));
    if (!fresh && it->second != joined.find(a[0])) return false;
  }
  return true;
}

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
  for (const auto v : vertex_)
    // Convex edges at v part its triangles; the flow of points that v governs ends at v, on the
    // graph, so v counts as governor of every component that it touches.
    for (const auto t : solid_.triangles_at(v))
      if (!separate(index.vertex(v), triangle_.at(t))) return false;
  return true;
}

CellAnswer CellSurface::conical(std::uint32_t vertex, bool) {
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

CellAnswer CellSurface::test(bool resolve) {
  CellAnswer r;
  const auto verdict = [&](CellVerdict v) {
    r.verdict = v;
    return r;
  };
  for (const auto v : vertex_) {
    bool convex = false, reflex = false;
    for (const auto e : solid_.edges_at(v)) {
      convex |= solid_.edge[e].kind == EdgeKind::kConvex;
      reflex |= solid_.edge[e].kind == EdgeKind::kReflex;
    }
    if (convex && reflex && !connected_at_(v)) return verdict(CellVerdict::kVertex);
  }

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
    if (!has_face[s]) return verdict(CellVerdict::kShellInside);
    if (chi != 2) return verdict(CellVerdict::kEuler);
  }

  // (1) The graph of each surface is connected, or Theorem E' joins its components.
  std::unordered_map<std::uint32_t, std::uint32_t> graph_of;
  bool connected = true;
  for (const auto& a : arc_) {
    r.has_axis = true;
    const auto s = surface_.find(node_element_[a[0]]);
    const auto [it, fresh] = graph_of.try_emplace(s, graph_.find(a[0]));
    connected &= fresh || it->second == graph_.find(a[0]);
  }
  if (!connected) {
    if (!joined_by_flow()) return verdict(CellVerdict::kGraph);
    r.curved_cut = true;
  }

  // (2) A piece of the solid minus the axis meets the surface in one component only.
  if (!pieces_are_separate()) return verdict(CellVerdict::kLabel);
  if (resolve && !shapes_are_simple(graph_, arc_)) return verdict(CellVerdict::kCluster);
  return verdict(CellVerdict::kAccepted);
}

}  // namespace

Rect box_face(const Box3& box, int face) {
  const int axis = face / 2, u = u_axis(axis), v = v_axis(axis);
  return {axis,     face % 2 == 0 ? box.lo[axis] : box.hi[axis], box.lo[u], box.hi[u], box.lo[v],
          box.hi[v]};
}

CellAnswer test_cell(const SiteGeometry& geometry, const Box3& box,
                     std::span<const SiteId> candidates, std::span<const std::uint32_t> triangles,
                     const std::array<std::shared_ptr<const FaceDiagram>, 6>& face,
                     const ConnectedAtVertex& connected_at, bool resolve) {
  for ([[maybe_unused]] const auto& d : face) BLUM_REQUIRE(d && d->status == FaceStatus::kDecided);
  CellSurface surface(geometry, box, triangles, face, connected_at);
  if (surface.vertices().size() == 1) {
    const auto v = surface.vertices().front();
    const bool incident =
        std::ranges::all_of(candidates, [&](SiteId s) { return geometry.has_corner(s, v); });
    if (incident) return surface.conical(v, resolve);
  }
  return surface.test(resolve);
}

}  // namespace blum
