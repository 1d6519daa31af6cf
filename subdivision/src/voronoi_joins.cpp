#include "voronoi_joins.hpp"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <vector>

#include "blum/arrangement/flow.hpp"
#include "blum/subdivision/cell_test.hpp"
#include "box_edges.hpp"
#include "voronoi_intervals.hpp"
#include "voronoi_traces.hpp"

namespace blum {
namespace {

/// Regions are taken in two halves, those of a triangle on the two sides of its plane: a triangle's
/// trace cuts a region into just these. Other regions have one half under two names.
class FlowJoins {
 public:
  /// `chains`: use the regions of triangles with several traces, too.
  FlowJoins(const SiteGeometry& geometry, VoronoiSurface& surface,
            const VoronoiSurface::Faces& face, const std::function<SitePlace(SiteId)>& place,
            bool chains)
      : geometry_(geometry), surface_(surface), face_(face), place_(place), chains_(chains) {
    closed_.assign(2 * surface.regions(), false);
    joined_.resize(surface.nodes() + 2 * surface.regions());
  }

  bool run() {
    for (int f = 0; f < 6; ++f) close_halves(f);
    for (int f = 0; f < 6; ++f) join_nodes(f);
    for (const EdgePair& p : edge_pairs()) join_across(p);
    for (const auto& a : surface_.arcs()) joined_.unite(a[0], a[1]);
    const auto first = joined_.find(surface_.arcs().front()[0]);
    if (!std::ranges::all_of(surface_.arcs(),
                             [&](const auto& a) { return joined_.find(a[0]) == first; }))
      return false;
    return !chains_ ||
           std::ranges::all_of(several_, [&](SiteId s) { return parts_traces(s, first); });
  }

  /// After run(): are there regions that `chains` would add?
  [[nodiscard]] bool chains_matter() const { return !several_.empty(); }

 private:
  static constexpr std::array kSides{1, -1};

  [[nodiscard]] bool is_face(SiteId s) const {
    return geometry_.index().kind(s) == SiteKind::kFace;
  }
  [[nodiscard]] static std::uint32_t half(std::uint32_t region, int side) {
    return 2 * region + (side > 0 ? 0 : 1);
  }
  /// As element of joined_.
  [[nodiscard]] std::uint32_t name(std::uint32_t half) const { return surface_.nodes() + half; }

  /// Through which halves of the regions of a face does no flow leave?
  void close_halves(int f) {
    const FaceDiagram& d = *face_[f];
    const int outward = f % 2 == 0 ? -1 : 1;
    for (std::uint32_t i = 0; i < d.region.size(); ++i) {
      const SiteId site = d.region[i].labels.front();
      const SitePlace place = place_(site);
      const auto r = surface_.region(f, i);
      // A site within the cell draws all of its region in: that is contractible anyway.
      const bool all = place.place == Place::kWithin;
      if (place.place == Place::kMeets && !place.simple()) {
        if (place.traces == 0 || !is_face(site)) continue;
        if (std::ranges::find(several_, site) == several_.end()) several_.push_back(site);
        if (!chains_) continue;
      }
      if (!all && is_face(site)) {
        const Ball n = geometry_.unit(site)[d.rect.axis] * Ball(outward);
        for (const int side : kSides) closed_[half(r, side)] = n.sign() == side;
        continue;
      }
      if (!all && !never_leaves(geometry_, site, d.rect, outward)) continue;
      closed_[half(r, 1)] = closed_[half(r, -1)] = true;
      joined_.unite(name(half(r, 1)), name(half(r, -1)));
    }
  }

  /// The sides of a triangle's plane that a point in the box may be said to lie on; both, for other
  /// sites.
  [[nodiscard]] bool on_side(SiteId site, const Box3& box, int side) const {
    return !is_face(site) || side_of_plane(geometry_, site, box) == side;
  }

  void join_nodes(int f) {
    const FaceDiagram& d = *face_[f];
    const auto join = [&](std::uint32_t n, std::uint32_t region) {
      const FaceNode& node = d.node[n];
      const Box3 box{point_on(d.rect.axis, d.rect.level, node.u0, node.v0),
                     point_on(d.rect.axis, d.rect.level, node.u1, node.v1)};
      for (const int side : kSides)
        if (const auto h = half(surface_.region(f, region), side);
            closed_[h] && on_side(d.region[region].labels.front(), box, side))
          joined_.unite(surface_.node(f, n), name(h));
    };
    for (const FaceArc& a : d.arc)
      for (const auto region : a.region)
        for (const auto n : {a.from, a.to}) join(n, region);
  }

