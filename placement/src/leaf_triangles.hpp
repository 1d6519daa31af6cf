/// The triangles of a mesh in one leaf, as bounds are computed of.
#pragma once

#include <span>
#include <vector>

#include "blum/kernel/solid.hpp"
#include "blum/placement/mesh.hpp"
#include "leaf_bound.hpp"

namespace blum {

/// `which`: triangles of the mesh, all in the leaf of `sides`.
[[nodiscard]] std::vector<LeafTriangle> leaf_triangles(const Frame& frame, const AxisMesh& mesh,
                                                       std::span<const std::uint32_t> which,
                                                       const LeafSides& sides);

}  // namespace blum
