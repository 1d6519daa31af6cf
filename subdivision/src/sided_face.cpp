#include "blum/subdivision/sided_face.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "blum/kernel/union_find.hpp"
#include "meeting.hpp"

namespace blum {

bool region_is_inside(const Predicates& predicates, SiteId site) {
  const SiteGeometry& geometry = predicates.geometry();
  const auto element = geometry.index().element(site);
  return geometry.index().kind(site) == SiteKind::kEdge
             ? geometry.solid().edge[element].kind == EdgeKind::kReflex
             : predicates.foot_cone(element) != Predicates::FootCone::kNone;
}

namespace {

constexpr std::uint32_t kNone = SidedFace::kNone;

/// Ends of arcs are put together in classes that lie on one side.
class FaceSides {
 public:
  FaceSides(Predicates& predicates, const InsideOracle& inside, const FaceDiagram& face,
            std::span<const std::uint32_t> triangles)
      : predicates_(predicates),
        geometry_(predicates.geometry()),
        solid_(geometry_.solid()),
        inside_(inside),
        face_(face),
        triangles_(triangles) {}

  SidedFace run() {
    SidedFace r;
    if (!find_crossings()) return r;
    put_together();
    ask_sites();
    ask_nodes();
    if (!split_arcs() || contradicted_) return r;
    for (std::uint32_t k = 0; k < face_.arc.size(); ++k) {
      const int from = side_[end_.find(2 * k)], to = side_[end_.find(2 * k + 1)];
      if (from == 0 || to == 0) return r;
      r.inside.push_back({from > 0, to > 0});
    }
    r.crossing = std::move(crossing_);
    r.decided = true;
    return r;
  }

 private:
  [[nodiscard]] SiteId face_site(std::uint32_t t) const { return geometry_.index().face(t); }

  [[nodiscard]] bool find_crossings() {
    std::set<std::uint32_t> edges;
    for (const auto t : triangles_)
      edges.insert(solid_.triangle[t].edge.begin(), solid_.triangle[t].edge.end());
    for (const auto e : edges) {
      const auto meets = edge_crosses(predicates_, e, face_.rect);
      if (!meets) return false;
      if (!*meets) continue;
      SidedFace::Crossing c{e, node_of(e)};
      // Edges that are sites meet the plane in an event with their two triangles.
      if (c.node == kNone && solid_.edge[e].kind != EdgeKind::kFlat) return false;
      crossing_.push_back(c);
    }
    // Two crossings in one node: it stands for a tree, and nothing tells which way they cut it.
    std::set<std::uint32_t> nodes;
    return std::ranges::all_of(crossing_,
                               [&](const SidedFace::Crossing& c) {
                                 return c.node == kNone || nodes.insert(c.node).second;
                               }) &&
           !ambiguous_;
  }

  /// The node whose tree the crossing may be in.
  [[nodiscard]] std::uint32_t node_of(std::uint32_t e) {
    const SolidEdge& edge = solid_.edge[e];
    std::uint32_t found = kNone;
    for (std::uint32_t n = 0; n < face_.node.size(); ++n) {
      const FaceNode& node = face_.node[n];
      const auto governs = [&](SiteId s) {
        return std::ranges::find(node.governors, s) != node.governors.end();
      };
      if (node.kind != FaceNode::Kind::kEvent || !governs(face_site(edge.triangle[0])) ||
          !governs(face_site(edge.triangle[1])) ||
          (edge.kind != EdgeKind::kFlat && !governs(geometry_.index().edge(e))))
        continue;
      const auto in = edge_crosses(
          predicates_, e, {face_.rect.axis, face_.rect.level, node.u0, node.u1, node.v0, node.v1});
      ambiguous_ = ambiguous_ || !in || (*in && found != kNone);
      if (!in || !*in) continue;
      found = n;
    }
    return found;
  }

  /// Arcs between the two triangles of an edge.
  [[nodiscard]] std::vector<std::uint32_t> arcs_over(std::uint32_t edge) const {
    const SiteId a = face_site(solid_.edge[edge].triangle[0]),
                 b = face_site(solid_.edge[edge].triangle[1]);
    std::vector<std::uint32_t> found;
    for (std::uint32_t k = 0; k < face_.arc.size(); ++k)
      if (const FaceArc& arc = face_.arc[k];
          (arc.left == a && arc.right == b) || (arc.left == b && arc.right == a))
        found.push_back(k);
    return found;
  }

  void put_together() {
    const auto arcs = static_cast<std::uint32_t>(face_.arc.size());
    end_.resize(2 * arcs);
    std::vector<bool> may_split(arcs, false), crossed(face_.node.size(), false);
    for (const auto& c : crossing_) {
      if (c.node != kNone)
        crossed[c.node] = true;
      else
        for (const auto k : arcs_over(c.edge)) may_split[k] = true;
    }
    std::vector<std::uint32_t> first(face_.node.size(), kNone);
    for (std::uint32_t k = 0; k < arcs; ++k) {
      if (!may_split[k]) end_.unite(2 * k, 2 * k + 1);
      for (const std::uint32_t end : {2 * k, 2 * k + 1}) {
        const auto n = node_at(end);
        if (crossed[n]) continue;
        if (first[n] == kNone) first[n] = end;
        end_.unite(first[n], end);
      }
    }
    crossed_ = std::move(crossed);
    side_.assign(2 * arcs, 0);
  }

  [[nodiscard]] std::uint32_t node_at(std::uint32_t end) const {
    const FaceArc& a = face_.arc[end / 2];
    return end % 2 == 0 ? a.from : a.to;
  }

