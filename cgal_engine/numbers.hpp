/// Exact numbers of the CGAL engine, and polynomials in the coordinates (u, v) of a rectangle.
#pragma once

#include <CGAL/Gmpq.h>
#include <CGAL/Gmpz.h>
#include <CGAL/Root_of_traits.h>
#include <CGAL/Sqrt_extension.h>

#include <array>

namespace blum::cgal {

using Integer = CGAL::Gmpz;
using Rational = CGAL::Gmpq;
/// a + b sqrt(c): exact roots of quadratic polynomials.
using Root = CGAL::Root_of_traits<Rational>::Root_of_2;

/// u * cu + v * cv + c.
struct Affine {
  Rational cu = 0, cv = 0, c = 0;
};

struct Quadratic {
  Rational uu = 0, uv = 0, vv = 0, u = 0, v = 0, c = 0;
  friend bool operator==(const Quadratic&, const Quadratic&) = default;
};

[[nodiscard]] inline Affine operator+(const Affine& a, const Affine& b) {
  return {a.cu + b.cu, a.cv + b.cv, a.c + b.c};
}
[[nodiscard]] inline Affine operator-(const Affine& a, const Affine& b) {
  return {a.cu - b.cu, a.cv - b.cv, a.c - b.c};
}
[[nodiscard]] inline Affine operator*(const Rational& k, const Affine& a) {
  return {k * a.cu, k * a.cv, k * a.c};
}
[[nodiscard]] inline Quadratic square(const Affine& a) {
  return {a.cu * a.cu,
          Rational(2) * a.cu * a.cv,
          a.cv * a.cv,
          Rational(2) * a.cu * a.c,
          Rational(2) * a.cv * a.c,
          a.c * a.c};
}
[[nodiscard]] inline Quadratic quadratic(const Affine& a) { return {0, 0, 0, a.cu, a.cv, a.c}; }
[[nodiscard]] inline Quadratic operator+(const Quadratic& a, const Quadratic& b) {
  return {a.uu + b.uu, a.uv + b.uv, a.vv + b.vv, a.u + b.u, a.v + b.v, a.c + b.c};
}
[[nodiscard]] inline Quadratic operator-(const Quadratic& a, const Quadratic& b) {
  return {a.uu - b.uu, a.uv - b.uv, a.vv - b.vv, a.u - b.u, a.v - b.v, a.c - b.c};
}

/// Closed interval.
struct Range {
  Rational lo = 0, hi = 0;
};
[[nodiscard]] inline bool has_zero(const Range& r) { return r.lo <= 0 && r.hi >= 0; }

/// A rectangle [lo, hi] in u and v.
struct Window {
  Range u, v;
};

/// Bounds of q on the window: least and greatest Bernstein coefficient.
[[nodiscard]] Range bounds(const Quadratic& q, const Window& w);

/// A point both of whose coordinates lie in one quadratic extension of the rationals.
struct Sample {
  Root u, v;
};
[[nodiscard]] Root value(const Quadratic& q, const Sample& p);
[[nodiscard]] Root value(const Affine& a, const Sample& p);

/// Some rational number strictly between a < b.
[[nodiscard]] Rational between(const Root& a, const Root& b);
/// A rational number smaller (greater) than x.
[[nodiscard]] Rational below(const Root& x);
[[nodiscard]] Rational above(const Root& x);

/// Distinct real roots of a t^2 + b t + c in increasing order. Requires: not all zero.
struct Roots {
  int count = 0;
  std::array<Root, 2> root;
};
[[nodiscard]] Roots roots(const Rational& a, const Rational& b, const Rational& c);

/// The greatest double <= x and the smallest one >= x.
[[nodiscard]] double double_below(const Root& x);
[[nodiscard]] double double_above(const Root& x);
[[nodiscard]] double double_below(const Rational& x);
[[nodiscard]] double double_above(const Rational& x);

}  // namespace blum::cgal
