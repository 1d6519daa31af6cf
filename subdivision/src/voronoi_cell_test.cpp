#include "blum/subdivision/voronoi_cell_test.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>
#include <vector>

#include "blum/arrangement/flow.hpp"
#include "blum/kernel/check.hpp"
#include "box_edges.hpp"
#include "graph_parts.hpp"

namespace blum {
namespace {

/// How a closed site lies to a closed box. Planes of the box hold no vertex of the solid.
enum class Place : std::uint8_t { kApart, kMeets, kWithin };

Place place_of(const SiteGeometry& geometry, SiteId site, const Box3& box) {
  const Solid& solid = geometry.solid();
  int n = 0;
  const auto corner = geometry.corners(site, n);
  bool within = true;
  for (int axis = 0; axis < 3; ++axis) {
    bool below = true, above = true;
    for (int k = 0; k < n; ++k) {
      const double x = solid.point[corner[k]][axis];
      below &= x < box.lo[axis];
      above &= x > box.hi[axis];
      within &= x > box.lo[axis] && x < box.hi[axis];
    }
    if (below || above) return Place::kApart;
  }
  if (within) return Place::kWithin;
  Point3 c;
  for (int k = 0; k < 3; ++k) c[k] = 0.5 * (box.lo[k] + box.hi[k]);
  const auto reach = [&](const BallVector& w) {
    double r = 0;
    for (int k = 0; k < 3; ++k)
      r += w[k].magnitude() * std::max(box.hi[k] - c[k], c[k] - box.lo[k]);
    return r * (1 + 0x1p-40);
  };
  // Conditions of the site's own extent; those of incidence say nothing about where it lies.
  const auto domain = geometry.domain(site);
  for (std::uint32_t k = 0; k < geometry.own_conditions(site); ++k)
    if (dot(domain[k].w, difference(c, solid.point[domain[k].base])).low() > reach(domain[k].w))
      return Place::kApart;
  const BallVector d = difference(c, geometry.base(site));
  const BallVector& u = geometry.unit(site);
  if (geometry.index().kind(site) == SiteKind::kFace) {
    const Ball h = dot(d, u);
    if (h.low() > reach(u) || h.high() < -reach(u)) return Place::kApart;
  } else if (geometry.index().kind(site) == SiteKind::kEdge) {
    // Across the line, in the directions of the axes.
    for (int axis = 0; axis < 3; ++axis) {
      BallVector e{};
      e[axis] = Ball(1.0);
      const BallVector w = cross(u, e);
      const Ball h = dot(d, w);
      if (h.low() > reach(w) || h.high() < -reach(w)) return Place::kApart;
    }
  }
  return Place::kMeets;
}

class VoronoiCell {
 public:
  VoronoiCell(const SiteGeometry& geometry, const Box3& box, std::span<const SiteId> candidates,
              const VoronoiSurface::Faces& face)
      : geometry_(geometry), face_(face), surface_(face) {
    for (const SiteId s : candidates) place_[s.value] = place_of(geometry, s, box);
    for (std::uint32_t r = 0; r < surface_.regions(); ++r) {
      auto& pieces = pieces_of_[surface_.site(r).value];
      const auto p = surface_.piece(r);
      if (std::ranges::find(pieces, p) == pieces.end()) pieces.push_back(p);
    }
    components_ = surface_.count_components();
  }

  [[nodiscard]] CellAnswer test(Criterion criterion, bool resolve);

 private:
  [[nodiscard]] Place place(SiteId s) const { return place_.at(s.value); }
  [[nodiscard]] bool none_hidden() const;
  [[nodiscard]] bool one_piece_each() const;
  [[nodiscard]] bool pieces_are_separate();
  [[nodiscard]] bool joined_by_flow();
  [[nodiscard]] CellVerdict strict();
  [[nodiscard]] bool at_one_vertex() const;

