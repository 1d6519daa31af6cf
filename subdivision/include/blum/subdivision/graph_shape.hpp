/// The shape of a connected graph after suppressing its nodes of degree 2 (theory section 4).
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace blum {

enum class GraphShape : std::uint8_t {
  kPoint,     ///< one node, no arc
  kLoop,      ///< a disk of one sheet
  kPath,      ///< a half-disk of one sheet with a rim
  kSeam,      ///< k >= 3 arcs between two nodes: a seam passes
  kJunction,  ///< the complete graph on four nodes
  kRimEnd,    ///< a loop with a tail: a rim inside the solid ends in a seam, which ends there too
  kOther,
};

/// Nodes are 0..nodes-1; arcs join two of them (loops and parallel arcs are legal).
/// Requires a connected graph with at least one node.
[[nodiscard]] GraphShape graph_shape(std::uint32_t nodes,
                                     std::span<const std::array<std::uint32_t, 2>> arcs);

}  // namespace blum
