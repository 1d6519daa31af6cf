/// The arrangements by CGAL: three ways to cut a rectangle into cells of constant governors.
#pragma once

#include "planar_cells.hpp"
#include "relevant.hpp"

namespace blum::cgal {

/// All relevant curves, cut by Arr_algebraic_segment_traits_2.
[[nodiscard]] PlanarCells arrange_algebraic(const Relevant& relevant, const Window& window);

}  // namespace blum::cgal
