// Where a half-space h(x) <= 0 cuts the hull of points p_i, the cut is the hull of the points with
// h <= 0 and of the crossings on the segments from these to the others. Crossings are taken a
// little too far: at t = a / (a + b), with upper bound a of -h(p_i) and lower bound b of h(p_j), so
// that the true crossing is between p_i and the point.
//
// Rounding. The crossing is three operations on coordinates of at most m in magnitude: it errs by
// less than 8 ulp of m in each, 16 in length, beside the radii of its ends.

#include "domain_part.hpp"

#include <algorithm>
#include <cmath>

namespace blum {
namespace {

constexpr std::size_t kMostPoints = 40;

struct Valued {
  RoundedVector point;
  Ball value;
};

Ball value_of(const HalfSpace& h, const Point3& base, const RoundedVector& x) {
  const Ball at = dot(h.w, difference(x.mid, base));
  return {at.mid, at.rad + x.rad * (1 + 1e-14)};
}

RoundedVector crossing(const Valued& in, const Valued& out) {
  const double a = std::max(0.0, -in.value.low()), b = out.value.low();
  const double t = std::min(1.0, a / (a + b) * (1 + 1e-15));
  RoundedVector x;
  double most = 0;
  for (int k = 0; k < 3; ++k) {
    const double p = in.point.mid[k], q = out.point.mid[k];
    x.mid[k] = p + t * (q - p);
    most = std::max({most, std::abs(p), std::abs(q)});
  }
  x.rad = std::max(in.point.rad, out.point.rad) + 16 * Ball::kUnit * most;
  return x;
}

/// Do the corners of a box lie on a common edge of it?
bool on_an_edge(const Point3& p, const Point3& q) {
  int different = 0;
  for (int k = 0; k < 3; ++k) different += p[k] != q[k] ? 1 : 0;
  return different == 1;
}

}  // namespace

std::vector<RoundedVector> domain_part(const SiteGeometry& geometry, SiteId site, const Box3& box) {
  std::vector<RoundedVector> points;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Point3 x;
    bool other = true;  // than the corners before, where the box is flat
    for (int k = 0; k < 3; ++k) {
      const bool high = (corner & (4u >> k)) != 0;
      x[k] = high ? box.hi[k] : box.lo[k];
      other = other && (!high || box.lo[k] < box.hi[k]);
    }
    if (other) points.push_back({x, 0});
  }
  bool corners = true;
  for (const HalfSpace& h : geometry.domain(site)) {
    std::vector<Valued> in, out;
    for (const RoundedVector& x : points) {
      const Valued v{x, value_of(h, geometry.solid().point[h.base], x)};
      (v.value.low() > 0 ? out : in).push_back(v);
    }
    if (in.empty()) return {};
    if (out.empty()) continue;
    std::vector<RoundedVector> kept;
    for (const Valued& p : in) kept.push_back(p.point);
    for (const Valued& p : in)
      for (const Valued& q : out)
        if (!corners || on_an_edge(p.point.mid, q.point.mid)) kept.push_back(crossing(p, q));
    if (kept.size() > kMostPoints) continue;
    points = std::move(kept);
    corners = false;
  }
  return points;
}

}  // namespace blum
