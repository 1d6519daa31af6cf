/// How the production engine decided a face: what a certificate says of it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "blum/kernel/site.hpp"

namespace blum {

/// A direction in the plane of a face, in coordinates (u_axis, v_axis): (u, v), or the left normal
/// of the projected line from one vertex to another.
struct PlaneDirection {
  double u = 0, v = 0;
  std::optional<std::array<std::uint32_t, 2>> line;
};

/// A part of a face, or a cut through one. A face's records are in preorder, the low side of a cut
/// first.
struct PartRecord {
  enum class Kind : std::uint8_t {
    kCutU,  ///< at `cut`
    kCutV,
    kOutside,  ///< the part does not meet the solid
    kStar,     ///< Theorem D' with groups by ties
    kFeet,     ///< Theorem D'' with groups by feet
    kChords,   ///< Theorem D', chords: by `between` and `parted`; groups by ties
    kFeetChords,
    kCone,   ///< Theorem G about `vertex`
    kRim,    ///< the rim of two edges at `vertex`
    kExact,  ///< exact algebra
    kSlice,  ///< Theorem S about `vertex`
    kLink,   ///< the chains at `vertex`
  };
  Kind kind = Kind::kOutside;
  double cut = 0;
  std::vector<SiteId> sites;  ///< all that may govern the part
  /// Of the group that holds the site. Groups that need none are missing.
  std::vector<std::pair<SiteId, PlaneDirection>> direction;
  /// Chords: the group of a gains on that of b along the direction.
  struct Between {
    SiteId a, b;
    PlaneDirection along;
  };
  std::vector<Between> between;
  /// Chords: wherever the first two govern, the third, a face, would be nearer.
  std::vector<std::array<SiteId, 3>> parted;
  std::uint32_t vertex = 0;
  std::array<std::uint32_t, 2> edge{};
  bool plain = true;  ///< of the reasons of ProductionEngine::prefer_plain_reasons alone
};

}  // namespace blum
