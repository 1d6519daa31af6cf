/// Which sites can own a sample of a box? Lists that shrink from a box to its parts.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "blum/gpu/grid.hpp"
#include "scan_sites.hpp"

namespace blum::detail {

/// A box of samples, begin[axis] <= index < end[axis].
struct CullNode {
  std::array<std::uint32_t, 3> begin{}, end{};
  /// Every sample of the box has a site within this distance, or is beyond the band.
  double reach = 0;
};

class BlockCull {
 public:
  /// Keeps references. `band` caps the distances of interest.
  BlockCull(const ScanSites& sites, const VoxelGrid& grid, double band)
      : sites_(sites), grid_(grid), band_(band) {}

  [[nodiscard]] CullNode root() const { return {{0, 0, 0}, grid_.size, band_}; }

  /// Appends the sites of `parents` that may own a sample of the node, or be within `margin` of
  /// doing so, and lowers node.reach. Requires: `parents` does so for a box around it, whose reach
  /// node.reach is.
  void filter(CullNode& node, std::span<const Sphere> parents, std::vector<Sphere>& kept,
              std::vector<double>& scratch) const;

  /// The halves, quarters or eighths of a node, cut at multiples of kBlock from the grid's start.
  static void split(const CullNode& node, std::vector<CullNode>& parts);
  [[nodiscard]] static bool is_block(const CullNode& node);
  /// How many blocks splitting ends with.
  [[nodiscard]] static std::uint64_t blocks_in(const CullNode& node);

 private:
  const ScanSites& sites_;
  const VoxelGrid& grid_;
  double band_;
};

}  // namespace blum::detail
