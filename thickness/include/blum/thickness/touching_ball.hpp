/// The largest ball inside a solid that touches its boundary at a given point of a face.
///
/// Let p lie inside a face with unit inner normal n. The ball with radius r that touches there has
/// its centre at p + r n, and a point q of the boundary lies on it for r = |q - p|^2 / (2 n.(q -
/// p)), if n.(q - p) > 0. So the largest ball has the least such radius over all q. Over a closed
/// segment the quotient of a convex quadratic and a positive linear function is quasi-convex, and
/// over a plane least where the ball is tangent: the minimum over a triangle has a closed form.
#pragma once

#include <cstdint>
#include <span>

#include "blum/kernel/point.hpp"
#include "blum/kernel/site_geometry.hpp"
#include "blum/kernel/site_tree.hpp"

namespace blum {

/// Radius of the ball that touches at p with inner normal n and first meets a site, and where.
struct Touch {
  double radius;  ///< infinite if the site is not in front of the face
  Point3 foot;
};
/// Working frame, doubles alone: no bound.
[[nodiscard]] Touch touch_site(const SiteGeometry& geometry, SiteId site, const Point3& p,
                               const Point3& n);

/// Working frame. Certified: the radius of the largest ball that touches at the point of the face
/// nearest to the sample lies in [lower, upper].
struct TouchingBall {
  double radius = 0, lower = 0, upper = 0;
  Point3 centre;
  Point3 foot;           ///< where it also touches
  SiteId site;           ///< what it touches there; of several that tie, one
  double angle_deg = 0;  ///< between the directions from the centre to the sample and the foot
};

/// `partners`: sites that the ball may meet, from the medial axis; they save work, and where none
/// of them is the right one, the result is so all the same. Requires: p within kOnSite of the
/// face's interior. How it is certified: docs/thickness.md.
[[nodiscard]] TouchingBall touching_ball(const SiteGeometry& geometry, const SiteTree& tree,
                                         std::uint32_t face, const Point3& p,
                                         std::span<const SiteId> partners);

}  // namespace blum
