#include "blum/subdivision/voronoi_surface.hpp"

#include <map>
#include <set>

#include "blum/kernel/check.hpp"
#include "box_edges.hpp"

namespace blum {

VoronoiSurface::VoronoiSurface(const Faces& face) {
  std::uint32_t regions = 0, nodes = 0;
  for (int f = 0; f < 6; ++f) {
    region_base_[f] = regions;
    node_base_[f] = nodes;
    regions += static_cast<std::uint32_t>(face[f]->region.size());
    nodes += static_cast<std::uint32_t>(face[f]->node.size());
  }
  pieces_.resize(regions);
  graph_.resize(nodes);
  for (int f = 0; f < 6; ++f) {
    for (const FaceRegion& r : face[f]->region) {
      BLUM_CHECK(r.labels.size() == 1);
      site_.push_back(r.labels.front());
    }
    for (const FaceArc& a : face[f]->arc) {
      arc_.push_back({node(f, a.from), node(f, a.to)});
      graph_.unite(arc_.back()[0], arc_.back()[1]);
    }
  }
  for (const EdgePair& p : edge_pairs()) {
    const FaceDiagram &first = *face[p.face[0]], &second = *face[p.face[1]];
    const auto &a = first.side_region[p.side[0]], &b = second.side_region[p.side[1]];
    BLUM_CHECK(a.size() == b.size());
    for (std::size_t k = 0; k < a.size(); ++k)
      pieces_.unite(region(p.face[0], a[k]), region(p.face[1], b[k]));
    std::map<std::uint32_t, std::uint32_t> at;  // breakpoint -> node
    for (std::uint32_t i = 0; i < first.node.size(); ++i)
      if (first.node[i].kind == FaceNode::Kind::kSide && first.node[i].side == p.side[0])
        at[first.node[i].breakpoint] = node(p.face[0], i);
    for (std::uint32_t j = 0; j < second.node.size(); ++j) {
      if (second.node[j].kind != FaceNode::Kind::kSide || second.node[j].side != p.side[1])
        continue;
      arc_.push_back({at.at(second.node[j].breakpoint), node(p.face[1], j)});
      graph_.unite(arc_.back()[0], arc_.back()[1]);
    }
  }
}

std::uint32_t VoronoiSurface::count_pieces() {
  std::uint32_t n = 0;
  for (std::uint32_t r = 0; r < regions(); ++r) n += piece(r) == r;
  return n;
}

std::uint32_t VoronoiSurface::count_components() {
  std::uint32_t n = 0;
  for (std::uint32_t k = 0; k < nodes(); ++k) n += component(k) == k;
  return n;
}

long VoronoiSurface::pieces_euler() {
  const long pieces = count_pieces(), components = count_components();
  const long graph = static_cast<long>(nodes()) - static_cast<long>(arc_.size());
  // V - E + F = 1 + components, where F counts the pieces.
  BLUM_CHECK(components == 0 || graph + pieces == 1 + components);
  return 2 - graph;
}

std::vector<SphereArc> VoronoiSurface::sphere_arcs(const Faces& face) {
  std::vector<SphereArc> all;
  for (int f = 0; f < 6; ++f)
    for (const FaceArc& a : face[f]->arc)
      all.push_back({{node(f, a.from), node(f, a.to)},
                     {piece(region(f, a.region[0])), piece(region(f, a.region[1]))}});
  UnionFind name;
  name.resize(nodes());
  for (std::size_t k = all.size(); k < arc_.size(); ++k) name.unite(arc_[k][0], arc_[k][1]);
  for (SphereArc& a : all)
    for (auto& n : a.node) n = name.find(n);
  return all;
}

bool VoronoiSurface::border_is_simple(const Faces& face, std::uint32_t piece_id) {
  // Follows no walk: a border is simple iff each of its arcs has the piece on one side only and
  // each of its nodes has two ends of such arcs.
  std::map<std::uint32_t, int> ends;
  for (const SphereArc& a : sphere_arcs(face)) {
    const bool left = a.piece[0] == piece_id, right = a.piece[1] == piece_id;
    if (left && right) return false;
    if (!left && !right) continue;
    ++ends[a.node[0]];
    ++ends[a.node[1]];
  }
  for (const auto& [n, count] : ends)
    if (count != 2) return false;
  return true;
}

}  // namespace blum
