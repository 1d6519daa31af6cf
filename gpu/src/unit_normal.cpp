#include "unit_normal.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "vector3.hpp"

namespace blum::detail {
namespace {

/// hi + lo, |lo| <= ulp(hi).
struct Double2 {
  double hi = 0, lo = 0;
};

Double2 two_sum(double a, double b) {
  const double s = a + b, t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}

/// Relative error at most 2^-101.
Double2 product(const Double2& a, const Double2& b) {
  const double p = a.hi * b.hi;
  const double e = std::fma(a.hi, b.hi, -p) + (a.hi * b.lo + a.lo * b.hi);
  return two_sum(p, e);
}

/// a b - c d, within 2^-99 (|a b| + |c d|) and one rounding to double.
double determinant(const Double2& a, const Double2& b, const Double2& c, const Double2& d) {
  const Double2 p = product(a, b), q = product(c, d);
  const Double2 s = two_sum(p.hi, -q.hi);
  return s.hi + (s.lo + (p.lo - q.lo));
}

}  // namespace

std::optional<Point3> unit_normal(const Point3& a, const Point3& b, const Point3& c) {
  // Exact differences, scaled by a power of two so that nothing under- or overflows.
  std::array<Double2, 3> e, f;
  double largest_e = 0, largest_f = 0;
  for (int k = 0; k < 3; ++k) {
    e[k] = two_sum(b[k], -a[k]);
    f[k] = two_sum(c[k], -a[k]);
    largest_e = std::max(largest_e, std::abs(e[k].hi));
    largest_f = std::max(largest_f, std::abs(f[k].hi));
  }
  if (largest_e == 0 || largest_f == 0) return std::nullopt;
  const auto scale = [](std::array<Double2, 3>& v, double largest) {
    const int exponent = -std::ilogb(largest);
    for (Double2& x : v) x = {std::scalbn(x.hi, exponent), std::scalbn(x.lo, exponent)};
  };
  scale(e, largest_e);
  scale(f, largest_f);
  Point3 n;
  for (int k = 0; k < 3; ++k) {
    const int i = u_axis(k), j = v_axis(k);
    n[k] = determinant(e[i], f[j], e[j], f[i]);
  }
  // 1 <= |e|, |f| < 4: components err by less than 2^-95 before their rounding to double, relative
  // to a length of at least 2^-42 by 2^-53 = u. With that rounding (u) and unit (6u): 8u.
  const double l = length(n);
  if (!(l >= 0x1p-42)) return std::nullopt;
  return unit(n);
}

}  // namespace blum::detail
