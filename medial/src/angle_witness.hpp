/// Points that certainly lie on the axis, and how large their separation angle certainly is.
#pragma once

#include <optional>

#include "angle_box.hpp"
#include "blum/kernel/inside.hpp"

namespace blum {

/// Looks for a point near `start`, in `within` (a closed part of the leaf), where two sites with
/// nearly opposite roles tie: Newton's method for their carriers from `a` and `b`, then an exact
/// test of the governors at two points p and q on its two sides.
///
/// Why it is certain. All governors of points of the small box around p and q are among `near`. Its
/// points are in the closed sets F_i = {x : i governs x}, i in `near`; split `near` into those
/// whose directions are near that of p's governor and those near that of q's. Both unions are
/// closed, they cover the segment pq, and each holds an end: some x on it is in both, so it has a
/// foot of either kind. The bound is the least angle between directions of different kind over the
/// whole box.
class AngleWitness {
 public:
  AngleWitness(const SiteGeometry& geometry, ProductionEngine& engine, const InsideOracle& inside)
      : geometry_(geometry), engine_(engine), inside_(inside) {}

  /// Radians; nullopt: nothing found. Requires: a role of kind kArc that is alone.
  [[nodiscard]] std::optional<double> on_sheet(const LeafParts& leaf, const AngleRole& role,
                                               const AngleBox& within, const Point3& start,
                                               SiteId a, SiteId b);

  /// The same for a point of the seam, looked for in `search`, a part of `within`: a small
  /// rectangle across it whose exact diagram has a node of three or more regions, all of different
  /// groups. The node stands for a tree whose ends are its arcs: each arc ends in a point with feet
  /// in the regions on its two sides and in a third. The bound is the largest over the arcs of the
  /// least angle between the two.
  [[nodiscard]] std::optional<double> on_seam(const LeafParts& leaf, const AngleRole& role,
                                              const AngleBox& within, const Box3& search);

 private:
  const SiteGeometry& geometry_;
  ProductionEngine& engine_;
  const InsideOracle& inside_;
};

}  // namespace blum
