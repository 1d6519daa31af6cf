// Positions on Voronoi diagrams, where sites that touch tie on a plane with equal distances beside
// it: distances alone do not tell where.
#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "blum/arrangement/touching.hpp"
#include "blum/kernel/closest_point.hpp"
#include "locate.hpp"

namespace blum {
namespace {

struct Value {
  double f = 0;
  Point3 gradient;
};

/// Distance to the carrier of a site.
Value distance_to_carrier(const SiteGeometry& geometry, SiteId site, const Point3& x) {
  const Point3& b = geometry.base(site);
  Point3 d{x.x - b.x, x.y - b.y, x.z - b.z};
  const SiteKind kind = geometry.index().kind(site);
  if (kind != SiteKind::kVertex) {
    const BallVector& u = geometry.unit(site);
    const double s = d.x * u[0].mid + d.y * u[1].mid + d.z * u[2].mid;
    for (int k = 0; k < 3; ++k)
      d[k] = kind == SiteKind::kFace ? s * u[static_cast<std::size_t>(k)].mid
                                     : d[k] - s * u[static_cast<std::size_t>(k)].mid;
  }
  const double r = std::hypot(d.x, d.y, d.z);
  if (!(r > 0)) return {};
  return {r, {d.x / r, d.y / r, d.z / r}};
}

/// A function of x that vanishes where a and b tie.
Value tie_function(const SiteGeometry& geometry, const Touch& touch, SiteId a, SiteId b,
                   const Point3& x) {
  if (touch.kind == Touch::Kind::kPlane) {
    const Point3& p = geometry.solid().point[touch.base];
    Value v;
    double length = 0;
    for (int k = 0; k < 3; ++k) {
      v.gradient[k] = touch.w[static_cast<std::size_t>(k)].mid;
      v.f += v.gradient[k] * (x[k] - p[k]);
      length = std::hypot(length, v.gradient[k]);
    }
    v.f /= length;
    for (int k = 0; k < 3; ++k) v.gradient[k] /= length;
    return v;
  }
  const Value fa = distance_to_carrier(geometry, a, x), fb = distance_to_carrier(geometry, b, x);
  Value v{fa.f - fb.f, {}};
  for (int k = 0; k < 3; ++k) v.gradient[k] = fa.gradient[k] - fb.gradient[k];
  return v;
}

}  // namespace

Placed Locator::voronoi_tie(const Segment& line, const Breakpoint& breakpoint,
                            std::span<const SiteId> candidates) {
  const auto at = [&](double t) { return point_on(line.axis, t, line.u, line.v); };
  const SiteId below = breakpoint.below, above = breakpoint.above;
  const Touch t = touch(engine_.predicates(), below, above);
  double lo = breakpoint.lo, hi = breakpoint.hi;
  const auto gap = [&](double s) { return tie_function(geometry_, t, below, above, at(s)).f; };
  for (int k = 0; k < 200; ++k) {
    const double m = 0.5 * lo + 0.5 * hi;
    if (!(m > lo && m < hi)) break;
    (gap(m) > 0 ? hi : lo) = m;
  }
  const double m = 0.5 * lo + 0.5 * hi;
  Placed p = anywhere(at(m), candidates);
  p.on_axis = std::abs(gap(m)) <= kTieTolerance;
  return p;
}

Placed Locator::voronoi_event(const Rect& rect, const FaceNode& node,
                              std::span<const SiteId> candidates) {
  const int u = u_axis(rect.axis), v = v_axis(rect.axis);
  const auto at = [&](double s, double t) { return point_on(rect.axis, rect.level, s, t); };
  double s = 0.5 * (node.u0 + node.u1), t = 0.5 * (node.v0 + node.v1);
  const double size = std::max(node.u1 - node.u0, node.v1 - node.v0);
  std::vector<std::tuple<SiteId, SiteId, Touch>> pairs;
  for (std::size_t i = 0; i < node.governors.size(); ++i)
    for (std::size_t j = i + 1; j < node.governors.size(); ++j) {
      const Touch found = touch(engine_.predicates(), node.governors[i], node.governors[j]);
      if (found.kind != Touch::Kind::kNever)
        pairs.emplace_back(node.governors[i], node.governors[j], found);
    }
  // Gauss-Newton on all pairs.
  const auto residual = [&](double a, double b) {
    double worst = 0;
    for (const auto& [i, j, found] : pairs)
      worst = std::max(worst, std::abs(tie_function(geometry_, found, i, j, at(a, b)).f));
    return worst;
  };
  double best_s = s, best_t = t, best = residual(s, t);
  for (int iteration = 0; iteration < 40 && best > 0; ++iteration) {
    double a = 0, b = 0, c = 0, ra = 0, rb = 0;
    for (const auto& [i, j, found] : pairs) {
      const Value f = tie_function(geometry_, found, i, j, at(s, t));
      const double x = f.gradient[u], y = f.gradient[v];
      a += x * x;
      b += x * y;
      c += y * y;
      ra += x * f.f;
      rb += y * f.f;
    }
    const double damping = 1e-14 * (a + c) + 1e-300, det = (a + damping) * (c + damping) - b * b;
    if (!(det > 0)) break;
    s = std::clamp(s - ((c + damping) * ra - b * rb) / det, node.u0 - size, node.u1 + size);
    t = std::clamp(t - ((a + damping) * rb - b * ra) / det, node.v0 - size, node.v1 + size);
    const bool within = s >= node.u0 && s <= node.u1 && t >= node.v0 && t <= node.v1;
    const double here = residual(s, t);
    if (within && here < best) {
      best = here;
      best_s = s;
      best_t = t;
    }
  }
  Placed p = anywhere(at(best_s, best_t), candidates);
  // On the diagram: all governors at the least distance, on the planes that separate them.
  p.on_axis = best <= kTieTolerance && pairs.size() > 0 &&
              std::ranges::all_of(node.governors, [&](SiteId g) {
                return distance_estimate(geometry_, g, p.position) <= p.radius + kTieTolerance;
              });
  return p;
}

}  // namespace blum
