#include "blum/kernel/inside.hpp"

#include <cmath>
#include <utility>

#include "blum/kernel/check.hpp"
#include "inside_columns.hpp"

namespace blum {

struct InsideOracle::Impl {
  explicit Impl(std::vector<exact::Triangle> triangles) : columns(std::move(triangles)) {}
  Columns columns;
};

InsideOracle::InsideOracle(const Solid& solid) {
  std::vector<exact::Triangle> triangles;
  triangles.reserve(solid.triangle.size());
  for (const SolidTriangle& t : solid.triangle) {
    triangles.push_back(
        {solid.point[t.vertex[0]], solid.point[t.vertex[1]], solid.point[t.vertex[2]]});
  }
  impl_ = std::make_shared<const Impl>(std::move(triangles));
}

InsideOracle::Where InsideOracle::locate(const Point3& p) const {
  BLUM_REQUIRE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
  std::size_t crossings = 0;
  if (impl_->columns.cast_up(p, [&](std::uint32_t) { ++crossings; })) return Where::kBoundary;
  return crossings % 2 == 1 ? Where::kInside : Where::kOutside;
}

InsideOracle::Where InsideOracle::locate_brute_force(const Point3& p) const {
  std::size_t crossings = 0;
  for (std::size_t i = 0; i < impl_->columns.size(); ++i) {
    const RayHit h = hit_above_exact(p, impl_->columns.triangle(i));
    if (h == RayHit::kOnTriangle) return Where::kBoundary;
    crossings += h == RayHit::kCrosses;
  }
  return crossings % 2 == 1 ? Where::kInside : Where::kOutside;
}

}  // namespace blum
