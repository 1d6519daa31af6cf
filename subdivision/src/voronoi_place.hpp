/// How the sites of a Voronoi diagram lie to a cell.
#pragma once

#include <cstdint>

#include "blum/kernel/predicates.hpp"

namespace blum {

/// How a closed site lies to a closed box. Planes of the box hold no vertex of the solid. Where
/// that is not certain, kMeets stands for kApart too.
enum class Place : std::uint8_t { kApart, kMeets, kWithin };

struct SitePlace {
  Place place = Place::kApart;
  /// kMeets: how many components its trace on the box's surface has; 0: not known.
  int traces = 0;
  /// kMeets, a triangle: it is the whole section of the box by its plane, so its trace is a closed
  /// curve.
  bool section = false;
  /// Bit f: its border, or the edge, crosses face f (box_face).
  std::uint8_t crossed = 0;

  /// kMeets: is its trace connected? Then paths that no flow crosses may run in its piece of the
  /// surface, off its own trace there; through it, if that is a closed curve.
  [[nodiscard]] bool simple() const { return traces == 1; }
};

[[nodiscard]] SitePlace place_of(Predicates& predicates, SiteId site, const Box3& box);

/// Side of the plane of a triangle that all of a box lies on, by its normal: 1, -1; 0 if that is
/// not certain.
[[nodiscard]] int side_of_plane(const SiteGeometry& geometry, SiteId triangle, const Box3& box);

}  // namespace blum
