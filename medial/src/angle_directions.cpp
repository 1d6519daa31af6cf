#include "angle_directions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace blum {
namespace {

/// From a point to its foot on the carrier.
BallVector to_carrier(const SiteGeometry& geometry, SiteId site, const Point3& x) {
  BallVector w = difference(geometry.base(site), x);
  const SiteKind kind = geometry.index().kind(site);
  if (kind == SiteKind::kVertex) return w;
  const BallVector& u = geometry.unit(site);
  const Ball along = dot(w, u);
  if (kind == SiteKind::kFace) return {along * u[0], along * u[1], along * u[2]};
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
  const double cross =
      std::hypot(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
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
  view.is_face = geometry.index().kind(site) == SiteKind::kFace;
  const Point3 c = center_of(box);
  const BallVector w = to_carrier(geometry, site, c);
  if (view.is_face) {
    view.at_center = direction_of(geometry.unit(site));
    view.distance = dot(geometry.unit(site), difference(geometry.base(site), c));
  } else {
    view.at_center = direction_of(w);
    view.distance = length_of(w);
  }
  view.nearest = std::max(0.0, (view.distance.low() - radius_of(box)) * (1 - 1e-15));
  double spread = view.at_center.error;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    Point3 x;
    std::size_t same = corner;  // a corner at the same place, where the box is flat
    for (int k = 0; k < 3; ++k) {
      const std::size_t bit = std::size_t{1} << k;
      x[k] = (corner & bit) != 0 ? box.hi[k] : box.lo[k];
      if (box.hi[k] == box.lo[k]) same &= ~bit;
    }
    if (same != corner) {
      view.to_foot[corner] = view.to_foot[same];
      continue;
    }
    const BallVector at = to_carrier(geometry, site, x);
    for (int k = 0; k < 3; ++k) {
      view.to_foot[corner].mid[k] = at[k].mid;
      view.to_foot[corner].rad += at[k].rad;
    }
    if (!view.is_face) spread = std::max(spread, angle_at_most(view.at_center, direction_of(at)));
  }
  if (spread < 0.499 * kPi) view.spread = spread;
  return view;
}

namespace {

/// Upper bounds of the angle over the points that are equally far from both carriers.
double by_normal(const SiteView& face, const SiteView& other) {
  double least = std::numeric_limits<double>::infinity(), farthest = 0;
  const Point3& n = face.at_center.vector;  // a unit vector up to its error
  for (const RoundedVector& w : other.to_foot) {
    const double length = std::hypot(w.mid.x, w.mid.y, w.mid.z) + w.rad;
    const double inner = n.x * w.mid.x + n.y * w.mid.y + n.z * w.mid.z;
    least = std::min(least, inner - w.rad - length * (face.at_center.error + 1e-14));
    farthest = std::max(farthest, length);
  }
  // The distance is convex, so it is nowhere larger than in a corner.
  const double cosine = least >= 0 ? least / (farthest * (1 + 1e-14)) : least / other.nearest;
  return cosine > -1 ? std::acos(std::min(1.0, cosine)) + kAngleSlack : kPi;
}

double by_chord(const SiteView& a, const SiteView& b) {
  double chord = 0;
  for (std::size_t k = 0; k < a.to_foot.size(); ++k) {
    const RoundedVector &v = a.to_foot[k], &w = b.to_foot[k];
    chord = std::max(
        chord, std::hypot(v.mid.x - w.mid.x, v.mid.y - w.mid.y, v.mid.z - w.mid.z) * (1 + 1e-14) +
                   v.rad + w.rad);
  }
  const double sine = chord / (2 * std::max(a.nearest, b.nearest)) * (1 + 1e-14);
  return sine < 1 ? 2 * std::asin(sine) + kAngleSlack : kPi;
}

}  // namespace

double angle_at_most(const SiteView& a, const SiteView& b) {
  double most = kPi;
  if (a.spread < kPi && b.spread < kPi)
    most = std::min(most, angle(a.at_center.vector, b.at_center.vector) + a.spread + b.spread +
                              3 * kAngleSlack);
  if (a.is_face && b.is_face) return most;
  if (a.is_face != b.is_face) {
    const SiteView &face = a.is_face ? a : b, &other = a.is_face ? b : a;
    if (other.nearest > 0) most = std::min(most, by_normal(face, other));
  }
  if (std::max(a.nearest, b.nearest) > 0) most = std::min(most, by_chord(a, b));
  return most;
}

double angle_at_least(const SiteView& a, const SiteView& b) {
  if (a.spread >= kPi || b.spread >= kPi) return 0;
  return std::max(
      0.0, angle(a.at_center.vector, b.at_center.vector) - a.spread - b.spread - 3 * kAngleSlack);
}

bool may_tie(const SiteView& a, const SiteView& b, double radius) {
  // On the way from the centre to the tie the carriers are not equally far: no bounds for ties
  // here.
  const double most = a.spread < kPi && b.spread < kPi
                          ? std::min(kPi, angle(a.at_center.vector, b.at_center.vector) + a.spread +
                                              b.spread + 3 * kAngleSlack)
                          : kPi;
  const double slope = 2 * std::sin(0.5 * most) * (1 + 1e-14) + 1e-14;
  const Ball gap = a.distance - b.distance;
  return std::abs(gap.mid) - gap.rad <= slope * radius + 1e-300;
}

}  // namespace blum
