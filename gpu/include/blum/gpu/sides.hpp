/// The sign of a distance field: exact for solids, explicitly undefined for anything else.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "blum/gpu/field.hpp"
#include "blum/kernel/mesh.hpp"
#include "blum/kernel/result.hpp"
#include "blum/kernel/solid.hpp"

namespace blum {

enum class FieldSide : std::uint8_t {
  kOutside,
  kInside,
  kBoundary,   ///< exactly on the boundary
  kUndefined,  ///< the input bounds no solid
};

struct FieldSides {
  std::vector<FieldSide> side;    ///< by voxel
  std::string reason;             ///< why everything is undefined; empty otherwise
  std::uint64_t exact_tests = 0;  ///< samples decided by the exact test, the others by continuity
};

/// Exact for every sample. Two samples of a row are on one side if one of them is farther from the
/// boundary (certified) than from the other; where that does not hold the exact test decides.
/// Requires: `field` is the field of all faces of the mesh that the solid was built from; if it is
/// an OpenGL backend's, its certificate rests on the driver (FieldBound), and so do the sides.
[[nodiscard]] FieldSides sides_of(const Solid& solid, const DistanceField& field, int threads);
/// The same where there may be no solid: then all sides are undefined, for the reason given.
[[nodiscard]] FieldSides sides_of(const Result<Solid>& solid, const DistanceField& field,
                                  int threads);

/// Negative inside, 0 on the boundary, NaN where the side is undefined.
[[nodiscard]] double signed_distance(const DistanceField& field, const FieldSides& sides,
                                     std::size_t voxel);

}  // namespace blum
