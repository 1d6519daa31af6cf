// All sites for all samples: slow, simple, and independent of the scan conversion.
#include <algorithm>
#include <atomic>
#include <cmath>

#include "blum/kernel/parallel.hpp"
#include "scan_field.hpp"

namespace blum::detail {

bool brute_field(const SiteSet& sites, const FieldOptions& options, DistanceField& field) {
  const VoxelGrid& grid = field.grid;
  std::vector<double> widest(grid.size[2], 0);
  std::atomic<std::size_t> done{0};
  std::atomic<bool> goes_on{true};
  for_each_in_parallel(options.threads, grid.size[2], [&](int, std::size_t k) {
    if (!goes_on) return;
    const std::size_t slice = std::size_t{grid.size[0]} * grid.size[1];
    std::vector<SquaredDistanceBounds> all(sites.size());
    for (std::size_t voxel = k * slice; voxel < (k + 1) * slice; ++voxel) {
      const Point3 q = grid.point(voxel);
      SquaredDistanceBounds best{std::numeric_limits<double>::infinity(),
                                 std::numeric_limits<double>::infinity()};
      for (std::uint32_t s = 0; s < sites.size(); ++s) {
        if (!sites.is_site({s})) {
          all[s] = {std::numeric_limits<double>::infinity(),
                    std::numeric_limits<double>::infinity()};
          continue;
        }
        all[s] = sites.squared_distance(q, {s});
        best = {std::min(best.lo, all[s].lo), std::min(best.hi, all[s].hi)};
      }
      const double distance = std::sqrt(best.hi);
      if (!(distance <= field.band)) continue;
      // Sites that the bounds cannot tell apart tie: the lowest id owns the sample.
      const auto owner = std::ranges::find_if(
          all, [&](const SquaredDistanceBounds& d) { return d.lo <= best.hi; });
      field.site[voxel] = static_cast<std::uint32_t>(owner - all.begin());
      field.distance[voxel] = distance;
      // The owner's own upper bound may be a little higher than the least one.
      widest[k] =
          std::max({widest[k], distance - std::sqrt(best.lo), std::sqrt(owner->hi) - distance});
    }
    const auto part = static_cast<double>(++done) / grid.size[2];
    if (options.on_progress && !options.on_progress(part)) goes_on = false;
  });
  field.bound.below = field.bound.above = *std::ranges::max_element(widest);
  field.bound.relative = 0x1p-51;
  // The owner is the lowest id that may be the nearest.
  field.bound.regret = field.bound.below + field.bound.above;
  return goes_on;
}

}  // namespace blum::detail
