#include "numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace blum::cgal {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Bisects until lo and hi, lo <= x <= hi, are at most 2^-64 of their size apart.
Range narrow(const Root& x) {
  Range r{below(x), above(x)};
  const Rational part = Rational(1) / Rational(std::ldexp(1.0, 64));
  for (int step = 0; step < 1200; ++step) {
    const Rational size = std::max(abs(r.lo), abs(r.hi));
    if (r.hi - r.lo <= part * size) break;
    const Rational middle = (r.lo + r.hi) / Rational(2);
    const CGAL::Comparison_result c = CGAL::compare(Root(middle), x);
    if (c == CGAL::EQUAL) return {middle, middle};
    (c == CGAL::SMALLER ? r.lo : r.hi) = middle;
  }
  return r;
}

double greatest_double(const Rational& start, const auto& at_most_x) {
  double d = CGAL::to_double(start);
  while (!at_most_x(d)) d = std::nextafter(d, -kInfinity);
  for (double next; at_most_x(next = std::nextafter(d, kInfinity));) d = next;
  return d;
}

double smallest_double(const Rational& start, const auto& at_least_x) {
  double d = CGAL::to_double(start);
  while (!at_least_x(d)) d = std::nextafter(d, kInfinity);
  for (double next; at_least_x(next = std::nextafter(d, -kInfinity));) d = next;
  return d;
}

}  // namespace

Range bounds(const Quadratic& q, const Window& w) {
  const Rational du = w.u.hi - w.u.lo, dv = w.v.hi - w.v.lo, two = 2;
  const Rational &a = w.u.lo, &b = w.v.lo;
  const Rational c = q.uu * a * a + q.uv * a * b + q.vv * b * b + q.u * a + q.v * b + q.c;
  const Rational s = (two * q.uu * a + q.uv * b + q.u) * du / two;
  const Rational t = (two * q.vv * b + q.uv * a + q.v) * dv / two;
  const Rational ss = q.uu * du * du, tt = q.vv * dv * dv, st = q.uv * du * dv / Rational(4);
  Range r{c, c};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Rational x = c + Rational(i) * s + Rational(j) * t + Rational(i * j) * st;
      if (i == 2) x += ss;
      if (j == 2) x += tt;
      r.lo = std::min(r.lo, x);
      r.hi = std::max(r.hi, x);
    }
  return r;
}

Root value(const Quadratic& q, const Sample& p) {
  return Root(q.uu) * p.u * p.u + Root(q.uv) * p.u * p.v + Root(q.vv) * p.v * p.v +
         Root(q.u) * p.u + Root(q.v) * p.v + Root(q.c);
}

Root value(const Affine& a, const Sample& p) {
  return Root(a.cu) * p.u + Root(a.cv) * p.v + Root(a.c);
}

Rational below(const Root& x) {
  Rational step = 1;
  while (CGAL::compare(Root(Rational(0) - step), x) != CGAL::SMALLER) step *= Rational(2);
  return Rational(0) - step;
}

Rational above(const Root& x) {
  Rational step = 1;
  while (CGAL::compare(Root(step), x) != CGAL::LARGER) step *= Rational(2);
  return step;
}

Rational between(const Root& a, const Root& b) {
  Range r{below(a), above(b)};
  while (true) {
    const Rational middle = (r.lo + r.hi) / Rational(2);
    if (CGAL::compare(Root(middle), a) != CGAL::LARGER) {
      r.lo = middle;
    } else if (CGAL::compare(Root(middle), b) != CGAL::SMALLER) {
      r.hi = middle;
    } else {
      return middle;
    }
  }
}

Roots roots(const Rational& a, const Rational& b, const Rational& c) {
  Roots out;
  if (a == 0) {
    if (b != 0) out = {1, {Root(Rational(0) - c / b), Root()}};
    return out;
  }
  const Rational half = Rational(0) - b / (Rational(2) * a);
  const Rational square = half * half - c / a;
  if (square < 0) return out;
  if (square == 0) return {1, {Root(half), Root()}};
  return {2, {Root(half, Rational(-1), square), Root(half, Rational(1), square)}};
}

double double_below(const Root& x) {
  return greatest_double(
      narrow(x).lo, [&](double d) { return CGAL::compare(Root(Rational(d)), x) != CGAL::LARGER; });
}
double double_above(const Root& x) {
  return smallest_double(
      narrow(x).hi, [&](double d) { return CGAL::compare(Root(Rational(d)), x) != CGAL::SMALLER; });
}
double double_below(const Rational& x) {
  return greatest_double(x, [&](double d) { return Rational(d) <= x; });
}
double double_above(const Rational& x) {
  return smallest_double(x, [&](double d) { return Rational(d) >= x; });
}

}  // namespace blum::cgal
