#include "locate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "blum/arrangement/common_point.hpp"
#include "blum/kernel/closest_point.hpp"

namespace blum {
namespace {

/// Working units. Differences of distances up to the first may be rounding; brackets up to the
/// second are good positions anyway.
constexpr double kGapNoise = 1e-13, kFineBracket = 1e-10;

}  // namespace

Placed Locator::anywhere(const Point3& x, std::span<const SiteId> candidates) const {
  Placed p;
  p.position = x;
  p.radius = nearest_foot(geometry_, candidates, x).distance;
  for (const SiteId s : candidates)
    if (distance_estimate(geometry_, s, x) <= p.radius + kTieTolerance) p.governors.push_back(s);
  return p;
}

Placed Locator::tie(const Segment& line, const Breakpoint& breakpoint,
                    std::span<const SiteId> candidates) {
  if (geometry_.kind() == DiagramKind::kVoronoi) return voronoi_tie(line, breakpoint, candidates);
  const auto at = [&](double t) { return point_on(line.axis, t, line.u, line.v); };
  double lo = breakpoint.lo, hi = breakpoint.hi;
  // The groups that hold the governors below and above; a shorter list of candidates may have
  // isolated the tie than is at hand here, so other groups may show, but they govern nothing.
  const auto groups = engine_.tie_groups(candidates, at(lo), at(hi));
  const auto group_of = [&](SiteId s) {
    for (const auto& g : groups)
      if (std::find(g.begin(), g.end(), s) != g.end()) return g;
    return std::vector<SiteId>{s};
  };
  const auto below = group_of(breakpoint.below), above = group_of(breakpoint.above);
  const auto gap = [&](double t) {
    return nearest_foot(geometry_, below, at(t)).distance -
           nearest_foot(geometry_, above, at(t)).distance;
  };
  // Where feet are so near to each other that the gap is rounding, exact governors tell the side.
  const auto certain_side = [&](double t) {
    std::vector<SiteId> governors;
    engine_.predicates().governors(at(t), candidates, governors);
    const auto all_in = [&](const std::vector<SiteId>& group) {
      return std::all_of(governors.begin(), governors.end(), [&](SiteId s) {
        return std::find(group.begin(), group.end(), s) != group.end();
      });
    };
    return governors.empty() ? 0 : all_in(below) ? -1 : all_in(above) ? 1 : 0;
  };
  // The gap rises from the governor below to the one above: bisection.
  for (int k = 0; k < 200; ++k) {
    const double m = 0.5 * lo + 0.5 * hi;
    if (!(m > lo && m < hi)) break;
    double side = gap(m);
    if (std::abs(side) <= kGapNoise && hi - lo > kFineBracket) {
      const int certain = certain_side(m);
      if (certain != 0) side = certain;
    }
    (side > 0 ? hi : lo) = m;
  }
  const double t = 0.5 * lo + 0.5 * hi;
  Placed p = anywhere(at(t), candidates);
  p.on_axis = std::abs(gap(t)) <= kTieTolerance;
  return p;
}

Placed Locator::event(const Rect& rect, const FaceNode& node, std::span<const SiteId> candidates) {
  if (geometry_.kind() == DiagramKind::kVoronoi) return voronoi_event(rect, node, candidates);
  const Point3 lo = point_on(rect.axis, rect.level, node.u0, node.v0),
               hi = point_on(rect.axis, rect.level, node.u1, node.v1);
  const auto groups = engine_.tie_groups(candidates, lo, hi);
  const CommonPoint c = common_point(geometry_, groups, lo, hi);
  const auto inside = [&](const Point3& x) {
    return inside_.locate(x) == InsideOracle::Where::kInside;
  };
  // The node's rectangle may reach out of the solid, where faces have common points too.
  if (c.gap <= kTieTolerance && inside(c.point)) {
    Placed p = anywhere(c.point, candidates);
    p.on_axis = true;
    return p;
  }
  // Several events, or none that is a common point: from the middle outwards.
  constexpr int kSteps = 8;
  Point3 best = c.point;
  if (groups.size() < 2 || !inside(best)) {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; j <= kSteps; ++j) {
        const double s = static_cast<double>(i) / kSteps, t = static_cast<double>(j) / kSteps;
        const Point3 x = point_on(rect.axis, rect.level, node.u0 + s * (node.u1 - node.u0),
                                  node.v0 + t * (node.v1 - node.v0));
        const double off = std::hypot(s - 0.5, t - 0.5);
        if (off < least && inside(x)) {
          least = off;
          best = x;
        }
      }
  }
  return anywhere(best, candidates);
}

Placed Locator::rim(const Rect& rect, const FaceNode& node, std::span<const SiteId> candidates) {
  const Solid& solid = geometry_.solid();
  const SiteIndex& index = geometry_.index();
  std::vector<std::uint32_t> edges;
  for (const SiteId s : node.governors)
    if (index.kind(s) == SiteKind::kEdge) edges.push_back(index.element(s));
  const auto direction = [&](std::uint32_t e) {
    const Point3 &a = solid.point[solid.edge[e].vertex[0]],
                 &b = solid.point[solid.edge[e].vertex[1]];
    return Point3{b.x - a.x, b.y - a.y, b.z - a.z};
  };
  // Rims start at the corners of a vertex' polar cone, which are orthogonal to two of its edges.
  const int u = u_axis(rect.axis), v = v_axis(rect.axis);
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = i + 1; j < edges.size(); ++j) {
      const Point3 a = direction(edges[i]), b = direction(edges[j]);
      const Point3 r{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
      if (r[rect.axis] == 0) continue;
      for (const auto p : solid.edge[edges[i]].vertex)
        for (const auto q : solid.edge[edges[j]].vertex) {
          if (p != q) continue;
          const Point3& o = solid.point[p];
          const double t = (rect.level - o[rect.axis]) / r[rect.axis];
          Point3 x{o.x + t * r.x, o.y + t * r.y, o.z + t * r.z};
          x[rect.axis] = rect.level;
          if (x[u] < node.u0 || x[u] > node.u1 || x[v] < node.v0 || x[v] > node.v1) continue;
          Placed placed = anywhere(x, candidates);
          placed.on_axis =
              std::hypot(x.x - o.x, x.y - o.y, x.z - o.z) <= placed.radius + kTieTolerance;
          if (placed.on_axis) return placed;
        }
    }
  return anywhere(
      point_on(rect.axis, rect.level, 0.5 * (node.u0 + node.u1), 0.5 * (node.v0 + node.v1)),
      candidates);
}

Placed Locator::convex_edge(const Rect& rect, const FaceNode& node) const {
  const Solid& solid = geometry_.solid();
  const auto& ends = solid.edge[node.boundary_edge].vertex;
  const Point3 &a = solid.point[ends[0]], &b = solid.point[ends[1]];
  const double s = (rect.level - a[rect.axis]) / (b[rect.axis] - a[rect.axis]);
  Placed p;
  for (int k = 0; k < 3; ++k) p.position[k] = a[k] + s * (b[k] - a[k]);
  p.position[rect.axis] = rect.level;
  p.on_axis = true;
  p.governors = node.governors;
  return p;
}

}  // namespace blum
