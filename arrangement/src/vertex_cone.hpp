/// Parts where all sites meet in one vertex and the distance is that to the cone of the boundary.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "local_form.hpp"

namespace blum {

/// A vertex that is a corner of all sites; nullopt if there is none.
[[nodiscard]] std::optional<std::uint32_t> common_vertex(const SiteGeometry& geometry,
                                                         std::span<const LocalForm> forms);

/// Are all feet of points of the range on the sites at v, extended to cones from v, in the sites
/// themselves? False also means "not certain".
[[nodiscard]] bool feet_stay_at(const SiteGeometry& geometry, std::uint32_t v, const Range& range);

}  // namespace blum
