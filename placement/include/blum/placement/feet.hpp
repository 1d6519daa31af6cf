/// The way from sheets to the boundary and back: each sheet has two sides, and each side of it a
/// patch of the boundary, the feet of its points.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "blum/kernel/result.hpp"
#include "blum/medial/medial_axis.hpp"
#include "blum/placement/placement.hpp"

namespace blum {

struct SheetFeet {
  struct Foot {
    Point3 position;               ///< model units, on the boundary
    std::uint32_t axis_point = 0;  ///< vertex of the mesh
    SiteId site;                   ///< that holds it, a nearest one of its side
    bool is_foot = false;  ///< as far from the axis point as the boundary, to 1e-9 of the extent
  };
  /// The image of a triangle of the mesh. Flat where a side is an edge or a vertex of the boundary.
  struct Patch {
    std::array<std::uint32_t, 3> foot{};  ///< in the order of the triangle's corners
    std::uint32_t triangle = 0;           ///< of the mesh
    std::uint8_t side = 0;                ///< 0 or 1, the same all over a sheet that has two sides
    SiteId site;                          ///< nearest to the triangle's centre on that side
  };
  std::vector<Foot> foot;
  std::vector<Patch> patch;   ///< two for each triangle, side 0 first
  std::size_t one_sided = 0;  ///< sheets whose sides could not be told apart all over
};

/// Feet of the vertices of the placement's mesh on the sides of each triangle there. Positions are
/// double: closest points (closest_point.hpp).
[[nodiscard]] SheetFeet sheet_feet(const AxisPlacement& placement, const Parts& parts);

/// VTK PolyData. Points are the feet, Polys the patches. PointData: axis_point (point of
/// PREFIX.vtp), site, is_foot (0/1). CellData: sheet, side (0/1), axis_triangle (the triangle's
/// number among the Polys of PREFIX.vtp), site (numbered as there), element (of the solid: vertex,
/// edge or triangle) and element_kind (0, 1, 2). FieldData: one_sided. The numbers are those of the
/// whole axis, not of one that --theta has simplified.
[[nodiscard]] std::optional<Error> write_feet(const SheetFeet& feet, const Parts& parts,
                                              const Solid& solid,
                                              const std::filesystem::path& file);

}  // namespace blum
