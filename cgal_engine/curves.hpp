/// Plane curves of degree one and two that are irreducible over the rationals, each once.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "numbers.hpp"

namespace blum::cgal {

/// Primitive integer coefficients of uu, uv, vv, u, v, 1; the first that is not zero is positive.
struct Curve {
  std::array<Integer, 6> c;
  friend bool operator<(const Curve& a, const Curve& b) { return a.c < b.c; }
};
[[nodiscard]] Quadratic quadratic(const Curve& curve);

/// Where a polynomial vanishes: everywhere, or on the union of irreducible curves.
struct Zeros {
  bool everywhere = false;
  std::vector<Curve> on;
};
/// Factors q over the rationals: conics whose matrix is singular may be one line or two.
[[nodiscard]] Zeros zeros(const Quadratic& q);

class CurveTable {
 public:
  /// The number of the curve, which is new if need be.
  int add(const Curve& curve);
  /// Its number, or -1.
  [[nodiscard]] int find(const Curve& curve) const;
  [[nodiscard]] const std::vector<Curve>& all() const { return curve_; }

 private:
  std::vector<Curve> curve_;
  std::map<Curve, int> number_;
};

}  // namespace blum::cgal
