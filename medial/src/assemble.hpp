/// Leaves -> cell complex (theory section 4).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "blum/kernel/site_geometry.hpp"
#include "blum/medial/complex.hpp"
#include "blum/subdivision/engine_set.hpp"
#include "blum/subdivision/subdivision.hpp"

namespace blum {

/// The diagram on a rectangle between two leaves that is no face of either.
struct OwnInterface {
  std::shared_ptr<const FaceDiagram> diagram;
  std::uint32_t leaf = 0;  ///< whose candidates it was made with
};

struct Assembly {
  CellComplex complex;
  std::vector<std::uint32_t> undecided;  ///< accepted leaves with an interface in bad position
  std::vector<OwnInterface> own_interface;
  bool stopped = false;                  ///< the run's watch has fired: there is no complex
};

/// Glues the cones of all accepted leaves along their minimal interfaces: every interface
/// rectangle, interface edge and tie on it is one object that both sides refer to. Undecided
/// leaves, and those that turn out to have an undecidable interface, are left out. Positions and
/// radii are in model units. The same for any number of threads.
[[nodiscard]] Assembly assemble(const SiteGeometry& geometry, const Subdivision& subdivision,
                                EngineSet& engines);

}  // namespace blum
