/// Which cells of a scene are to be seen.
#pragma once

#include <cstdint>
#include <vector>

#include "blum/show/scene.hpp"

namespace blum {

/// Numbers of triangles and lines of the scene. Lines between two triangles of one sheet, as a seam
/// is once the third sheet has gone, are neither.
struct VisibleCells {
  std::vector<std::uint32_t> triangle;
  std::vector<std::uint32_t> seam;  ///< lines with three triangles or more, or with none
  std::vector<std::uint32_t> rim;   ///< lines with one triangle
};

/// The axis simplified by theta (degrees): cells whose value is at least theta. All cells of a
/// scene without such values.
[[nodiscard]] VisibleCells visible_cells(const Scene& scene, double theta_deg);

}  // namespace blum
