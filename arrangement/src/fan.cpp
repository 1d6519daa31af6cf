#include "fan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace blum {
namespace {

constexpr double kUp = 1 + 0x1p-40, kDown = 1 - 0x1p-40;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

BallVector negative(const BallVector& w) { return {-w[0], -w[1], -w[2]}; }

BallVector combined(const Ball& p, const BallVector& a, const Ball& q, const BallVector& b) {
  return {p * a[0] + q * b[0], p * a[1] + q * b[1], p * a[2] + q * b[2]};
}

double apart_upper(const BallVector& a, const BallVector& b) {
  const BallVector d = combined(Ball(1.0), a, Ball(-1.0), b);
  return std::sqrt(dot(d, d).high()) * kUp;
}

void set_stretch(Fan& f) {
  const BallVector sum = combined(Ball(1.0), f.end[0], Ball(1.0), f.end[1]);
  const double square = dot(sum, sum).low();
  f.stretch = square > 0 ? 2 / std::sqrt(square) * kUp : kInfinite;
}

Fan fan_of(const SiteGeometry& geometry, SiteId site) {
  const SiteIndex& index = geometry.index();
  Fan f;
  switch (index.kind(site)) {
    case SiteKind::kVertex:
      break;
    case SiteKind::kFace:
      f.count = 1;
      f.end[0] = negative(geometry.unit(site));
      f.face[0] = site;
      break;
    case SiteKind::kEdge: {
      f.count = 2;
      const auto& beside = geometry.solid().edge[index.element(site)].triangle;
      for (std::size_t k = 0; k < 2; ++k) {
        f.face[k] = index.face(beside[k]);
        f.end[k] = negative(geometry.unit(*f.face[k]));
      }
      set_stretch(f);
      break;
    }
  }
  return f;
}

/// Lower bound of |grad d_face - grad d_edge| where they tie: its square is twice the depth of the
/// foot on the edge in front of the plane of the face, divided by the distance.
double apart_at_ties(EngineContext& context, const LocalForm& face, const LocalForm& edge,
                     const Range& range) {
  const SiteGeometry& geometry = context.geometry;
  const Solid& solid = geometry.solid();
  const BallVector &n = geometry.unit(face.site), &u = geometry.unit(edge.site);
  const double farthest = (Ball(0.0, spread(n, range)) - face.height).high();
  if (!(farthest > 0)) return 0;
  const auto [p, q] = solid.edge[geometry.index().element(edge.site)].vertex;
  const Ball at_p = -context.height(p, face.site), at_q = -context.height(q, face.site);
  const BallVector along = difference(solid.point[q], solid.point[p]);
  const Ball whole = root(dot(along, along));
  // Depth is linear along the edge; feet of the range lie in a part of it.
  const Ball foot =
      dot(u, difference(range.center, solid.point[p])) + Ball(0.0, spread(u, range));
  const auto depth = [&](double t) { return at_p + (at_q - at_p) * divide(Ball(t), whole); };
  const double least = std::min(depth(std::max(0.0, foot.low())).low(),
                                depth(std::min(whole.high(), foot.high())).low());
  return least > 0 ? std::sqrt(2 * least / farthest * kDown) * kDown : 0;
}

/// Takes from an edge's fan what is nearer than `apart` to the direction of a face. False: all.
bool trim(Fan& fan, const BallVector& face, double apart) {
  const std::array<double, 2> near{apart_upper(fan.end[0], face), apart_upper(fan.end[1], face)};
  const bool first = near[0] < apart, second = near[1] < apart;
  if (first && second) return !(apart < 1);  // a cap of the sphere is convex
  if (!first && !second) return true;
  BallVector& trimmed = fan.end[first ? 0 : 1];
  const BallVector& other = fan.end[first ? 1 : 0];
  const double step = (apart - near[first ? 0 : 1]) * kDown;
  if (!(step > 0 && step < 1)) return true;
  // The arc's point at that distance from the end.
  const Ball cosine = dot(trimmed, other);
  const BallVector tangent = combined(Ball(1.0), other, -cosine, trimmed);
  const Ball square = dot(tangent, tangent);
  if (!(square.low() > 0)) return true;
  const Ball c(step), half_square = c * c * Ball(0.5), cos_angle = Ball(1.0) - half_square;
  if ((cosine - cos_angle).sign() != -1) return (cosine - cos_angle).sign() != 1;
  const Ball sin_angle = c * root(Ball(1.0) - half_square * Ball(0.5));
  trimmed = combined(cos_angle, trimmed, divide(sin_angle, root(square)), tangent);
  fan.face[first ? 0 : 1].reset();
  set_stretch(fan);
  return true;
}

}  // namespace

bool Fan::least_at_end(const BallVector& w) const {
  if (count == 1) return true;
  const Ball first = dot(end[0], w), second = dot(end[1], w);
  if (std::min(first.low(), second.low()) >= 0) return true;
  // Along an arc of less than pi, a product that rises from one end is least at an end.
  const Ball cosine = dot(end[0], end[1]);
  return (second - cosine * first).low() >= 0 || (first - cosine * second).low() >= 0;
}

double Fan::low(const BallVector& w) const {
  double least = dot(end[0], w).low();
  if (count == 2) least = std::min(least, dot(end[1], w).low());
  return least_at_end(w) ? least : least * stretch * kUp;
}

double Fan::high(const BallVector& w) const { return -low(negative(w)); }

FanPair fans_at_ties(EngineContext& context, const LocalForm& a, const LocalForm& b,
                     const Range& range) {
  FanPair r{fan_of(context.geometry, a.site), fan_of(context.geometry, b.site)};
  if (a.kind == SiteKind::kFace && b.kind == SiteKind::kEdge)
    r.tie = trim(r.b, r.a.end[0], apart_at_ties(context, a, b, range));
  if (b.kind == SiteKind::kFace && a.kind == SiteKind::kEdge)
    r.tie = trim(r.a, r.b.end[0], apart_at_ties(context, b, a, range));
  return r;
}

bool gains_by_fans(EngineContext& context, const FanPair& fans, const BallVector& w) {
  const auto& [a, b, tie] = fans;
  if (a.count == 0 || b.count == 0) return false;
  if (a.high(w) < b.low(w)) return true;
  // End by end, with precise differences of normals. Equal gradients mean equal feet.
  if (!b.least_at_end(w) || !a.least_at_end(negative(w))) return false;
  for (int i = 0; i < a.count; ++i)
    for (int j = 0; j < b.count; ++j) {
      const BallVector d = a.face[i] && b.face[j]
                               ? context.unit_difference(*a.face[i], *b.face[j])
                               : combined(Ball(1.0), b.end[j], Ball(-1.0), a.end[i]);
      const int sign = dot(d, w).sign();
      if (sign != 1 && sign != 0) return false;
    }
  return true;
}

}  // namespace blum
