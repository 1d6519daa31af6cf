/// Tubes: a region that passes through a cell (docs/proofs.md, "Theorem T").
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace blum {

/// An arc of a connected graph on a sphere: its ends, and the pieces on its two sides, in no order.
/// kUnknown where a side is not known.
struct SphereArc {
  static constexpr std::uint32_t kUnknown = 0xffffffffu;
  std::array<std::uint32_t, 2> node{};
  std::array<std::uint32_t, 2> piece{kUnknown, kUnknown};
};

/// A path on the sphere crosses an arc; `forward`: from the left to the right of the arc, directed
/// from node[0] to node[1], in one of the two orientations of the sphere, the same for all arcs.
struct Crossing {
  std::uint32_t arc = 0;
  bool forward = true;
};

/// The arcs that a path from piece `from` to piece `to` crosses. A closed walk in the graph parts
/// the two pieces as often as it crosses the path, counted with signs: that count does not depend
/// on the path. How the graph lies on the sphere is not asked for; null where it is not told by the
/// arcs and pieces (`from` and `to` beside blocks of the graph that have one node in common).
[[nodiscard]] std::optional<std::vector<Crossing>> tube_crossings(std::span<const SphereArc> arcs,
                                                                  std::uint32_t from,
                                                                  std::uint32_t to);

}  // namespace blum
