#include "axis_distance.hpp"

#include <algorithm>
#include <cmath>

#include "blum/kernel/closest_point.hpp"
#include "blum/kernel/point_algebra.hpp"

namespace blum {
namespace {

constexpr int kSteps = 8;
/// Half the length of the segments tried, as parts of the radius: above rounding, and more where a
/// tie is flat.
constexpr double kReach[] = {1e-9, 1e-7, 1e-5, 1e-3, 1e-2};
/// Relative error of a length of this file: a few roundings.
constexpr double kRelative = 1e-14;

}  // namespace

AxisDistance::Feet AxisDistance::feet(const Point3& p) const {
  const std::vector<TriangleDistance> nearest = tree_.possibly_nearest(p);
  double least = std::numeric_limits<double>::infinity();
  for (const TriangleDistance& t : nearest) least = std::min(least, t.squared.lo);
  Feet f;
  f.distance = std::sqrt(least) * (1 - kRelative);
  bool first = true;
  for (const TriangleDistance& t : nearest) {
    const Point3 y = closest_point(geometry_, geometry_.index().face(t.triangle), p);
    // The triangle is convex: |y - foot|^2 <= |y - p|^2 - |foot - p|^2 for a point y of it.
    const double reach = distance_between(p, y) * (1 + kRelative) + kOnSite;
    const double off =
        std::sqrt(std::max(0.0, reach * reach - t.squared.lo) + kRelative * reach * reach) +
        kOnSite;
    if (first) f.center = y;
    f.radius = std::max(f.radius, (distance_between(f.center, y) + off) * (1 + kRelative));
    first = false;
  }
  return f;
}

bool AxisDistance::parts(const Point3& p, const Point3& q) const {
  const double length = distance_between(p, q) * (1 + kRelative);
  const Feet at_p = feet(p);
  if (!(length < at_p.distance)) return false;  // the segment might leave the solid
  const Feet at_q = feet(q);
  const double apart = distance_between(at_p.center, at_q.center) * (1 - kRelative);
  return apart - at_p.radius - at_q.radius > length &&
         inside_.locate(p) == InsideOracle::Where::kInside;
}

std::optional<double> AxisDistance::at_most(const Point3& p, const SiteGroup& a,
                                            const SiteGroup& b) const {
  Point3 x = p, across;
  double radius = 0;
  for (int step = 0; step < kSteps; ++step) {
    const NearestFoot to_a = nearest_foot(geometry_, a, x), to_b = nearest_foot(geometry_, b, x);
    if (!(to_a.distance > 0) || !(to_b.distance > 0)) return std::nullopt;
    const Point3 w = (1 / to_a.distance) * (x - to_a.foot) - (1 / to_b.distance) * (x - to_b.foot);
    const double slope = inner(w, w), gap = to_a.distance - to_b.distance;
    if (!(slope > 1e-20)) return std::nullopt;
    radius = to_a.distance;
    across = (1 / std::sqrt(slope)) * w;
    const double move = gap / std::sqrt(slope);
    if (std::abs(move) <= 1e-15) break;
    x = x - move * across;
  }
  for (const double reach : kReach) {
    const Point3 on_a = x - (reach * radius) * across, on_b = x + (reach * radius) * across;
    if (parts(on_a, on_b))
      return std::max(distance_between(p, on_a), distance_between(p, on_b)) * (1 + kRelative);
  }
  return std::nullopt;
}

bool AxisDistance::may_share_foot(SiteId s, SiteId t, const Point3& p, double reach) const {
  const Solid& solid = geometry_.solid();
  int n = 0, m = 0;
  const auto at_s = geometry_.corners(s, n), at_t = geometry_.corners(t, m);
  std::array<std::uint32_t, 3> common{};
  std::size_t count = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j)
      if (at_s[static_cast<std::size_t>(i)] == at_t[static_cast<std::size_t>(j)])
        common[count++] = at_s[static_cast<std::size_t>(i)];
  // Closed sites of a valid solid meet in a common vertex or edge, or not at all; no point of the
  // solid has a foot inside a convex edge, and feet are not farther than the boundary is.
  for (std::size_t k = 0; k < count; ++k)
    if (distance_between(p, solid.point[common[k]]) * (1 - kRelative) <= reach) return true;
  if (count < 2) return false;
  for (const auto e : solid.edges_at(common[0])) {
    const auto& ends = solid.edge[e].vertex;
    if (ends[0] == common[1] || ends[1] == common[1])
      return count > 2 || solid.edge[e].kind != EdgeKind::kConvex;
  }
  return true;
}

