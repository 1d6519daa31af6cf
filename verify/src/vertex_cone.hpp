/// The polar cone of a boundary vertex: whose foot the vertex is, and the axis near it.
#pragma once

#include "shape.hpp"

namespace blum::verify {

/// docs/proofs.md, "Which vertices are feet" and "Vertices in a boundary cell".
struct VertexCone {
  enum class Foot : std::uint8_t {
    kNever,  ///< of no point of the solid
    kRay,    ///< at most of points on one ray
    kMaybe,
  };
  Foot foot = Foot::kMaybe;
  bool axis_connected = false;  ///< it is certain that the axis near the vertex is connected
};

[[nodiscard]] VertexCone vertex_cone(const Shape& shape, std::uint32_t vertex);

/// Does the polar cone of v meet the box, which is a rectangle, a segment or a point?
[[nodiscard]] bool polar_cone_meets(const Shape& shape, std::uint32_t v, const Box3& box);

}  // namespace blum::verify
