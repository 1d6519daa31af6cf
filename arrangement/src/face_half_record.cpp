#include "face_half.hpp"

namespace blum {

void FaceEngine::HalfMap::record() {
  std::vector<std::uint32_t> element;  // of each run
  for (const Run& run : runs_) {
    std::vector<std::uint32_t> all = run.elements;
    for (const auto t : run.traces) all.push_back(engine_.trace_element(t));
    for (const auto e : all) {
      engine_.region_.unite(all.front(), e);
      engine_.component_.unite(all.front(), e);
    }
    engine_.label_element(all.front(), labels_[run.region]);
    element.push_back(all.front());
  }
  for (std::size_t c = 0; c < circle_.size(); ++c) {
    const auto end = c + 1 < circle_.size() ? circle_[c + 1] : runs_.size();
    for (std::size_t k = circle_[c]; k < end; ++k) {
      engine_.component_.unite(element[circle_[c]], element[k]);
      engine_.region_.unite(element[k], element[same_.find(static_cast<std::uint32_t>(k))]);
    }
  }
  std::map<std::uint32_t, std::uint32_t> within;  // region -> element
  const auto node_of = [&](std::uint32_t n) {
    if (id_[n] != kNone) return id_[n];
    const FaceNode& node = whole_.node[n];
    if (node.kind == FaceNode::Kind::kConvexEdge)
      return id_[n] = engine_.convex_node(node.boundary_edge);
    id_[n] = engine_.new_node(node.kind, root_);
    FaceNode& own = engine_.nodes_[id_[n]].node;
    own = node;
    own.u0 = std::max(node.u0, root_.u0);
    own.u1 = std::min(node.u1, root_.u1);
    own.v0 = std::max(node.v0, root_.v0);
    own.v1 = std::min(node.v1, root_.v1);
    return id_[n];
  };
  for (const Arc& a : arcs_) {
    std::array<std::uint32_t, 2> beside{};
    for (const std::size_t k : {0u, 1u}) {
      if (a.run[k] != kNone) {
        beside[k] = element[a.run[k]];
        continue;
      }
      const auto [it, fresh] = within.try_emplace(a.of->region[k], 0u);
      if (fresh) {
        it->second = engine_.new_element();
        engine_.label_element(it->second, labels_[it->first]);
      }
      beside[k] = it->second;
    }
    engine_.component_.unite(beside[0], beside[1]);
    for (const auto n : {a.from, a.to}) engine_.nodes_[node_of(n)].element = beside[0];
    engine_.add_arc(node_of(a.from), node_of(a.to), a.sites[0], a.sites[1], beside);
  }
}

bool FaceEngine::take_half(const Box& root) {
  const auto half = Half::of(problem_.rect, problem_.whole->rect);
  if (!half) return false;
  HalfMap map(*this, root, *half);
  if (!map.find()) return false;
  map.record();
  ++context_.counts.halves;
  return true;
}

}  // namespace blum