bool AxisDistance::exactly_parts(const Point3& p, const Point3& q, const SiteGroup& a,
                                 const SiteGroup& b, const LeafSides& leaf) const {
  const double length = distance_between(p, q) * (1 + kRelative);
  const SquaredDistanceBounds squared = tree_.squared_distance(p);
  if (!(length < std::sqrt(squared.lo) * (1 - kRelative))) return false;
  Box3 hull;
  for (int k = 0; k < 3; ++k) {
    hull.lo[k] = std::min(p[k], q[k]);
    hull.hi[k] = std::max(p[k], q[k]);
  }
  const auto in = [](const SiteGroup& side, SiteId s) {
    return std::find(side.begin(), side.end(), s) != side.end();
  };
  const std::vector<SiteId> near = engine_.prune(leaf.candidates(), hull.lo, hull.hi);
  SiteGroup on_a, on_b;
  for (const SiteId s : near) {
    if (in(a, s) == in(b, s)) return false;
    (in(a, s) ? on_a : on_b).push_back(s);
  }
  const double reach = std::sqrt(squared.hi) * (1 + kRelative) + 2 * length;
  for (const SiteId s : on_a)
    for (const SiteId t : on_b)
      if (may_share_foot(s, t, p, reach)) return false;
  std::vector<SiteId> at_p, at_q;
  engine_.predicates().governors(p, near, at_p);
  engine_.predicates().governors(q, near, at_q);
  const auto all_in = [&](const std::vector<SiteId>& sites, const SiteGroup& side) {
    return !sites.empty() &&
           std::all_of(sites.begin(), sites.end(), [&](SiteId s) { return in(side, s); });
  };
  return ((all_in(at_p, on_a) && all_in(at_q, on_b)) ||
          (all_in(at_p, on_b) && all_in(at_q, on_a))) &&
         inside_.locate(p) == InsideOracle::Where::kInside;
}

std::optional<double> AxisDistance::exactly_at_most(const Point3& p, const SiteGroup& a,
                                                    const SiteGroup& b, const LeafSides& leaf,
                                                    double most) const {
  const auto nearest = [&](const SiteGroup& side) {
    return *std::min_element(side.begin(), side.end(), [&](SiteId s, SiteId t) {
      return distance_estimate(geometry_, s, p) < distance_estimate(geometry_, t, p);
    });
  };
  const SiteId s = nearest(a), t = nearest(b);
  const SiteIndex& index = geometry_.index();
  if (index.kind(s) != SiteKind::kFace || index.kind(t) != SiteKind::kFace ||
      !contains(leaf.box(), p))
    return std::nullopt;
  const BallVector difference = engine_.predicates().unit_difference(s, t);
  const Point3 w{difference[0].mid, difference[1].mid, difference[2].mid};
  const double size = length(w);
  if (!(size > 0)) return std::nullopt;
  const Point3 across = (1 / size) * w;
  for (const double reach : {1e-9, 1e-6, 1e-4, 0.1 * most, 0.3 * most, 0.6 * most, 0.9 * most}) {
    if (reach > most) break;
    Point3 from = p - reach * across, to = p + reach * across;
    // The line through p may leave the leaf on one side.
    for (Point3* end : {&from, &to})
      if (!contains(leaf.box(), *end)) *end = p;
    if (from == to) break;
    if (exactly_parts(from, to, a, b, leaf)) return reach * (1 + kRelative) + 1e-15;
  }
  return std::nullopt;
}

}  // namespace blum
