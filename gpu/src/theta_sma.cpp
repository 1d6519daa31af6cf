#include "blum/gpu/theta_sma.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "blum/kernel/check.hpp"
#include "vector3.hpp"

namespace blum {
namespace {

/// Direction from the sample to its foot; nullopt where it has none.
std::optional<Point3> direction(const SiteSet& sites, const DistanceField& field,
                                const FieldSides* sides, std::size_t voxel) {
  if (field.site[voxel] == kNoSite.value || field.interval(voxel).lo <= 0) return std::nullopt;
  if (sides != nullptr && sides->side[voxel] != FieldSide::kInside) return std::nullopt;
  return detail::unit(detail::minus(foot_at(sites, field, voxel), field.grid.point(voxel)));
}

}  // namespace

VoxelSma theta_sma(const SiteSet& sites, const DistanceField& field, const FieldSides* sides,
                   double theta_rad) {
  BLUM_REQUIRE(theta_rad > 0 && theta_rad <= std::numbers::pi);
  const VoxelGrid& grid = field.grid;
  const std::size_t slice = std::size_t{grid.size[0]} * grid.size[1];
  const std::array<std::size_t, 3> stride = {1, grid.size[0], slice};
  const double cosine = std::cos(theta_rad);
  const auto fill = [&](std::uint32_t k, std::vector<std::optional<Point3>>& out) {
    out.resize(slice);
    for (std::size_t v = 0; v < slice; ++v) {
      out[v] = direction(sites, field, sides, v + k * slice);
    }
  };
  VoxelSma sma;
  std::vector<std::optional<Point3>> here, above;
  fill(0, above);
  for (std::uint32_t k = 0; k < grid.size[2]; ++k) {
    std::swap(here, above);
    if (k + 1 < grid.size[2]) fill(k + 1, above);
    for (std::size_t in_slice = 0; in_slice < slice; ++in_slice) {
      const std::size_t voxel = in_slice + k * slice;
      const auto position = grid.position(voxel);
      for (int axis = 0; axis < 3; ++axis) {
        if (position[axis] + 1 == grid.size[axis]) continue;
        const auto& a = here[in_slice];
        const auto& b = axis == 2 ? above[in_slice] : here[in_slice + stride[axis]];
        if (!a || !b || detail::dot(*a, *b) > cosine || !((*b)[axis] > (*a)[axis])) continue;
        sma.facets.push_back({voxel, axis});
        const std::size_t next = voxel + stride[axis];
        sma.voxels.push_back(field.distance[next] > field.distance[voxel] ? next : voxel);
      }
    }
  }
  std::ranges::sort(sma.voxels);
  sma.voxels.erase(std::ranges::unique(sma.voxels).begin(), sma.voxels.end());
  return sma;
}

}  // namespace blum