  const SiteGeometry& geometry_;
  const VoronoiSurface::Faces& face_;
  VoronoiSurface surface_;
  std::unordered_map<std::uint32_t, Place> place_;                 // of the candidates
  std::map<std::uint32_t, std::vector<std::uint32_t>> pieces_of_;  // of the sites that show
  std::uint32_t components_ = 0;
};

bool VoronoiCell::none_hidden() const {
  return std::ranges::all_of(place_, [&](const auto& p) {
    return p.second != Place::kWithin || pieces_of_.contains(p.first);
  });
}

bool VoronoiCell::one_piece_each() const {
  return std::ranges::all_of(pieces_of_, [](const auto& p) { return p.second.size() == 1; });
}

/// Condition (2) of Theorem V.
bool VoronoiCell::pieces_are_separate() {
  bool one_each = true;
  for (const auto& [site, pieces] : pieces_of_) {
    if (pieces.size() == 1) continue;
    if (place(SiteId{site}) != Place::kApart) return false;
    one_each = false;
  }
  if (one_each) return true;
  // Pieces with a point where the flow certainly leaves the cell belong to different components of
  // the region within.
  std::unordered_map<std::uint32_t, bool> leaves;
  for (int f = 0; f < 6; ++f) {
    const FaceDiagram& d = *face_[f];
    for (std::uint32_t r = 0; r < d.region.size(); ++r) {
      const SiteId site = d.region[r].labels.front();
      if (pieces_of_.at(site.value).size() == 1) continue;
      bool& known = leaves[surface_.piece(surface_.region(f, r))];
      known = known || never_leaves(geometry_, site, d.rect, f % 2 == 0 ? 1 : -1);
    }
  }
  return std::ranges::all_of(leaves, [](const auto& p) { return p.second; });
}

/// Condition (3) of Theorem V: paths that no flow crosses join the components of the graph.
bool VoronoiCell::joined_by_flow() {
  const auto regions = surface_.regions(), nodes = surface_.nodes();
  std::vector<bool> closed(regions, false);
  UnionFind joined;
  joined.resize(nodes + regions);
  for (int f = 0; f < 6; ++f) {
    const FaceDiagram& d = *face_[f];
    for (std::uint32_t i = 0; i < d.region.size(); ++i) {
      const SiteId site = d.region[i].labels.front();
      const auto r = surface_.region(f, i);
      // A site within the cell draws all of its region in: that is contractible anyway.
      closed[r] = place(site) == Place::kWithin ||
                  (place(site) == Place::kApart &&
                   never_leaves(geometry_, site, d.rect, f % 2 == 0 ? -1 : 1));
    }
    for (const FaceArc& a : d.arc)
      for (const auto i : a.region)
        if (const auto r = surface_.region(f, i); closed[r])
          joined.unite(surface_.node(f, a.from), nodes + r);
  }
  for (const EdgePair& p : edge_pairs()) {
    const auto &a = face_[p.face[0]]->side_region[p.side[0]],
               &b = face_[p.face[1]]->side_region[p.side[1]];
    for (std::size_t k = 0; k < a.size(); ++k) {
      const auto ra = surface_.region(p.face[0], a[k]), rb = surface_.region(p.face[1], b[k]);
      if (closed[ra] && closed[rb]) joined.unite(nodes + ra, nodes + rb);
    }
  }
  for (const auto& a : surface_.arcs()) joined.unite(a[0], a[1]);
  const auto first = joined.find(surface_.arcs().front()[0]);
  return std::ranges::all_of(surface_.arcs(),
                             [&](const auto& a) { return joined.find(a[0]) == first; });
}

CellVerdict VoronoiCell::strict() {
  // Boundary cell criterion: at most one point site in the cell, the other sites that meet it
  // incident on the point; and all governors meet the cell.
  std::vector<SiteId> meet, points;
  for (const auto& [site, place] : place_) {
    if (place == Place::kApart) continue;
    meet.push_back({site});
    if (geometry_.index().kind({site}) == SiteKind::kVertex) points.push_back({site});
  }
  if (!meet.empty()) {
    if (points.size() > 1 || meet.size() < place_.size()) return CellVerdict::kGovernor;
    if (points.size() == 1)
      for (const SiteId s : meet)
        if (!geometry_.has_corner(s, geometry_.index().element(points[0])))
          return CellVerdict::kGovernor;
  }
  // Homotopy criterion: each region's part of the surface is a closed disk.
  if (components_ > 1) return CellVerdict::kGraph;
  if (!one_piece_each()) return CellVerdict::kLabel;
  for (const auto& [site, pieces] : pieces_of_)
    if (components_ == 1 && !surface_.border_is_simple(face_, pieces.front()))
      return CellVerdict::kLabel;
  return CellVerdict::kAccepted;
}

bool VoronoiCell::at_one_vertex() const {
  for (const auto& [site, place] : place_)
    if (place != Place::kApart) {
      int n = 0;
      const auto corner = geometry_.corners({site}, n);
      return std::any_of(corner.begin(), corner.begin() + n, [&](auto v) {
        return std::ranges::all_of(
            pieces_of_, [&](const auto& p) { return geometry_.has_corner({p.first}, v); });
      });
    }
  return false;
}

CellAnswer VoronoiCell::test(Criterion criterion, bool resolve) {
  CellAnswer r;
  const auto verdict = [&](CellVerdict v) {
    r.verdict = v;
    return r;
  };
  r.has_axis = surface_.has_graph();
  if (!none_hidden()) return verdict(CellVerdict::kHidden);
  switch (criterion) {
    case Criterion::kStrict:
      if (const CellVerdict v = strict(); v != CellVerdict::kAccepted) return verdict(v);
      break;
    case Criterion::kDisks:
      if (components_ > 1) return verdict(CellVerdict::kGraph);
      if (!one_piece_each()) return verdict(CellVerdict::kLabel);
      break;
    case Criterion::kRelaxed:
      if (components_ > 1) {
        if (!joined_by_flow()) return verdict(CellVerdict::kGraph);
        r.curved_cut = true;
      }
      if (!pieces_are_separate()) return verdict(CellVerdict::kLabel);
      break;
  }
  if (resolve && !at_one_vertex()) {
    UnionFind graph;
    graph.resize(surface_.nodes());
    for (const auto& a : surface_.arcs()) graph.unite(a[0], a[1]);
    if (!shapes_are_simple(graph, surface_.arcs())) return verdict(CellVerdict::kCluster);
  }
  return verdict(CellVerdict::kAccepted);
}

}  // namespace

CellAnswer test_voronoi_cell(const SiteGeometry& geometry, const Box3& box,
                             std::span<const SiteId> candidates, const VoronoiSurface::Faces& face,
                             Criterion criterion, bool resolve) {
  BLUM_REQUIRE(geometry.kind() == DiagramKind::kVoronoi);
  return VoronoiCell(geometry, box, candidates, face).test(criterion, resolve);
}

}  // namespace blum
