#include <algorithm>
#include <cmath>

#include "exact_geometry_number.hpp"
#include "frame_choice.hpp"

namespace blum {

Point3 Frame::to_model(const Point3& w) const {
  return {origin.x + std::ldexp(w.x, exponent), origin.y + std::ldexp(w.y, exponent),
          origin.z + std::ldexp(w.z, exponent)};
}

double Frame::length_to_model(double working_length) const {
  return std::ldexp(working_length, exponent);
}

Point3 Frame::to_working(const Point3& m) const {
  return {std::ldexp(m.x - origin.x, -exponent), std::ldexp(m.y - origin.y, -exponent),
          std::ldexp(m.z - origin.z, -exponent)};
}

double Frame::length_to_working(double model_length) const {
  return std::ldexp(model_length, -exponent);
}

namespace {

// Below this ratio of distance to extent a translation gains too few bits to be worth a frame that
// is harder to read.
constexpr double kFar = 4;

double choose_origin(std::span<const Point3> points, int axis) {
  double lo = points[0][axis], hi = lo;
  for (const Point3& p : points) {
    lo = std::min(lo, p[axis]);
    hi = std::max(hi, p[axis]);
  }
  const double extent = hi - lo;
  if (!(extent > 0) || std::max(std::abs(lo), std::abs(hi)) <= kFar * extent) return 0;
  // The middle, with as few bits as the extent allows: then differences tend to be exact.
  const double step = std::ldexp(1.0, std::ilogb(extent));
  const double origin = std::nearbyint((lo + 0.5 * extent) / step) * step;
  if (!std::isfinite(origin)) return 0;
  for (const Point3& p : points) {
    const double d = p[axis] - origin;
    if (!(exact::Dyadic(p[axis]) - exact::Dyadic(origin) == exact::Dyadic(d))) return 0;
  }
  return origin;
}

}  // namespace

Result<FramedPoints> choose_frame(std::span<const Point3> points) {
  FramedPoints out;
  out.working.assign(points.begin(), points.end());
  if (points.empty()) return out;
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = choose_origin(points, axis);
    out.frame.origin[axis] = origin;
    for (Point3& p : out.working) {
      p[axis] = p[axis] - origin + 0.0;  // the sum makes a positive zero of a negative one
      largest = std::max(largest, std::abs(p[axis]));
    }
  }
  if (largest == 0) return out;
  int exponent = 0;
  if (std::frexp(largest, &exponent) == 0.5) --exponent;
  out.frame.exponent = exponent;
  for (std::size_t i = 0; i < out.working.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double x = out.working[i][axis], scaled = std::ldexp(x, -exponent);
      if (std::ldexp(scaled, exponent) != x) {
        return Error{ErrorCode::kCoordinateOutOfRange,
                     "a coordinate is too small beside the largest one to be scaled exactly", "",
                     i};
      }
      out.working[i][axis] = scaled;
    }
  }
  return out;
}

}  // namespace blum
