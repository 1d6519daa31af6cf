#include "curves.hpp"

#include <gmp.h>

#include <optional>

namespace blum::cgal {
namespace {

Curve primitive(const Quadratic& q) {
  const std::array<Rational, 6> r{q.uu, q.uv, q.vv, q.u, q.v, q.c};
  mpz_t scale, divisor;
  mpz_init_set_ui(scale, 1);
  mpz_init_set_ui(divisor, 0);
  for (const Rational& x : r) mpz_lcm(scale, scale, x.denominator().mpz());
  Curve out;
  for (std::size_t k = 0; k < 6; ++k) {
    mpz_t x;
    mpz_init(x);
    mpz_divexact(x, scale, r[k].denominator().mpz());
    mpz_mul(x, x, r[k].numerator().mpz());
    mpz_gcd(divisor, divisor, x);
    out.c[k] = Integer(x);
    mpz_clear(x);
  }
  int sign = 0;
  for (const Integer& x : out.c)
    if (sign == 0) sign = x < 0 ? -1 : x > 0 ? 1 : 0;
  if (sign < 0) mpz_neg(divisor, divisor);
  const Integer d(divisor);
  for (Integer& x : out.c) x = x / d;
  mpz_clear(scale);
  mpz_clear(divisor);
  return out;
}

/// The square root of x if that is rational.
std::optional<Rational> square_root(const Rational& x) {
  if (x < 0) return std::nullopt;
  const auto root = [](const Integer& n) -> std::optional<Integer> {
    if (mpz_perfect_square_p(n.mpz()) == 0) return std::nullopt;
    mpz_t r;
    mpz_init(r);
    mpz_sqrt(r, n.mpz());
    const Integer out(r);
    mpz_clear(r);
    return out;
  };
  const auto p = root(x.numerator()), q = root(x.denominator());
  if (!p || !q) return std::nullopt;
  return Rational(*p, *q);
}

Rational determinant(const Quadratic& q) {  // times 4
  return Rational(4) * q.uu * q.vv * q.c + q.uv * q.u * q.v - q.uu * q.v * q.v - q.vv * q.u * q.u -
         q.c * q.uv * q.uv;
}

Quadratic swapped(const Quadratic& q) { return {q.vv, q.uv, q.uu, q.v, q.u, q.c}; }

/// The two rational lines of a singular conic, equal for a double line.
std::optional<std::array<Quadratic, 2>> lines(const Quadratic& q) {
  if (q.uu == 0 && q.vv == 0) {  // uv (u + v'/uv)(v + u'/uv), primes for the linear coefficients
    return std::array<Quadratic, 2>{Quadratic{0, 0, 0, q.uv, 0, q.v},
                                    Quadratic{0, 0, 0, 0, q.uv, q.u}};
  }
  if (q.uu == 0) {
    auto out = lines(swapped(q));
    if (out) {
      for (Quadratic& l : *out) l = swapped(l);
    }
    return out;
  }
  // 2 uu u + (uv v + u') +- sqrt(discriminant(v)), which is a square as the determinant is 0.
  const Rational two = 2, four = 4;
  const Rational p = q.uv * q.uv - four * q.uu * q.vv;
  const Rational s = two * q.uv * q.u - four * q.uu * q.v;
  const Rational r = q.u * q.u - four * q.uu * q.c;
  const auto root = square_root(p != 0 ? p : r);
  if (!root) return std::nullopt;
  const Rational slope = p != 0 ? *root : Rational(0);
  const Rational shift = p != 0 ? *root * s / (two * p) : *root;
  return std::array<Quadratic, 2>{Quadratic{0, 0, 0, two * q.uu, q.uv + slope, q.u + shift},
                                  Quadratic{0, 0, 0, two * q.uu, q.uv - slope, q.u - shift}};
}

}  // namespace

Quadratic quadratic(const Curve& curve) {
  const auto& c = curve.c;
  return {Rational(c[0]), Rational(c[1]), Rational(c[2]),
          Rational(c[3]), Rational(c[4]), Rational(c[5])};
}

Zeros zeros(const Quadratic& q) {
  if (q == Quadratic{}) return {true, {}};
  if (q.uu == 0 && q.uv == 0 && q.vv == 0) {
    if (q.u == 0 && q.v == 0) return {};
    return {false, {primitive(q)}};
  }
  if (determinant(q) == 0)
    if (const auto pair = lines(q)) {
      Zeros out;
      for (const Quadratic& l : *pair)
        if (l.u != 0 || l.v != 0) {
          const Curve c = primitive(l);
          if (out.on.empty() || out.on[0].c != c.c) out.on.push_back(c);
        }
      return out;
    }
  return {false, {primitive(q)}};
}

int CurveTable::add(const Curve& curve) {
  const auto [it, fresh] = number_.try_emplace(curve, static_cast<int>(curve_.size()));
  if (fresh) curve_.push_back(curve);
  return it->second;
}

int CurveTable::find(const Curve& curve) const {
  const auto it = number_.find(curve);
  return it == number_.end() ? -1 : it->second;
}

}  // namespace blum::cgal
