/// The geometry of a medial axis: points moved onto it, finer meshes, and how far the result is
/// from the exact axis at most. Topology is not touched: it stays as it is certified, and what is
/// done here is a realization of the complex in space.
///
///   AxisPlacement placement(solid, options);
///   auto axis = compute_medial_axis(solid, medial_options, {}, {}, placement.review());
///   MedialResult drawn = placement.realized(axis.value());
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "blum/kernel/solid.hpp"
#include "blum/medial/medial_axis.hpp"
#include "blum/medial/review.hpp"
#include "blum/placement/mesh.hpp"

namespace blum {

/// Lengths in model units.
struct PlacementOptions {
  /// Leaves are divided until the two-sided Hausdorff distance between result and axis is certainly
  /// at most this. 0: none is asked for, and the bound is the largest diameter of a leaf.
  double epsilon = 0;
  /// Longest edge of the meshes of sheets and of the polylines of seams and rims. 0: that of the
  /// complex, or 0.4 times the root of epsilon times the diagonal where epsilon is asked for.
  double edge_length = 0;
};

/// One review. Seconds.
struct PlacementRound {
  std::size_t leaves = 0;  ///< of the subdivision
  std::size_t failed = 0;  ///< leaves whose bound is more than epsilon
  double bound = 0;        ///< of all, model units
  double since_start_s = 0;
  /// Of this round. Dividing looks ahead: placement and bounds of the parts are in it.
  double refine_s = 0, assemble_s = 0, place_s = 0, mesh_s = 0, bound_s = 0;
};

struct PlacementReport {
  std::size_t moved = 0;        ///< apexes on the sheet, seam or junction that they stand for
  std::size_t on_part = 0;      ///< points on the axis, but only on a part of what meets in them
  std::size_t unconverged = 0;  ///< points of the mesh that stay off the axis
  std::size_t rounds = 0;       ///< of dividing leaves
  std::size_t leaves_by_diameter = 0;  ///< whose bound is their diameter
  std::size_t boxes = 0, points = 0;   ///< looked at to find the bound, in all rounds
  std::vector<PlacementRound> round;  ///< bound against time; the last may be one that was given up
  /// Two-sided, model units; infinite where a cell is undecided.
  double bound = std::numeric_limits<double>::infinity();
  bool reached = false;  ///< it is at most epsilon, or none was asked for
  double place_s = 0, mesh_s = 0, bound_s = 0;
};

class AxisPlacement {
 public:
  /// The solid must outlive this. Requires lengths >= 0.
  AxisPlacement(const Solid& solid, const PlacementOptions& options);
  ~AxisPlacement();

  /// For compute_medial_axis, once. This object must live as long as the run.
  [[nodiscard]] AxisReview review();
  /// Of the last review.
  [[nodiscard]] const PlacementReport& report() const;
  /// The mesh of the last review's complex; the complex itself where no edge length was asked for.
  [[nodiscard]] const AxisMesh& mesh() const;
  /// Sites at each cone's leaf, of the last review.
  [[nodiscard]] const ConeSides& sides() const;
  [[nodiscard]] const SiteGeometry& geometry() const;
  /// with_mesh of the result of the run.
  [[nodiscard]] MedialResult realized(const MedialResult& result) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace blum
