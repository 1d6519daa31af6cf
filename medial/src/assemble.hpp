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

/// The common rectangle of two leaves, and where its arcs are in the complex.
struct GluedInterface {
  std::shared_ptr<const FaceDiagram> diagram;
  std::uint32_t low = 0, high = 0;  ///< leaves
  std::uint32_t donor = 0;          ///< the leaf whose candidates serve, where it is no face of one
  std::uint32_t first_edge = 0;     ///< of its arcs, which follow in their order
};

struct Assembly {
  CellComplex complex;
  std::vector<std::uint32_t> undecided;   ///< accepted leaves with an interface in bad position
  std::vector<GluedInterface> interface;  ///< medial axes only: for certificates
  bool stopped = false;                   ///< the run's watch has fired: there is no complex
};

/// Glues the cones of all accepted leaves along their minimal interfaces: every interface
/// rectangle, interface edge and tie on it is one object that both sides refer to. Undecided
/// leaves, and those that turn out to have an undecidable interface, are left out. Positions and
/// radii are in model units. The same for any number of threads.
[[nodiscard]] Assembly assemble(const SiteGeometry& geometry, const Subdivision& subdivision,
                                EngineSet& engines);

}  // namespace blum
