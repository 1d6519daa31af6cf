/// Fields as files that other programs read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "blum/gpu/grid.hpp"
#include "blum/gpu/sides.hpp"
#include "blum/kernel/result.hpp"

namespace blum {

/// Views of what is written; `order` values a voxel.
struct FieldImage {
  VoxelGrid grid;
  std::uint32_t order = 1;
  std::span<const double> distance;     ///< model units, signed or not; infinity beyond the band
  std::span<const std::uint32_t> site;  ///< ids, 4294967295 for none
  std::span<const FieldSide> side;      ///< may be empty
};

/// The extension decides; values keep every bit, and numbers in headers read back as they are.
///  .vti   VTK image data; point data `distance` (Float64), `site` (UInt32) and, if there are
///  sides,
///         `side` (UInt8: 0 outside, 1 inside, 2 boundary, 3 undefined); `order` components each.
///  .nrrd  distances (double), raw; space directions and origin; axes x, y, z, after the order if
///         that is above 1.
///  .npy   distances (float64), shape (nz, ny, nx) or (nz, ny, nx, order); since the format holds
///  no
///         geometry, FILE.json beside it names size, origin and spacing.
/// Files appear whole or not at all. Errors: kBadArgument (another extension), kOutputNotWritten.
[[nodiscard]] std::optional<Error> write_field(const FieldImage& image,
                                               const std::filesystem::path& file);

/// The files that write_field would write; empty if it does not know the extension.
[[nodiscard]] std::vector<std::filesystem::path> field_files(const std::filesystem::path& file);

}  // namespace blum
