#include "graph.hpp"

#include <algorithm>

#include "failure.hpp"

namespace blum::verify {

void check_graph(FaceMap& map, const Graph& claimed) {
  using Kind = FaceMap::Node::Kind;
  std::vector<Graph::End> end;  // of each node
  for (const FaceMap::Node& n : map.node)
    end.push_back(n.kind == Kind::kSide
                      ? Graph::End{Graph::kSide, static_cast<std::uint32_t>(n.side), n.change}
                      : Graph::End{Graph::kConvexEdge, n.edge, 0});
  std::vector<bool> loop(map.node.size(), false), used(claimed.event.size(), false);
  for (const FaceMap::Arc& a : map.arc)
    if (a.node[0] == a.node[1]) loop[a.node[0]] = true;
  // Events by their boxes.
  for (std::size_t n = 0; n < map.node.size(); ++n) {
    const auto& [kind, side, change, edge, box, piece] = map.node[n];
    if (loop[n]) end[n] = {Graph::kLoop, 0, 0};
    if ((kind != Kind::kEvent && kind != Kind::kRim) || loop[n]) continue;
    int found = 0;
    for (std::uint32_t e = 0; e < claimed.event.size(); ++e) {
      const auto& [rim, own] = claimed.event[e];
      if (own[0] >= box[1] || box[0] >= own[1] || own[2] >= box[3] || box[2] >= own[3]) continue;
      require(own[0] <= box[0] && own[1] >= box[1] && own[2] <= box[2] && own[3] >= box[3] &&
                  !used[e] && rim == (kind == Kind::kRim),
              "diagram: a box does not isolate an event of its kind");
      used[e] = true;
      end[n] = {Graph::kEvent, e, 0};
      ++found;
    }
    require(found == 1, "diagram: an event is missing, or there twice");
  }
  require(std::ranges::find(used, false) == used.end(), "diagram: an event that there is not");

  require(map.arc.size() == claimed.arc.size(), "diagram: another number of arcs");
  std::vector<bool> taken(claimed.arc.size(), false);
  std::vector<FaceMap::Arc> arcs(claimed.arc.size());
  for (const FaceMap::Arc& own : map.arc) {
    const Graph::End p = end[own.node[0]], q = end[own.node[1]];
    const auto governs = [&](Site s, int side) {
      return std::ranges::binary_search(map.region[own.region[side]].labels, s);
    };
    std::size_t k = 0;
    for (; k < taken.size(); ++k) {
      const auto& [ends, site] = claimed.arc[k];
      if (!taken[k] && (ends == std::array{p, q} || ends == std::array{q, p}) &&
          ((governs(site[0], 0) && governs(site[1], 1)) ||
           (governs(site[0], 1) && governs(site[1], 0))))
        break;
    }
    require(k < taken.size(), "diagram: an arc is missing, or not between these sites");
    taken[k] = true;
    arcs[k] = own;
    if (claimed.arc[k].end[0] != p) std::swap(arcs[k].node[0], arcs[k].node[1]);
  }
  map.arc = std::move(arcs);
}

}  // namespace blum::verify
