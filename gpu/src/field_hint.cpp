#include "blum/gpu/field_hint.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "vector3.hpp"

namespace blum {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Bounds {
  VoxelGrid grid;
  Frame frame;
  std::vector<double> upper;  // model units
};

double upper_bound(const Bounds& b, const Point3& working) {
  const Point3 x = b.frame.to_model(working);
  std::array<std::uint32_t, 3> at{};
  for (int axis = 0; axis < 3; ++axis) {
    const double t = (x[axis] - b.grid.origin[axis]) / b.grid.spacing[axis];
    at[axis] = static_cast<std::uint32_t>(
        std::lround(std::clamp(t, 0.0, static_cast<double>(b.grid.size[axis] - 1))));
  }
  const Point3 s = b.grid.point(at[0], at[1], at[2]);
  // to_model rounds a working point that is no vertex by half an ulp of its coordinates.
  const double rounding =
      0x1p-50 * (std::abs(x.x) + std::abs(x.y) + std::abs(x.z) + detail::length(b.frame.origin));
  const double model =
      b.upper[b.grid.index(at[0], at[1], at[2])] + detail::length(detail::minus(x, s)) + rounding;
  return std::ldexp(model * (1 + 0x1p-48), -b.frame.exponent);
}

}  // namespace

DistanceHint field_hint(const SiteSet& sites, const DistanceField& field, const Frame& frame) {
  auto bounds = std::make_shared<Bounds>();
  bounds->grid = field.grid;
  bounds->frame = frame;
  bounds->upper.reserve(field.site.size());
  for (std::size_t v = 0; v < field.site.size(); ++v) {
    const SiteId s = field.site_at(v);
    bounds->upper.push_back(sites.is_site(s)
                                ? std::sqrt(sites.squared_distance(field.grid.point(v), s).hi) *
                                      (1 + 0x1p-50)
                                : kInfinity);
  }
  return [b = std::shared_ptr<const Bounds>(std::move(bounds))](const Point3& working) {
    return upper_bound(*b, working);
  };
}

}  // namespace blum
