/// Exact validation of a polygon mesh: every way it fails to bound a solid, as data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "blum/kernel/mesh.hpp"
#include "blum/kernel/point.hpp"

namespace blum {

/// Stable names: defect_kind_name. All tests are exact on the coordinates as read.
enum class DefectKind : std::uint8_t {
  kNoFaces,                  ///< the mesh has no face
  kNonFiniteCoordinate,      ///< NaN or infinite (vertices)
  kCoordinateOutOfRange,     ///< |x| > 2^200 (vertices)
  kIndexOutOfRange,          ///< a face names a vertex that does not exist (faces)
  kDegenerateFace,           ///< fewer than 3 vertices, a repeated vertex, or zero area (faces)
  kNonSimplePolygon,         ///< a polygon whose boundary meets itself (faces)
  kNonPlanarPolygon,         ///< warning: triangulated by a fixed rule, below (faces)
  kDuplicateFace,            ///< same set of vertices as an earlier face (faces)
  kDuplicateVertex,          ///< warning: same coordinates as an earlier vertex (vertices)
  kIsolatedVertex,           ///< warning: in no face; dropped (vertices)
  kBoundaryEdge,             ///< an edge with one face (vertex pairs)
  kNonManifoldEdge,          ///< an edge with three or more faces (vertex pairs)
  kNonManifoldVertex,        ///< several fans of faces meet in the vertex: pinched (vertices)
  kInconsistentOrientation,  ///< both faces run along the edge in one direction (vertex pairs)
  kSelfIntersection,         ///< two faces meet outside their common vertex or edge (face pairs)
  kShellNesting,             ///< a shell's orientation contradicts its depth of nesting (shells)
  kInvertedSolid,            ///< warning: all normals point inwards; the solid is turned round
};

enum class Severity : std::uint8_t { kWarning, kError };

[[nodiscard]] const char* defect_kind_name(DefectKind kind);
[[nodiscard]] const char* severity_name(Severity severity);
[[nodiscard]] Severity defect_severity(DefectKind kind);
/// What DefectExample::elements counts: "vertex", "face", "edge" (two vertices), "face_pair",
/// "shell" (the shell's first face), or "mesh" (no elements).
[[nodiscard]] const char* defect_element_name(DefectKind kind);

struct DefectExample {
  std::vector<std::size_t> elements;  ///< indices into the mesh as given
  std::vector<Point3> points;         ///< coordinates that show the place, model units
};

struct Defect {
  DefectKind kind = DefectKind::kNoFaces;
  std::size_t count = 0;
  bool count_is_lower_bound = false;    ///< the search stopped at a million
  std::vector<DefectExample> examples;  ///< the first ones in index order, at most 5
};

struct ValidationReport {
  std::vector<Defect> defects;  ///< in the order of DefectKind, at most one a kind
  /// No defect of severity error: build_solid accepts the mesh.
  [[nodiscard]] bool valid() const;
  [[nodiscard]] const Defect* find(DefectKind kind) const;
  /// "2 boundary_edge (edge 3 7 at (0,0,1)), ..." for errors only, or for warnings only.
  [[nodiscard]] std::string summary(Severity severity) const;
};

/// All defect classes are looked for, also after the first is found; a check leaves out only the
/// faces that it cannot be asked of (degenerate ones, say). Shells are checked when everything
/// else holds. Deterministic.
///
/// Polygons are triangulated by one rule, planar or not: project along the axis on which the
/// (Newell) normal is largest, the lowest on ties, along the next one if the projection is not
/// simple; there cut ears, from the polygon's smallest vertex index on, going on behind each ear.
/// The triangulation then is the solid.
[[nodiscard]] ValidationReport validate_mesh(const PolygonMesh& mesh);

}  // namespace blum
