/// Sites (features): the vertices, edges and faces of a solid's boundary.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <vector>

#include "blum/kernel/solid.hpp"

namespace blum {

enum class SiteKind : std::uint8_t { kVertex, kEdge, kFace };

/// One number for all sites of a solid: vertices first, then edges, then faces (triangles).
struct SiteId {
  std::uint32_t value = 0;
  friend constexpr auto operator<=>(const SiteId&, const SiteId&) = default;
};

/// Translates between site ids and the elements of one solid.
class SiteIndex {
 public:
  SiteIndex() = default;
  explicit SiteIndex(const Solid& solid)
      : vertices_(static_cast<std::uint32_t>(solid.point.size())),
        edges_(static_cast<std::uint32_t>(solid.edge.size())),
        faces_(static_cast<std::uint32_t>(solid.triangle.size())) {}
  [[nodiscard]] SiteId vertex(std::uint32_t i) const { return {i}; }
  [[nodiscard]] SiteId edge(std::uint32_t i) const { return {vertices_ + i}; }
  [[nodiscard]] SiteId face(std::uint32_t i) const { return {vertices_ + edges_ + i}; }
  [[nodiscard]] SiteKind kind(SiteId s) const {
    return s.value < vertices_            ? SiteKind::kVertex
           : s.value < vertices_ + edges_ ? SiteKind::kEdge
                                          : SiteKind::kFace;
  }
  /// Index of the element within its kind.
  [[nodiscard]] std::uint32_t element(SiteId s) const {
    return s.value < vertices_            ? s.value
           : s.value < vertices_ + edges_ ? s.value - vertices_
                                          : s.value - vertices_ - edges_;
  }
  [[nodiscard]] std::uint32_t size() const { return vertices_ + edges_ + faces_; }

 private:
  std::uint32_t vertices_ = 0, edges_ = 0, faces_ = 0;
};

struct SiteCounts {
  std::size_t vertices = 0, edges = 0, faces = 0;
};

/// Sites that are not degenerate (theory section 1): vertices whose polar cone has an interior,
/// edges that are not flat, all faces.
[[nodiscard]] SiteCounts count_sites(const Solid& solid);

}  // namespace blum
template <>
struct std::hash<blum::SiteId> {
  std::size_t operator()(blum::SiteId s) const noexcept { return s.value; }
};
