#include "cell_surface.hpp"

#include <algorithm>

#include "blum/kernel/check.hpp"
#include "blum/kernel/strictly_inside.hpp"
#include "box_edges.hpp"

namespace blum {

CellSurface::CellSurface(const SiteGeometry& geometry, const Box3& box,
                         std::span<const std::uint32_t> triangles,
                         const std::array<std::shared_ptr<const FaceDiagram>, 6>& face,
                         const CellOracles& oracles)
    : geometry_(geometry), solid_(geometry.solid()), box_(box), face_(face), oracles_(oracles) {
  number_elements(triangles);
  glue();
}

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
      if (fresh) it->second = strictly_inside(solid_.point[v], box_);
      if (it->second && triangle_.try_emplace(t, elements).second) ++elements;
    }
  for (const auto& [v, inside] : seen)
    if (inside) vertex_.push_back(v);
  for (int f = 0; f < 6; ++f)
    for (const FaceTracePoint& p : face_[f]->trace_point) edge_[p.boundary_edge];
  for (const auto v : vertex_)
    for (const auto e : solid_.edges_at(v)) edge_[e];
  for (const auto v : vertex_) {
    bool convex = false, reflex = false;
    for (const auto e : solid_.edges_at(v)) {
      convex |= solid_.edge[e].kind == EdgeKind::kConvex;
      reflex |= solid_.edge[e].kind == EdgeKind::kReflex;
    }
    if (convex && reflex) {
      const Predicates::AxisAtVertex* axis = oracles_.axis_at(v);
      vertices_known_ &= axis != nullptr;
      if (axis != nullptr && axis->trees > 1) axis_at_[v] = axis;
    }
    for (const auto e : solid_.edges_at(v))
      if (solid_.edge[e].kind == EdgeKind::kConvex &&
          vertex_node_.try_emplace({v, tree_at(v, e)}, nodes).second)
        ++nodes;
  }
  cut_.resize(elements);
  surface_.resize(elements);
  graph_.resize(nodes);
  node_element_.assign(nodes, kNone);
}

std::uint32_t CellSurface::tree_at(std::uint32_t vertex, std::uint32_t edge) const {
  const auto it = axis_at_.find(vertex);
  if (it == axis_at_.end()) return 0;
  const auto edges = solid_.edges_at(vertex);
  return it->second->tree[static_cast<std::size_t>(std::ranges::find(edges, edge) - edges.begin())];
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
  for (const EdgePair& p : edge_pairs()) {
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
      if (const auto it = vertex_node_.find({v, tree_at(v, e)}); it != vertex_node_.end()) {
        nodes.push_back(it->second);
        node_element_[it->second] = a;
      }
    // A convex edge has exactly two ends in the closed cell.
    BLUM_CHECK(nodes.size() == 2);
    graph_.unite(nodes[0], nodes[1]);
    arc_.push_back({nodes[0], nodes[1]});
  }
  for (const auto& [v, axis] : axis_at_)
    for (const auto t : axis->merged)
      cut_.unite(triangle_.at(axis->merged.front()), triangle_.at(t));
}

}  // namespace blum
