#include "angle_directions.hpp"

#include <algorithm>
#include <cmath>

namespace blum {
namespace {

/// From a point to its foot on the carrier of a vertex or an edge.
BallVector to_carrier(const SiteGeometry& geometry, SiteId site, const Point3& x) {
  BallVector w = difference(geometry.base(site), x);
  if (geometry.index().kind(site) == SiteKind::kVertex) return w;
  const BallVector& u = geometry.unit(site);
  const Ball along = dot(w, u);
  for (int k = 0; k < 3; ++k) w[k] = w[k] - along * u[k];
  return w;
}

Direction direction_of(const BallVector& w) {
  Direction d;
  double error = 0;
  for (int k = 0; k < 3; ++k) {
    d.vector[k] = w[k].mid;
    error += w[k].rad;
  }
  const double length = std::hypot(d.vector.x, d.vector.y, d.vector.z) * (1 - 1e-15);
  if (error < 0.5 * length) d.error = std::asin(error / length) * (1 + 1e-12) + 1e-300;
  return d;
}

/// Between the vectors as they are; errs by less than kAngleSlack.
double angle(const Point3& a, const Point3& b) {
  const double cross = std::hypot(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                                  a.x * b.y - a.y * b.x);
  return std::atan2(cross, a.x * b.x + a.y * b.y + a.z * b.z);
}

Ball length_of(const BallVector& w) {
  double mid = 0, rad = 0;
  for (const Ball& c : w) {
    mid = std::hypot(mid, c.mid);
    rad += c.rad;
  }
  return {mid, (rad + 4 * mid * Ball::kUnit) * Ball::kInflate + Ball::kTiny};
}

}  // namespace

double angle_at_most(const Direction& a, const Direction& b) {
  if (a.error >= kPi || b.error >= kPi) return kPi;
  return std::min(kPi, angle(a.vector, b.vector) + a.error + b.error + kAngleSlack);
}

double angle_at_least(const Direction& a, const Direction& b) {
  if (a.error >= kPi || b.error >= kPi) return 0;
  return std::max(0.0, angle(a.vector, b.vector) - a.error - b.error - kAngleSlack);
}

Point3 center_of(const Box3& box) {
  Point3 c;
  for (int k = 0; k < 3; ++k) c[k] = box.lo[k] + 0.5 * (box.hi[k] - box.lo[k]);
  return c;
}

double radius_of(const Box3& box) {
  const Point3 c = center_of(box);
  double squared = 0;
  for (int k = 0; k < 3; ++k) {
    const double r = std::max(box.hi[k] - c[k], c[k] - box.lo[k]);
    squared += r * r;
  }
  return std::sqrt(squared) * (1 + 1e-14) + 1e-150;
}

SiteView view_of(const SiteGeometry& geometry, SiteId site, const Box3& box) {
  SiteView view;
  view.site = site;
  const Point3 c = center_of(box);
  if (geometry.index().kind(site) == SiteKind::kFace) {
    const BallVector& n = geometry.unit(site);
    view.at_center = direction_of(n);
    view.spread = view.at_center.error;
    view.distance = dot(n, difference(geometry.base(site), c));
    return view;
  }
  const BallVector w = to_carrier(geometry, site, c);
  view.at_center = direction_of(w);
  view.distance = length_of(w);
  double spread = view.at_center.error;
  for (int corner = 0; corner < 8; ++corner) {
    Point3 x;
    bool fresh = true;
    for (int k = 0; k < 3; ++k) {
      const bool high = ((corner >> k) & 1) != 0;
      x[k] = high ? box.hi[k] : box.lo[k];
      fresh &= !high || box.hi[k] > box.lo[k];
    }
    if (fresh)
      spread = std::max(spread, angle_at_most(view.at_center,
                                              direction_of(to_carrier(geometry, site, x))));
  }
  if (spread < 0.499 * kPi) view.spread = spread;
  return view;
}

double angle_at_most(const SiteView& a, const SiteView& b) {
  if (a.spread >= kPi || b.spread >= kPi) return kPi;
  return std::min(kPi, angle(a.at_center.vector, b.at_center.vector) + a.spread + b.spread +
                           3 * kAngleSlack);
}

double angle_at_least(const SiteView& a, const SiteView& b) {
  if (a.spread >= kPi || b.spread >= kPi) return 0;
  return std::max(0.0, angle(a.at_center.vector, b.at_center.vector) - a.spread - b.spread -
                           3 * kAngleSlack);
}

bool may_tie(const SiteView& a, const SiteView& b, double radius) {
  const double slope = 2 * std::sin(0.5 * angle_at_most(a, b)) * (1 + 1e-14) + 1e-14;
  const Ball gap = a.distance - b.distance;
  return std::abs(gap.mid) - gap.rad <= slope * radius + 1e-300;
}

}  // namespace blum
