/// Is a cluster of events one degenerate junction?
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "blum/kernel/site_geometry.hpp"

namespace blum {

/// A point of the box at the same distance from all groups (the nearest member counts), to
/// kCommonTolerance of the working extent; found by Gauss-Newton from the centre. Only the reading
/// of the complex depends on it (whether refining a cluster further can help), never its topology.
[[nodiscard]] std::optional<Point3> common_point(const SiteGeometry& geometry,
                                                 std::span<const std::vector<SiteId>> groups,
                                                 const Box3& box);
inline constexpr double kCommonTolerance = 1e-13;

}  // namespace blum
