#include "blum/subdivision/voronoi_cell_test.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

#include "blum/arrangement/flow.hpp"
#include "blum/kernel/check.hpp"
#include "graph_parts.hpp"
#include "voronoi_intervals.hpp"
#include "voronoi_joins.hpp"
#include "voronoi_place.hpp"
#include "voronoi_traces.hpp"

namespace blum {
namespace {

class VoronoiCell {
 public:
  VoronoiCell(Predicates& predicates, const Box3& box, std::span<const SiteId> candidates,
              const VoronoiSurface::Faces& face)
      : geometry_(predicates.geometry()), face_(face), surface_(face) {
    for (const SiteId s : candidates) place_[s.value] = place_of(predicates, s, box);
    for (std::uint32_t r = 0; r < surface_.regions(); ++r) {
      auto& pieces = pieces_of_[surface_.site(r).value];
      const auto p = surface_.piece(r);
      if (std::ranges::find(pieces, p) == pieces.end()) pieces.push_back(p);
    }
    components_ = surface_.count_components();
  }

  [[nodiscard]] CellAnswer test(Criterion criterion, bool resolve, bool tubes);

 private:
  [[nodiscard]] Place place(SiteId s) const { return place_.at(s.value).place; }
  [[nodiscard]] bool none_hidden() const;
  [[nodiscard]] bool one_piece_each() const;
  [[nodiscard]] bool pieces_are_separate();
  [[nodiscard]] std::optional<SiteId> tube();
  [[nodiscard]] bool flow_only_enters(std::uint32_t piece);
  [[nodiscard]] bool anchored(SiteId site, const std::vector<std::uint32_t>& pieces);
  [[nodiscard]] CellVerdict strict();
  [[nodiscard]] bool at_one_vertex() const;

