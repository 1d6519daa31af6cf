// Parts of a face where feet on different sites may merge in a boundary vertex: rims inside the
// solid, and what comes near to one.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "blum/arrangement/polar_cone.hpp"
#include "blum/kernel/check.hpp"
#include "face_engine.hpp"
#include "vertex_cone.hpp"

namespace blum {

std::uint32_t FaceEngine::ends_of(const Circle& circle) {
  return static_cast<std::uint32_t>(std::count_if(circle.begin(), circle.end(), separates));
}

bool FaceEngine::wholly_inside(const Border& border) {
  return border.loop.empty() && border.circle.size() == 1 &&
         std::none_of(border.circle[0].begin(), border.circle[0].end(),
                      [](const Step& s) { return s.kind == Step::Kind::kTrace; });
}

bool FaceEngine::accept_rim(const Box& box, std::span<const LocalForm> forms, const Groups& feet,
                            const Border& border) {
  // Needs a part wholly inside the solid, all candidates at one vertex, and the rim's point in it.
  if (!wholly_inside(border)) return false;
  const SiteGeometry& geometry = context_.geometry;
  const SiteIndex& index = geometry.index();
  const Solid& solid = geometry.solid();
  std::vector<SiteId> sites;
  std::vector<std::uint32_t> edges;
  for (const LocalForm& f : forms) {
    sites.push_back(f.site);
    if (f.kind == SiteKind::kEdge) edges.push_back(index.element(f.site));
  }
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = i + 1; j < edges.size(); ++j) {
      std::uint32_t common = Breakpoint::kNone;
      for (const auto p : solid.edge[edges[i]].vertex)
        for (const auto q : solid.edge[edges[j]].vertex)
          if (p == q) common = p;
      if (common == Breakpoint::kNone ||
          context_.never_essential(index.edge(edges[i]), index.edge(edges[j])))
        continue;
      Predicates& predicates = context_.predicates;
      if (!predicates.rim_common(common, edges[i], edges[j], sites)) return false;
      const auto side = [&](int along, double value) {
        return predicates.compare_rim(common, edges[i], edges[j], problem_.rect.axis,
                                      problem_.rect.level, along, value);
      };
      const auto a = side(u_, box.u0), b = side(u_, box.u1), c = side(v_, box.v0),
                 d = side(v_, box.v1);
      if (!a || !(*a > 0 && *b < 0 && *c > 0 && *d < 0)) return false;

      // On the plane all d_i^2 - |x - v|^2 are homogeneous about the rim's point: a cone.
      ++context_.counts.rims;
      record(border.circle[0], forms, feet, box, {}, Rims::kCone);
      note(PartRecord::Kind::kRim, forms, common, {edges[i], edges[j]});
      return true;
    }
  return false;
}

namespace {

bool all_different(std::vector<std::uint32_t> x) {
  std::sort(x.begin(), x.end());
  return std::adjacent_find(x.begin(), x.end()) == x.end();
}

}  // namespace

std::optional<std::uint32_t> common_vertex(const SiteGeometry& geometry,
                                           std::span<const LocalForm> forms) {
  int n = 0;
  const auto first = geometry.corners(forms[0].site, n);
  for (int k = 0; k < n; ++k)
    if (std::all_of(forms.begin() + 1, forms.end(),
                    [&](const LocalForm& f) { return geometry.has_corner(f.site, first[k]); }))
      return first[k];
  return std::nullopt;
}

// Projections move no farther apart than points, so their distance from v is at most that of the
// centre's plus the radius.
bool feet_stay_at(const SiteGeometry& geometry, std::uint32_t v, const Range& range) {
  const Solid& solid = geometry.solid();
  const Point3& o = solid.point[v];
  const BallVector x = difference(range.center, o);
  const auto beyond = [&](const BallVector& w) { return dot(w, x).low() > spread(w, range); };
  double reach = std::numeric_limits<double>::infinity(), farthest = 0;
  for (const auto t : solid.triangles_at(v)) {
    const auto& tv = solid.triangle[t].vertex;
    const auto at = static_cast<std::size_t>(std::find(tv.begin(), tv.end(), v) - tv.begin());
    const BallVector a = difference(solid.point[tv[(at + 1) % 3]], o),
                     b = difference(solid.point[tv[(at + 2) % 3]], o);
    const BallVector across = cross(a, b), side = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    const double height = std::sqrt(std::max(0.0, dot(across, across).low())) / length_above(side);
    reach = std::min(reach, height * (1 - 0x1p-40));
    const SiteId face = geometry.index().face(t);
    const auto domain = geometry.domain(face);  // prism conditions in the order of the edges
    if (beyond(domain[at].w) || beyond(domain[(at + 2) % 3].w)) continue;
    const BallVector& n = geometry.unit(face);
    const Ball h = dot(n, x);
    farthest =
        std::max(farthest, length_above({x[0] - n[0] * h, x[1] - n[1] * h, x[2] - n[2] * h}));
  }
  for (const auto e : solid.edges_at(v)) {
    const auto& ends = solid.edge[e].vertex;
    const BallVector along = difference(solid.point[ends[0] == v ? ends[1] : ends[0]], o);
    if (beyond({-along[0], -along[1], -along[2]})) continue;
    farthest = std::max(farthest, dot(geometry.unit(geometry.index().edge(e)), x).magnitude());
  }
  return (farthest + range.radius()) * (1 + 0x1p-40) < reach;
}

std::optional<FaceEngine::Apex> FaceEngine::apex_of(const Box& box,
                                                    std::span<const LocalForm> forms,
                                                    const Border& border) {
  if (!wholly_inside(border)) return std::nullopt;
  const Rect& r = problem_.rect;
  const Solid& solid = context_.geometry.solid();
  const auto v = common_vertex(context_.geometry, forms);
  if (!v || solid.point[*v][r.axis] == r.level) return std::nullopt;
  const Range range = range_of(box);
  if (!feet_stay_at(context_.geometry, *v, range)) return std::nullopt;
  return Apex{*v, may_be_foot(context_, *v, forms, range) &&
                      meets_polar_cone(solid, *v, point_on(r.axis, r.level, box.u0, box.v0),
                                       point_on(r.axis, r.level, box.u1, box.v1))};
}

bool FaceEngine::accept_cone(const Box& box, std::span<const LocalForm> forms, const Groups& feet,
                             const Border& border) {
  const auto apex = apex_of(box, forms, border);
  if (!apex) return false;
  // Theorem G: the axis is a forest here, whose ends are the ties and, one for each tree, points
  // where feet merge in v.
  const Circle& circle = border.circle[0];
  const std::uint32_t ties = ends_of(circle);
  const auto one_tree = [&]() -> bool {
    if (ties == 0) return true;
    // Even with a single ray, two ties may be one arc, or meet in an event from which a rim starts.
    if (apex->is_foot || ties == 1) return apex->is_foot && ties == 1;
    if (ties <= 3) return true;
    // Intervals in different groups are of different regions: then the forest is one tree.
    const auto runs = runs_of(circle, forms, feet);
    return runs && all_different(*runs) && may_be_cluster(box, forms, feet, circle);
  };
  if (context_.links_first || !one_tree())
    return !context_.plain && accept_link(*apex, box, forms, feet, circle);
  context_.counts.rims += ties == 1;
  record(circle, forms, feet, box, {}, ties == 1 ? Rims::kTips : Rims::kNone);
  note(PartRecord::Kind::kCone, forms, apex->vertex);
  return true;
}

}  // namespace blum
