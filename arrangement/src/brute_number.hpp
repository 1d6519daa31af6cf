/// RAII handles for the oracle's exact numbers: integer polynomials in one variable (FLINT) and
/// real balls (Arb). Rationals are GMP's mpq_class.
#pragma once

#include <gmpxx.h>  // before FLINT, so that its mpz conversions are declared

#include <arb.h>
#include <arb_fmpz_poly.h>
#include <fmpz_poly.h>

#include <compare>
#include <utility>

namespace blum::brute {

using Rational = mpq_class;

/// A polynomial with integer coefficients.
class Poly {
 public:
  Poly() { fmpz_poly_init(p_); }
  Poly(const Poly& o) : Poly() { fmpz_poly_set(p_, o.p_); }
  Poly(Poly&& o) noexcept : Poly() { fmpz_poly_swap(p_, o.p_); }
  Poly& operator=(Poly o) noexcept {
    fmpz_poly_swap(p_, o.p_);
    return *this;
  }
  ~Poly() { fmpz_poly_clear(p_); }

  void set(slong power, const mpz_class& c) {
    fmpz_t z;
    fmpz_init(z);
    fmpz_set_mpz(z, c.get_mpz_t());
    fmpz_poly_set_coeff_fmpz(p_, power, z);
    fmpz_clear(z);
  }
  [[nodiscard]] mpz_class coefficient(slong power) const {
    mpz_class r;
    if (power < fmpz_poly_length(p_)) {
      fmpz_t z;
      fmpz_init(z);
      fmpz_poly_get_coeff_fmpz(z, p_, power);
      fmpz_get_mpz(r.get_mpz_t(), z);
      fmpz_clear(z);
    }
    return r;
  }
  [[nodiscard]] slong degree() const { return fmpz_poly_degree(p_); }
  [[nodiscard]] bool is_zero() const { return fmpz_poly_is_zero(p_) != 0; }
  /// Sign of the leading coefficient.
  [[nodiscard]] int sign() const { return is_zero() ? 0 : fmpz_sgn(fmpz_poly_lead(p_)); }
  /// Requires: *this is primitive. Then division over Z and over Q agree.
  [[nodiscard]] bool divides(const Poly& o) const {
    Poly q;
    return o.is_zero() || fmpz_poly_divides(q.p_, o.p_, p_) != 0;
  }

  friend Poly operator+(const Poly& a, const Poly& b) {
    Poly r;
    fmpz_poly_add(r.p_, a.p_, b.p_);
    return r;
  }
  friend Poly operator-(const Poly& a, const Poly& b) {
    Poly r;
    fmpz_poly_sub(r.p_, a.p_, b.p_);
    return r;
  }
  friend Poly operator*(const Poly& a, const Poly& b) {
    Poly r;
    fmpz_poly_mul(r.p_, a.p_, b.p_);
    return r;
  }
  friend Poly operator*(slong k, const Poly& a) {
    Poly r;
    fmpz_poly_scalar_mul_si(r.p_, a.p_, k);
    return r;
  }
  friend bool operator==(const Poly& a, const Poly& b) { return fmpz_poly_equal(a.p_, b.p_) != 0; }
  /// Some total order, for maps.
  friend std::strong_ordering operator<=>(const Poly& a, const Poly& b) {
    if (a.degree() != b.degree()) return a.degree() <=> b.degree();
    for (slong k = 0; k <= a.degree(); ++k) {
      const int c = fmpz_cmp(a.p_->coeffs + k, b.p_->coeffs + k);
      if (c != 0) return c <=> 0;
    }
    return std::strong_ordering::equal;
  }
  [[nodiscard]] const fmpz_poly_struct* get() const { return p_; }
  [[nodiscard]] fmpz_poly_struct* get() { return p_; }

 private:
  fmpz_poly_t p_;
};

/// A real number known to lie in an interval.
class Real {
 public:
  Real() { arb_init(x_); }
  Real(const Real& o) : Real() { arb_set(x_, o.x_); }
  Real(Real&& o) noexcept : Real() { arb_swap(x_, o.x_); }
  Real& operator=(Real o) noexcept {
    arb_swap(x_, o.x_);
    return *this;
  }
  ~Real() { arb_clear(x_); }
  /// Certain sign, or 0 if the ball contains zero.
  [[nodiscard]] int sign() const { return arb_is_positive(x_) ? 1 : arb_is_negative(x_) ? -1 : 0; }
  [[nodiscard]] bool overlaps(const Real& o) const { return arb_overlaps(x_, o.x_) != 0; }
  [[nodiscard]] bool below(const Real& o) const { return arb_lt(x_, o.x_) != 0; }
  [[nodiscard]] arb_srcptr get() const { return x_; }
  [[nodiscard]] arb_ptr get() { return x_; }

 private:
  arb_t x_;
};

/// An exact binary floating-point number: one end of a Real.
class Bound {
 public:
  Bound() { arf_init(x_); }
  Bound(const Bound& o) : Bound() { arf_set(x_, o.x_); }
  Bound(Bound&& o) noexcept : Bound() { arf_swap(x_, o.x_); }
  Bound& operator=(Bound o) noexcept {
    arf_swap(x_, o.x_);
    return *this;
  }
  ~Bound() { arf_clear(x_); }
  [[nodiscard]] arf_srcptr get() const { return x_; }
  [[nodiscard]] arf_ptr get() { return x_; }

 private:
  arf_t x_;
};

/// Outward rounded double bounds.
[[nodiscard]] std::pair<double, double> bounds(const Real& x);
/// Encloses q.
[[nodiscard]] Real enclose(const Rational& q, slong precision);

}  // namespace blum::brute
