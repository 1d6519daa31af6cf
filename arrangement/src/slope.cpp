#include "slope.hpp"

#include <algorithm>
#include <cmath>

#include "groups.hpp"

namespace blum {
namespace {

/// Upper bound of slope . w over the range.
double slope_upper(const PairSlope& slope, const Range& range, const BallVector& w) {
  const Ball s = dot(slope.gradient, w);
  double bound = s.high();
  if (!slope.constant) {
    for (int i = 0; i < 3; ++i) {
      if (range.half[i] == 0) continue;
      Ball row(0.0);
      for (int j = 0; j < 3; ++j) {
        if (w[j].mid == 0 && w[j].rad == 0) continue;
        row = row + entry(slope.matrix, i, j) * w[j];
      }
      bound += 2 * row.magnitude() * range.half[i] * Ball::kInflate;
    }
    bound += std::abs(bound) * 0x1p-48 + 0x1p-1000;
    // The sum of up to four terms may cancel: charge the rounding of each partial sum.
    bound += 0x1p-50 * std::abs(s.high());
  }
  return bound;
}

}  // namespace

BallVector slope_of_heights(EngineContext& context, const LocalForm& a, const LocalForm& b) {
  return a.side != b.side ? signed_difference(context.geometry.unit(a.site), a.side,
                                              context.geometry.unit(b.site), b.side)
         : a.side < 0     ? context.unit_difference(b.site, a.site)
                          : context.unit_difference(a.site, b.site);
}

PairSlope pair_slope(EngineContext& context, const LocalForm& a, const LocalForm& b,
                     const Range& range) {
  PairSlope r;
  if (context.voronoi()) {
    const Touch& t = context.touch(a.site, b.site);
    // Of a wedge as sharp as that, the difference of the normals tells more.
    constexpr double kSharp = 1e-6;
    if (t.kind == Touch::Kind::kPlane ||
        (t.kind == Touch::Kind::kBisector && dot(t.w, t.w).low() > kSharp)) {
      r.gradient = t.w;
      r.constant = true;
      return r;
    }
  }
  if (a.side != 0 && b.side != 0) {
    // The distances are the heights times their signs, so grad(d_a - d_b) is constant.
    r.gradient = slope_of_heights(context, a, b);
    r.constant = true;
    return r;
  }
  // At a tie grad(d_a - d_b) and grad(d_a^2 - d_b^2) differ by the positive factor 2d.
  const PairForm form = pair_form(context, a, b, range);
  r.gradient = form.gradient;
  r.matrix = form.a;
  if (!context.voronoi() && !context.plain) r.fans = fans_at_ties(context, a, b, range);
  return r;
}

Direction Direction::reversed() const {
  Direction r{{-w[0], -w[1], -w[2]}, line};
  if (r.line) std::swap(r.line->from, r.line->to);
  return r;
}

Direction left_normal(const Solid& solid, int axis, std::uint32_t from, std::uint32_t to) {
  const int u = u_axis(axis), v = v_axis(axis);
  const BallVector d = difference(solid.point[to], solid.point[from]);
  Direction r;
  r.w[u] = -d[v];
  r.w[v] = d[u];
  r.line = Direction::Line{axis, from, to};
  return r;
}

bool gains(const PairSlope& slope, const Range& range, const BallVector& w) {
  return slope_upper(slope, range, w) < 0 || (!slope.constant && gains_by_fans(slope.fans, w));
}

bool edge_is_between(const SiteGeometry& geometry, const LocalForm& a, const LocalForm& b) {
  if (a.kind != SiteKind::kFace || b.kind != SiteKind::kFace || a.side == 0 || a.side != b.side)
    return false;
  const Solid& solid = geometry.solid();
  const auto e =
      solid.common_edge(geometry.index().element(a.site), geometry.index().element(b.site));
  return e && solid.edge[*e].kind == (a.side > 0 ? EdgeKind::kConvex : EdgeKind::kReflex);
}

namespace {

/// Have two edges with a common end no feet from the same point of the range? The product of a
/// point with either direction from there would not be negative, nor that with their sum: which is
/// small for edges nearly in line.
bool feet_exclude_each_other(const SiteGeometry& geometry, const LocalForm& a, const LocalForm& b,
                             const Range& range) {
  if (a.kind != SiteKind::kEdge || b.kind != SiteKind::kEdge) return false;
  const CommonCorners common = common_corners(geometry, a.site, b.site);
  if (common.count != 1) return false;
  const auto v = common.vertex[0];
  const BallVector e = away_from(geometry, geometry.index().element(a.site), v),
                   f = away_from(geometry, geometry.index().element(b.site), v),
                   sum = {e[0] + f[0], e[1] + f[1], e[2] + f[2]};
  return dot(sum, difference(range.center, geometry.solid().point[v])).high() < -spread(sum, range);
}

}  // namespace

bool may_tie(EngineContext& context, const LocalForm& a, const LocalForm& b, const Range& range) {
  if (context.voronoi()) {
    const Touch& t = context.touch(a.site, b.site);
    if (t.kind == Touch::Kind::kNever || feet_exclude_each_other(context.geometry, a, b, range))
      return false;
    if (t.kind != Touch::Kind::kOrdinary) {
      const Ball h = dot(t.w, difference(range.center, context.geometry.solid().point[t.base]));
      const double s = spread(t.w, range);
      if (!(h.low() <= s && h.high() >= -s)) return false;
      if (t.kind == Touch::Kind::kPlane) return true;
      if (edge_is_between(context.geometry, a, b)) return false;
    }
  }
  // Distances of faces that both govern are their heights times the same sign.
  if (a.side != 0 && a.side == b.side && heights_compared(context, a.site, b.site, range) != 0)
    return false;
  return !certainly_farther(context.geometry, a, b, range, &context) &&
         !certainly_farther(context.geometry, b, a, range, &context);
}

bool may_both_govern(EngineContext& context, const LocalForm& a, const LocalForm& b,
                     const Range& range) {
  return !context.never_essential(a.site, b.site) && may_tie(context, a, b, range) &&
         (context.voronoi() || context.plain || fans_at_ties(context, a, b, range).tie);
}

/// Of what parts two sites, so much is asked for that a checker that rounds otherwise agrees.
constexpr double kSteep = 0x1p10, kPartedBy = 0x1p-40;

bool parted_by(const SiteGeometry& geometry, const LocalForm& a, const LocalForm& c,
               const LocalForm& b, const Range& range) {
  if (a.side == 0 || c.side == 0 || !b.covers_side || b.kind != SiteKind::kFace) return false;
  // Where both govern, their distance is t d_a + (1 - t) d_c for any number t: the best one leaves
  // the least slope.
  const BallVector ac = signed_difference(geometry.unit(a.site), a.side, geometry.unit(c.site),
                                          c.side),
                   bc = signed_difference(geometry.unit(b.site), b.side, geometry.unit(c.site),
                                          c.side);
  double up = 0, down = 0;
  for (int k = 0; k < 3; ++k) {
    const double weight = range.half[k] * range.half[k];
    up += weight * ac[k].mid * bc[k].mid;
    down += weight * ac[k].mid * ac[k].mid;
  }
  if (!(down > 0)) return false;
  const Ball t(up / down);
  if (!(std::abs(t.mid) < kSteep)) return false;
  BallVector w;
  for (int k = 0; k < 3; ++k) w[k] = bc[k] - t * ac[k];
  const Ball hc = with_sign(c.height, c.side),
             h = with_sign(b.height, b.side) - hc - t * (with_sign(a.height, a.side) - hc);
  return h.high() + spread(w, range) < -kPartedBy;
}

int side(EngineContext& context, const Direction& direction, std::uint32_t v, std::uint32_t p) {
  if (v == p) return 0;
  const Solid& solid = context.geometry.solid();
  if (direction.line && (v == direction.line->from || v == direction.line->to))
    return context.predicates.side_of_line(direction.line->axis, direction.line->from,
                                           direction.line->to, p);
  return dot(direction.w, difference(solid.point[p], solid.point[v])).sign();
}

namespace {

/// Is (y - z) . w > 0 for all points y of a and z of b that are feet of points of the range? By the
/// corners alone. Requires: they share no foot there.
bool lies_ahead(EngineContext& context, SiteId a, SiteId b, const Direction& direction,
                std::span<const LocalForm> forms, const Range& range) {
  const SiteGeometry& geometry = context.geometry;
  int na = 0, nb = 0;
  const auto ca = geometry.corners(a, na), cb = geometry.corners(b, nb);
  const CommonCorners common = common_corners(geometry, a, b);
  if (common.count == 0) {
    for (int i = 0; i < na; ++i)
      for (int j = 0; j < nb; ++j)
        if (side(context, direction, cb[j], ca[i]) != 1) return false;
    return true;
  }
  // A plane through a common corner v, which is no foot, parts them: one lies on its side and may
  // touch it, the other strictly. A site is strictly on a side too if it meets the plane in v and
  // in a boundary edge from there that holds no foot.
  const auto v = common.vertex[0];
  const auto parted = [&](std::span<const std::uint32_t> corner, int sign, bool strictly) {
    int on_plane = 0;
    for (const auto p : corner) {
      if (p == v) continue;
      const int s = side(context, direction, v, p);
      if (s == sign || (s == 0 && !strictly)) continue;
      if (s != 0 || ++on_plane > 1 || may_be_foot(context, p, forms, range) ||
          may_hold_foot(context, v, p, forms))
        return false;
    }
    return true;
  };
  const std::span<const std::uint32_t> a_corner(ca.data(), static_cast<std::size_t>(na)),
      b_corner(cb.data(), static_cast<std::size_t>(nb));
  return (parted(a_corner, 1, true) && parted(b_corner, -1, false)) ||
         (parted(a_corner, 1, false) && parted(b_corner, -1, true));
}

}  // namespace

bool gains_by_feet(EngineContext& context, const PairSlope& slope, SiteId a, SiteId b,
                   const Direction& direction, std::span<const LocalForm> forms,
                   const Range& range) {
  return lies_ahead(context, a, b, direction, forms, range) ||
         (!slope.constant && gains_by_fan_ends(context, slope.fans, direction.w));
}

std::optional<std::vector<int>> sides_of(EngineContext& context, std::span<const LocalForm> forms,
                                         std::uint32_t v, const Direction& direction,
                                         const Range& range) {
  const SiteGeometry& geometry = context.geometry;
  std::vector<int> of(forms.size(), 0);
  for (std::size_t i = 0; i < forms.size(); ++i) {
    int n = 0, on_plane = 0;
    const auto corner = geometry.corners(forms[i].site, n);
    const bool at_v = geometry.has_corner(forms[i].site, v);
    for (int k = 0; k < n; ++k) {
      const auto p = corner[k];
      if (p == v) continue;
      const int s = side(context, direction, v, p);
      if (s == 2 || s * of[i] < 0) return std::nullopt;
      if (s != 0) {
        of[i] = s;
      } else if (++on_plane > 1 || may_be_foot(context, p, forms, range) ||
                 (at_v && may_hold_foot(context, v, p, forms))) {
        return std::nullopt;
      }
    }
  }
  for (std::size_t i = 0; i < forms.size(); ++i)
    for (std::size_t j = i + 1; j < forms.size(); ++j)
      if (of[i] * of[j] >= 0 && !context.never_essential(forms[i].site, forms[j].site))
        return std::nullopt;
  return of;
}

}  // namespace blum
