#include "face_engine.hpp"

#include <algorithm>
#include <vector>

#include "blum/kernel/check.hpp"

namespace blum {

// The diagram, once all parts are recorded.

FaceDiagram FaceEngine::assemble(const Box& root) {
  FaceDiagram d;
  d.rect = problem_.rect;
  // Internal ties are not nodes: splice the two arcs at each.
  std::vector<bool> arc_gone(arcs_.size(), false);
  std::vector<bool> node_gone(nodes_.size(), false);
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
    Node& node = nodes_[n];
    if (node.node.kind != FaceNode::Kind::kSide || node.node.side != 255) continue;
    BLUM_CHECK(node.arc.size() == 2);
    const auto a = node.arc[0], b = node.arc[1];
    if (a == b) {  // a closed loop of G: keep this node on it
      node.node.kind = FaceNode::Kind::kEvent;
      continue;
    }
    const auto far = [&](std::uint32_t arc) {
      return arcs_[arc].from == n ? arcs_[arc].to : arcs_[arc].from;
    };
    const auto end_a = far(a), end_b = far(b);
    arcs_[a].from = end_a;
    arcs_[a].to = end_b;
    arc_gone[b] = true;
    std::replace(nodes_[end_b].arc.begin(), nodes_[end_b].arc.end(), b, a);
    node_gone[n] = true;
  }
  std::vector<std::uint32_t> node_index(nodes_.size(), Breakpoint::kNone);
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
    if (node_gone[n]) continue;
    node_index[n] = static_cast<std::uint32_t>(d.node.size());
    d.node.push_back(nodes_[n].node);
  }
  for (std::uint32_t a = 0; a < arcs_.size(); ++a) {
    if (arc_gone[a]) continue;
    FaceArc arc = arcs_[a];
    arc.from = node_index[arc.from];
    arc.to = node_index[arc.to];
    d.arc.push_back(arc);
  }

  // Regions in order of their smallest element; labels of all their elements.
  const auto elements = region_.size();
  std::vector<std::uint32_t> region_index(elements, Breakpoint::kNone),
      piece_index(elements, Breakpoint::kNone);
  std::vector<bool> seen(elements, false);
  const auto see = [&](std::uint32_t e) { seen[region_.find(e)] = true; };
  for (std::uint32_t e = 0; e < elements; ++e)
    if (!element_label_[e].empty()) see(e);
  for (std::uint32_t e = 0; e < elements; ++e) {
    if (!seen[region_.find(e)]) continue;
    const auto root_e = region_.find(e), root_c = component_.find(e);
    if (piece_index[root_c] == Breakpoint::kNone) {
      piece_index[root_c] = static_cast<std::uint32_t>(d.piece.size());
      d.piece.push_back({0});
    }
    if (region_index[root_e] == Breakpoint::kNone) {
      region_index[root_e] = static_cast<std::uint32_t>(d.region.size());
      d.region.push_back({{}, piece_index[root_c]});
    }
    auto& labels = d.region[region_index[root_e]].labels;
    labels.insert(labels.end(), element_label_[e].begin(), element_label_[e].end());
  }
  for (FaceRegion& r : d.region) {
    std::sort(r.labels.begin(), r.labels.end());
    r.labels.erase(std::unique(r.labels.begin(), r.labels.end()), r.labels.end());
  }
  for (FaceArc& a : d.arc)
    for (auto& r : a.region) r = region_index[region_.find(r)];
  for (std::uint32_t n = 0; n < nodes_.size(); ++n)
    if (!node_gone[n])
      d.node[node_index[n]].piece = piece_index[component_.find(nodes_[n].element)];
  for (int s = 0; s < 4; ++s)
    for (const Piece1& p : root.side[s].piece)
      d.side_region[s].push_back(p.inside ? region_index[region_.find(p.element)]
                                          : FaceDiagram::kOutside);
  for (const auto& [t, e] : trace_element_) d.trace.push_back({t, region_index[region_.find(e)]});
  const Border border = border_of(root);
  for (const Circle& c : border.circle)
    for (const Step& s : c)
      if (s.kind == Step::Kind::kInterval) {
        ++d.piece[piece_index[component_.find(s.id)]].boundary_circles;
        break;
      }
  for (const auto t : border.loop)
    ++d.piece[piece_index[component_.find(trace_element_.at(t))]].boundary_circles;
  for (const TracePoint& p : trace_point_)
    if (in_box(p, root)) d.trace_point.push_back({p.edge});
  return d;
}

}  // namespace blum
