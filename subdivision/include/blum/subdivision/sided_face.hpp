/// Which part of a Voronoi diagram on a rectangle lies inside the solid.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "blum/arrangement/face_diagram.hpp"
#include "blum/kernel/inside.hpp"
#include "blum/kernel/predicates.hpp"

namespace blum {

/// Does the region of an edge or vertex lie inside the solid? (It lies on one side wholly.)
/// Requires: predicates of the Voronoi geometry; a candidate that is no face.
[[nodiscard]] bool region_is_inside(const Predicates& predicates, SiteId site);

/// The diagram meets the solid's boundary in the edges of the triangulation only, so on a rectangle
/// in the points where these cross it.
struct SidedFace {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  struct Crossing {
    std::uint32_t edge = 0;
    std::uint32_t node = kNone;  ///< it is in this node
    std::uint32_t arc = kNone;   ///< or in this arc; one of the two is kNone
  };
  bool decided = false;
  std::vector<Crossing> crossing;  ///< in the order of their edges
  /// For each arc: do its ends `from` and `to` lie inside? They differ if a crossing is in the arc.
  std::vector<std::array<bool, 2>> inside;
};

/// Triangles: a superset of those that meet the rectangle. Not decided where two crossings are not
/// told apart or a component of the graph has neither a site nor a node that tells its side.
/// Requires: a decided diagram of the Voronoi geometry.
[[nodiscard]] SidedFace sided_face(Predicates& predicates, const InsideOracle& inside,
                                   const FaceDiagram& face,
                                   std::span<const std::uint32_t> triangles);

}  // namespace blum
