/// From labelled cells to the answer: the planar map of regions, arcs and nodes.
#pragma once

#include "blum/arrangement/face_diagram.hpp"
#include "labelled_cells.hpp"

namespace blum::cgal {

/// Fills nodes, arcs, regions, pieces and traces of `out`, whose rect and sides are given.
/// Throws BadPosition.
void read_map(const Forms& forms, const PlanarCells& cells, const LabelledCells& labels,
              FaceDiagram& out);

}  // namespace blum::cgal
