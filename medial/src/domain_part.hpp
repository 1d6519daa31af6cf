/// The part of a box that a site may govern: its points in the site's domain.
#pragma once

#include <vector>

#include "blum/kernel/site_geometry.hpp"

namespace blum {

/// A point or vector known up to a distance.
struct RoundedVector {
  Point3 mid;
  double rad = 0;
};

/// Points whose convex hull holds the box's part in the domain of the site; none: there is no such
/// part. The corners of the box, cut by one condition of the domain after the other where that
/// makes few points.
[[nodiscard]] std::vector<RoundedVector> domain_part(const SiteGeometry& geometry, SiteId site,
                                                     const Box3& box);

}  // namespace blum
