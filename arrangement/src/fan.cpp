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
  return length_above(d);
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

/// What is known of the ties of a face and an edge from the depth of the edge in front of the plane
/// of the face: (distance between feet)^2 is twice the depth times the distance.
struct Depth {
  double apart = 0;     ///< lower bound of |grad d_face - grad d_edge|
  double feet = 0;      ///< lower bound of the distance between the feet
  double farthest = 0;  ///< upper bound of the distance
  bool behind = false;  ///< no foot on the edge lies in front: they do not tie
};

/// Depths in front of the plane of a face at both ends of the part of an edge that holds all its
/// feet of points of the range. Between them the depth is linear.
std::array<Ball, 2> depths_along(EngineContext& context, SiteId face, SiteId edge,
                                 const Range& range) {
  const SiteGeometry& geometry = context.geometry;
  const Solid& solid = geometry.solid();
  const BallVector& u = geometry.unit(edge);
  const auto [p, q] = solid.edge[geometry.index().element(edge)].vertex;
  const Ball at_p = -context.height(p, face), at_q = -context.height(q, face);
  const BallVector along = difference(solid.point[q], solid.point[p]);
  const Ball whole = root(dot(along, along));
  const Ball foot = dot(u, difference(range.center, solid.point[p])) + Ball(0.0, spread(u, range));
  const auto depth = [&](double t) { return at_p + (at_q - at_p) * divide(Ball(t), whole); };
  return {depth(std::max(0.0, foot.low())), depth(std::min(whole.high(), foot.high()))};
}

Depth depth_at_ties(EngineContext& context, const LocalForm& face, const LocalForm& edge,
                    const Range& range) {
  const BallVector& n = context.geometry.unit(face.site);
  const Ball distance = Ball(0.0, spread(n, range)) - face.height;
  Depth r;
  r.farthest = distance.high();
  if (!(r.farthest > 0)) return r;
  const auto [first, last] = depths_along(context, face.site, edge.site, range);
  r.behind = first.high() < 0 && last.high() < 0;
  const double least = std::min(first.low(), last.low());
  if (!(least > 0)) return r;
  r.apart = std::sqrt(2 * least / r.farthest * kDown) * kDown;
  r.feet = std::sqrt(2 * least * std::max(0.0, distance.low()) * kDown) * kDown;
  return r;
}

/// Replaces an end by the arc's point at a distance of `step` from it. False: there is none.
bool shorten(Fan& fan, std::size_t k, double step) {
  const BallVector& other = fan.end[1 - k];
  const Ball cosine = dot(fan.end[k], other);
  const BallVector tangent = combined(Ball(1.0), other, -cosine, fan.end[k]);
  const Ball square = dot(tangent, tangent);
  if (!(step > 0 && step < 1 && square.low() > 0)) return true;
  const Ball c(step), half_square = c * c * Ball(0.5), cos_angle = Ball(1.0) - half_square;
  const int sign = (cosine - cos_angle).sign();
  if (sign != -1) return sign != 1;
  const Ball sin_angle = c * root(Ball(1.0) - half_square * Ball(0.5));
  fan.end[k] = combined(cos_angle, fan.end[k], divide(sin_angle, root(square)), tangent);
  fan.face[k].reset();
  set_stretch(fan);
  return true;
}

/// The point of the arc next to a direction, if that is not an end.
std::optional<BallVector> middle_of(const Fan& fan, const BallVector& direction) {
  const BallVector normal = cross(fan.end[0], fan.end[1]);
  const Ball square = dot(normal, normal);
  if (!(square.low() > 0)) return std::nullopt;
  BallVector m = combined(Ball(1.0), direction, -divide(dot(direction, normal), square), normal);
  const Ball norm = dot(m, m);
  if (!(norm.low() > 0)) return std::nullopt;
  for (Ball& c : m) c = divide(c, root(norm));
  if (!(dot(cross(fan.end[0], m), normal).low() > 0 && dot(cross(m, fan.end[1]), normal).low() > 0))
    return std::nullopt;
  return m;
}

