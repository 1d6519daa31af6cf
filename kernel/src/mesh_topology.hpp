/// The edges of a face list.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace blum {

/// One side of a face: from -> to, in face `face`; the corners are positions in the flat list of
/// all faces' vertices.
struct HalfEdge {
  std::uint32_t low = 0, high = 0;  ///< its two vertices, low < high
  std::uint32_t face = 0;
  std::uint32_t corner_low = 0, corner_high = 0;
  bool forward = false;  ///< runs from low to high
};

/// Half-edges sorted by (low, high, face, forward first): edges are runs of equal (low, high).
class EdgeTable {
 public:
  void reserve(std::size_t n) { half_.reserve(n); }
  /// Adds the sides of a face whose corners are numbered from `first_corner`.
  void add_face(std::uint32_t face, std::span<const std::uint32_t> vertices,
                std::uint32_t first_corner);
  void finish();

  /// Calls visit(span of half-edges) for each edge in the order of (low, high).
  template <class Visit>
  void for_each_edge(Visit&& visit) const {
    for (std::size_t i = 0; i < half_.size();) {
      std::size_t j = i + 1;
      while (j < half_.size() && half_[j].low == half_[i].low && half_[j].high == half_[i].high) {
        ++j;
      }
      visit(std::span(half_).subspan(i, j - i));
      i = j;
    }
  }
  [[nodiscard]] std::size_t edge_count() const;
  /// Number of faces at the edge.
  [[nodiscard]] std::size_t degree(std::uint32_t a, std::uint32_t b) const;

 private:
  std::vector<HalfEdge> half_;
};

}  // namespace blum
