#include "mesh_topology.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace blum {

void EdgeTable::add_face(std::uint32_t face, std::span<const std::uint32_t> vertices,
                         std::uint32_t first_corner) {
  const auto n = static_cast<std::uint32_t>(vertices.size());
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t l = (k + 1) % n;
    HalfEdge h;
    h.face = face;
    h.forward = vertices[k] < vertices[l];
    h.low = std::min(vertices[k], vertices[l]);
    h.high = std::max(vertices[k], vertices[l]);
    h.corner_low = first_corner + (h.forward ? k : l);
    h.corner_high = first_corner + (h.forward ? l : k);
    half_.push_back(h);
  }
}

void EdgeTable::finish() {
  std::sort(half_.begin(), half_.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tuple(a.low, a.high, a.face, !a.forward) <
           std::tuple(b.low, b.high, b.face, !b.forward);
  });
}

std::size_t EdgeTable::edge_count() const {
  std::size_t n = 0;
  for_each_edge([&](std::span<const HalfEdge>) { ++n; });
  return n;
}

std::size_t EdgeTable::degree(std::uint32_t a, std::uint32_t b) const {
  const std::pair key(std::min(a, b), std::max(a, b));
  const auto first = std::partition_point(half_.begin(), half_.end(), [&](const HalfEdge& h) {
    return std::pair(h.low, h.high) < key;
  });
  auto last = first;
  while (last != half_.end() && last->low == key.first && last->high == key.second) ++last;
  return static_cast<std::size_t>(last - first);
}

}  // namespace blum
