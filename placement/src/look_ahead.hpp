/// Whether a leaf will be fine enough, before its neighbours are known. Decides what is divided;
/// certifies nothing.
#pragma once

#include "blum/medial/leaf_complex.hpp"
#include "leaf_bound.hpp"

namespace blum {

struct LookAhead {
  double target = 0;       ///< working units
  double edge_length = 0;  ///< of the mesh, working units
};

/// Places and meshes the part of the axis in the leaf as if no neighbour divided its faces: is the
/// bound at most the target? With the engines and tools of one thread.
[[nodiscard]] bool fine_enough(const SiteGeometry& geometry, const Leaf& leaf, EngineSet& engines,
                               int thread, BoundTools& tools, const LookAhead& look);

}  // namespace blum
