/// Exact test of which points of a rectangle or segment a boundary vertex may have as foot.
#pragma once

#include <cstdint>

#include "blum/kernel/point.hpp"
#include "blum/kernel/solid.hpp"

namespace blum {

/// Does the closed polar cone {x : (x - v).e <= 0 for all edges e at v} meet the closed box
/// [lo, hi]? Requires: lo == hi on at least one axis. Rational arithmetic; for the rare case that
/// outside_polar_cone (local_form.hpp) cannot decide.
[[nodiscard]] bool meets_polar_cone(const Solid& solid, std::uint32_t vertex, const Point3& lo,
                                    const Point3& hi);

}  // namespace blum
