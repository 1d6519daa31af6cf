/// The part of the cell complex in one leaf.
#pragma once

#include "blum/kernel/site_geometry.hpp"
#include "blum/medial/complex.hpp"
#include "blum/subdivision/engine_set.hpp"
#include "blum/subdivision/subdivision.hpp"

namespace blum {

/// The cones of one accepted leaf of a medial axis as they would be if no neighbour divided its
/// faces: for looking ahead, as the complex of the whole is the same up to more vertices on the
/// leaf's surface. All cones say leaf 0. Empty where an interface could not be decided. Works with
/// the engines of the given thread alone.
[[nodiscard]] CellComplex leaf_complex(const SiteGeometry& geometry, const Leaf& leaf,
                                       EngineSet& engines, int thread);

}  // namespace blum
