#include "exact.hpp"

#include <algorithm>
#include <set>

#include "blum/arrangement/brute_engine.hpp"

namespace blum::verify {
namespace {

constexpr std::size_t kMostSites = 16;  // it takes seconds with more

/// The changes of a side, and the regions of its pieces: both found them.
void check_side(const FaceDiagram& d, std::size_t s, Line& line) {
  const auto& own = line.change;
  const auto& other = d.side[s]->breakpoint;
  const std::string what = "face: exact algebra finds other changes on a side";
  require(own.size() == other.size() && d.side_region[s].size() == line.piece.size(), what);
  for (std::size_t k = 0; k < own.size(); ++k) {
    require(own[k].boundary == (other[k].kind == Breakpoint::Kind::kBoundary), what);
    require(own[k].boundary ? own[k].triangle == other[k].triangle
                            : own[k].below.t <= other[k].hi && own[k].above.t >= other[k].lo,
            what);
  }
  for (std::size_t k = 0; k < line.piece.size(); ++k) {
    Line::Piece& p = line.piece[k];
    p.id = d.side_region[s][k];
    require(p.inside == (p.id != FaceDiagram::kOutside), what);
    require(!p.inside || std::ranges::binary_search(d.region[p.id].labels, SiteId{p.label}),
            "face: exact algebra finds other governors on a side");
  }
}

std::vector<SiteId> ids(std::span<const Site> sites) {
  if (sites.size() > kMostSites) throw Undecided("too many sites for exact algebra");
  std::vector<SiteId> list;
  for (const Site s : sites) list.push_back({s});
  return list;
}

FaceMap::Node node_of(const FaceNode& n, const Rect& r) {
  using Kind = FaceMap::Node::Kind;
  if (n.kind == FaceNode::Kind::kSide)
    return {.kind = Kind::kSide, .side = n.side, .change = n.breakpoint, .piece = n.piece};
  if (n.kind == FaceNode::Kind::kConvexEdge)
    return {.kind = Kind::kConvexEdge, .edge = n.boundary_edge, .piece = n.piece};
  return {.kind = n.kind == FaceNode::Kind::kRim ? Kind::kRim : Kind::kEvent,
          .box = {std::max(n.u0, r.u0), std::min(n.u1, r.u1), std::max(n.v0, r.v0),
                  std::min(n.v1, r.v1)},
          .piece = n.piece};
}

/// Every tie of the sides ends one arc, between the regions beside it; other nodes end some.
void check_ends(const FaceMap& map) {
  std::vector<int> degree(map.node.size(), 0);
  for (const auto& [ends, region] : map.arc)
    for (const auto e : ends) {
      ++degree[e];
      const FaceMap::Node& n = map.node[e];
      if (n.kind != FaceMap::Node::Kind::kSide) continue;
      const auto* piece = &map.side[static_cast<std::size_t>(n.side)].piece[n.change];
      require(std::set{region[0], region[1]} == std::set{piece[0].id, piece[1].id},
              "face: exact algebra parts other regions at a side");
    }
  std::set<std::pair<int, std::uint32_t>> met;
  for (std::size_t n = 0; n < degree.size(); ++n) {
    const auto& [kind, side, change, edge, box, piece] = map.node[n];
    const bool on_side = kind == FaceMap::Node::Kind::kSide;
    require(on_side ? degree[n] == 1 : degree[n] > 0, "face: a sheet touches the plane");
    if (on_side) met.insert({side, change});
  }
  std::ptrdiff_t ties = 0;
  for (const Line& side : map.side)
    ties += std::ranges::count(side.change, false, &Line::Change::boundary);
  require(std::cmp_equal(met.size(), ties), "face: exact algebra misses a tie of a side");
}

}  // namespace

Algebra::Algebra(const Shape& shape) {
  solid_.point = shape.point;
  for (const Edge& e : shape.edge)
    solid_.edge.push_back({e.vertex, e.triangle,
                           e.bend == Bend::kConvex   ? EdgeKind::kConvex
                           : e.bend == Bend::kReflex ? EdgeKind::kReflex
                                                     : EdgeKind::kFlat});
  for (const Triangle& t : shape.triangle) solid_.triangle.push_back({t.vertex, t.edge});
  for (std::size_t v = 0; v < shape.point.size(); ++v) {
    solid_.vertex_edge_begin.push_back(static_cast<std::uint32_t>(solid_.vertex_edge.size()));
    solid_.vertex_edge.insert(solid_.vertex_edge.end(), shape.edges_at[v].begin(),
                              shape.edges_at[v].end());
    solid_.vertex_degenerate.push_back(!shape.cone[v].interior);
  }
  solid_.vertex_edge_begin.push_back(static_cast<std::uint32_t>(solid_.vertex_edge.size()));
}

FaceMap Algebra::diagram(const Rect& rect, const std::array<Line, 4>& side,
                         std::span<const Site> sites,
                         std::span<const std::uint32_t> triangles) const {
  const std::vector<SiteId> candidates = ids(sites);
  const FaceDiagram d =
      brute_face({&solid_, rect, candidates, triangles, triangles.empty(), DiagramKind::kMedial});
  if (d.status != FaceStatus::kDecided) throw Undecided(d.reason);
  FaceMap map;
  map.rect = rect;
  map.side = side;
  for (std::size_t s = 0; s < 4; ++s) check_side(d, s, map.side[s]);
  for (const FaceRegion& r : d.region) {
    map.region.push_back({{}, r.piece});
    for (const SiteId s : r.labels) map.region.back().labels.push_back(s.value);
  }
  for (const FacePiece& p : d.piece) map.circles.push_back(p.boundary_circles);
  for (const FaceTrace& t : d.trace) map.trace.push_back({t.triangle, t.region});
  for (const FaceTracePoint& p : d.trace_point) map.trace_point.push_back(p.boundary_edge);
  for (const FaceNode& n : d.node) map.node.push_back(node_of(n, rect));
  for (const FaceArc& a : d.arc) {
    require(a.region[0] != FaceArc::kUnknown && a.region[1] != FaceArc::kUnknown,
            "face: exact algebra does not name a region");
    map.arc.push_back({{a.from, a.to}, a.region});
  }
  check_ends(map);
  ++diagrams;
  return map;
}

std::size_t Algebra::ties(const Segment& segment, std::span<const Site> sites) const {
  const std::vector<SiteId> candidates = ids(sites);
  const auto found = brute_segment(solid_, segment, candidates, {}, true, DiagramKind::kMedial);
  if (!found) throw Undecided("line: not in general position");
  ++segments;
  return found->breakpoint.size();
}

}  // namespace blum::verify
