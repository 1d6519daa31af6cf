/// Stretches of a cell's edges within one region.
#pragma once

#include <vector>

#include "blum/arrangement/face_diagram.hpp"
#include "voronoi_place.hpp"

namespace blum {

struct EdgeInterval {
  std::size_t index = 0;
  Point3 low, high;  ///< two points of the closed stretch
};

[[nodiscard]] inline std::vector<EdgeInterval> intervals(const SegmentDiagram& line) {
  const Segment& s = line.segment;
  std::vector<EdgeInterval> all;
  for (std::size_t k = 0; k < line.interval.size(); ++k) {
    const double low = k == 0 ? s.t0 : line.breakpoint[k - 1].hi,
                 high = k < line.breakpoint.size() ? line.breakpoint[k].lo : s.t1;
    if (low > high) continue;  // between two neighbouring doubles
    all.push_back({k, point_on(s.axis, low, s.u, s.v), point_on(s.axis, high, s.u, s.v)});
  }
  return all;
}

/// Is the site a triangle whose plane certainly crosses the stretch? (If the stretch is in its
/// region, it does so in the triangle.)
[[nodiscard]] inline bool crosses_plane(const SiteGeometry& geometry, SiteId site,
                                        const EdgeInterval& i) {
  return geometry.index().kind(site) == SiteKind::kFace &&
         side_of_plane(geometry, site, {i.low, i.low}) *
                 side_of_plane(geometry, site, {i.high, i.high}) <
             0;
}

}  // namespace blum
