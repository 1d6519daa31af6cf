#include "brute_algebra.hpp"

#include <acb.h>
#include <fmpz_poly_factor.h>

#include "blum/kernel/check.hpp"

namespace blum::brute {

std::pair<double, double> bounds(const Real& x) {
  arf_t a;
  arf_init(a);
  std::pair<double, double> r;
  arb_get_lbound_arf(a, x.get(), 120);
  r.first = arf_get_d(a, ARF_RND_FLOOR);
  arb_get_ubound_arf(a, x.get(), 120);
  r.second = arf_get_d(a, ARF_RND_CEIL);
  arf_clear(a);
  return r;
}

Real enclose(const Rational& q, slong precision) {
  Real r;
  fmpq_t z;
  fmpq_init(z);
  fmpq_set_mpq(z, q.get_mpq_t());
  arb_set_fmpq(r.get(), z, precision);
  fmpq_clear(z);
  return r;
}

Minimal::Minimal(Poly m) : m_(std::move(m)) { BLUM_CHECK(m_.degree() >= 1); }

const std::vector<Real>& Minimal::roots(slong precision) const {
  auto [it, fresh] = roots_.try_emplace(precision);
  if (!fresh) return it->second;
  if (m_.degree() == 1) {
    it->second.push_back(
        enclose(Rational(-m_.coefficient(0)) / Rational(m_.coefficient(1)), precision));
    return it->second;
  }
  const slong n = m_.degree();
  acb_ptr z = _acb_vec_init(n);
  arb_fmpz_poly_complex_roots(z, m_.get(), 0, precision);
  // Documented order: real roots first, ascending, with imaginary part exactly zero.
  for (slong k = 0; k < n && arb_is_zero(acb_imagref(z + k)); ++k) {
    Real r;
    arb_set(r.get(), acb_realref(z + k));
    it->second.push_back(std::move(r));
  }
  _acb_vec_clear(z, n);
  return it->second;
}

Algebraic rational(const Rational& q) {
  Poly m;
  m.set(0, -q.get_num());
  m.set(1, q.get_den());
  return {std::make_shared<Minimal>(std::move(m)), 0};
}

int compare(const Algebraic& a, const Algebraic& b) {
  if (a.index == b.index && a.minimal->poly() == b.minimal->poly()) return 0;
  for (slong precision = 64;; precision *= 2) {
    if (a.enclosure(precision).below(b.enclosure(precision))) return -1;
    if (b.enclosure(precision).below(a.enclosure(precision))) return 1;
    BLUM_CHECK(precision < (slong{1} << 24));
  }
}

std::vector<Algebraic> MinimalStore::roots(const Poly& p) {
  BLUM_CHECK(!p.is_zero());
  std::vector<Algebraic> out;
  if (p.degree() < 1) return out;
  fmpz_poly_factor_t factors;
  fmpz_poly_factor_init(factors);
  fmpz_poly_factor(factors, p.get());
  for (slong k = 0; k < factors->num; ++k) {
    Poly m;
    fmpz_poly_set(m.get(), factors->p + k);
    if (m.sign() < 0) m = -1 * m;
    auto& known = known_[m];
    if (!known) known = std::make_shared<Minimal>(m);
    for (int i = 0; i < known->real_roots(); ++i) out.push_back({known, i});
  }
  fmpz_poly_factor_clear(factors);
  return out;
}

Poly Curve::discriminant() const { return c[1] * c[1] - 4 * (c[0] * c[2]); }

namespace {

/// Divides by the content and makes the leading coefficient in v positive; returns its old sign.
int normalize(Curve& f) {
  fmpz_t content, each;
  fmpz_init(content);
  fmpz_init(each);
  for (const Poly& c : f.c) {
    fmpz_poly_content(each, c.get());
    fmpz_gcd(content, content, each);
  }
  const int sign = f.c[static_cast<std::size_t>(f.degree())].sign();
  if (sign < 0) fmpz_neg(content, content);
  for (Poly& c : f.c) {
    Poly q;
    fmpz_poly_scalar_divexact_fmpz(q.get(), c.get(), content);
    c = std::move(q);
  }
  fmpz_clear(content);
  fmpz_clear(each);
  return sign;
}

}  // namespace

bool factorize(const std::array<Poly, 3>& c, Factors& out) {
  out = {};
  if (c[2].is_zero() && c[1].is_zero()) {
    if (c[0].degree() > 0) return false;
    out.sign = c[0].sign();
    return true;
  }
  Curve f{c};
  if (f.c[static_cast<std::size_t>(f.degree())].degree() != 0) return false;
  Poly root;
  if (f.degree() == 1) {
    out.sign = normalize(f);
    out.curve = {{f, 1}};
  } else if (const Poly d = f.discriminant();
             d.is_zero() || (d.sign() > 0 && fmpz_poly_sqrt(root.get(), d.get()) != 0)) {
    // 4 c2 f = (2 c2 v + c1 + root) (2 c2 v + c1 - root)
    Curve plus{{c[1] + root, 2 * c[2], Poly()}}, minus{{c[1] - root, 2 * c[2], Poly()}};
    normalize(plus);
    normalize(minus);
    out.sign = c[2].sign();
    if (plus == minus) {
      out.curve = {{plus, 2}};
    } else {
      out.curve = {{plus, 1}, {minus, 1}};
    }
  } else {
    out.sign = normalize(f);
    out.curve = {{f, 1}};
  }
  return true;
}

Elimination eliminate(const Curve& f, const Curve& g) {
  if (f.degree() < g.degree()) return eliminate(g, f);
  Elimination e;
  if (f.degree() == 2 && g.degree() == 2) {
    e.first = f.c[2] * g.c[1] - g.c[2] * f.c[1];
    e.rest = f.c[2] * g.c[0] - g.c[2] * f.c[0];
    e.resultant = e.rest * e.rest - e.first * (f.c[1] * g.c[0] - g.c[1] * f.c[0]);
  } else {
    e.first = g.c[1];
    e.rest = g.c[0];
    e.resultant = f.degree() == 2 ? f.c[2] * g.c[0] * g.c[0] - f.c[1] * g.c[1] * g.c[0] +
                                        f.c[0] * g.c[1] * g.c[1]
                                  : f.c[1] * g.c[0] - g.c[1] * f.c[0];
  }
  return e;
}

Real evaluate(const Poly& p, const Real& x, slong precision) {
  Real r;
  arb_fmpz_poly_evaluate_arb(r.get(), p.get(), x.get(), precision);
  return r;
}

Real evaluate(const Curve& f, const Real& s, const Real& v, slong precision) {
  Real r = evaluate(f.c[2], s, precision);
  for (int k = 1; k >= 0; --k) {
    arb_mul(r.get(), r.get(), v.get(), precision);
    arb_add(r.get(), r.get(), evaluate(f.c[static_cast<std::size_t>(k)], s, precision).get(),
            precision);
  }
  return r;
}

Real curve_root(const Curve& f, int branch, bool double_root, const Real& s, slong precision) {
  Real r;
  if (f.degree() == 1) {
    arb_neg(r.get(), evaluate(f.c[0], s, precision).get());
    arb_div(r.get(), r.get(), evaluate(f.c[1], s, precision).get(), precision);
    return r;
  }
  if (!double_root) {
    r = evaluate(f.discriminant(), s, precision);
    arb_sqrtpos(r.get(), r.get(), precision);
    if (branch == 0) arb_neg(r.get(), r.get());
  }
  arb_sub(r.get(), r.get(), evaluate(f.c[1], s, precision).get(), precision);
  arb_div(r.get(), r.get(), evaluate(f.c[2], s, precision).get(), precision);
  arb_mul_2exp_si(r.get(), r.get(), -1);
  return r;
}

}  // namespace blum::brute
