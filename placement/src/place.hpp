/// Moves the points of a complex onto the axis.
#pragma once

#include <atomic>
#include <cstddef>

#include "blum/kernel/inside.hpp"
#include "blum/kernel/site_geometry.hpp"
#include "blum/medial/complex.hpp"
#include "blum/medial/parts.hpp"
#include "blum/placement/mesh.hpp"

namespace blum {

struct PlacedPoints {
  std::size_t moved = 0;  ///< apexes on the axis now, where all that meets in them ties
  std::size_t on_part =
      0;  ///< points moved onto the axis, but only onto some of what meets in them
  std::size_t unconverged =
      0;  ///< vertices that are not known to be on the axis (on_axis == false)
};

struct PlaceOptions {
  const std::atomic<bool>* stop = nullptr;  ///< points that are left when it becomes true stay
  int threads = 1;                          ///< the places do not depend on it
};

/// Each apex goes to a point of its leaf that is equally far from all sides of the leaf (a point of
/// its sheet, seam, junction or degenerate junction); where none is found, to one on a seam or a
/// sheet over its base; else it stays. A cluster of events that is not on the axis goes to such a
/// point on its leaves' common face. Other vertices stay.
[[nodiscard]] PlacedPoints place_points(const SiteGeometry& geometry, const InsideOracle& inside,
                                        const Parts& parts, const ConeSides& sides,
                                        CellComplex& complex, const PlaceOptions& options);

}  // namespace blum
