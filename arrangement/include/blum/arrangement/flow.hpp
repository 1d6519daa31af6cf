/// Where the flow towards the boundary can leave a cell.
#pragma once

#include "blum/kernel/point.hpp"
#include "blum/kernel/site_geometry.hpp"

namespace blum {

/// Is (y - foot of y) . (outward * e_axis) > 0 at every point y of the rectangle that `site`
/// governs? Then no segment from a point to its foot on `site` leaves through the rectangle in the
/// direction outward * e_axis (outward = +-1). False also means "not certain".
/// Source: docs/proofs.md, Theorem E'.
[[nodiscard]] bool never_leaves(const SiteGeometry& geometry, SiteId site, const Rect& rect,
                                int outward);

}  // namespace blum
