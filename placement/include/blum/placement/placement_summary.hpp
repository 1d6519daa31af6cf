/// What placement did, for the summaries of a run.
#pragma once

#include <optional>

#include "blum/medial/summary.hpp"
#include "blum/placement/placement.hpp"
#include "blum/placement/reconstruction.hpp"
#include "blum/placement/smooth.hpp"

namespace blum {

/// "geometry": {"moved","on_part","unconverged","rounds","reviews": [{"leaves","failed",
/// "hausdorff_percent","since_start_s","refine_s","assemble_s","place_s","mesh_s","bound_s"}],
/// "leaves_by_diameter","boxes","points",
/// "hausdorff_bound","hausdorff_percent","epsilon_reached","mesh": {"complete","vertices","edges",
/// "triangles"},"time_s": {"place","mesh","bound"}}; percents are of `diagonal`, model units.
[[nodiscard]] SummarySection placement_section(const PlacementReport& report, const AxisMesh& mesh,
                                               double diagonal);
/// "smooth": {"sheets","skipped","points","largest_displacement","percent"}
[[nodiscard]] SummarySection smooth_section(const SmoothReport& report, double diagonal);
/// "reconstruction": {"balls","boundary_to_union_percent": [lo, hi],
/// "union_to_boundary_sampled_percent","border_samples"}
[[nodiscard]] SummarySection reconstruction_section(const ReconstructionError& error,
                                                    double diagonal);

}  // namespace blum
