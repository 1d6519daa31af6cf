/// The k nearest primitives of every sample: the discrete Voronoi diagram of order k.
#pragma once

#include <cstdint>
#include <vector>

#include "blum/gpu/field.hpp"

namespace blum {

/// Sites here are the *primitives* of the soup as closed sets (SiteSet::primitives): vertices,
/// edges and faces would be nearest together almost everywhere. Source: thesis section 4.3.2.
struct NearestSites {
  VoxelGrid grid;
  std::uint32_t order = 0;
  /// order * voxel + n: the n-th nearest primitive, kNoSite.value if it is beyond the band or there
  /// are no more, and its distance (infinity then). By distance, then by number.
  std::vector<std::uint32_t> site;
  std::vector<double> distance;
  FieldBound bound;  ///< for each of the distances
};

/// Uses band, threads, culling.blocks and on_progress of the options; backend kBrute looks at all
/// primitives for all samples. Errors: as compute_field, and an order of 0 or above 64.
[[nodiscard]] Result<NearestSites> nearest_sites(const SiteSet& sites, const VoxelGrid& grid,
                                                 std::uint32_t order, const FieldOptions& options);

}  // namespace blum