  void tell(std::uint32_t end, bool inside) {
    int& side = side_[end_.find(end)];
    const int now = inside ? 1 : -1;
    contradicted_ = contradicted_ || side == -now;
    side = now;
  }

  void ask_sites() {
    for (std::uint32_t k = 0; k < face_.arc.size(); ++k) {
      const FaceArc& a = face_.arc[k];
      bool faces = true;
      for (const SiteId s : {a.left, a.right}) {
        if (geometry_.index().kind(s) == SiteKind::kFace) continue;
        faces = false;
        tell(2 * k, region_is_inside(predicates_, s));
        tell(2 * k + 1, region_is_inside(predicates_, s));
      }
      if (!faces) continue;
      // Balls that touch both triangles of a convex edge lie inside, of a reflex edge outside.
      const auto e =
          solid_.common_edge(geometry_.index().element(a.left), geometry_.index().element(a.right));
      if (!e || solid_.edge[*e].kind == EdgeKind::kFlat) continue;
      tell(2 * k, solid_.edge[*e].kind == EdgeKind::kConvex);
      tell(2 * k + 1, solid_.edge[*e].kind == EdgeKind::kConvex);
    }
  }

  /// Where nothing is known yet, nodes that the boundary does not come near.
  void ask_nodes() {
    const Rect& r = face_.rect;
    for (std::uint32_t end = 0; end < end_.size(); ++end) {
      const auto n = node_at(end);
      if (side_[end_.find(end)] != 0 || crossed_[n]) continue;
      const FaceNode& node = face_.node[n];
      const Box3 box{point_on(r.axis, r.level, node.u0, node.v0),
                     point_on(r.axis, r.level, node.u1, node.v1)};
      if (triangles_meeting(geometry_, triangles_, box).empty()) {
        tell(end, inside_.locate(box.lo) == InsideOracle::Where::kInside);
      } else if (node.kind == FaceNode::Kind::kSide) {
        const SegmentDiagram& line = *face_.side[node.side];
        if (shares_its_gap(line, node.breakpoint)) continue;
        if (const auto side = side_of_tie(line.segment, line.breakpoint[node.breakpoint]))
          tell(end, *side);
      }
    }
  }

  /// Does a tie on a side of the rectangle lie inside? Between the point where it is known that the
  /// site below governs, and the tie, that site alone governs, so no boundary but its own is
  /// crossed.
  [[nodiscard]] std::optional<bool> side_of_tie(const Segment& s, const Breakpoint& b) {
    const auto at = [&](double t) { return point_on(s.axis, t, s.u, s.v); };
    const auto where = inside_.locate(at(b.lo));
    if (where == InsideOracle::Where::kBoundary) return std::nullopt;
    bool inside = where == InsideOracle::Where::kInside;
    if (geometry_.index().kind(b.below) == SiteKind::kFace) {
      const auto t = geometry_.index().element(b.below);
      const int low = predicates_.plane_side(at(b.lo), t),
                high = predicates_.plane_side(at(b.hi), t);
      const auto pierced = predicates_.pierces(t, s.axis, s.u, s.v);
      if (low == 0 || high == 0 || !pierced) return std::nullopt;
      if (low != high && *pierced != 0) inside = !inside;
    }
    return inside;
  }

  /// Crossings of flat edges: the one arc over the edge whose ends lie on different sides.
  [[nodiscard]] bool split_arcs() {
    for (bool changed = true; changed;) {
      changed = false;
      for (auto& c : crossing_) {
        if (c.node != kNone || c.arc != kNone) continue;
        const auto arcs = arcs_over(c.edge);
        std::uint32_t unknown = 0, split = kNone;
        for (const auto k : arcs) {
          const int from = side_[end_.find(2 * k)], to = side_[end_.find(2 * k + 1)];
          unknown += from == 0 || to == 0;
          if (from * to < 0) {
            if (split != kNone) return false;
            split = k;
          }
        }
        if (arcs.size() == 1 && unknown == 1) {
          const auto k = arcs.front();
          const int from = side_[end_.find(2 * k)], to = side_[end_.find(2 * k + 1)];
          if (from == 0 && to == 0) continue;
          tell(from == 0 ? 2 * k : 2 * k + 1, (from == 0 ? to : from) < 0);
          split = k;
          unknown = 0;
        }
        if (unknown > 0) continue;
        if (split == kNone) return false;
        c.arc = split;
        changed = true;
      }
    }
    return std::ranges::all_of(
        crossing_, [](const SidedFace::Crossing& c) { return c.node != kNone || c.arc != kNone; });
  }

  Predicates& predicates_;
  const SiteGeometry& geometry_;
  const Solid& solid_;
  const InsideOracle& inside_;
  const FaceDiagram& face_;
  std::span<const std::uint32_t> triangles_;
  std::vector<SidedFace::Crossing> crossing_;
  bool ambiguous_ = false, contradicted_ = false;
  std::vector<bool> crossed_;  // nodes with a crossing
  UnionFind end_;              // 2k: `from` of arc k, 2k + 1: `to`
  std::vector<int> side_;      // of classes: 1 inside, -1 outside, 0 not known
};

}  // namespace

SidedFace sided_face(Predicates& predicates, const InsideOracle& inside, const FaceDiagram& face,
                     std::span<const std::uint32_t> triangles) {
  return FaceSides(predicates, inside, face, triangles).run();
}

}  // namespace blum
