/// Voxel images as input: for every voxel the nearest feature voxel and its distance.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "blum/gpu/grid.hpp"
#include "blum/kernel/result.hpp"

namespace blum {

inline constexpr std::uint64_t kNoVoxel = std::numeric_limits<std::uint64_t>::max();

struct FeatureTransform {
  std::vector<std::uint64_t> feature;  ///< by voxel: the nearest feature voxel's number
  std::vector<double> distance;        ///< between centres, model units; relative error <= 2^-50
};

/// Distances are those of the lattice, sqrt(sum ((i - i') spacing)^2), whatever the grid's origin.
/// Of equally near features (by rounded squared distance) the one with the lowest number is taken.
/// Linear in the number of voxels: one lower envelope of parabolas a row and axis (after
/// Felzenszwalb and Huttenlocher; DiFi section 2.2 lists others). Deterministic for any number of
/// threads. Errors (kBadArgument): a bad grid, a spacing below 2^-400, an image of another size, no
/// feature at all, threads < 1. `on_progress` gets a part from 0 to 1, from any thread; if it
/// returns false: kInterrupted.
[[nodiscard]] Result<FeatureTransform> feature_transform(
    const VoxelGrid& grid, std::span<const std::uint8_t> is_feature, int threads,
    const std::function<bool(double)>& on_progress = {});

/// About how many bytes feature_transform needs at its peak, beside the image.
[[nodiscard]] std::uint64_t feature_transform_bytes(const VoxelGrid& grid);

}  // namespace blum
