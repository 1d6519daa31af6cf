/// Partitions of the candidates of a range into groups that can be told apart there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine_context.hpp"
#include "local_form.hpp"

namespace blum {

struct Groups {
  std::vector<std::uint32_t> of;  ///< group of each form
  std::uint32_t count = 0;
  bool cliques = true;  ///< within each group no pair can tie essentially

  /// Connected components of "never tie essentially": the coarsest groups.
  [[nodiscard]] static Groups by_ties(EngineContext& context, std::span<const LocalForm> forms);
  /// Connected components of may_share_foot: the finest groups. Off the axis feet are continuous,
  /// so all governors of a connected part of the range off the axis are in one of them.
  [[nodiscard]] static Groups by_feet(EngineContext& context, std::span<const LocalForm> forms,
                                      const Range& range);

  /// Group of a site; count if it is not among the forms.
  [[nodiscard]] std::uint32_t find(std::span<const LocalForm> forms, SiteId s) const;
  /// Sites of a group.
  [[nodiscard]] std::vector<SiteId> members(std::span<const LocalForm> forms,
                                            std::uint32_t group) const;
  friend bool operator==(const Groups&, const Groups&) = default;
};

/// May the boundary vertex be a foot of a point of the range (inside the solid)? False only if
/// certain. `forms`: the pruned candidates of the range.
[[nodiscard]] bool may_be_foot(EngineContext& context, std::uint32_t vertex,
                               std::span<const LocalForm> forms, const Range& range);

/// May the interior of the boundary edge from v to p hold a foot of a point of the range? False
/// only if certain.
[[nodiscard]] bool may_hold_foot(EngineContext& context, std::uint32_t v, std::uint32_t p,
                                 std::span<const LocalForm> forms);

/// May one point be the foot of a point of the range on both sites? False only if certain. Closed
/// sites of a valid solid meet in a common vertex or edge, or not at all.
[[nodiscard]] bool may_share_foot(EngineContext& context, SiteId a, SiteId b,
                                  std::span<const LocalForm> forms, const Range& range);

/// Corners that two sites have in common.
struct CommonCorners {
  std::array<std::uint32_t, 3> vertex{};
  int count = 0;
};
[[nodiscard]] CommonCorners common_corners(const SiteGeometry& geometry, SiteId a, SiteId b);

}  // namespace blum
