/// What a run did, as JSON (a stable schema, for scripts) and as text for people.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "blum/kernel/flatten.hpp"
#include "blum/kernel/solid.hpp"
#include "blum/medial/medial_axis.hpp"
#include "blum/medial/simplify.hpp"

namespace blum {

/// What another module has to say of a run.
struct SummarySection {
  std::string name;  ///< key of the JSON summary
  std::string json;  ///< its value
  std::string text;  ///< lines for people, each ended by a line break
};

struct SummaryInput {
  std::string model;  ///< as the caller names it
  const Solid* solid = nullptr;
  const MedialResult* result = nullptr;
  double read_s = 0;   ///< reading and validating the file
  double sites_s = 0;  ///< from the mesh to the solid and its sites
  double total_s = 0;
  std::uint64_t peak_memory_bytes = 0;
  std::string version;
  const MedialResult* pruned = nullptr;  ///< simplified(), if the files hold that
  double theta_deg = 0;
  Simplify simplify = Simplify::kHomotopy;
  const FlattenReport* flattened = nullptr;  ///< what was changed before, if anything was asked for
  std::vector<SummarySection> sections;      ///< added at the end, in their order
};

/// Highest resident memory of this process so far; 0 where the system does not tell.
[[nodiscard]] std::uint64_t peak_memory_bytes();

/// One JSON object:
///   {"model", "sites": {"vertices","edges","faces"}, "solid": {"betti"}, "result": {"mode",
///   "certified","betti","sheets","seams","junctions","clusters","leaves","max_depth",
///   "undecided_cells","hausdorff_bound"}, "cuts": {"leaves","planes_tried"}, "stages":
///   {"filter","extended","exact"}, "time_s": {"read","sites","subdivide","assemble","total"},
///   "peak_memory_bytes", "seed", "threads", "version"}
/// "cuts": leaves accepted thanks to planes that miss the axis, and planes tried in all.
/// result.betti is null unless the result is certified. Only if cells are undecided there are two
/// more keys: "undecided_by_reason": {"depth": 3, ...}, with the reasons that occur, and
/// "undecided": [{"reason", "depth", "lo", "hi"}], at most the first 1000 of them. Only if the
/// solid was flattened there is "coplanar": {"tolerance","vertices_moved","largest_displacement",
/// "slivers_dropped","flat_edges_before","flat_edges_after","nearly_flat_edges_before",
/// "nearly_flat_edges_left"}; "solid" and all that follows are then about the changed solid.
/// Only if angles were wanted there is "angles": {"boxes","parts_wider","widest_deg","time_s"}, and
/// only if the files hold a simplified axis "pruned":
/// {"theta_deg","method","betti","sheets","seams", "curves","junctions","area"}, counted anew
/// (count_shapes); "result" is about the whole axis.
/// Only in Voronoi mode there is "voronoi": {"regions","pieces_euler","euler","criterion","margin",
/// "side","regions_inside","regions_outside","solid_euler"} (VoronoiCheck) and "tubes", the leaves
/// accepted by Theorem T; pieces_euler is null if the sides of the box are not decided, euler if
/// cells are not. Numbers that are not finite become null. Requires solid and result.
[[nodiscard]] std::string summary_json(const SummaryInput& input);

/// The same for people: lines, each ended by a line break.
[[nodiscard]] std::string summary_text(const SummaryInput& input);

}  // namespace blum
