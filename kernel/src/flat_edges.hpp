/// Which edges of a solid are flat up to noise?
#pragma once

#include <vector>

#include "blum/kernel/solid.hpp"

namespace blum {

/// For each edge: not exactly flat, but the far vertex of each of the two triangles is at most
/// `tolerance` (model units) off the other's plane; in rounded arithmetic. Asking both keeps the
/// edges of slivers out, whose own far vertex is close to every plane through the edge.
[[nodiscard]] std::vector<bool> nearly_flat_edges(const Solid& solid, double tolerance);

}  // namespace blum