/// Does the closed face lie ahead of the edge along w, but for less than `reach`?
bool reaches_ahead(const SiteGeometry& geometry, SiteId face, SiteId edge, const BallVector& w,
                   double reach) {
  int nf = 0, ne = 0;
  const auto f = geometry.corners(face, nf), e = geometry.corners(edge, ne);
  const Solid& solid = geometry.solid();
  for (int i = 0; i < nf; ++i)
    for (int j = 0; j < ne; ++j)
      if (!(dot(w, difference(solid.point[f[i]], solid.point[e[j]])).low() > -reach)) return false;
  return true;
}

/// Takes from an edge's fan what is too near to the direction of a face. False: that is all.
bool trim(EngineContext& context, Fan& fan, const Fan& of_face, const LocalForm& face,
          const LocalForm& edge, const Range& range) {
  const Depth depth = depth_at_ties(context, face, edge, range);
  if (depth.behind) return false;
  if (!(depth.apart > 0)) return true;
  const BallVector& direction = of_face.end[0];
  const std::array<double, 2> near{apart_upper(fan.end[0], direction),
                                   apart_upper(fan.end[1], direction)};
  const bool first = near[0] < depth.apart, second = near[1] < depth.apart;
  if (first && second) return !(depth.apart < 1);  // a cap of the sphere is convex
  if (first || second) {
    const std::size_t k = first ? 0 : 1;
    return shorten(fan, k, (depth.apart - near[k]) * kDown);
  }
  // The middle falls out: what is left on one side would need feet behind the edge.
  const auto middle = middle_of(fan, direction);
  if (!middle) return true;
  const double off = apart_upper(*middle, direction);
  for (std::size_t k = 0; k < 2; ++k) {
    // From the middle away from end k; ties on that side have the foot on the face behind by the
    // sine of an angle, which is the chord times the cosine of half the angle.
    const Ball twice = Ball(1.0) + dot(fan.end[k], *middle);
    if (!(twice.low() > 0)) continue;
    const double share = std::sqrt(0.5 * twice.low()) * kDown;
    const BallVector w =
        combined(Ball(1.0), fan.end[1 - k], -dot(fan.end[1 - k], *middle), *middle);
    // Nothing is known of w if the face is almost orthogonal to the arc: then norm may reach zero.
    const Ball norm = root(dot(w, w));
    const double least = share * depth.feet * kDown - (1 + share) * off * depth.farthest * kUp;
    if (!(least > 0 && norm.low() > 0)) continue;
    const double reach = least * norm.low() * kDown;
    if (!(reach > 0) || !reaches_ahead(context.geometry, face.site, edge.site, w, reach)) continue;
    fan.end[k] = *middle;
    fan.face[k].reset();
    set_stretch(fan);
    return shorten(fan, k, (depth.apart - off) * kDown);
  }
  return true;
}

/// end[i] of a less end[j] of b, the fans of two edges.
BallVector end_difference(EngineContext& context, const Fan& a, std::size_t i, const Fan& b,
                          std::size_t j) {
  return context.unit_difference(*b.face[j], *a.face[i]);  // the ends are inner normals
}

/// Does a plane part the cones of the fans of two edges? False: undecided.
bool cones_apart(EngineContext& context, const Fan& a, const Fan& b) {
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      const BallVector w = end_difference(context, a, i, b, j);
      if (dot(a.end[0], w).low() > 0 && dot(a.end[1], w).low() > 0 && dot(b.end[0], w).high() < 0 &&
          dot(b.end[1], w).high() < 0)
        return true;
    }
  return false;
}

