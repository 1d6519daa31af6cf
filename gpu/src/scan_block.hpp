/// The inner loop: distances of the samples of one block to a list of sites.
#pragma once

#include <cstdint>
#include <span>

#include "scan_sites.hpp"

namespace blum::detail {

inline constexpr int kBlock = 8;  ///< samples along an edge of a block

/// Samples (x[i], y[j], z[k]); unused x repeat the last one, so that rows are always whole.
struct Block {
  double x[kBlock], y[kBlock], z[kBlock];
  int ny = 0, nz = 0;
  /// By sample i + 8 (j + 8 k): the least squared distance so far and the place of its site in
  /// the list (as a double, which keeps rows in step). Start with infinity and any number.
  alignas(64) double squared[kBlock * kBlock * kBlock];
  alignas(64) double owner[kBlock * kBlock * kBlock];
};

/// Takes the sites in the order of the list, which is that of ranks; a later one wins only if it is
/// strictly nearer. The result is the same whatever instructions the processor has: no fused
/// operations.
void scan_block(Block& block, const ScanSites& sites, std::span<const Sphere> list);

}  // namespace blum::detail
