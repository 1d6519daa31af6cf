// Components of the graph on a cell's surface, and which of them the flow leaves joined.

#include <algorithm>

#include "blum/arrangement/flow.hpp"
#include "box_edges.hpp"
#include "cell_surface.hpp"

namespace blum {

CellSurface::Components CellSurface::components() {
  std::map<std::array<std::uint32_t, 2>, bool> seen;  // surface and root
  for (const auto& a : arc_) seen[{surface_.find(node_element_[a[0]]), graph_.find(a[0])}];
  Components component;
  for (const auto& [key, unused] : seen) {
    Component c;
    c.surface = key[0];
    c.root = c.joined = key[1];
    component.push_back(std::move(c));
  }
  return component;
}

bool CellSurface::connected(const Components& component) {
  return std::ranges::adjacent_find(component, {}, &Component::surface) == component.end();
}

bool CellSurface::joined_by_flow(Components& component) {
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
  for (const EdgePair& p : edge_pairs()) {
    const auto &a = face_[p.face[0]]->side_region[p.side[0]],
               &b = face_[p.face[1]]->side_region[p.side[1]];
    for (std::size_t k = 0; k < a.size(); ++k) {
      if (a[k] == FaceDiagram::kOutside) continue;
      const auto ra = region(p.face[0], a[k]), rb = region(p.face[1], b[k]);
      if (closed[ra] && closed[rb]) joined.unite(graph_.size() + ra, graph_.size() + rb);
    }
  }
  for (const auto& a : arc_) joined.unite(a[0], a[1]);
  for (Component& c : component) c.joined = joined.find(c.root);
  for (std::size_t i = 1; i < component.size(); ++i)
    if (component[i].surface == component[i - 1].surface &&
        component[i].joined != component[i - 1].joined)
      return false;
  return true;
}

}  // namespace blum
