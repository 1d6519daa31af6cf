/// Ball arithmetic in double: a midpoint and a radius that bounds the distance to the true value.
///
/// Bound: in round-to-nearest each operation errs by at most u|result| (u = 2^-53) or, on
/// underflow, by 2^-1075. kUnit = 2^-52 = 2u is charged per operation; the radius itself is a sum
/// and product of at most 8 non-negative terms, so its own rounding is at most a factor
/// (1 + 2^-53)^9 < 1 + 2^-49 = kInflate; kTiny covers underflow of up to 2^10 such operations.
/// Needs no directed rounding, only that the compiler does not contract or reorder
/// (-ffp-contract=off, no -ffast-math).
#pragma once

#include <array>
#include <cmath>

#include "blum/kernel/point.hpp"

namespace blum {

struct Ball {
  double mid = 0, rad = 0;

  static constexpr double kUnit = 0x1p-52;
  static constexpr double kInflate = 1 + 0x1p-49;
  static constexpr double kTiny = 0x1p-1060;

  constexpr Ball() = default;
  constexpr Ball(double value) : mid(value) {}
  constexpr Ball(double m, double r) : mid(m), rad(r) {}

  /// The last terms cover the rounding of mid -+ rad, which errs by at most u (|mid| + rad).
  [[nodiscard]] double low() const { return (mid - rad) - (std::abs(mid) + rad) * kUnit - kTiny; }
  [[nodiscard]] double high() const { return (mid + rad) + (std::abs(mid) + rad) * kUnit + kTiny; }
  [[nodiscard]] double magnitude() const { return (std::abs(mid) + rad) * kInflate; }
  /// Sign if certain, 2 otherwise. A radius of exactly 0 certifies a zero.
  [[nodiscard]] int sign() const {
    if (mid > rad) return 1;
    if (mid < -rad) return -1;
    return mid == 0 && rad == 0 ? 0 : 2;
  }
  friend Ball operator-(const Ball& a) { return {-a.mid, a.rad}; }
  friend Ball operator+(const Ball& a, const Ball& b) {
    const double m = a.mid + b.mid;
    return {m, (a.rad + b.rad + std::abs(m) * kUnit) * kInflate};
  }
  friend Ball operator-(const Ball& a, const Ball& b) { return a + (-b); }
  friend Ball operator*(const Ball& a, const Ball& b) {
    const double m = a.mid * b.mid;
    return {
        m,
        (std::abs(a.mid) * b.rad + std::abs(b.mid) * a.rad + a.rad * b.rad + std::abs(m) * kUnit) *
                kInflate +
            (m == 0 && a.rad == 0 && b.rad == 0 && (a.mid == 0 || b.mid == 0) ? 0.0 : kTiny)};
  }
};

[[nodiscard]] inline Ball square(const Ball& a) { return a * a; }

/// Requires: b certainly non-zero. |a/b - m| <= (a.rad + |m| b.rad) / (|b.mid| - b.rad) + rounding.
[[nodiscard]] inline Ball divide(const Ball& a, const Ball& b) {
  const double m = a.mid / b.mid;
  const double d = (std::abs(b.mid) - b.rad) * (1 - 0x1p-50);
  return {m, ((a.rad + std::abs(m) * b.rad) / d + std::abs(m) * Ball::kUnit) * Ball::kInflate +
                 Ball::kTiny};
}

/// Requires: a certainly positive. |sqrt(a) - sqrt(mid)| <= rad / sqrt(mid - rad).
[[nodiscard]] inline Ball root(const Ball& a) {
  const double m = std::sqrt(a.mid);
  const double d = std::sqrt((a.mid - a.rad) * (1 - 0x1p-50)) * (1 - 0x1p-50);
  return {m, (a.rad / d + m * Ball::kUnit) * Ball::kInflate + Ball::kTiny};
}

using BallVector = std::array<Ball, 3>;

[[nodiscard]] inline BallVector difference(const Point3& a, const Point3& b) {
  BallVector d;
  for (int k = 0; k < 3; ++k) d[k] = Ball(a[k]) - Ball(b[k]);
  return d;
}
[[nodiscard]] inline Ball dot(const BallVector& a, const BallVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
[[nodiscard]] inline BallVector cross(const BallVector& a, const BallVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace blum
