#include "face_map.hpp"

#include <algorithm>

#include "failure.hpp"

namespace blum::verify {

std::uint32_t MapBuilder::new_element() {
  labels_.emplace_back();
  piece_.add();
  return region_.add();
}

std::uint32_t MapBuilder::element_of(const Step& step) {
  if (step.kind == Step::Kind::kPiece) return step.id;
  const auto [it, fresh] = trace_element_.try_emplace(step.id, 0u);
  if (fresh) it->second = new_element();
  return it->second;
}

std::uint32_t MapBuilder::new_node(const FaceMap::Node& node, bool through) {
  node_.push_back(node);
  through_.push_back(through);
  return static_cast<std::uint32_t>(node_.size() - 1);
}

std::uint32_t MapBuilder::node_of(const Step& separator) {
  if (separator.kind == Step::Kind::kTie) return separator.id;
  const auto [it, fresh] = convex_node_.try_emplace(separator.id, 0u);
  if (fresh)
    it->second = new_node({.kind = FaceMap::Node::Kind::kConvexEdge, .edge = separator.id});
  return it->second;
}

Line MapBuilder::name(Line line, int side) {
  for (std::uint32_t k = 0; k < line.change.size(); ++k)
    if (!line.change[k].boundary)
      line.change[k].id =
          new_node({.kind = FaceMap::Node::Kind::kSide, .side = side, .change = k}, side < 0);
  for (Line::Piece& p : line.piece)
    if (p.inside) p.id = new_element();
  return line;
}

/// Where two parts meet arcs go on: one node less, but on a closed arc, which keeps one.
void MapBuilder::splice() {
  std::vector<std::vector<std::uint32_t>> at(node_.size());
  for (std::uint32_t a = 0; a < arc_.size(); ++a)
    for (const auto n : arc_[a].node) at[n].push_back(a);
  std::vector<bool> gone(arc_.size(), false);
  for (std::uint32_t n = 0; n < node_.size(); ++n) {
    if (!through_[n] || node_[n].piece == kNone) continue;
    node_[n].kind = FaceMap::Node::Kind::kEvent;
    require(at[n].size() == 2, "face: an arc ends where two parts meet");
    const auto a = at[n][0], b = at[n][1];
    if (a == b) continue;
    const auto far = arc_[b].node[arc_[b].node[0] == n ? 1 : 0];
    arc_[a].node[arc_[a].node[0] == n ? 0 : 1] = far;
    std::ranges::replace(at[far], b, a);
    gone[b] = true;
    node_[n].piece = kNone;
  }
  std::erase_if(arc_, [&](const FaceMap::Arc& a) { return gone[&a - arc_.data()]; });
}

/// Regions, pieces and nodes get numbers of their own.
FaceMap MapBuilder::finish(const Box& root) {
  splice();
  FaceMap map;
  map.rect = root.rect;
  map.side = root.side;
  std::map<std::uint32_t, std::uint32_t> region_of, piece_of, node_of;  // by root, root, node
  const auto piece = [&](std::uint32_t element) {
    const auto [it, fresh] =
        piece_of.try_emplace(piece_.find(element), static_cast<std::uint32_t>(map.circles.size()));
    if (fresh) map.circles.push_back(0);
    return it->second;
  };
  const auto region = [&](std::uint32_t element) {
    const auto [it, fresh] =
        region_of.try_emplace(region_.find(element), static_cast<std::uint32_t>(map.region.size()));
    if (fresh) map.region.push_back({{}, piece(element)});
    return it->second;
  };
  for (std::uint32_t e = 0; e < region_.size(); ++e)
    for (const Site s : labels_[e]) map.region[region(e)].labels.push_back(s);
  for (FaceMap::Region& r : map.region) {
    std::ranges::sort(r.labels);
    r.labels.erase(std::ranges::unique(r.labels).begin(), r.labels.end());
  }
  for (std::uint32_t n = 0; n < node_.size(); ++n) {
    if (node_[n].piece == kNone) continue;
    node_of[n] = static_cast<std::uint32_t>(map.node.size());
    map.node.push_back(node_[n]);
    map.node.back().piece = piece(node_[n].piece);
  }
  for (const FaceMap::Arc& a : arc_)
    map.arc.push_back({{node_of.at(a.node[0]), node_of.at(a.node[1])},
                       {region(a.region[0]), region(a.region[1])}});
  for (Line& side : map.side)
    for (Line::Piece& p : side.piece)
      if (p.inside) p.id = region(p.id);
  for (const auto& [t, e] : trace_element_) map.trace.push_back({t, region(e)});
  map.trace_point = traces_.edges_in(root.rect);
  // Circles around the pieces: those that meet the border, and closed curves of ∂O.
  std::set<std::uint32_t> seen;
  for (const Circle& c : traces_.border(root).circle) {
    for (const Step& s : c)
      if (s.kind == Step::Kind::kTrace) seen.insert(s.id);
    ++map.circles[piece(element_of(c.front()))];
  }
  for (const auto& [t, element] : trace_element_) {
    if (seen.contains(t)) continue;
    ++map.circles[piece(element)];
    seen.merge(traces_.loop_of(t));
  }
  return map;
}

}  // namespace blum::verify
