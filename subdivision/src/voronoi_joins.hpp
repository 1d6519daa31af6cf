/// Condition (3) of Theorem V: paths that no flow crosses join the components of the graph on the
/// surface of a cell.
#pragma once

#include <functional>

#include "blum/kernel/site_geometry.hpp"
#include "blum/subdivision/voronoi_surface.hpp"
#include "voronoi_place.hpp"

namespace blum {

/// Requires: a graph that is not empty.
[[nodiscard]] bool joined_by_flow(const SiteGeometry& geometry, VoronoiSurface& surface,
                                  const VoronoiSurface::Faces& face,
                                  const std::function<SitePlace(SiteId)>& place);

}  // namespace blum
