/// Separation angles of the parts of a medial axis (theory section 5): the separation angle of a
/// point is the largest angle between the directions to two of its feet; that of a part is the
/// supremum over its points.
///
/// What is a point of which part? In a leaf the sites fall into groups, one for each connected
/// piece of the leaf minus the axis. A point of the axis whose feet are in two groups belongs to
/// the sheets whose arcs on the leaf's surface part these groups; one with more groups to the seams
/// that end in nodes where all of these meet; and any other to the apex of the leaf's cones, or the
/// one part that the apex lies on. So each point of the axis is counted by a part of K in the same
/// leaf, and parts of angle >= theta come within the Hausdorff bound of every point of angle >=
/// theta.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "blum/medial/complex.hpp"
#include "blum/medial/filtration.hpp"
#include "blum/medial/parts.hpp"

namespace blum {

/// Degrees. Certified: lo <= supremum <= hi. All roundings are covered.
struct AngleInterval {
  double lo = 0, hi = 180;
  [[nodiscard]] double width() const { return hi - lo; }
};

struct AngleOptions {
  bool wanted = false;
  double tolerance_deg = 1;            ///< a part is refined until its interval is as narrow
  std::size_t boxes_per_leaf = 20000;  ///< or so many boxes looked at for each leaf that it is in
  /// Where small boxes tell nothing it is the leaf that is too coarse to say which part a point
  /// belongs to: so many times such leaves are divided, and all parts bounded anew.
  int refinements = 24;
  /// Degrees: the certificate, where one is written, holds the collapses of values below this, as
  /// simplified() by Simplify::kHomotopy has them. Requires `wanted`.
  std::optional<double> certified_theta_deg{};
};

struct PartAngles {
  std::vector<AngleInterval> sheet, seam;  ///< as numbered in Parts
  /// Of each vertex of K where seams end (junctions, clusters); of others the interval of the part
  /// that they lie inside. Vertices on the boundary of the solid are not on the axis: 0, 0.
  std::vector<AngleInterval> vertex;
  std::vector<bool> is_node;  ///< vertices that are a part of their own
  double widest_deg = 0;      ///< over all sheets, seams and nodes but clusters
  std::size_t wide = 0;       ///< of these, the parts wider than the tolerance
  std::size_t boxes = 0;      ///< looked at
  /// Of the wide parts, the leaves where small boxes told nothing, that of the widest part first.
  std::vector<std::uint32_t> coarse_leaves;
};

/// The cost of each cell: the upper bound of the part it belongs to. Convex boundary edges, which
/// are not on the axis, cost nothing.
[[nodiscard]] CellValues cell_costs(const CellComplex& complex, const Parts& parts,
                                    const PartAngles& angles);

}  // namespace blum
