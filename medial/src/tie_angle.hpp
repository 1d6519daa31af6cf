/// How large the angle of two feet is over a box, at points that are equally far from both, and
/// perhaps from a third: bounds of second order.
#pragma once

#include "angle_directions.hpp"

namespace blum {

/// At least the angle between the directions to the feet of a and b, over all points of the box
/// that are equally far from their carriers, and from that of `third` where there is one (null:
/// there is none), and lie in the domains of all of them. All are views over the box. Radians; 0:
/// there is no such point; kPi: no bound, as for two faces, whose angle is the same everywhere.
[[nodiscard]] double angle_on_tie_at_most(const SiteGeometry& geometry, const SiteView& a,
                                          const SiteView& b, const SiteView* third,
                                          const Box3& box);

}  // namespace blum
