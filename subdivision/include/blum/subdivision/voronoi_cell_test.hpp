/// When is the part of the Voronoi diagram in a cell topologically trivial? (docs/proofs.md,
/// "Voronoi mode")
#pragma once

#include <span>

#include "blum/kernel/predicates.hpp"
#include "blum/subdivision/cell_test.hpp"
#include "blum/subdivision/subdivision.hpp"
#include "blum/subdivision/voronoi_surface.hpp"

namespace blum {

/// `candidates`: a superset of the sites that govern points of the box. `resolve` also asks that
/// each component of the graph has the shape of a sheet, a seam or a junction. `tubes`: Theorem T
/// may be used (relaxed criterion only). Requires: predicates of the Voronoi geometry; all six
/// diagrams decided, from the same segment diagrams along common edges.
[[nodiscard]] CellAnswer test_voronoi_cell(Predicates& predicates, const Box3& box,
                                           std::span<const SiteId> candidates,
                                           const VoronoiSurface::Faces& face, Criterion criterion,
                                           bool resolve, bool tubes);

}  // namespace blum
