/// Signs of real expressions: balls in double decide first, GMP rationals last.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cmath>
#include <type_traits>

#include "blum/kernel/ball.hpp"
#include "blum/kernel/point.hpp"

namespace blum::verify {

using Rational = mpq_class;
template <class N>
using Vec = std::array<N, 3>;

[[nodiscard]] inline int sign_of(const Ball& x) { return x.sign(); }  // 2: not known
[[nodiscard]] inline int sign_of(const Rational& x) { return sgn(x); }

/// The exact sign of `expression`, a generic function of a number type's value: called as
/// expression(N(0)) for N = Ball, then Rational, and returns a sign (2: not known).
template <class F>
[[nodiscard]] int decide(F&& expression) {
  const int s = expression(Ball(0.0));
  return s != 2 ? s : expression(Rational(0));
}

template <class N>
[[nodiscard]] Vec<N> exactly(const Point3& p) {
  return {N(p.x), N(p.y), N(p.z)};
}
template <class N>
[[nodiscard]] Vec<N> minus(const Vec<N>& a, const Vec<N>& b) {
  return {N(a[0] - b[0]), N(a[1] - b[1]), N(a[2] - b[2])};
}
template <class N>
[[nodiscard]] Vec<N> plus(const Vec<N>& a, const Vec<N>& b) {
  return {N(a[0] + b[0]), N(a[1] + b[1]), N(a[2] + b[2])};
}
template <class N>
[[nodiscard]] Vec<N> times(const Vec<N>& a, const N& s) {
  return {N(a[0] * s), N(a[1] * s), N(a[2] * s)};
}
template <class N>
[[nodiscard]] N inner(const Vec<N>& a, const Vec<N>& b) {
  return N(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}
template <class N>
[[nodiscard]] Vec<N> outer(const Vec<N>& a, const Vec<N>& b) {
  return {N(a[1] * b[2] - a[2] * b[1]), N(a[2] * b[0] - a[0] * b[2]), N(a[0] * b[1] - a[1] * b[0])};
}
[[nodiscard]] inline bool is_zero(const Vec<Rational>& a) { return a == Vec<Rational>{}; }

/// At least |x|.
[[nodiscard]] inline Ball magnitude(const Ball& x) { return Ball(x.magnitude()); }
[[nodiscard]] inline Rational magnitude(const Rational& x) { return abs(x); }

/// A vector, exact and enclosed.
class Exact {
 public:
  Exact() = default;
  Exact(const Vec<Rational>& x) : exact_(x) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double mid = x[k].get_d();  // truncated: off by less than 2^-52 |x|
      ball_[k] = {mid, mid == x[k] ? 0.0 : std::abs(mid) * 0x1p-51 + Ball::kTiny};
    }
  }
  template <class N>
  [[nodiscard]] const Vec<N>& as() const {
    if constexpr (std::is_same_v<N, Ball>)
      return ball_;
    else
      return exact_;
  }

 private:
  Vec<Rational> exact_;
  Vec<Ball> ball_;
};

/// Sign of p / sqrt(s) - q / sqrt(t). Requires s, t > 0.
template <class N>
[[nodiscard]] int compare_over_roots(const N& p, const N& s, const N& q, const N& t) {
  const int sp = sign_of(p), sq = sign_of(q);
  if (sp == 2 || sq == 2) return 2;
  if (sp != sq) return sp > sq ? 1 : -1;
  if (sp == 0) return 0;
  const int c = sign_of(N(p * p * t - q * q * s));
  return c == 2 ? 2 : sp * c;
}

}  // namespace blum::verify
