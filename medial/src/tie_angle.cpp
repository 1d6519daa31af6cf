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
//
// Near 180 degrees the cosine says little. But r cos(angle / 2) is half of |v + w|, which is not
// less than e.(v + w) for any unit vector e: a linear function, to be treated in the same way. Here
// e is the direction of v + w where the ties would be if they were linear.
//
// In the same way the conditions of a domain, which are linear, may fail wherever the ties hold.

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

constexpr double kBlunt = -0.5;  // the cosine below which |v + w| is looked at, too

/// Multiples of two ties.
using Shares = std::array<double, 2>;

/// The vector to the foot from c + y is foot - across y.
struct Carrier {
  BallVector foot;
  BallMatrix across;
};

Carrier carrier(const SiteGeometry& geometry, const SiteView& view) {
  const SiteKind kind = geometry.index().kind(view.site);
  Carrier c{view.at_center, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    if (kind != SiteKind::kFace) c.across[i][i] = Ball(1);
    if (kind == SiteKind::kVertex) continue;
    const BallVector& u = geometry.unit(view.site);
    for (std::size_t j = 0; j < 3; ++j)
      c.across[i][j] = kind == SiteKind::kFace ? u[i] * u[j] : c.across[i][j] - u[i] * u[j];
  }
  return c;
}

/// v.w
Form product(const Carrier& a, const Carrier& b) {
  Form f;
  f.value = dot(a.foot, b.foot);
  for (std::size_t i = 0; i < 3; ++i) {
    f.slope[i] = -(dot(a.across[i], b.foot) + dot(b.across[i], a.foot));
    for (std::size_t j = 0; j < 3; ++j)
      f.curve[i][j] = a.across[i][0] * b.across[0][j] + a.across[i][1] * b.across[1][j] +
                      a.across[i][2] * b.across[2][j];
  }
  return f;
}

/// v.v
Form square(const Carrier& a) {
  Form f{dot(a.foot, a.foot), {}, a.across};
  for (std::size_t i = 0; i < 3; ++i) f.slope[i] = Ball(-2) * a.foot[i];
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

/// The same from above; of a linear form.
double most_of(const Form& f, const HalfWidths& h) {
  double spread = 0;
  for (std::size_t i = 0; i < 3; ++i) spread += f.slope[i].magnitude() * h[i];
  return f.value.high() + spread * (1 + 1e-14) + 1e-300;
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

/// A unit vector but for rounding: of v + w at the point of the ties that is nearest to the centre,
/// as their values and slopes there say.
Point3 direction_of_sum(const Carrier& a, const Carrier& b, const std::array<Form, 2>& tie,
                        bool third) {
  Point3 y{},
      across{};  // where the point is; what moves it on the second tie but not off the first
  const auto slope = [&](std::size_t t) {
    const BallVector& g = tie[t].slope;
    return Point3{g[0].mid, g[1].mid, g[2].mid};
  };
  const auto inner = [](const Point3& p, const Point3& q) {
    return p.x * q.x + p.y * q.y + p.z * q.z;
  };
  const auto move = [&](const Point3& along, double value, const Point3& g) {
    const double step = -value / inner(along, g);
    if (!std::isfinite(step)) return;
    for (int k = 0; k < 3; ++k) y[k] += step * along[k];
  };
  const Point3 g = slope(0);
  move(g, tie[0].value.mid, g);
  if (third) {
    const Point3 f = slope(1);
    const double share = inner(f, g) / inner(g, g);
    for (int k = 0; k < 3; ++k) across[k] = f[k] - share * g[k];
    move(across, tie[1].value.mid + inner(f, y), f);
  }
  Point3 sum;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    sum[k] = a.foot[i].mid + b.foot[i].mid;
    for (int l = 0; l < 3; ++l) {
      const auto j = static_cast<std::size_t>(l);
      sum[k] -= (a.across[i][j].mid + b.across[i][j].mid) * y[l];
    }
  }
  const double length = std::sqrt(inner(sum, sum));
  for (int k = 0; k < 3; ++k) sum[k] /= length;
  return sum;
}

/// e.(v + w)
Form part_of_sum(const Carrier& a, const Carrier& b, const Point3& e) {
  Form f;
  for (std::size_t i = 0; i < 3; ++i) {
    const Ball ei(e[static_cast<int>(i)]);
    f.value = f.value + ei * (a.foot[i] + b.foot[i]);
    for (std::size_t j = 0; j < 3; ++j)
      f.slope[j] = f.slope[j] - ei * (a.across[i][j] + b.across[i][j]);
  }
  return f;
}

}  // namespace

double angle_on_tie_at_most(const SiteGeometry& geometry, const SiteView& a, const SiteView& b,
                            const SiteView* third, const Box3& box) {
  double nearest = 0, farthest = std::numeric_limits<double>::infinity();
  for (const SiteView* view : {&a, &b, third}) {
    if (!view) continue;
    nearest = std::max(nearest, view->nearest);
    farthest = std::min(farthest, (view->distance.magnitude() + view->reach) * (1 + 1e-15));
  }
  const Carrier p = carrier(geometry, a), q = carrier(geometry, b);
  const Form vv = square(p), ww = square(q);
  std::array<Form, 2> tie{vv, vv};
  add(tie[0], -1, ww);
  if (third) add(tie[1], -1, square(carrier(geometry, *third)));
  const Point3 c = center_of(box);
  HalfWidths h = half_widths_of(box);
  for (double& half : h) half *= 1 + 1e-15;
  const auto least_on_ties = [&](Form form) {
    const Shares m = best_shares(form, tie, third != nullptr, h);
    add(form, m[0], tie[0]);
    if (third) add(form, m[1], tie[1]);
    return least_of(form, h);
  };

  for (const SiteView* view : {&a, &b, third}) {
    if (!view) continue;
    for (const HalfSpace& border : geometry.domain(view->site)) {
      const Form form{
          dot(border.w, difference(c, geometry.solid().point[border.base])), border.w, {}};
      if (most_of(form, h) > 0 && least_on_ties(form) > 0) return 0;
    }
  }
  if (!(nearest > 0) || (a.is_face && b.is_face)) return kPi;
  Form form = product(p, q);
  const double s = std::clamp(form.value.mid / std::sqrt(vv.value.mid * ww.value.mid), -1.0, 1.0);
  if (!std::isfinite(s)) return kPi;
  add(form, -0.5 * s, vv);
  add(form, -0.5 * s, ww);
  // Rounded by less than 5 ulp of 2.
  const double least = std::min(0.0, least_on_ties(form));
  const double cosine = s + least / (nearest * nearest) * (1 + 1e-15) - 4e-15;
  const double most = cosine > -1 ? std::acos(cosine) + kAngleSlack : kPi;
  if (s > kBlunt) return most;
  const double sum =
      least_on_ties(part_of_sum(p, q, direction_of_sum(p, q, tie, third != nullptr)));
  const double half = sum / (2 * farthest) * (1 - 1e-14);  // e is no longer than 1 + 1e-15
  return half > 0 && half < 1 ? std::min(most, 2 * std::acos(half) + kAngleSlack) : most;
}

}  // namespace blum
