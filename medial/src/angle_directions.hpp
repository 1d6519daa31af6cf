/// Bounds on the directions from the points of a box to their feet on the carriers of sites.
///
/// Faces have one direction (their normal); the directions to a vertex fill a cone, those to an
/// edge a wedge, and the widest angle to the direction at the centre is reached in a corner of the
/// box, as long as all corners are within 90 degrees: directions within an angle of less than 90
/// degrees of a given one form a convex cone, and the vector to the carrier is affine in the point.
/// (The cones and wedges of thesis section 5.6.1; where the box comes too near to the carrier there
/// is no bound.) Two more bounds are often better. Where one direction is a face's normal n and w
/// the vector to the other foot, the cosine is (n.w) / |w|, and n.w is affine. And where the two
/// feet are equally far, 2 |w| sin(angle / 2) is the distance of the feet, which is largest in a
/// corner.
///
/// Rounding. Vectors are balls (kernel/ball.hpp): a vector off by r from one of length l is off by
/// an angle of at most asin(r / l). The angle between two double vectors by atan2 of cross and
/// inner product errs by less than 16 ulp of 1 from the products and 4 ulp of pi from the library:
/// kAngleSlack is over a hundred times that.
#pragma once

#include <array>
#include <numbers>
#include <span>
#include <vector>

#include "blum/kernel/ball.hpp"
#include "domain_part.hpp"

namespace blum {

inline constexpr double kAngleSlack = 1e-12;
inline constexpr double kPi = std::numbers::pi;

/// A direction known up to an angle.
struct Direction {
  Point3 vector;       ///< not normalised
  double error = kPi;  ///< radians; kPi: nothing is known
};

/// Directions within an angle of one.
struct Fan {
  Direction axis;
  double spread = kPi;  ///< its error included; kPi: no bound
};

/// Of one site, over a box.
struct SiteView {
  SiteId site;
  Fan all;               ///< about the direction at the centre
  BallVector at_center;  ///< from the centre to its foot on the carrier
  Ball distance;         ///< of the centre from the carrier
  bool is_face = false;
  std::array<RoundedVector, 8> to_foot;  ///< from the corners of the box to their feet
  double reach = 0;    ///< the vector to the foot changes by no more from the centre to any point
  double nearest = 0;  ///< no point of the box is nearer to the carrier
};

/// What is left of a view where only points count that the site governs.
struct Governed {
  bool nowhere = false;  ///< there are none
  Fan fan;
  std::vector<RoundedVector> to_foot;  ///< from points whose hull holds them; not of faces
};

/// Between two directions, radians: certified bounds in [0, pi].
[[nodiscard]] double angle_at_most(const Direction& a, const Direction& b);
[[nodiscard]] double angle_at_least(const Direction& a, const Direction& b);

[[nodiscard]] double angle_at_most(const Fan& a, const Fan& b);

[[nodiscard]] SiteView view_of(const SiteGeometry& geometry, SiteId site, const Box3& box);
[[nodiscard]] Governed governed(const SiteGeometry& geometry, const SiteView& view,
                                const Box3& box);

/// Over all points of the box that are equally far from both carriers.
[[nodiscard]] double angle_at_most(const SiteView& a, const SiteView& b);
/// Over all points of the box that both govern.
[[nodiscard]] double angle_at_most(const SiteView& a, const Governed& part_of_a, const SiteView& b,
                                   const Governed& part_of_b);
/// Over all points of the box.
[[nodiscard]] double angle_at_least(const SiteView& a, const SiteView& b);

/// May the carriers be equally far from some point of the box? `radius`: from the centre to the
/// corners, rounded up. The difference of distances has a gradient of length 2 sin(angle / 2).
[[nodiscard]] bool may_tie(const SiteView& a, const SiteView& b, double radius);

[[nodiscard]] Point3 center_of(const Box3& box);
/// The largest distances from there along the axes, but for one rounding each.
[[nodiscard]] std::array<double, 3> half_widths_of(const Box3& box);
[[nodiscard]] double radius_of(const Box3& box);

}  // namespace blum
