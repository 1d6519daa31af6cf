/// Is a point inside the solid? By crossings of axis-parallel rays, exactly.
#pragma once

#include <optional>

#include "shape.hpp"

namespace blum::verify {

/// nullopt where the rays along all axes touch an edge of the surface, or x lies on it.
[[nodiscard]] std::optional<bool> is_inside(const Shape& shape, const Point3& x);

/// The triangles, of some, that a segment crosses; nullopt where it meets an edge of the surface,
/// or ends on it.
[[nodiscard]] std::optional<std::vector<std::uint32_t>> triangles_crossed(
    const Shape& shape, const Segment& segment, std::span<const std::uint32_t> triangles);

}  // namespace blum::verify