/// Lower bound of 1 - the product of any two vectors of the fans of two edges; 0: nothing known.
/// See "Two arcs" in docs/proofs.md.
double arcs_apart(EngineContext& context, const Fan& a, const Fan& b) {
  if (!cones_apart(context, a, b)) return 0;
  double least = 2;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      const BallVector d = end_difference(context, a, i, b, j);
      least = std::min(least, 0.5 * dot(d, d).low() * kDown);
    }
  const auto inside = [&](const Fan& one, const Fan& other) {
    for (const BallVector& end : one.end)
      if (!other.least_at_end(negative(end)))
        least = std::min(least, (1 - other.high(end)) * kDown - 0x1p-50);
  };
  inside(a, b);
  inside(b, a);
  return std::max(0.0, least);
}

/// Lower bound of 1 - grad d_a . grad d_b where two edges tie: the gradients are as far apart as
/// the feet are, over the distance. By the depths of either edge in front of both planes at the
/// other, which lies in them.
double feet_apart(EngineContext& context, SiteId a, SiteId b, const Range& range) {
  const SiteGeometry& geometry = context.geometry;
  double between = 0, farthest = kInfinite;
  for (const auto& [edge, other] : {std::pair{a, b}, std::pair{b, a}}) {
    const BallVector from = difference(range.center, geometry.base(edge));
    farthest =
        std::min(farthest, (length_above(cross(geometry.unit(edge), from)) + range.radius()) * kUp);
    for (const auto t : geometry.solid().edge[geometry.index().element(other)].triangle) {
      const auto [first, last] = depths_along(context, geometry.index().face(t), edge, range);
      between = std::max(
          {between, std::min(first.low(), last.low()), std::min(-first.high(), -last.high())});
    }
  }
  const double ratio = between / farthest * kDown;
  return 0.5 * ratio * ratio * kDown;
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
    r.tie = trim(context, r.b, r.a, a, b, range);
  if (b.kind == SiteKind::kFace && a.kind == SiteKind::kEdge)
    r.tie = trim(context, r.a, r.b, b, a, range);
  return r;
}

double fans_apart(EngineContext& context, const LocalForm& a, const LocalForm& b,
                  const Range& range) {
  const Fan fa = fan_of(context.geometry, a.site), fb = fan_of(context.geometry, b.site);
  if (fa.count == 0 || fb.count == 0) return 0;
  if (fa.count == 1 && fb.count == 1) {
    const BallVector& d = context.unit_difference(a.site, b.site);
    return std::max(0.0, 0.5 * dot(d, d).low() * kDown);
  }
  if (fa.count == 2 && fb.count == 2)
    return std::max(arcs_apart(context, fa, fb), feet_apart(context, a.site, b.site, range));
  const double cosine = fa.count == 2 ? fa.high(fb.end[0]) : fb.high(fa.end[0]);
  double apart = 0;
  if (fa.count == 1) apart = depth_at_ties(context, a, b, range).apart;
  if (fb.count == 1) apart = depth_at_ties(context, b, a, range).apart;
  return std::max({0.0, (1 - cosine) * kDown - 0x1p-50, 0.5 * apart * apart * kDown});
}

bool gains_by_fans(const FanPair& fans, const BallVector& w) {
  return fans.a.count > 0 && fans.b.count > 0 && fans.a.high(w) < fans.b.low(w);
}

bool gains_by_fan_ends(EngineContext& context, const FanPair& fans, const BallVector& w) {
  const auto& [a, b, tie] = fans;
  if (a.count == 0 || b.count == 0 || !b.least_at_end(w) || !a.least_at_end(negative(w)))
    return false;
  const auto zero = [](const Ball& x) { return x.sign() == 0; };
  for (std::size_t i = 0; i < static_cast<std::size_t>(a.count); ++i)
    for (std::size_t j = 0; j < static_cast<std::size_t>(b.count); ++j) {
      const BallVector d = a.face[i] && b.face[j]
                               ? context.unit_difference(*a.face[i], *b.face[j])
                               : combined(Ball(1.0), b.end[j], Ball(-1.0), a.end[i]);
      if (dot(d, w).sign() != 1 && !std::all_of(d.begin(), d.end(), zero)) return false;
    }
  return true;
}

}  // namespace blum
