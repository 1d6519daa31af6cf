/// Normals of triangles, accurate for slivers too.
#pragma once

#include <optional>

#include "blum/kernel/point.hpp"

namespace blum::detail {

/// The unit vector along (b - a) x (c - a), each component within 8 * 2^-53 of the exact one;
/// nullopt if this cannot be promised. Every point of the triangle then is within kThinTriangle
/// times its longest side of that side.
[[nodiscard]] std::optional<Point3> unit_normal(const Point3& a, const Point3& b, const Point3& c);
inline constexpr double kThinTriangle = 0x1p-41;

}  // namespace blum::detail
