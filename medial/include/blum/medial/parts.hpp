/// Reading the complex: sheets, seams, junctions and clusters (theory section 4).
#pragma once

#include <cstdint>
#include <vector>

#include "blum/medial/complex.hpp"

namespace blum {

/// Shape of the base graph of one cone, after suppressing its nodes of degree 2.
enum class ConeShape : std::uint8_t {
  kLoop,         ///< a disk of one sheet
  kPath,         ///< a half-disk of one sheet with a rim
  kSeam,         ///< k >= 3 arcs between two nodes: a seam passes
  kJunction,     ///< the complete graph on four nodes
  kBoundaryEnd,  ///< Theorem B cone with nodes of degree >= 3: seams end in a boundary vertex
  kCluster,      ///< anything else; the first cone of a ring
  kRing,         ///< the other two cones of a ring: parts of the cluster of the first
};

struct Parts {
  /// Sheet of each triangle: a component of the 2-cells after removing the seams and the edges of
  /// rings, which stand for what is in the cluster.
  std::vector<std::uint32_t> triangle_sheet;
  std::uint32_t sheets = 0;
  /// Seam of each edge; kNoSeam for edges inside sheets and on rims. Seams are maximal curves
  /// whose ends are junctions, clusters or boundary vertices; closed seams have none.
  static constexpr std::uint32_t kNoSeam = 0xffffffffu;
  std::vector<std::uint32_t> edge_seam;
  std::uint32_t seams = 0;
  std::vector<ConeShape> cone_shape;
  std::uint32_t junctions = 0, clusters = 0;
};

[[nodiscard]] Parts read_parts(const CellComplex& complex);

}  // namespace blum
