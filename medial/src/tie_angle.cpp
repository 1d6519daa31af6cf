// Let v and w be the vectors from x to its feet on the carriers of a and b. With x = c + y (c the
// centre of the box, |y_i| <= h_i) they are v - P y and w - Q y, where P and Q project across the
// carriers (v, w: at c from here on; P v = v, Q w = w). Where |v| = |w| = r, the cosine of the
// angle is v.w / r^2, so that for any number s
//
//   r^2 (cosine - s) = v.w - s (v.v + w.w) / 2   (at x).
//
// The right side is a quadratic polynomial in y, and so are the ties, v.v - w.w and v.v - z.z (z:
// to the third foot), which vanish: any multiples of them may be added. If t <= 0 is at most the
// least value of the sum over the box, then the cosine is at least s + t / r^2, and r is not less
// than the distances of the box from the carriers. Here s is the cosine at c; the multiples are
// among those where as many components of the slope vanish as there are ties, and one of these
// leaves the largest bound of the linear part.

#include "tie_angle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace blum {
namespace {

using BallMatrix = std::array<BallVector, 3>;

/// y -> value + slope.y + y' curve y
struct Form {
  Ball value;
  BallVector slope;
  BallMatrix curve;  // need not be symmetric
};

/// Multiples of two ties.
using Shares = std::array<double, 2>;

BallMatrix across(const SiteGeometry& geometry, SiteId site) {
  const SiteKind kind = geometry.index().kind(site);
  BallMatrix p;
  for (std::size_t i = 0; i < 3; ++i) {
    if (kind != SiteKind::kFace) p[i][i] = Ball(1);
    if (kind == SiteKind::kVertex) continue;
    const BallVector& u = geometry.unit(site);
    for (std::size_t j = 0; j < 3; ++j)
      p[i][j] = kind == SiteKind::kFace ? u[i] * u[j] : p[i][j] - u[i] * u[j];
  }
  return p;
}

/// (v - P y) . (w - Q y)
Form product(const BallVector& v, const BallMatrix& p, const BallVector& w, const BallMatrix& q) {
  Form f;
  f.value = dot(v, w);
  for (std::size_t i = 0; i < 3; ++i) {
    f.slope[i] = -(dot(p[i], w) + dot(q[i], v));
    for (std::size_t j = 0; j < 3; ++j)
      f.curve[i][j] = p[i][0] * q[0][j] + p[i][1] * q[1][j] + p[i][2] * q[2][j];
  }
  return f;
}

/// |v - P y|^2
Form square(const BallVector& v, const BallMatrix& p) {
  Form f{dot(v, v), {}, p};
  for (std::size_t i = 0; i < 3; ++i) f.slope[i] = Ball(-2) * v[i];
  return f;
}

void add(Form& f, double share, const Form& g) {
  const Ball m(share);
  f.value = f.value + m * g.value;
  for (std::size_t i = 0; i < 3; ++i) {
    f.slope[i] = f.slope[i] + m * g.slope[i];
    for (std::size_t j = 0; j < 3; ++j) f.curve[i][j] = f.curve[i][j] + m * g.curve[i][j];
  }
}

using HalfWidths = std::array<double, 3>;

/// At most the least value over the box.
double least_of(const Form& f, const HalfWidths& h) {
  double spread = 0;  // sums and products of fewer than twenty numbers, none negative
  for (std::size_t i = 0; i < 3; ++i) {
    spread += f.slope[i].magnitude() * h[i] + std::max(0.0, -f.curve[i][i].low()) * h[i] * h[i];
    for (std::size_t j = 0; j < i; ++j)
      spread += (f.curve[i][j] + f.curve[j][i]).magnitude() * h[i] * h[j];
  }
  return f.value.low() - spread * (1 + 1e-14) - 1e-300;
}

/// The best multiples for the linear part of f, about.
Shares best_shares(const Form& f, const std::array<Form, 2>& tie, bool third, const HalfWidths& h) {
  Shares best{};
  double most = -std::numeric_limits<double>::infinity();
  const auto offer = [&](const Shares& m) {
    double least = f.value.mid + m[0] * tie[0].value.mid + m[1] * tie[1].value.mid;
    for (std::size_t k = 0; k < 3; ++k)
      least -=
          h[k] * std::abs(f.slope[k].mid + m[0] * tie[0].slope[k].mid + m[1] * tie[1].slope[k].mid);
    if (!(least > most)) return;  // nor where it is not finite
    most = least;
    best = m;
  };
  offer({0, 0});
  for (std::size_t i = 0; i < 3; ++i) {
    const double g = -f.slope[i].mid, d = tie[0].slope[i].mid, e = tie[1].slope[i].mid;
    offer({g / d, 0});
    if (!third) continue;
    offer({0, g / e});
    for (std::size_t j = 0; j < i; ++j) {
      const double k = -f.slope[j].mid, p = tie[0].slope[j].mid, q = tie[1].slope[j].mid;
      const double det = d * q - e * p;
      offer({(g * q - e * k) / det, (d * k - g * p) / det});
    }
  }
  return best;
}

}  // namespace

double angle_on_tie_at_most(const SiteGeometry& geometry, const SiteView& a, const SiteView& b,
                            const SiteView* third, const Box3& box) {
  double nearest = std::max(a.nearest, b.nearest);
  if (third) nearest = std::max(nearest, third->nearest);
  if (!(nearest > 0)) return kPi;
  const BallMatrix p = across(geometry, a.site), q = across(geometry, b.site);
  const Form vv = square(a.at_center, p), ww = square(b.at_center, q);
  Form form = product(a.at_center, p, b.at_center, q);
  const double s = std::clamp(form.value.mid / std::sqrt(vv.value.mid * ww.value.mid), -1.0, 1.0);
  if (!std::isfinite(s)) return kPi;
  add(form, -0.5 * s, vv);
  add(form, -0.5 * s, ww);
  std::array<Form, 2> tie{vv, vv};
  add(tie[0], -1, ww);
  if (third) add(tie[1], -1, square(third->at_center, across(geometry, third->site)));
  const Point3 c = center_of(box);
  HalfWidths h;
  for (int k = 0; k < 3; ++k) h[k] = std::max(box.hi[k] - c[k], c[k] - box.lo[k]) * (1 + 1e-15);
  const Shares m = best_shares(form, tie, third != nullptr, h);
  add(form, m[0], tie[0]);
  if (third) add(form, m[1], tie[1]);
  const double least = std::min(0.0, least_of(form, h));
  // Rounded by less than 5 ulp of 2.
  const double cosine = s + least / (nearest * nearest) * (1 + 1e-15) - 4e-15;
  return cosine > -1 ? std::acos(cosine) + kAngleSlack : kPi;
}

}  // namespace blum
