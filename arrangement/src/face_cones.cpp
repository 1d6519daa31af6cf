// Parts of a Voronoi diagram on a face where the boundary itself, or a line on which feet merge in
// a vertex, crosses the plane: squared distances have no slope there.
#include <algorithm>
#include <array>
#include <set>

#include "blum/arrangement/polar_cone.hpp"
#include "face_engine.hpp"
#include "vertex_cone.hpp"

namespace blum {

bool FaceEngine::each_shows_once(const Border& border) {
  if (!wholly_inside(border)) return false;
  const Circle& circle = border.circle[0];
  const std::size_t n = circle.size();
  std::size_t start = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (circle[i].kind == Step::Kind::kTie) start = i;
  std::vector<SiteId> shown;
  for (std::size_t k = 0; k < n; ++k) {
    const Step& s = circle[(start + k) % n];
    if (s.kind == Step::Kind::kTie) continue;
    const bool fresh = k == 0 || circle[(start + k - 1) % n].kind == Step::Kind::kTie;
    if (!fresh) continue;
    if (std::ranges::find(shown, s.label) != shown.end()) return false;
    shown.push_back(s.label);
  }
  return true;
}

bool FaceEngine::edge_and_its_faces(std::span<const LocalForm> forms, const Range& range) const {
  if (forms.size() > 3) return false;
  const SiteGeometry& geometry = context_.geometry;
  const SiteIndex& index = geometry.index();
  const auto edge =
      std::ranges::find_if(forms, [](const LocalForm& f) { return f.kind == SiteKind::kEdge; });
  if (edge == forms.end()) return false;
  const auto e = index.element(edge->site);
  const auto& faces = geometry.solid().edge[e].triangle;
  for (const LocalForm& f : forms)
    if (f.site != edge->site && f.site != index.face(faces[0]) && f.site != index.face(faces[1]))
      return false;
  // All feet on the line of the edge and beside it lie in the sites.
  const auto holds = [&](SiteId s, std::size_t k) {
    return holds_everywhere(geometry, geometry.domain(s)[k], range);
  };
  if (!holds(edge->site, 0) || !holds(edge->site, 1)) return false;
  for (const auto t : faces)
    for (std::size_t k = 0; k < 3; ++k)
      if (geometry.solid().triangle[t].edge[k] != e && !holds(index.face(t), k)) return false;
  return true;
}

bool FaceEngine::reaches(SiteId face, SiteId other, const Range& range) const {
  const SiteGeometry& geometry = context_.geometry;
  const auto t = geometry.index().element(face);
  const auto& edges = geometry.solid().triangle[geometry.index().element(other)].edge;
  for (std::size_t k = 0; k < 3; ++k)
    if (std::ranges::find(edges, geometry.solid().triangle[t].edge[k]) == edges.end() &&
        !holds_everywhere(geometry, geometry.domain(face)[k], range))
      return false;
  return true;
}

bool FaceEngine::ties_are_straight(std::span<const LocalForm> forms, const Range& range) {
  for (std::size_t i = 0; i < forms.size(); ++i)
    for (std::size_t j = i + 1; j < forms.size(); ++j) {
      const LocalForm &a = forms[i], &b = forms[j];
      // Where the projection on a carrier lies in the site, the carrier's distance is not less than
      // d: then a line parts the two regions wholly.
      if (a.side != 0 && b.side != 0 && a.covers && b.covers) continue;
      const Touch& t = context_.touch(a.site, b.site);
      if (t.kind == Touch::Kind::kPlane) continue;
      if (t.kind == Touch::Kind::kBisector && reaches(a.site, b.site, range) &&
          reaches(b.site, a.site, range))
        continue;
      if (may_tie(context_, a, b, range)) return false;
    }
  return true;
}

bool FaceEngine::accept_convex(const Box& box, std::span<const LocalForm> forms,
                               const Groups& sites, const Border& border) {
  if (forms.size() > kMaxGroups || !wholly_inside(border)) return false;
  const Circle& circle = border.circle[0];
  const Range range = range_of(box);
  // The sectors at an edge are unbounded: one that does not show on the border is not in the part.
  if (edge_and_its_faces(forms, range)) return record_forest(circle, forms, sites, box);
  const bool all_show = std::ranges::all_of(forms, [&](const LocalForm& f) {
    return std::ranges::any_of(circle, [&](const Step& s) {
      return s.kind == Step::Kind::kInterval && s.label == f.site;
    });
  });
  return all_show && ties_are_straight(forms, range) && record_forest(circle, forms, sites, box);
}

bool FaceEngine::record_forest(const Circle& circle, std::span<const LocalForm> forms,
                               const Groups& sites, const Box& box) {
  const auto region = runs_of(circle, forms, sites);
  if (!region) return false;
  std::size_t regions = 1;
  if (region->size() > 1)
    for (const auto& [root, ends] : trees_of(*region)) {
      if (ends.size() < 2) return false;
      if (ends.size() > 3 && context_.part_clusters &&
          range_of(box).radius() > ProductionEngine::kSmallestCluster)
        return false;
      regions += ends.size() - 1;
    }
  if (regions != std::set(region->begin(), region->end()).size()) return false;
  record(circle, forms, sites, box, *region);
  return true;
}

bool FaceEngine::accept_vertex_link(const Box& box, std::span<const LocalForm> forms,
                                    const Groups& sites, const Border& border) {
  if (!each_shows_once(border)) return false;
  const SiteGeometry& geometry = context_.geometry;
  const SiteIndex& index = geometry.index();
  const Solid& solid = geometry.solid();
  const Rect& r = problem_.rect;
  const auto v = common_vertex(geometry, forms);
  if (!v || solid.point[*v][r.axis] == r.level) return false;
  const Range range = range_of(box);
  if (!feet_stay_at(geometry, *v, range)) return false;

  // A region that does not show might lie within the part, but then its site's cone would too.
  const auto shows = [&](SiteId s) {
    return std::ranges::any_of(border.circle[0], [s](const Step& step) {
      return step.kind == Step::Kind::kInterval && step.label == s;
    });
  };
  const auto misses = [&](const LocalForm& f) {
    switch (f.kind) {
      case SiteKind::kFace:
        return f.side != 0;
      case SiteKind::kVertex:
        return !meets_polar_cone(solid, *v, point_on(r.axis, r.level, box.u0, box.v0),
                                 point_on(r.axis, r.level, box.u1, box.v1));
      case SiteKind::kEdge:
        break;
    }
    const auto& ends = solid.edge[index.element(f.site)].vertex;
    const Point3 &o = solid.point[*v], &tip = solid.point[ends[0] == *v ? ends[1] : ends[0]];
    const Ball rise = Ball(tip[r.axis]) - Ball(o[r.axis]), gap = Ball(r.level) - Ball(o[r.axis]);
    if (rise.sign() == 0) return true;
    if (rise.sign() == 2) return false;
    const Ball s = divide(gap, rise);
    if (s.high() < 0) return true;
    const auto beyond = [&](int axis, double lo, double hi) {
      const Ball x = Ball(o[axis]) + s * (Ball(tip[axis]) - Ball(o[axis]));
      return x.low() > hi || x.high() < lo;
    };
    return beyond(u_, box.u0, box.u1) || beyond(v_, box.v0, box.v1);
  };
  for (const LocalForm& f : forms)
    if (!shows(f.site) && !misses(f)) return false;
  if (ends_of(border.circle[0]) > 3 && !may_be_cluster(box, forms, sites, border.circle[0]))
    return false;
  record(border.circle[0], forms, sites, box);
  return true;
}

Trouble FaceEngine::find_corners_in_plane() const {
  const SiteGeometry& geometry = context_.geometry;
  const Rect& r = problem_.rect;
  for (const SiteId s : problem_.candidates) {
    int n = 0;
    const auto corner = geometry.corners(s, n);
    for (int k = 0; k < n; ++k) {
      const Point3& p = geometry.solid().point[corner[k]];
      if (p[r.axis] == r.level && p[u_] >= r.u0 && p[u_] <= r.u1 && p[v_] >= r.v0 && p[v_] <= r.v1)
        return {FaceStatus::kBadPosition, "boundary vertex in the plane of a face"};
    }
  }
  return {};
}

}  // namespace blum
