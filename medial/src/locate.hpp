/// Positions of the complex's vertices in double. Topology is decided before; here points are only
/// placed, and what did not converge is said.
#pragma once

#include <span>
#include <vector>

#include "blum/arrangement/face_diagram.hpp"
#include "blum/arrangement/production_engine.hpp"
#include "blum/kernel/inside.hpp"
#include "blum/kernel/site_geometry.hpp"

namespace blum {

struct Placed {
  Point3 position;  ///< working frame
  double radius = 0;
  bool on_axis = false;
  std::vector<SiteId> governors;  ///< sites at that distance, to kTieTolerance
};

/// Working units (the solid's extent is about 1).
inline constexpr double kTieTolerance = 1e-11;

class Locator {
 public:
  Locator(const SiteGeometry& geometry, ProductionEngine& engine, const InsideOracle& inside)
      : geometry_(geometry), engine_(engine), inside_(inside) {}

  /// The essential tie isolated by a breakpoint of a segment.
  [[nodiscard]] Placed tie(const Segment& line, const Breakpoint& breakpoint,
                           std::span<const SiteId> candidates);
  /// An event or cluster of a face. (Voronoi: found by the separating planes of sites that touch
  /// and the distances of others.) Where no common point of its groups is found: a point of its
  /// rectangle inside the solid, not on the axis.
  [[nodiscard]] Placed event(const Rect& rect, const FaceNode& node,
                             std::span<const SiteId> candidates);
  [[nodiscard]] Placed rim(const Rect& rect, const FaceNode& node,
                           std::span<const SiteId> candidates);
  /// Where a boundary edge crosses a face.
  [[nodiscard]] Placed convex_edge(const Rect& rect, const FaceNode& node) const;
  /// Radius and nearest sites of a point that is not claimed to lie on the axis.
  [[nodiscard]] Placed anywhere(const Point3& x, std::span<const SiteId> candidates) const;

 private:
  [[nodiscard]] Placed voronoi_tie(const Segment& line, const Breakpoint& breakpoint,
                                   std::span<const SiteId> candidates);
  [[nodiscard]] Placed voronoi_event(const Rect& rect, const FaceNode& node,
                                     std::span<const SiteId> candidates);

  const SiteGeometry& geometry_;
  ProductionEngine& engine_;
  const InsideOracle& inside_;
};

}  // namespace blum
