/// Leaves -> cell complex (theory section 4).
#pragma once

#include "blum/kernel/site_geometry.hpp"
#include "blum/medial/complex.hpp"
#include "blum/subdivision/engine_set.hpp"
#include "blum/subdivision/subdivision.hpp"

namespace blum {

/// Glues the cones of all accepted leaves along their minimal interfaces: every interface
/// rectangle, interface edge and tie on it is one object that both sides refer to. Undecided
/// leaves are left out. Positions and radii are in model units.
[[nodiscard]] CellComplex assemble(const SiteGeometry& geometry, const Subdivision& subdivision,
                                   EngineSet& engines);

}  // namespace blum
