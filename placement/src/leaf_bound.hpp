/// The two-sided Hausdorff distance between the medial axis and triangles that stand for it, inside
/// one leaf (docs/proofs.md, "Distance between axis and complex").
#pragma once

#include <array>
#include <atomic>
#include <optional>
#include <vector>

#include "axis_distance.hpp"
#include "blum/arrangement/production_engine.hpp"

namespace blum {

/// A triangle of the complex in a leaf. Working frame.
struct LeafTriangle {
  std::array<Point3, 3> corner;
  std::array<bool, 3> on_rim{};  ///< lies on a convex edge, which bounds the axis
  SiteGroup a, b;                ///< of the sheet that it belongs to
  bool well_placed = false;      ///< all corners are on the axis, and the sheet has two sides
};

/// What one thread bounds with.
struct BoundTools {
  const SiteGeometry& geometry;
  ProductionEngine& engine;
  const SiteTree& tree;
  const InsideOracle& inside;
  const std::atomic<bool>& stop;
  /// How often it was looked: boxes for points of the axis, points of the triangles.
  std::size_t boxes = 0, points = 0;
};

/// Is every point of the triangles certainly within `target` of the axis, and every point of the
/// axis in the leaf within `target` of a triangle? Returns the largest bound that was used, at most
/// `target`; nullopt: not shown (it may be true at a finer look, which is not worth it). Where not
/// all triangles are well placed, of each it must be shown by the sides of its own sheet: smaller
/// leaves place more points.
[[nodiscard]] std::optional<double> bound_in_leaf(BoundTools& tools, const LeafSides& leaf,
                                                  const std::vector<LeafTriangle>& triangles,
                                                  double target);

struct LeafBound {
  double bound = 0;          ///< a certain one
  bool fine_enough = false;  ///< bound_in_leaf has shown it for the target
};

/// bound_in_leaf for `target`; where that shows nothing, by any sides and with distances by way of
/// points whose own is known, for the target, twice the target and so on; until `diameter` of the
/// leaf, which is always a bound.
[[nodiscard]] LeafBound least_bound_in_leaf(BoundTools& tools, const LeafSides& leaf,
                                            const std::vector<LeafTriangle>& triangles,
                                            double target, double diameter);

}  // namespace blum
