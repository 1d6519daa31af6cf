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

RoundedVector rounded(const BallVector& w) {
  RoundedVector r;
  for (int k = 0; k < 3; ++k) {
    r.mid[k] = w[k].mid;
    r.rad += w[k].rad;
  }
  return r;
}

Direction direction_of(const RoundedVector& w) {
  Direction d{w.mid, kPi};
  const double length = std::hypot(w.mid.x, w.mid.y, w.mid.z) * (1 - 1e-15);
  if (w.rad < 0.5 * length) d.error = std::asin(w.rad / length) * (1 + 1e-12) + 1e-300;
  return d;
}
Direction direction_of(const BallVector& w) { return direction_of(rounded(w)); }

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

double angle_at_most(const Fan& a, const Fan& b) {
  if (a.spread >= kPi || b.spread >= kPi) return kPi;
  return std::min(kPi, angle(a.axis.vector, b.axis.vector) + a.spread + b.spread + 3 * kAngleSlack);
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

std::array<double, 3> half_widths_of(const Box3& box) {
  const Point3 c = center_of(box);
  std::array<double, 3> h{};
  for (int k = 0; k < 3; ++k)
    h[static_cast<std::size_t>(k)] = std::max(box.hi[k] - c[k], c[k] - box.lo[k]);
  return h;
}

double radius_of(const Box3& box) {
  double squared = 0;
  for (const double h : half_widths_of(box)) squared += h * h;
  return std::sqrt(squared) * (1 + 1e-14) + 1e-150;
}

/// About the direction of `axis`: the least fan that holds all of those.
Fan fan_about(const Direction& axis, std::span<const Direction> all) {
  double spread = axis.error;
  for (const Direction& d : all) spread = std::max(spread, angle_at_most(axis, d));
  // Directions within less than 90 degrees of one are a convex cone.
  return {axis, spread < 0.499 * kPi ? spread : kPi};
}

/// Along a unit vector e the vector to the carrier changes by its component across the carrier.
double reach_of(const SiteGeometry& geometry, SiteId site, const Box3& box) {
  const double radius = radius_of(box);
  const SiteKind kind = geometry.index().kind(site);
  if (kind == SiteKind::kVertex) return radius;
  const auto half = half_widths_of(box);
  double reach = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Ball along = square(geometry.unit(site)[k]);
    const Ball across = kind == SiteKind::kFace ? along : Ball(1) - along;
    reach += std::sqrt(std::max(0.0, across.high())) * half[k];
  }
  return std::min(radius, reach * (1 + 1e-14) + 1e-150);
}

SiteView view_of(const SiteGeometry& geometry, SiteId site, const Box3& box) {
  SiteView view;
  view.site = site;
  view.is_face = geometry.index().kind(site) == SiteKind::kFace;
  const Point3 c = center_of(box);
  const BallVector w = view.at_center = to_carrier(geometry, site, c);
  view.distance =
      view.is_face ? dot(geometry.unit(site), difference(geometry.base(site), c)) : length_of(w);
  view.reach = reach_of(geometry, site, box);
  view.nearest = std::max(0.0, (view.distance.low() - view.reach) * (1 - 1e-15));
  std::vector<Direction> direction;
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
    view.to_foot[corner] = rounded(at);
    if (!view.is_face) direction.push_back(direction_of(at));
  }
  view.all = fan_about(direction_of(view.is_face ? geometry.unit(site) : w), direction);
  return view;
}

namespace {

/// Of an edge: between the normals of its faces.
Fan wedge(const SiteGeometry& geometry, SiteId edge) {
  const auto& triangle = geometry.solid().edge[geometry.index().element(edge)].triangle;
  BallVector sum;
  std::vector<Direction> side;
  for (const auto t : triangle) {
    const BallVector& n = geometry.unit(geometry.index().face(t));
    for (int k = 0; k < 3; ++k) sum[k] = sum[k] + n[k];
    side.push_back(direction_of(n));
  }
  return fan_about(direction_of(sum), side);
}

}  // namespace

