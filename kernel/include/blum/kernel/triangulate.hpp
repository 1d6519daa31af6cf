/// Faces to triangles, with exact predicates and one fixed rule.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "blum/kernel/point.hpp"

namespace blum {

enum class FaceShape : std::uint8_t {
  kGood,
  kGoodNonPlanar,  ///< more than three vertices, not in one plane; triangulated all the same
  kDegenerate,     ///< a repeated vertex or position in a row, or zero area
  kNonSimple,      ///< the boundary meets itself
};

/// Appends the triangles of one face to `out` (same turning sense, no zero-area triangle) unless
/// its shape is bad. Requires: at least 3 valid indices, finite points.
///
/// Rule: the polygon is projected along the axis on which its (Newell) normal is largest, the
/// lowest axis on ties; if the projection is not simple, along the next axis. There ears are cut,
/// starting at the face's smallest vertex index and going on behind each ear. The result does not
/// depend on which vertex the file names first, and not on translation or positive scaling.
FaceShape triangulate_face(std::span<const Point3> points, std::span<const std::uint32_t> face,
                           std::vector<std::array<std::uint32_t, 3>>& out);

}  // namespace blum
