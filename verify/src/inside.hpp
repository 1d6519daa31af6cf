/// Is a point inside the solid? By crossings of axis-parallel rays, exactly.
#pragma once

#include <optional>

#include "shape.hpp"

namespace blum::verify {

/// nullopt where the rays along all axes touch an edge of the surface, or x lies on it.
[[nodiscard]] std::optional<bool> is_inside(const Shape& shape, const Point3& x);

/// Sign of the turn of p, q and (u, v), projected along `axis`.
[[nodiscard]] int turn(int axis, const Point3& p, const Point3& q, double u, double v);

}  // namespace blum::verify
