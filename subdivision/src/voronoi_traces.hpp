/// Where a triangle meets the surface of a cell.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "blum/kernel/union_find.hpp"
#include "blum/subdivision/voronoi_surface.hpp"
#include "voronoi_place.hpp"

namespace blum {

/// The one piece of the surface that all regions of a site on face f belong to, if there is one.
[[nodiscard]] std::optional<std::uint32_t> piece_on_face(VoronoiSurface& surface,
                                                         const VoronoiSurface::Faces& face,
                                                         SiteId site, int f);

/// The components of a triangle's trace: chains of segments, one at most on each face of the box.
class TraceChains {
 public:
  /// Requires: `place`, that of the triangle, is kMeets, the number of its traces is known, and it
  /// is no section.
  TraceChains(const SiteGeometry& geometry, VoronoiSurface& surface,
              const VoronoiSurface::Faces& face, SiteId triangle, const SitePlace& place);

  /// Else nothing below may be relied on.
  [[nodiscard]] bool known() const { return known_; }
  [[nodiscard]] bool on_face(int f) const { return on_face_[f]; }
  /// One of the faces that the chain of a face runs over, the same for all of these.
  [[nodiscard]] std::uint32_t chain(int f) { return chain_.find(static_cast<std::uint32_t>(f)); }
  /// The piece of the surface that the chain over a face lies in, if that is certain.
  [[nodiscard]] std::optional<std::uint32_t> piece(int f);

 private:
  [[nodiscard]] bool first_of(int f);

  bool known_ = false;
  std::array<bool, 6> on_face_{};
  UnionFind chain_;
  std::array<std::optional<std::uint32_t>, 6> piece_{};  // that the segment on a face lies in
};

}  // namespace blum