  /// Halves that reach across an edge of the cell.
  void join_across(const EdgePair& p) {
    const FaceDiagram &first = *face_[p.face[0]], &second = *face_[p.face[1]];
    const auto &a = first.side_region[p.side[0]], &b = second.side_region[p.side[1]];
    for (const EdgeInterval& i : intervals(*first.side[p.side[0]])) {
      const SiteId site = first.region[a[i.index]].labels.front();
      const auto ra = surface_.region(p.face[0], a[i.index]),
                 rb = surface_.region(p.face[1], b[i.index]);
      for (const Point3& x : {i.low, i.high})
        for (const int side : kSides)
          if (closed_[half(ra, side)] && closed_[half(rb, side)] && on_side(site, {x, x}, side))
            joined_.unite(name(half(ra, side)), name(half(rb, side)));
      if (!crosses_plane(geometry_, site, i) || !place_(site).section) continue;
      const auto [it, fresh] = trace_.try_emplace(site.value, 0);
      if (fresh) it->second = joined_.add();
      for (const auto r : {ra, rb})
        for (const int side : kSides)
          if (closed_[half(r, side)]) joined_.unite(name(half(r, side)), it->second);
    }
  }

  /// Does each part of the piece of a triangle off N, which is joined to `first`, hold one
  /// component of its trace at most?
  bool parts_traces(SiteId site, std::uint32_t first) {
    TraceChains trace(geometry_, surface_, face_, site, place_(site));
    if (!trace.known()) return false;
    // Halves and, one for each face, segments of the trace.
    UnionFind part;
    part.resize(static_cast<std::uint32_t>(closed_.size()) + 6);
    const auto segment = [&](int f) {
      return static_cast<std::uint32_t>(closed_.size()) + static_cast<std::uint32_t>(f);
    };
    const auto open = [&](std::uint32_t h) {
      return !closed_[h] || joined_.find(name(h)) != first;
    };
    for (int f = 0; f < 6; ++f) {
      if (!trace.on_face(f)) continue;
      part.unite(segment(f), segment(static_cast<int>(trace.chain(f))));
      for (std::uint32_t r = 0; r < face_[f]->region.size(); ++r)
        if (face_[f]->region[r].labels.front() == site)
          for (const int side : kSides)
            if (const auto h = half(surface_.region(f, r), side); open(h))
              part.unite(h, segment(f));
    }
    for (const EdgePair& p : edge_pairs()) {
      const FaceDiagram& d = *face_[p.face[0]];
      const auto &a = d.side_region[p.side[0]], &b = face_[p.face[1]]->side_region[p.side[1]];
      std::vector<const EdgeInterval*> between(a.size(), nullptr);
      const auto all = intervals(*d.side[p.side[0]]);
      for (const EdgeInterval& i : all) between[i.index] = &i;
      for (std::size_t k = 0; k < a.size(); ++k) {
        if (d.region[a[k]].labels.front() != site) continue;
        for (const int side : kSides) {
          // Ends known to lie on the other side: so does what is between.
          if (between[k] != nullptr &&
              side_of_plane(geometry_, site, {between[k]->low, between[k]->low}) == -side &&
              side_of_plane(geometry_, site, {between[k]->high, between[k]->high}) == -side)
            continue;
          const auto ha = half(surface_.region(p.face[0], a[k]), side),
                     hb = half(surface_.region(p.face[1], b[k]), side);
          if (open(ha) && open(hb)) part.unite(ha, hb);
        }
      }
    }
    for (int f = 0; f < 6; ++f)
      for (int g = 0; g < f; ++g)
        if (trace.on_face(f) && trace.on_face(g) && trace.chain(f) != trace.chain(g) &&
            part.find(segment(f)) == part.find(segment(g)))
          return false;
    return true;
  }

  const SiteGeometry& geometry_;
  VoronoiSurface& surface_;
  const VoronoiSurface::Faces& face_;
  const std::function<SitePlace(SiteId)>& place_;
  const bool chains_;
  std::vector<SiteId> several_;  // triangles with several traces
  std::vector<bool> closed_;     // halves
  UnionFind joined_;             // nodes, halves, traces
  std::unordered_map<std::uint32_t, std::uint32_t> trace_;
};

}  // namespace

bool joined_by_flow(const SiteGeometry& geometry, VoronoiSurface& surface,
                    const VoronoiSurface::Faces& face,
                    const std::function<SitePlace(SiteId)>& place) {
  FlowJoins plain(geometry, surface, face, place, false);
  return plain.run() ||
         (plain.chains_matter() && FlowJoins(geometry, surface, face, place, true).run());
}

}  // namespace blum
