/// An oracle for Predicates::axis_at: the graph on a small box about the vertex.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <vector>

#include "blum/arrangement/face_diagram.hpp"
#include "blum/kernel/union_find.hpp"
#include "blum/subdivision/cell_test.hpp"

namespace blum::test {

struct SharedSide {
  std::size_t face[2];
  int side[2];
};
/// Sides of two faces of a box that are one edge of it.
inline std::vector<SharedSide> shared_sides() {
  const Box3 box{{0, 0, 0}, {1, 2, 3}};
  std::vector<SharedSide> pairs;
  for (int f = 0; f < 6; ++f)
    for (int g = f + 1; g < 6; ++g)
      for (int s = 0; s < 4; ++s)
        for (int t = 0; t < 4; ++t)
          if (side_segment(box_face(box, f), s) == side_segment(box_face(box, g), t))
            pairs.push_back({{static_cast<std::size_t>(f), static_cast<std::size_t>(g)}, {s, t}});
  return pairs;
}

/// The graph on the surface of a cell with the given diagrams, convex boundary edges inside the
/// cell not counted.
struct GraphComponents {
  std::size_t count = 0;
  std::map<std::uint32_t, std::uint32_t> of_edge;  ///< of convex edges that cross the surface once
};
inline GraphComponents graph_components(
    const std::array<std::shared_ptr<const FaceDiagram>, 6>& face) {
  std::array<std::uint32_t, 6> base{};
  std::uint32_t nodes = 0;
  for (int f = 0; f < 6; ++f) {
    base[f] = nodes;
    nodes += static_cast<std::uint32_t>(face[f]->node.size());
  }
  UnionFind graph;
  graph.resize(nodes);
  std::size_t components = nodes;
  const auto unite = [&](std::uint32_t a, std::uint32_t b) {
    if (graph.find(a) != graph.find(b)) --components;
    graph.unite(a, b);
  };
  for (int f = 0; f < 6; ++f)
    for (const FaceArc& a : face[f]->arc) unite(base[f] + a.from, base[f] + a.to);
  for (const auto& p : shared_sides())
    for (std::uint32_t i = 0; i < face[p.face[0]]->node.size(); ++i)
      for (std::uint32_t j = 0; j < face[p.face[1]]->node.size(); ++j) {
        const FaceNode &m = face[p.face[0]]->node[i], &n = face[p.face[1]]->node[j];
        if (m.kind == FaceNode::Kind::kSide && n.kind == FaceNode::Kind::kSide &&
            m.side == p.side[0] && n.side == p.side[1] && m.breakpoint == n.breakpoint)
          unite(base[p.face[0]] + i, base[p.face[1]] + j);
      }
  GraphComponents r;
  r.count = components;
  for (int f = 0; f < 6; ++f)
    for (std::uint32_t i = 0; i < face[f]->node.size(); ++i)
      if (const FaceNode& n = face[f]->node[i]; n.kind == FaceNode::Kind::kConvexEdge)
        r.of_edge[n.boundary_edge] = graph.find(base[f] + i);
  return r;
}

}  // namespace blum::test
