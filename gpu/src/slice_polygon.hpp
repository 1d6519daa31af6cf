/// Convex polygons in a slice, in pixels: sample (i, j) is the point (i + 0.5, j + 0.5).
#pragma once

#include <array>
#include <cmath>

namespace blum::detail {

/// a x + b y <= c.
struct HalfPlane {
  double a = 0, b = 0, c = 0;
};

/// An affine function of the sample: at + x * i + y * j.
struct PixelAffine {
  double at = 0, x = 0, y = 0;
  /// At a place in pixels.
  [[nodiscard]] double operator()(double px, double py) const {
    return at + x * (px - 0.5) + y * (py - 0.5);
  }
  /// Where it is at most `limit`, and `pixels` of every axis beyond.
  [[nodiscard]] HalfPlane at_most(double limit, double pixels) const {
    return {x, y, limit - at + 0.5 * (x + y) + pixels * (std::abs(x) + std::abs(y))};
  }
};

struct PixelRect {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

class ConvexPolygon {
 public:
  explicit ConvexPolygon(const PixelRect& r)
      : corner_{{{r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}}},
        size_(r.x0 < r.x1 && r.y0 < r.y1 ? 4 : 0) {}

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] const std::array<double, 2>& operator[](int k) const { return corner_[k]; }

  /// Keeps what lies in the half-plane. (A polygon with too many corners, which rounding alone can
  /// make of 4 sides and the dozen of conditions that there are, stays larger.)
  void clip(const HalfPlane& h) {
    std::array<double, kMost> value;
    bool cuts = false;
    for (int k = 0; k < size_; ++k) {
      value[k] = h.a * corner_[k][0] + h.b * corner_[k][1] - h.c;
      cuts |= value[k] > 0;
    }
    if (!cuts) return;
    std::array<std::array<double, 2>, kMost> out;
    int n = 0;
    for (int k = 0; k < size_; ++k) {
      if (n + 2 > kMost) return;
      const int next = k + 1 == size_ ? 0 : k + 1;
      if (value[k] <= 0) out[n++] = corner_[k];
      if ((value[k] <= 0) != (value[next] <= 0)) {
        const double t = value[k] / (value[k] - value[next]);
        out[n++] = {corner_[k][0] + t * (corner_[next][0] - corner_[k][0]),
                    corner_[k][1] + t * (corner_[next][1] - corner_[k][1])};
      }
    }
    corner_ = out;
    size_ = n < 3 ? 0 : n;
  }

  [[nodiscard]] double area() const {
    double twice = 0;
    for (int k = 1; k + 1 < size_; ++k) {
      twice += (corner_[k][0] - corner_[0][0]) * (corner_[k + 1][1] - corner_[0][1]) -
               (corner_[k][1] - corner_[0][1]) * (corner_[k + 1][0] - corner_[0][0]);
    }
    return 0.5 * std::abs(twice);
  }

  static constexpr int kMost = 32;

 private:
  std::array<std::array<double, 2>, kMost> corner_;
  int size_ = 0;
};

}  // namespace blum::detail