Governed governed(const SiteGeometry& geometry, const SiteView& view, const Box3& box) {
  Governed result{false, view.all, {}};
  if (view.is_face) return result;
  const std::vector<RoundedVector> part = domain_part(geometry, view.site, box);
  result.nowhere = part.empty();
  std::vector<Direction> direction;
  Direction axis{{}, 0};
  for (const RoundedVector& x : part) {
    RoundedVector w = rounded(to_carrier(geometry, view.site, x.mid));
    w.rad += x.rad;  // projecting makes no vector longer
    result.to_foot.push_back(w);
    direction.push_back(direction_of(w));
    const double length = std::hypot(w.mid.x, w.mid.y, w.mid.z);
    for (int k = 0; k < 3; ++k) axis.vector[k] += length > 0 ? w.mid[k] / length : 0;
  }
  const Fan about = fan_about(axis, direction);
  if (about.spread < result.fan.spread) result.fan = about;
  if (geometry.index().kind(view.site) != SiteKind::kEdge) return result;
  const Fan between = wedge(geometry, view.site);
  if (between.spread < result.fan.spread) result.fan = between;
  return result;
}

namespace {

/// Upper bounds of the angle over the points that are equally far from both carriers. `to_foot`:
/// from points whose hull holds them, none nearer than `nearest`, to the other site.
double by_normal(const Direction& normal, std::span<const RoundedVector> to_foot, double nearest) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  const Point3& n = normal.vector;  // a unit vector up to its error
  for (const RoundedVector& w : to_foot) {
    const double length = std::hypot(w.mid.x, w.mid.y, w.mid.z) + w.rad;
    const double inner = n.x * w.mid.x + n.y * w.mid.y + n.z * w.mid.z;
    least = std::min(least, inner - w.rad - length * (normal.error + 1e-14));
    most = std::max(most, angle_at_most(normal, direction_of(w)));
  }
  // Directions within at most 90 degrees of n are a convex cone.
  if (most <= 0.5 * kPi) return most;
  if (least >= 0) return 0.5 * kPi + kAngleSlack;
  const double cosine = least / nearest;
  return cosine > -1 ? std::acos(cosine) + kAngleSlack : kPi;
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
  double most = angle_at_most(a.all, b.all);
  if (a.is_face && b.is_face) return most;
  if (a.is_face != b.is_face) {
    const SiteView &face = a.is_face ? a : b, &other = a.is_face ? b : a;
    if (other.nearest > 0)
      most = std::min(most, by_normal(face.all.axis, other.to_foot, other.nearest));
  }
  if (std::max(a.nearest, b.nearest) > 0) most = std::min(most, by_chord(a, b));
  return most;
}

double angle_at_most(const SiteView& a, const Governed& part_of_a, const SiteView& b,
                     const Governed& part_of_b) {
  if (part_of_a.nowhere || part_of_b.nowhere) return 0;
  double most = std::min(angle_at_most(a, b), angle_at_most(part_of_a.fan, part_of_b.fan));
  if (a.is_face != b.is_face) {
    const SiteView &face = a.is_face ? a : b, &other = a.is_face ? b : a;
    const Governed& part = a.is_face ? part_of_b : part_of_a;
    if (other.nearest > 0)
      most = std::min(most, by_normal(face.all.axis, part.to_foot, other.nearest));
  }
  return most;
}

double angle_at_least(const SiteView& a, const SiteView& b) {
  if (a.all.spread >= kPi || b.all.spread >= kPi) return 0;
  return std::max(0.0, angle(a.all.axis.vector, b.all.axis.vector) - a.all.spread - b.all.spread -
                           3 * kAngleSlack);
}

bool may_tie(const SiteView& a, const SiteView& b, double radius) {
  // On the way from the centre to the tie the carriers are not equally far: no bounds for ties
  // here, nor of what is governed.
  const double slope = 2 * std::sin(0.5 * angle_at_most(a.all, b.all)) * (1 + 1e-14) + 1e-14;
  const Ball gap = a.distance - b.distance;
  return std::abs(gap.mid) - gap.rad <=
         std::min(slope * radius, (a.reach + b.reach) * (1 + 1e-15)) + 1e-300;
}

}  // namespace blum
