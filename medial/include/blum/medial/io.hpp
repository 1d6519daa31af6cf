/// Writing a medial axis to files: .ma (points, edges, faces), .vtp (VTK PolyData), .obj; and what
/// of it is undecided, .undecided.vtp.
///
/// Every writer goes through a temporary file in the same directory and a rename: under the final
/// name there is the old file or the whole new one. Doubles are written so that they read back
/// bit-identical.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "blum/kernel/result.hpp"
#include "blum/kernel/solid.hpp"
#include "blum/medial/medial_axis.hpp"

namespace blum {

/// A text to be written, such as a summary.
struct TextFile {
  std::filesystem::path path;
  std::string text;
};

/// Writes PREFIX.ma, PREFIX.vtp and PREFIX.obj (suffixes appended to `prefix`, dots in it kept),
/// and the texts in `also`. If the result is not certified, also PREFIX.undecided.vtp; if it is, a
/// file of that name from an earlier run is removed. All files are complete before the first gets
/// its name. Error: kOutputNotWritten, with the file.
[[nodiscard]] std::optional<Error> write_medial(const MedialResult& result, const Solid& solid,
                                                const std::filesystem::path& prefix,
                                                std::span<const TextFile> also = {});

/// Text: "nv ne nf", then nv lines "v x y z r", ne lines "e i j", nf lines "f i j k", indices from
/// 0. All vertices, edges and triangles of the complex in their order; two edges may have equal
/// ends.
[[nodiscard]] std::optional<Error> write_ma(const MedialResult& result,
                                            const std::filesystem::path& file);

/// VTK XML PolyData. Points are the vertices of the complex, Lines its seams and free edges (rims,
/// convex edges), Polys its triangles.
///   PointData: radius, on_axis (0/1), kind (ComplexVertex::Kind).
///   CellData:  sheet (-1 on lines), seam (-1 off seams), governor_a, governor_b (site ids; -1 on
///              seams, which have more than two).
///              With angles: angle_lo, angle_hi (degrees, of the part that point or cell belongs
///              to) and theta (the value of the filtration: it stays up to this angle; 360:
///              always), in PointData too.
///   FieldData: governor_offset (points + 1 entries) and governor: the governors of point i are
///              governor[governor_offset[i] .. governor_offset[i + 1]); site_counts (vertices,
///              edges, triangles): a site id counts through the three in this order; solid_points,
///              solid_edges, solid_triangles: the elements meant, in model units; certified (0/1),
///              seed; undecided_box (lo, hi) and undecided_reason (UndecidedReason) per cell;
///              line_edge and triangle_edge: the edges of the complex that a line is and a triangle
///              has (two may have the same ends; sheets are joined across those of two triangles).
///              Of what the file holds: pruned (1: sheets of the axis have been left out); betti
///              (if certified); sheets, seams, junctions, clusters; hausdorff_bound (model units).
///              Pruned ones are counted anew (count_shapes) and have no clusters; a bound is there
///              only if the result is certified, not pruned, not smoothed, and the bound finite.
[[nodiscard]] std::optional<Error> write_vtp(const MedialResult& result, const Solid& solid,
                                             const std::filesystem::path& file);

/// VTK XML PolyData: the undecided cells as boxes, each of eight points and six quadrilaterals, in
/// model units. CellData: reason (UndecidedReason), depth (bisections), cell (number of the box).
[[nodiscard]] std::optional<Error> write_undecided(std::span<const UndecidedCell> cells,
                                                   const std::filesystem::path& file);

/// Wavefront OBJ: "v", "f" (triangles), "l" (seams and free edges), indices from 1.
[[nodiscard]] std::optional<Error> write_obj(const MedialResult& result,
                                             const std::filesystem::path& file);

/// Any text, in the same safe way (summaries).
[[nodiscard]] std::optional<Error> write_text(std::string_view text,
                                              const std::filesystem::path& file);

}  // namespace blum
