#include "blum/subdivision/graph_shape.hpp"

#include <map>
#include <vector>

namespace blum {

GraphShape graph_shape(std::uint32_t nodes, std::span<const std::array<std::uint32_t, 2>> arcs) {
  if (arcs.empty()) return GraphShape::kPoint;
  std::vector<std::vector<std::uint32_t>> incident(nodes);
  for (std::uint32_t a = 0; a < arcs.size(); ++a)
    for (const auto n : arcs[a]) incident[n].push_back(a);

  std::vector<std::uint32_t> branching;
  std::uint32_t ends = 0;
  for (std::uint32_t n = 0; n < nodes; ++n) {
    if (incident[n].size() >= 3) branching.push_back(n);
    if (incident[n].size() == 1) ++ends;
  }
  if (branching.empty()) return ends == 0 ? GraphShape::kLoop : GraphShape::kPath;

  if (branching.size() == 1 && ends == 1 && incident[branching.front()].size() == 3)
    return GraphShape::kRimEnd;

  // Walk from each branching node along every arc to the next node that is not of degree 2.
  std::map<std::array<std::uint32_t, 2>, int> joined;
  for (const auto start : branching) {
    for (const auto first : incident[start]) {
      std::uint32_t arc = first, at = start;
      for (;;) {
        at = arcs[arc][0] == at ? arcs[arc][1] : arcs[arc][0];
        if (incident[at].size() != 2) break;
        arc = incident[at][0] == arc ? incident[at][1] : incident[at][0];
      }
      if (incident[at].size() == 1 || at == start) return GraphShape::kOther;
      ++joined[{start, at}];
    }
  }
  if (branching.size() == 2) return GraphShape::kSeam;
  if (branching.size() != 4) return GraphShape::kOther;
  for (const auto a : branching)
    for (const auto b : branching) {
      if (a == b) continue;
      const auto it = joined.find({a, b});
      if (it == joined.end() || it->second != 1) return GraphShape::kOther;
    }
  return GraphShape::kJunction;
}

}  // namespace blum
