/// Distance fields by other libraries: built only where their packages are found.
#pragma once

#include <vector>

#include "blum/gpu/grid.hpp"
#include "blum/gpu/site_set.hpp"

namespace blum::bench {

/// Unsigned distance of every sample, by voxel. Each sample's query starts from the answer of the
/// sample before, the fairest way to ask for a whole grid.
[[nodiscard]] std::vector<float> embree_distances(const SiteSet& sites, const VoxelGrid& grid,
                                                  int threads);
[[nodiscard]] std::vector<float> cgal_distances(const SiteSet& sites, const VoxelGrid& grid,
                                                int threads);
/// OpenVDB computes a whole grid; NaN outside of a band. Requires cubes for voxels.
[[nodiscard]] std::vector<float> openvdb_distances(const SiteSet& sites, const VoxelGrid& grid,
                                                   int threads);
[[nodiscard]] std::vector<float> openvdb_band3(const SiteSet& sites, const VoxelGrid& grid,
                                               int threads);

}  // namespace blum::bench
