#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "blum/kernel/predicates.hpp"
#include "blum/kernel/site_geometry.hpp"

namespace blum {

/// Those of the boundary triangles that may meet the closed box, in the same order.
[[nodiscard]] std::vector<std::uint32_t> triangles_meeting(const SiteGeometry& geometry,
                                                           std::span<const std::uint32_t> triangles,
                                                           const Box3& box);

/// Does a boundary edge cross the rectangle? nullopt: it does so on the rectangle's border, or an
/// end lies in its plane.
[[nodiscard]] std::optional<bool> edge_crosses(Predicates& predicates, std::uint32_t edge,
                                               const Rect& rect);

/// Does a triangle whose border misses the box meet it, so that the plane's section of the box lies
/// in the triangle? nullopt: a corner of the box lies in the plane, or an edge on the border.
[[nodiscard]] std::optional<bool> is_section(Predicates& predicates, std::uint32_t triangle,
                                             const Box3& box);

}  // namespace blum
