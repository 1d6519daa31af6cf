#include "projection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "blum/kernel/point_algebra.hpp"

namespace blum::detail {
namespace {

constexpr double kEyeDistance = 2.1;  // diagonals of the box: all of it is before the eye
constexpr double kFilled = 0.88;      // of the picture's width or height

Point3 unit(const Point3& a) {
  const double l = length(a);
  return l > 0 ? Point3{a.x / l, a.y / l, a.z / l} : a;
}

}  // namespace

Projection::Projection(const Scene& scene, const RenderOptions& options)
    : box_(bounds_of(scene)), section_(options.section) {
  size_ = diameter(box_);
  if (!(size_ > 0)) size_ = 1;
  const double a = options.camera.azimuth_deg * M_PI / 180,
               e = options.camera.elevation_deg * M_PI / 180;
  const Point3 back = {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
  eye_ = middle(box_.lo, box_.hi) + kEyeDistance * size_ * back;
  forward_ = {-back.x, -back.y, -back.z};
  right_ = {-std::sin(a), std::cos(a), 0};
  up_ = cross(right_, forward_);
  lamp_ = unit(back + -0.3 * right_ + 0.5 * up_);
  fit(options);
}

void Projection::fit(const RenderOptions& options) {
  scale_ = 1;
  cx_ = cy_ = 0;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double left = kInfinity, right = -kInfinity, top = kInfinity, bottom = -kInfinity;
  for (int m = 0; m < 8; ++m) {
    const RasterVertex v = (*this)({m & 1 ? box_.hi.x : box_.lo.x, m & 2 ? box_.hi.y : box_.lo.y,
                                    m & 4 ? box_.hi.z : box_.lo.z});
    left = std::min(left, v.x);
    right = std::max(right, v.x);
    top = std::min(top, v.y);
    bottom = std::max(bottom, v.y);
  }
  const double wide = std::max(right - left, 1e-9), high = std::max(bottom - top, 1e-9);
  scale_ = options.zoom * std::min(kFilled * options.width / wide, kFilled * options.height / high);
  cx_ = options.width / 2.0 - scale_ * (left + right) / 2;
  cy_ = options.height / 2.0 - scale_ * (top + bottom) / 2;
}

RasterVertex Projection::operator()(const Point3& p) const {
  const Point3 d = p - eye_;
  RasterVertex v;
  // In sizes of the scene: the raster keeps floats.
  v.inverse_depth = size_ / inner(d, forward_);
  v.x = cx_ + scale_ * (inner(d, right_) / size_) * v.inverse_depth;
  v.y = cy_ - scale_ * (inner(d, up_) / size_) * v.inverse_depth;
  if (section_) {
    const int k = section_->axis;
    const double level = box_.lo[k] + section_->at * (box_.hi[k] - box_.lo[k]);
    v.clip = section_->flip ? p[k] - level : level - p[k];
  }
  return v;
}

double Projection::light(const Point3& a, const Point3& b, const Point3& c) const {
  const Point3 n = unit(cross(b - a, c - a));
  return 0.5 + 0.5 * std::abs(inner(n, lamp_));
}

RasterVertex Projection::nearer(RasterVertex v) const {
  const double depth = 1 / v.inverse_depth;
  v.inverse_depth = 1 / (depth - 0.002);
  return v;
}

}  // namespace blum::detail
