#include "blum/subdivision/cut_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "blum/kernel/ball.hpp"

namespace blum {
namespace {

constexpr int kSteps = 64;
/// Sizes of the largest component of a normal, and how much of the best gap a shorter one must
/// keep.
constexpr std::array<int, 5> kNormalSize{1, 2, 5, 16, 64};
constexpr double kKept = 0.7;

using Vector = std::array<double, 3>;

double dot3(const Vector& n, const Point3& p) { return n[0] * p.x + n[1] * p.y + n[2] * p.z; }

/// The point of the set that is farthest along sign * n, and how far.
struct Farthest {
  double along;
  Point3 point;
};
Farthest farthest(std::span<const Point3> points, const Vector& n, double sign) {
  Farthest best{-std::numeric_limits<double>::infinity(), points.front()};
  for (const Point3& p : points)
    if (const double h = sign * dot3(n, p); h > best.along) best = {h, p};
  return best;
}

/// An interval of one coordinate as a ball.
Ball coordinate(double lo, double hi) {
  if (lo == hi) return Ball(lo);
  const double mid = 0.5 * lo + 0.5 * hi;
  return {mid, std::max(hi - mid, mid - lo) * Ball::kInflate};
}

/// About the shortest vector from the hull of a to the hull of b, by Gilbert's algorithm.
Vector shortest(std::span<const Point3> a, std::span<const Point3> b) {
  Vector d{};
  for (std::size_t k = 0; k < 3; ++k)
    d[k] = b.front()[static_cast<int>(k)] - a.front()[static_cast<int>(k)];
  for (int step = 0; step < kSteps; ++step) {
    const Farthest p = farthest(a, d, 1), q = farthest(b, d, -1);
    double along = 0, length = 0;
    Vector e;
    for (std::size_t k = 0; k < 3; ++k) {
      e[k] = q.point[static_cast<int>(k)] - p.point[static_cast<int>(k)] - d[k];
      along -= e[k] * d[k];
      length += e[k] * e[k];
    }
    if (!(along > 0) || !(length > 0)) break;
    const double t = std::min(1.0, along / length);
    for (std::size_t k = 0; k < 3; ++k) d[k] += t * e[k];
  }
  return d;
}

std::optional<PlaneBetween> with_normal(std::span<const Point3> a, std::span<const Point3> b,
                                        const Vector& n) {
  const double length = std::hypot(n[0], n[1], n[2]);
  if (!(length > 0)) return std::nullopt;
  const double low = farthest(a, n, 1).along, high = -farthest(b, n, -1).along;
  if (!(high > low)) return std::nullopt;
  PlaneBetween r;
  r.gap = (high - low) / length;
  // An offset that errs by at most an eighth of the gap.
  const int exponent = std::ilogb(high - low) - 3;
  r.plane.offset = std::ldexp(std::round(std::ldexp(0.5 * (low + high), -exponent)), exponent);
  for (std::size_t k = 0; k < 3; ++k) r.plane.normal[k] = static_cast<int>(n[k]);
  return r;
}

}  // namespace

int side_of(const CutPlane& plane, const Box3& box) {
  Ball h(-plane.offset);
  for (int k = 0; k < 3; ++k)
    h = h + Ball(plane.normal[static_cast<std::size_t>(k)]) * coordinate(box.lo[k], box.hi[k]);
  return h.sign();
}

std::optional<Box3> around_section(const CutPlane& plane, const Box3& box) {
  const int side = side_of(plane, box);
  if (side == 1 || side == -1) return std::nullopt;
  Box3 r = box;
  for (int k = 0; k < 3; ++k) {
    const int n = plane.normal[static_cast<std::size_t>(k)];
    if (n == 0) continue;
    Ball rest(plane.offset);
    for (int j = 0; j < 3; ++j)
      if (j != k)
        rest = rest -
               Ball(plane.normal[static_cast<std::size_t>(j)]) * coordinate(box.lo[j], box.hi[j]);
    const Ball x = divide(rest, Ball(n));
    // The plane meets the box, so the bounds cannot pass each other but by rounding.
    const double lo = std::clamp(x.low(), box.lo[k], box.hi[k]),
                 hi = std::clamp(x.high(), box.lo[k], box.hi[k]);
    r.lo[k] = lo;
    r.hi[k] = hi;
  }
  return r;
}

std::optional<PlaneBetween> plane_between(std::span<const Point3> a, std::span<const Point3> b) {
  const Vector d = shortest(a, b);
  const double size = std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
  if (!(size > 0)) return std::nullopt;
  std::optional<PlaneBetween> best;
  std::array<std::optional<PlaneBetween>, kNormalSize.size()> found;
  for (std::size_t i = 0; i < kNormalSize.size(); ++i) {
    Vector n;
    for (std::size_t k = 0; k < 3; ++k) n[k] = std::round(d[k] / size * kNormalSize[i]);
    found[i] = with_normal(a, b, n);
    if (found[i] && (!best || found[i]->gap > best->gap)) best = found[i];
  }
  for (const auto& f : found)
    if (f && f->gap >= kKept * best->gap) return f;
  return best;
}

}  // namespace blum
