#include "blum/kernel/closest_point.hpp"

#include <algorithm>
#include <cmath>

namespace blum {

Point3 closest_point(const SiteGeometry& geometry, SiteId site, const Point3& x) {
  int count = 0;
  const auto corner = geometry.corners(site, count);
  const Solid& solid = geometry.solid();
  const Point3& a = solid.point[corner[0]];
  if (count == 1) return a;
  const auto minus = [](const Point3& p, const Point3& q) {
    return Point3{p.x - q.x, p.y - q.y, p.z - q.z};
  };
  const auto inner = [](const Point3& p, const Point3& q) {
    return p.x * q.x + p.y * q.y + p.z * q.z;
  };
  const auto on_edge = [&](const Point3& p, const Point3& q) {
    const Point3 d = minus(q, p);
    const double s = std::clamp(inner(minus(x, p), d) / inner(d, d), 0.0, 1.0);
    return Point3{p.x + s * d.x, p.y + s * d.y, p.z + s * d.z};
  };
  const Point3& b = solid.point[corner[1]];
  if (count == 2) return on_edge(a, b);
  const Point3& c = solid.point[corner[2]];
  // Barycentric coordinates; outside, the nearest of the three edges.
  const Point3 ab = minus(b, a), ac = minus(c, a), ax = minus(x, a);
  const double d00 = inner(ab, ab), d01 = inner(ab, ac), d11 = inner(ac, ac);
  const double d20 = inner(ax, ab), d21 = inner(ax, ac), det = d00 * d11 - d01 * d01;
  if (det > 0) {
    const double s = (d11 * d20 - d01 * d21) / det, t = (d00 * d21 - d01 * d20) / det;
    if (s >= 0 && t >= 0 && s + t <= 1)
      return {a.x + s * ab.x + t * ac.x, a.y + s * ab.y + t * ac.y, a.z + s * ab.z + t * ac.z};
  }
  Point3 best = on_edge(a, b);
  for (const Point3& p : {on_edge(b, c), on_edge(c, a)}) {
    const Point3 dp = minus(p, x), db = minus(best, x);
    if (inner(dp, dp) < inner(db, db)) best = p;
  }
  return best;
}

double distance_estimate(const SiteGeometry& geometry, SiteId site, const Point3& x) {
  const Point3 y = closest_point(geometry, site, x);
  return std::hypot(y.x - x.x, y.y - x.y, y.z - x.z);
}

NearestFoot nearest_foot(const SiteGeometry& geometry, std::span<const SiteId> sites,
                         const Point3& x) {
  NearestFoot best;
  for (const SiteId s : sites) {
    const Point3 y = closest_point(geometry, s, x);
    const double d = std::hypot(y.x - x.x, y.y - x.y, y.z - x.z);
    if (d < best.distance) best = {d, y};
  }
  return best;
}

}  // namespace blum
