/// The theorem by which a leaf was accepted, checked on the diagrams of its six faces.
#pragma once

#include "face.hpp"

namespace blum::verify {

/// Faces of a box in the order x low, x high, y low, ...
[[nodiscard]] Rect face_of(const Box3& box, std::size_t face);

/// Vertices of ∂O inside the box; triangles: all that meet it.
[[nodiscard]] std::vector<std::uint32_t> vertices_in(const Shape& shape, const Box3& box,
                                                     std::span<const std::uint32_t> triangles);

/// Theorem B: exactly one vertex in the cell, all candidates meet in it. Throws Failure.
void check_conical(const Sites& sites, const Box3& box, std::uint32_t vertex,
                   std::span<const Site> candidates, std::span<const std::uint32_t> triangles,
                   const std::array<FaceMap, 6>& face);

/// Theorem C (A where ∂O does not meet the cell) with A' and E'. Throws Failure.
void check_boundary(const Sites& sites, const Box3& box, std::span<const std::uint32_t> triangles,
                    const std::array<FaceMap, 6>& face);

}  // namespace blum::verify
