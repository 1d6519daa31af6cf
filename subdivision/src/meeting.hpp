#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "blum/kernel/site_geometry.hpp"

namespace blum {

/// Those of the boundary triangles that may meet the closed box, in the same order.
[[nodiscard]] std::vector<std::uint32_t> triangles_meeting(const SiteGeometry& geometry,
                                                           std::span<const std::uint32_t> triangles,
                                                           const Box3& box);

}  // namespace blum
