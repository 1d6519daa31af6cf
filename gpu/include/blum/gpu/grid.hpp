/// Sample points of a discrete field: a box-shaped grid of any resolution, voxels of any shape.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "blum/kernel/point.hpp"
#include "blum/kernel/result.hpp"

namespace blum {

/// Sample (i, j, k) *is* the point whose coordinates are the doubles origin + i * spacing, rounded
/// once for the product and once for the sum: every statement about a field is about these points.
/// Voxels are numbered with i running fastest. Model units.
struct VoxelGrid {
  std::array<std::uint32_t, 3> size{};
  Point3 origin;   ///< sample (0, 0, 0), the centre of its voxel
  Point3 spacing;  ///< > 0 on every axis; voxels need not be cubes

  [[nodiscard]] std::size_t voxels() const {
    return std::size_t{size[0]} * size[1] * std::size_t{size[2]};
  }
  [[nodiscard]] std::size_t index(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
    return i + size[0] * (j + size[1] * std::size_t{k});
  }
  [[nodiscard]] std::array<std::uint32_t, 3> position(std::size_t voxel) const {
    return {static_cast<std::uint32_t>(voxel % size[0]),
            static_cast<std::uint32_t>(voxel / size[0] % size[1]),
            static_cast<std::uint32_t>(voxel / size[0] / size[1])};
  }
  [[nodiscard]] double coordinate(int axis, std::uint32_t index) const;
  [[nodiscard]] Point3 point(std::uint32_t i, std::uint32_t j, std::uint32_t k) const;
  [[nodiscard]] Point3 point(std::size_t voxel) const;
  /// The box of the sample points (not of the voxels, which are half a spacing larger).
  [[nodiscard]] Box3 sample_box() const;
  friend bool operator==(const VoxelGrid&, const VoxelGrid&) = default;
};

/// The grid of size[0] x size[1] x size[2] voxels that fill `box`; samples are voxel centres.
/// Errors (kBadArgument): a size of 0 or above 2^20, a box that is empty, flat or not finite or
/// reaches beyond 2^200, voxels so small that neighbouring samples would be equal.
[[nodiscard]] Result<VoxelGrid> make_grid(const Box3& box, std::array<std::uint32_t, 3> size);

/// As make_grid says it, for a grid that comes from elsewhere.
[[nodiscard]] std::string grid_problem(const VoxelGrid& grid);

}  // namespace blum
