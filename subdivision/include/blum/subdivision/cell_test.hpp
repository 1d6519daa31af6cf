/// The homotopy criterion of one cell.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "blum/arrangement/face_diagram.hpp"
#include "blum/kernel/predicates.hpp"
#include "blum/kernel/site_geometry.hpp"
#include "blum/subdivision/section.hpp"

namespace blum {

enum class CellVerdict : std::uint8_t {
  kAccepted,
  kEuler,        ///< a component of cell ∩ O is not a ball
  kShellInside,  ///< a whole boundary shell lies in the cell
  kVertex,       ///< a boundary vertex near which the axis is not known
  kGraph,        ///< condition (1): the graph is not connected
  kLabel,        ///< condition (2): a site governs two components of the complement
  kCluster,      ///< resolving: the shape is no sheet, seam or junction
  kFace,         ///< a face diagram could not be decided
  kHidden,       ///< Voronoi: a site within the cell whose region does not show on its surface
  kGovernor,     ///< Voronoi, strict: the boundary cell criterion fails
  kSides,        ///< Voronoi, one side: conditions (4) and (5) of docs/proofs.md, "One side"
  kCount,        ///< how many there are
};

/// Faces of a box in the order x low, x high, y low, y high, z low, z high.
[[nodiscard]] Rect box_face(const Box3& box, int face);

struct CellAnswer {
  CellVerdict verdict = CellVerdict::kFace;
  bool conical = false;  ///< accepted by Theorem B about `vertex`
  std::uint32_t vertex = 0xffffffffu;
  bool has_axis = false;    ///< the graph is not empty
  bool curved_cut = false;  ///< Theorem E' joined several components of the graph
  /// Planes that part components of the graph (Theorem E); if accepted, needed for it.
  std::vector<CutPlane> cut;
  int planes_tried = 0;
  /// Accepted by Theorem T: just two pieces of the surface have a label among these.
  std::vector<SiteId> tube;
};

/// What a test asks about the cell beyond its faces.
struct CellOracles {
  /// Predicates::axis_at, or null if it is unknown. Asked for vertices with convex and reflex edges
  /// only. Answers must outlive the test.
  std::function<const Predicates::AxisAtVertex*(std::uint32_t vertex)> axis_at;
  SectionTest section;  ///< empty: no planes are tried
};

/// Tests Theorem B (exactly one boundary vertex in the cell, all candidates incident to it), else
/// Theorem C, of which Theorem A is the case without boundary, with the extensions A', E' and E of
/// docs/proofs.md. `resolve` also asks that each
/// component of the graph has the shape of a sheet, a seam or a junction.
/// Requires: all six diagrams decided, from the same segment diagrams along common edges.
[[nodiscard]] CellAnswer test_cell(const SiteGeometry& geometry, const Box3& box,
                                   std::span<const SiteId> candidates,
                                   std::span<const std::uint32_t> triangles,
                                   const std::array<std::shared_ptr<const FaceDiagram>, 6>& face,
                                   const CellOracles& oracles, bool resolve);

}  // namespace blum