  const SiteGeometry& geometry_;
  const VoronoiSurface::Faces& face_;
  VoronoiSurface surface_;
  std::unordered_map<std::uint32_t, SitePlace> place_;             // of the candidates
  std::map<std::uint32_t, std::vector<std::uint32_t>> pieces_of_;  // of the sites that show
  std::uint32_t components_ = 0;
  std::unordered_map<std::uint32_t, bool> known_;  // see pieces_are_separate
};

bool VoronoiCell::none_hidden() const {
  return std::ranges::all_of(place_, [&](const auto& p) {
    return p.second.place != Place::kWithin || pieces_of_.contains(p.first);
  });
}

bool VoronoiCell::one_piece_each() const {
  return std::ranges::all_of(pieces_of_, [](const auto& p) { return p.second.size() == 1; });
}

/// Condition (2) of Theorem V.
bool VoronoiCell::pieces_are_separate() {
  // Of sites with several pieces: is a piece known to belong to a component of its own in the cell?
  // Empty if that was not looked at.
  auto& known = known_;
  for (const auto& [site, pieces] : pieces_of_) {
    if (pieces.size() == 1) continue;
    const SitePlace& place = place_.at(site);
    if (place.place == Place::kWithin || (place.place == Place::kMeets && place.traces == 0)) {
      known.clear();
      return false;
    }
    for (const auto p : pieces) known[p] = false;
  }
  if (known.empty()) return true;
  // Where the flow certainly leaves: near a node or at an end of an interval.
  const auto see = [&](int f, std::uint32_t region, const Rect& near) {
    const auto it = known.find(surface_.piece(surface_.region(f, region)));
    if (it == known.end() || it->second) return;
    const SiteId site = face_[f]->region[region].labels.front();
    it->second = never_leaves(geometry_, site, near, f % 2 == 0 ? 1 : -1);
  };
  for (int f = 0; f < 6; ++f) {
    const FaceDiagram& d = *face_[f];
    for (const FaceArc& a : d.arc)
      for (const auto n : {a.from, a.to}) {
        const FaceNode& m = d.node[n];
        for (const auto region : a.region)
          see(f, region, {d.rect.axis, d.rect.level, m.u0, m.u1, m.v0, m.v1});
      }
    for (int s = 0; s < 4; ++s)
      for (const EdgeInterval& i : intervals(*d.side[s])) {
        const auto region = d.side_region[s][i.index];
        for (const Point3& x : {i.low, i.high}) {
          const double u = x[u_axis(d.rect.axis)], v = x[v_axis(d.rect.axis)];
          see(f, region, {d.rect.axis, d.rect.level, u, u, v, v});
        }
        // The triangle's trace crosses the edge: the piece is that of its feet in the cell.
        const SiteId site = d.region[region].labels.front();
        if (const auto it = known.find(surface_.piece(surface_.region(f, region)));
            it != known.end() && crosses_plane(geometry_, site, i))
          it->second = true;
      }
  }
  // What is near a site with several traces takes part of several pieces.
  for (const auto& [site, pieces] : pieces_of_)
    if (const SitePlace& place = place_.at(site);
        pieces.size() > 1 && place.place == Place::kMeets && !place.simple())
      for (const auto p : pieces) known[p] = false;
  return std::ranges::all_of(known, [](const auto& p) { return p.second; });
}

/// On the whole closed faces that the piece meets: so none of them meets the site itself, where the
/// inequality would not be strict.
bool VoronoiCell::flow_only_enters(std::uint32_t piece) {
  for (int f = 0; f < 6; ++f)
    for (std::uint32_t i = 0; i < face_[f]->region.size(); ++i)
      if (surface_.piece(surface_.region(f, i)) == piece &&
          !never_leaves(geometry_, face_[f]->region[i].labels.front(), face_[f]->rect,
                        f % 2 == 0 ? -1 : 1))
        return false;
  return true;
}

/// Does each of two pieces certainly hold one component of the site's trace?
bool VoronoiCell::anchored(SiteId site, const std::vector<std::uint32_t>& pieces) {
  const SitePlace& place = place_.at(site.value);
  if (place.traces != 2) return false;
  std::vector<std::uint32_t> found;
  if (geometry_.index().kind(site) == SiteKind::kFace) {
    TraceChains trace(geometry_, surface_, face_, site, place);
    if (!trace.known()) return false;
    for (int f = 0; f < 6; ++f)
      if (const auto p = trace.on_face(f) ? trace.piece(f) : std::nullopt) found.push_back(*p);
  } else {
    // An edge's region has one corner where it crosses a face.
    for (int f = 0; f < 6; ++f)
      if ((place.crossed >> f & 1) != 0)
        if (const auto p = piece_on_face(surface_, face_, site, f)) found.push_back(*p);
  }
  return std::ranges::all_of(pieces,
                             [&](auto p) { return std::ranges::find(found, p) != found.end(); });
}

/// Theorem T: where the pieces of all sites but one are separate, the site with two that are not.
std::optional<SiteId> VoronoiCell::tube() {
  if (components_ != 1 || known_.empty()) return std::nullopt;
  std::optional<SiteId> passing;
  for (const auto& [site, pieces] : pieces_of_) {
    std::vector<std::uint32_t> unknown;
    for (const auto p : pieces)
      if (pieces.size() > 1 && !known_.at(p)) unknown.push_back(p);
    if (unknown.empty()) continue;
    if (passing || pieces.size() != 2) return std::nullopt;
    passing = SiteId{site};
    const SitePlace& place = place_.at(site);
    const bool joined =
        place.place == Place::kMeets && !place.simple()
            ? anchored(*passing, pieces)
            : unknown.size() == 1 && !place.section && flow_only_enters(unknown.front());
    if (!joined || !tube_crossings(surface_.sphere_arcs(face_), pieces[0], pieces[1]))
      return std::nullopt;
  }
  return passing;
}

CellVerdict VoronoiCell::strict() {
  // Boundary cell criterion: at most one point site in the cell, the other sites that meet it
  // incident on the point; and all governors meet the cell.
  std::vector<SiteId> meet, points;
  for (const auto& [site, place] : place_) {
    if (place.place == Place::kApart) continue;
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
    if (place.place != Place::kApart) {
      int n = 0;
      const auto corner = geometry_.corners({site}, n);
      return std::any_of(corner.begin(), corner.begin() + n, [&](auto v) {
        return std::ranges::all_of(
            pieces_of_, [&](const auto& p) { return geometry_.has_corner({p.first}, v); });
      });
    }
  return false;
}

CellAnswer VoronoiCell::test(Criterion criterion, bool resolve, bool tubes) {
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
        if (!joined_by_flow(geometry_, surface_, face_,
                            [this](SiteId s) { return place_.at(s.value); }))
          return verdict(CellVerdict::kGraph);
        r.curved_cut = true;
      }
      if (!pieces_are_separate()) {
        const auto passing = tubes && !resolve ? tube() : std::nullopt;
        if (!passing) return verdict(CellVerdict::kLabel);
        r.tube = {*passing};
      }
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

CellAnswer test_voronoi_cell(Predicates& predicates, const Box3& box,
                             std::span<const SiteId> candidates, const VoronoiSurface::Faces& face,
                             Criterion criterion, bool resolve, bool tubes) {
  BLUM_REQUIRE(predicates.geometry().kind() == DiagramKind::kVoronoi);
  return VoronoiCell(predicates, box, candidates, face).test(criterion, resolve, tubes);
}

}  // namespace blum
