#include "angle_witness.hpp"

#include <algorithm>
#include <cmath>

#include "blum/arrangement/common_point.hpp"
#include "blum/kernel/closest_point.hpp"

namespace blum {
namespace {

constexpr int kSteps = 12;
/// Half the distance of the two points, and half the side of the rectangle, as parts of the
/// distance to the boundary: far above rounding, far below what angles can tell.
constexpr double kReach = 1e-8;
/// Directions of one kind are within this angle; kinds have to be farther apart than twice that.
constexpr double kKind = 1e-3;
/// A point where the distances differ by so much (working units) is not on a seam.
constexpr double kGap = 1e-10;

Point3 scaled_sum(const Point3& a, double s, const Point3& b) {
  return {a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}
double inner(const Point3& a, const Point3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Point3 cross(const Point3& a, const Point3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Point3 unit(const Point3& a) {
  const double n = std::hypot(a.x, a.y, a.z);
  return n > 0 ? Point3{a.x / n, a.y / n, a.z / n} : a;
}
Point3 clamped(Point3 x, const Box3& box) {
  for (int k = 0; k < 3; ++k) x[k] = std::clamp(x[k], box.lo[k], box.hi[k]);
  return x;
}
bool in(const Box3& box, const Point3& x) { return clamped(x, box) == x; }
Box3 hull(const Point3& p, const Point3& q) {
  Box3 b;
  for (int k = 0; k < 3; ++k) {
    b.lo[k] = std::min(p[k], q[k]);
    b.hi[k] = std::max(p[k], q[k]);
  }
  return b;
}

}  // namespace

std::optional<double> AngleWitness::on_sheet(const LeafParts& leaf, const AngleRole& role,
                                             const AngleBox& within, const Point3& start, SiteId a,
                                             SiteId b) {
  Point3 x = clamped(start, within.box);
  Point3 w;
  for (int step = 0; step < kSteps; ++step) {
    const SiteView va = view_of(geometry_, a, {x, x}), vb = view_of(geometry_, b, {x, x});
    if (va.all.spread >= kPi || vb.all.spread >= kPi) return std::nullopt;
    const Point3 ua = unit(va.all.axis.vector), ub = unit(vb.all.axis.vector);
    w = {ua.x - ub.x, ua.y - ub.y, ua.z - ub.z};
    for (int k = 0; k < 3; ++k)
      if (within.box.lo[k] == within.box.hi[k]) w[k] = 0;  // stay in a flat box
    const double slope = inner(w, w), gap = va.distance.mid - vb.distance.mid;
    if (!(slope > 1e-16)) return std::nullopt;
    if (std::abs(gap) <= 1e-15) break;
    x = clamped(scaled_sum(x, gap / slope, w), within.box);
  }
  const NearestFoot foot = nearest_foot(geometry_, within.candidates, x);
  const double reach = kReach * foot.distance;
  if (!(reach > 1e-14)) return std::nullopt;
  // Where the point is on a face or an edge of the box, so are its neighbours.
  for (int k = 0; k < 3; ++k)
    if (x[k] - reach < within.box.lo[k] || x[k] + reach > within.box.hi[k]) w[k] = 0;
  w = unit(w);
  const Point3 p = scaled_sum(x, reach, w), q = scaled_sum(x, -reach, w);
  if (!in(within.box, p) || !in(within.box, q)) return std::nullopt;
  if (inside_.locate(p) != InsideOracle::Where::kInside ||
      inside_.locate(q) != InsideOracle::Where::kInside)
    return std::nullopt;
  const Box3 box = hull(p, q);
  const auto near = engine_.prune(within.candidates, box.lo, box.hi);
  std::vector<SiteId> at_p, at_q;
  engine_.predicates().governors(p, near, at_p);
  engine_.predicates().governors(q, near, at_q);
  if (at_p.empty() || at_q.empty()) return std::nullopt;
  // The ball about p that touches the boundary is far larger than the segment.
  if (!(view_of(geometry_, at_p.front(), {p, p}).distance.low() > 4 * reach)) return std::nullopt;
  const SiteView first = view_of(geometry_, at_p.front(), box),
                 second = view_of(geometry_, at_q.front(), box);
  std::vector<SiteView> like_p, like_q;
  for (const SiteId s : near) {
    const SiteView v = view_of(geometry_, s, box);
    const bool is_p = angle_at_most(v.all, first.all) <= kKind,
               is_q = angle_at_most(v.all, second.all) <= kKind;
    if (is_p == is_q) return std::nullopt;  // a third kind of foot, or no two kinds
    (is_p ? like_p : like_q).push_back(v);
  }
  double lo = kPi;
  for (const SiteView& v : like_p)
    for (const SiteView& u : like_q) {
      const GroupSet g = leaf.groups.of(v.site), h = leaf.groups.of(u.site);
      const bool fits = ((g & role.a) && (h & role.b)) || ((g & role.b) && (h & role.a));
      if (!fits || ((g | h) & ~(role.a | role.b))) return std::nullopt;
      lo = std::min(lo, angle_at_least(v, u));
    }
  return lo;
}

std::optional<double> AngleWitness::on_seam(const LeafParts& leaf, const AngleRole& role,
                                            const AngleBox& within, const Box3& search) {
  std::vector<std::vector<SiteId>> groups;
  for (GroupSet rest = role.a; rest != 0; rest &= rest - 1) {
    groups.emplace_back();
    for (const SiteId s : within.candidates)
      if (leaf.groups.of(s) == (rest & -rest)) groups.back().push_back(s);
    if (groups.back().empty()) groups.pop_back();
  }
  if (groups.size() < 3) return std::nullopt;
  const CommonPoint c = common_point(geometry_, groups, search.lo, search.hi);
  if (!(c.gap <= kGap)) return std::nullopt;
  const Point3 x = c.point;
  const NearestFoot foot = nearest_foot(geometry_, within.candidates, x);
  const double half = kReach * foot.distance;
  if (!(half > 1e-13)) return std::nullopt;
  std::vector<Point3> direction;
  for (const SiteId s : within.candidates) {
    if (!(leaf.groups.of(s) & role.a)) continue;
    if (distance_estimate(geometry_, s, x) > foot.distance * (1 + 1e-6)) continue;
    const SiteView v = view_of(geometry_, s, {x, x});
    if (v.all.spread < kPi) direction.push_back(unit(v.all.axis.vector));
  }
  // Across the seam: normal to the axis that the directions' differences are most orthogonal to.
  Point3 along;
  double most = 0;
  for (std::size_t i = 0; i < direction.size(); ++i)
    for (std::size_t j = i + 1; j < direction.size(); ++j)
      for (std::size_t k = j + 1; k < direction.size(); ++k) {
        const Point3 n = cross(scaled_sum(direction[j], -1, direction[i]),
                               scaled_sum(direction[k], -1, direction[i]));
        if (inner(n, n) > most) {
          most = inner(n, n);
          along = n;
        }
      }
  if (!(most > 1e-12)) return std::nullopt;
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(along[k]) > std::abs(along[axis])) axis = k;
  for (int k = 0; k < 3; ++k)  // in a face of the box, if the point is in one
    if (x[k] == within.box.lo[k] || x[k] == within.box.hi[k]) axis = k;
  const int u = u_axis(axis), v = v_axis(axis);
  // Not centred, so that symmetric models do not put the seam on a line of bisection.
  const Rect rect{
      axis, x[axis], x[u] - 0.9 * half, x[u] + 1.1 * half, x[v] - 0.97 * half, x[v] + 1.03 * half};
  const Point3 lo = point_on(axis, rect.level, rect.u0, rect.v0),
               hi = point_on(axis, rect.level, rect.u1, rect.v1);
  if (!in(within.box, lo) || !in(within.box, hi)) return std::nullopt;
  if (inside_.locate(x) != InsideOracle::Where::kInside) return std::nullopt;
  const auto near = engine_.prune(within.candidates, lo, hi);
  FaceProblem problem;
  problem.solid = &geometry_.solid();
  problem.rect = rect;
  problem.candidates = near;
  problem.interior = true;
  const FaceDiagram d = engine_.face(problem);
  if (d.status != FaceStatus::kDecided) return std::nullopt;
  std::vector<SiteView> view;
  for (const SiteId s : near) view.push_back(view_of(geometry_, s, {lo, hi}));
  const auto governs = [&](std::uint32_t r, SiteId s) {
    return std::ranges::binary_search(d.region[r].labels, s);
  };
  const auto between = [&](std::uint32_t r, std::uint32_t q) {
    double least = kPi;
    for (const SiteView& a : view)
      for (const SiteView& b : view)
        if (governs(r, a.site) && governs(q, b.site)) least = std::min(least, angle_at_least(a, b));
    return least;
  };
  double best = 0;
  for (std::uint32_t n = 0; n < d.node.size(); ++n) {
    if (d.node[n].kind != FaceNode::Kind::kEvent) continue;
    std::vector<std::array<std::uint32_t, 2>> sides;  // of its arcs
    std::vector<std::uint32_t> region;
    for (const FaceArc& arc : d.arc) {
      if (arc.from != n && arc.to != n) continue;
      sides.push_back(arc.region);
      for (const auto r : arc.region)
        if (std::ranges::find(region, r) == region.end()) region.push_back(r);
    }
    bool fits = region.size() >= 3 && std::ranges::find(region, FaceArc::kUnknown) == region.end();
    GroupSet met = 0;
    for (std::size_t k = 0; fits && k < region.size(); ++k) {
      GroupSet own = 0;
      for (const SiteId s : d.region[region[k]].labels) own |= leaf.groups.of(s);
      fits = (own & ~role.a) == 0 && (own & met) == 0;
      met |= own;
    }
    if (!fits) continue;
    for (const auto& [r, q] : sides) best = std::max(best, between(r, q));
  }
  return best > 0 ? std::optional(best) : std::nullopt;
}

}  // namespace blum
