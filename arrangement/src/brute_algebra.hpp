/// Real algebraic numbers and plane curves of degree one and two for the oracle's sweep.
///
/// A curve is an irreducible polynomial of degree 1 or 2 in v whose coefficients are polynomials in
/// one other variable, called s here, and whose leading coefficient is a positive constant. So two
/// different curves have no common component, every vertical line s = const meets a curve in at
/// most two points, and no curve has a vertical asymptote or component.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <vector>

#include "brute_number.hpp"

namespace blum::brute {

/// An irreducible primitive polynomial and its real roots, which are refined on demand.
class Minimal {
 public:
  explicit Minimal(Poly m);
  [[nodiscard]] const Poly& poly() const { return m_; }
  [[nodiscard]] int real_roots() const { return static_cast<int>(roots(64).size()); }
  /// In increasing order, to about `precision` bits.
  [[nodiscard]] const std::vector<Real>& roots(slong precision) const;

 private:
  Poly m_;
  mutable std::map<slong, std::vector<Real>> roots_;
};

/// The real root number `index` of a minimal polynomial.
struct Algebraic {
  std::shared_ptr<const Minimal> minimal;
  int index = 0;
  [[nodiscard]] const Real& enclosure(slong precision) const {
    return minimal->roots(precision)[static_cast<std::size_t>(index)];
  }
  /// Is it a root of p? Exact.
  [[nodiscard]] bool is_root_of(const Poly& p) const { return minimal->poly().divides(p); }
};

[[nodiscard]] Algebraic rational(const Rational& q);
/// Exact comparison; equality is equality of minimal polynomial and index.
[[nodiscard]] int compare(const Algebraic& a, const Algebraic& b);
/// Gives equal minimal polynomials one object.
class MinimalStore {
 public:
  /// All real roots of p (not zero), each once.
  [[nodiscard]] std::vector<Algebraic> roots(const Poly& p);

 private:
  std::map<Poly, std::shared_ptr<const Minimal>> known_;
};

struct Curve {
  std::array<Poly, 3> c;  ///< c[0] + c[1] v + c[2] v^2
  friend auto operator<=>(const Curve&, const Curve&) = default;
  [[nodiscard]] int degree() const { return c[2].is_zero() ? 1 : 2; }
  [[nodiscard]] Poly discriminant() const;  ///< requires degree 2
};

/// f = sign * (positive constant) * product of curve^exponent. sign 0: f is identically zero.
struct Factors {
  int sign = 0;
  std::vector<std::pair<Curve, int>> curve;
};

/// Factors c[0] + c[1] v + c[2] v^2 over the rationals. Returns false if a leading coefficient in v
/// is not constant (another shear is needed).
[[nodiscard]] bool factorize(const std::array<Poly, 3>& c, Factors& out);

/// Elimination of v from two different curves: their common points lie over the roots of
/// `resultant`; over such a root where `first` is not zero there is one, v = -rest / first; where
/// it is zero the two polynomials in v are proportional.
struct Elimination {
  Poly resultant, first, rest;
};
[[nodiscard]] Elimination eliminate(const Curve& f, const Curve& g);

[[nodiscard]] Real evaluate(const Poly& p, const Real& x, slong precision);
/// Value of the curve's polynomial at (s, v).
[[nodiscard]] Real evaluate(const Curve& f, const Real& s, const Real& v, slong precision);
/// Root of `curve` over s. branch 0: the lower (or only) root, 1: the upper one.
/// Requires: a discriminant that is positive, or zero and said to be so.
[[nodiscard]] Real curve_root(const Curve& f, int branch, bool double_root, const Real& s,
                              slong precision);

}  // namespace blum::brute
