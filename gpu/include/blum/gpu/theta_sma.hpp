/// The voxel approximation of the theta-simplified medial axis, from a discrete field.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "blum/gpu/field.hpp"
#include "blum/gpu/sides.hpp"

namespace blum {

/// The common side of two voxels, `voxel` and the next one along `axis`.
struct VoxelFacet {
  std::size_t voxel = 0;
  int axis = 0;
  friend bool operator==(const VoxelFacet&, const VoxelFacet&) = default;
};

struct VoxelSma {
  std::vector<VoxelFacet> facets;   ///< in increasing order of voxel, then axis
  std::vector<std::size_t> voxels;  ///< of each facet the voxel farther from the sites; sorted
};

/// A facet belongs to it if the directions from its two samples to their feet enclose an angle of
/// at least theta and point away from each other along the segment between the samples, so that
/// this crosses a sheet of the medial axis and not the boundary. Samples on sites, beyond the band
/// or on different sides are left out. Approximate: sampled, feet rounded; no topology is promised.
/// Source: DiFi section 6, after Foskey, Lin, Manocha 2003.
/// `sides`: only facets of the inside are wanted; nullptr: all. Requires 0 < theta_rad <= pi.
[[nodiscard]] VoxelSma theta_sma(const SiteSet& sites, const DistanceField& field,
                                 const FieldSides* sides, double theta_rad);

}  // namespace blum
