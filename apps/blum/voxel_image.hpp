/// Voxel images as input of `blum field`: NRRD files, read by Teem.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "blum/gpu/grid.hpp"
#include "blum/kernel/result.hpp"

namespace blum::app {

/// Was the program built with Teem?
[[nodiscard]] bool has_voxel_images();
/// By its name: .nrrd, or .nhdr (a header that names the file of the values).
[[nodiscard]] bool is_voxel_image(const std::filesystem::path& file);

/// Where the voxels' centres are, in the units of the file; without the values. What the file does
/// not say is taken to be 1 (spacing) and 0 (origin). Errors: kFileNotFound; kMalformedFile: not
/// readable, not of three axes, axes that are turned, exchanged or reversed; a grid that make_grid
/// would refuse.
[[nodiscard]] Result<VoxelGrid> read_voxel_grid(const std::filesystem::path& file);

/// By voxel: is its value at least `threshold`, or, without one, not 0? Errors as above, and values
/// that are no numbers (`element`: the voxel).
[[nodiscard]] Result<std::vector<std::uint8_t>> read_features(const std::filesystem::path& file,
                                                              std::optional<double> threshold);

}  // namespace blum::app
