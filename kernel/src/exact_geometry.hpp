/// Exact predicates of the mesh checks: a double filter with a proved bound, then Dyadic numbers.
///
/// Contract of all signs here: finite doubles of absolute value <= 2^300; the result is the sign of
/// the real expression, never an approximation.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "blum/kernel/point.hpp"

namespace blum::exact {

/// Sign of det(b-a, c-a): positive when a, b, c turn left.
[[nodiscard]] int orient2d(double ax, double ay, double bx, double by, double cx, double cy);

/// orient2d of the projections along `axis`; equals the sign of ((b-a) x (c-a))[axis].
[[nodiscard]] int orient2d_along(int axis, const Point3& a, const Point3& b, const Point3& c);

/// Sign of ((b-a) x (c-a)) . (d-a): positive when d lies on the side the normal points to.
[[nodiscard]] int orient3d(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// The same signs, decided by exact arithmetic alone (the filters' twins in tests).
[[nodiscard]] int orient2d_exact(double ax, double ay, double bx, double by, double cx, double cy);
[[nodiscard]] int orient3d_exact(const Point3& a, const Point3& b, const Point3& c,
                                 const Point3& d);

/// An axis along which the projection of abc is not degenerate, or -1 when abc is collinear.
[[nodiscard]] int projection_axis(const Point3& a, const Point3& b, const Point3& c);
[[nodiscard]] bool collinear(const Point3& a, const Point3& b, const Point3& c);

/// Closed segments in the projection along `axis`. Requires: p != q and a != b there.
[[nodiscard]] bool segments_meet_along(int axis, const Point3& p, const Point3& q, const Point3& a,
                                       const Point3& b);

using Triangle = std::array<Point3, 3>;

/// Closed point in closed triangle. Requires: t not collinear.
[[nodiscard]] bool point_in_triangle(const Point3& p, const Triangle& t);

/// Closed segment and closed triangle. Requires: p != q, t not collinear.
[[nodiscard]] bool segment_meets_triangle(const Point3& p, const Point3& q, const Triangle& t);

/// Do two triangles, given by vertex indices, meet anywhere outside the simplex that their common
/// indices span? Equal index sets meet. Requires: neither collinear.
[[nodiscard]] bool triangles_meet_improperly(std::span<const Point3> points,
                                             const std::array<std::uint32_t, 3>& s,
                                             const std::array<std::uint32_t, 3>& t);

/// Sign of the volume enclosed by a closed triangle surface, positive for outward normals.
[[nodiscard]] int volume_sign(std::span<const Triangle> surface);

/// The open cone {x : x.(t-v) < 0 for all t in tips}, as the tips whose conditions bound it by
/// faces with an interior, in order around it. Empty if the cone is: that is, if the tips as seen
/// from v are in no open half-space. Requires: no tip equal to v; directions that are all in one
/// plane surround v in it (as they do at a vertex of a closed embedded surface).
[[nodiscard]] std::vector<std::size_t> polar_cone_sides(const Point3& v,
                                                        std::span<const Point3> tips);

}  // namespace blum::exact
