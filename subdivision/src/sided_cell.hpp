/// Voronoi diagrams on one side of the solid's boundary: what a cell must satisfy beyond Theorem V
/// (docs/proofs.md, "One side").
#pragma once

#include <span>

#include "blum/kernel/inside.hpp"
#include "blum/kernel/predicates.hpp"
#include "blum/subdivision/subdivision.hpp"
#include "blum/subdivision/voronoi_surface.hpp"

namespace blum {

struct SidedAnswer {
  bool accepted = false;
  bool has_diagram = false;  ///< accepted: the diagram of this side shows on the cell's surface
};

/// Triangles: a superset of those that meet the box. Requires: a cell that Theorem V accepts;
/// predicates of the Voronoi geometry; side not kBoth.
[[nodiscard]] SidedAnswer test_sided_cell(Predicates& predicates, const InsideOracle& inside,
                                          const Box3& box, std::span<const std::uint32_t> triangles,
                                          const VoronoiSurface::Faces& face, VoronoiSide side);

}  // namespace blum
