/// How large the angle of two feet is over a box, at points that are equally far from both, and
/// perhaps from a third: bounds of second order, for sites that are not both faces.
#pragma once

#include "angle_directions.hpp"

namespace blum {

/// At least the angle between the directions to the feet on the carriers of a and b, over all
/// points of the box that are equally far from them, and from `third` where there is one (null:
/// there is none). All are views over the box. Radians; kPi: no bound.
[[nodiscard]] double angle_on_tie_at_most(const SiteGeometry& geometry, const SiteView& a,
                                          const SiteView& b, const SiteView* third,
                                          const Box3& box);

}  // namespace blum
