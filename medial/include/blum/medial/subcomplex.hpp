/// A part of a complex as a complex, and what it looks like.
#pragma once

#include <cstdint>
#include <vector>

#include "blum/medial/complex.hpp"
#include "blum/medial/filtration.hpp"
#include "blum/medial/parts.hpp"

namespace blum {

struct Subcomplex {
  CellComplex complex;                                ///< cells in their order, and all cones
  std::vector<std::uint32_t> vertex, edge, triangle;  ///< what its cells are in the whole
};

/// Requires a closed set of cells: the faces of each are in it (BLUM_CHECK). An apex that is not is
/// replaced by vertex 0: cones then only number triangles.
[[nodiscard]] Subcomplex subcomplex(const CellComplex& complex, const CellMask& cells);

/// The parts of the whole, told of the subcomplex: sheets and seams keep their numbers.
[[nodiscard]] Parts restricted(const Parts& parts, const Subcomplex& part);

/// The cells of the given values, and the faces of the triangles and edges among them.
[[nodiscard]] CellMask closure_of_values(const CellComplex& complex, const CellValues& value,
                                         double at_least);

/// What a complex looks like, whatever its parts have been before.
struct ShapeCounts {
  std::size_t sheets = 0;     ///< maximal connected 2-manifold pieces
  std::size_t seams = 0;      ///< maximal curves of edges with three or more triangles
  std::size_t curves = 0;     ///< maximal curves of edges without triangles
  std::size_t junctions = 0;  ///< vertices where three or more ends of seams and curves meet
  double area = 0;            ///< of the triangles, model units squared
};
[[nodiscard]] ShapeCounts count_shapes(const CellComplex& complex);

}  // namespace blum
