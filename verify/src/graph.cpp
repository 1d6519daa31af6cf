#include "graph.hpp"

#include <algorithm>

#include "failure.hpp"

namespace blum::verify {
namespace {

using NodeKind = FaceMap::Node::Kind;

bool is_event(const FaceMap::Node& n) {
  return n.kind == NodeKind::kEvent || n.kind == NodeKind::kRim;
}

bool overlap(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  return a[0] < b[1] && b[0] < a[1] && a[2] < b[3] && b[2] < a[3];
}

bool holds(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  return a[0] <= b[0] && a[1] >= b[1] && a[2] <= b[2] && a[3] >= b[3];
}

}  // namespace

void check_graph(FaceMap& map, const Graph& claimed) {
  std::vector<bool> loop(map.node.size(), false);
  for (const FaceMap::Arc& a : map.arc)
    if (a.node[0] == a.node[1]) loop[a.node[0]] = true;
  // Events by their boxes.
  std::vector<std::uint32_t> event_of(map.node.size(), 0);
  std::vector<bool> used(claimed.event.size(), false);
  for (std::uint32_t n = 0; n < map.node.size(); ++n) {
    const FaceMap::Node& node = map.node[n];
    if (!is_event(node) || loop[n]) continue;
    std::size_t found = 0;
    for (std::uint32_t e = 0; e < claimed.event.size(); ++e) {
      const GraphEvent& event = claimed.event[e];
      if (!overlap(event.box, node.box)) continue;
      require(holds(event.box, node.box) && !used[e] && event.rim == (node.kind == NodeKind::kRim),
              "diagram: a box does not isolate an event of its kind");
      used[e] = true;
      event_of[n] = e;
      ++found;
    }
    require(found == 1, "diagram: an event is missing, or there twice");
  }
  require(std::ranges::find(used, false) == used.end(), "diagram: an event that there is not");

  const auto end_of = [&](std::uint32_t n) -> GraphEnd {
    const FaceMap::Node& node = map.node[n];
    if (node.kind == NodeKind::kSide)
      return {GraphEnd::Kind::kSide, static_cast<std::uint32_t>(node.side), node.change};
    if (node.kind == NodeKind::kConvexEdge) return {GraphEnd::Kind::kConvexEdge, node.edge, 0};
    if (loop[n]) return {GraphEnd::Kind::kLoop, 0, 0};
    return {GraphEnd::Kind::kEvent, event_of[n], 0};
  };
  const auto governs = [&](Site s, std::uint32_t region) {
    return std::ranges::binary_search(map.region[region].labels, s);
  };
  require(map.arc.size() == claimed.arc.size(), "diagram: another number of arcs");
  std::vector<bool> taken(claimed.arc.size(), false);
  std::vector<FaceMap::Arc> arcs(claimed.arc.size());
  for (const FaceMap::Arc& own : map.arc) {
    const GraphEnd p = end_of(own.node[0]), q = end_of(own.node[1]);
    const auto fits = [&](const GraphArc& a) {
      const bool ends = (a.end[0] == p && a.end[1] == q) || (a.end[0] == q && a.end[1] == p);
      return ends && ((governs(a.site[0], own.region[0]) && governs(a.site[1], own.region[1])) ||
                      (governs(a.site[0], own.region[1]) && governs(a.site[1], own.region[0])));
    };
    std::size_t k = 0;
    while (k < taken.size() && (taken[k] || !fits(claimed.arc[k]))) ++k;
    require(k < taken.size(), "diagram: an arc is missing, or not between these sites");
    taken[k] = true;
    arcs[k] = own;
    if (claimed.arc[k].end[0] != p) std::swap(arcs[k].node[0], arcs[k].node[1]);
  }
  map.arc = std::move(arcs);
}

}  // namespace blum::verify
