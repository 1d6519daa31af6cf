/// The middle surface of thin walls: sheets of a medial axis between nearly opposite faces.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <vector>

#include "blum/kernel/point.hpp"
#include "blum/kernel/result.hpp"
#include "blum/medial/medial_axis.hpp"

namespace blum {

struct MidsurfaceOptions {
  /// Sheets with a point whose two feet are seen under at least this angle, certainly (the lower
  /// bound). 180 are the feet on parallel faces; beside a T the sheets bend, and stay.
  double opposite_deg = 150;
  /// Model units: sheets that are thicker somewhere are left out.
  double most_thickness = std::numeric_limits<double>::infinity();
};

/// A part of the complex, model units. Sheets meet along the edges that they share there: where
/// walls meet in a T, three triangles have one edge.
struct Midsurface {
  std::vector<Point3> point;
  std::vector<double> thickness;  ///< of each point: twice its distance to the boundary
  std::vector<bool> on_axis;      ///< as in ComplexVertex; others are within the Hausdorff bound
  std::vector<std::array<std::uint32_t, 3>> triangle;
  std::vector<std::int32_t> sheet;                 ///< of each triangle, as in the axis
  std::vector<std::array<std::uint32_t, 2>> line;  ///< edges with other than two triangles
  std::vector<std::int32_t> line_sheets;           ///< triangles at each
  std::size_t sheets = 0, junction_lines = 0;      ///< lines with three triangles or more
  double least = 0, most = 0;                      ///< thickness
  double area = 0;
};

/// Requires angles in the result.
[[nodiscard]] Midsurface midsurface(const MedialResult& axis, const MidsurfaceOptions& options);

/// PREFIX.vtp: PointData thickness, on_axis; CellData sheet (-1 on lines), seam (0 on lines with
/// three triangles or more, else -1), triangles_at (of lines). PREFIX.ply: vertices with thickness,
/// faces with sheet. Error: kOutputNotWritten.
[[nodiscard]] std::optional<Error> write_midsurface(const Midsurface& midsurface,
                                                    const std::filesystem::path& prefix);

}  // namespace blum
