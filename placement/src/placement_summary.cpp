#include "blum/placement/placement_summary.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace blum {
namespace {

using Json = nlohmann::ordered_json;

template <class... Values>
std::string line(const char* format, Values... values) {
  std::array<char, 512> text;
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

}  // namespace

SummarySection placement_section(const PlacementReport& r, const AxisMesh& mesh, double diagonal) {
  const double percent = 100 * r.bound / diagonal;
  Json rounds = Json::array();
  for (const PlacementRound& round : r.round)
    rounds.push_back({{"leaves", round.leaves},
                      {"failed", round.failed},
                      {"hausdorff_percent", 100 * round.bound / diagonal},
                      {"since_start_s", round.since_start_s},
                      {"refine_s", round.refine_s},
                      {"assemble_s", round.assemble_s},
                      {"place_s", round.place_s},
                      {"mesh_s", round.mesh_s},
                      {"bound_s", round.bound_s}});
  const Json json = {{"moved", r.moved},
                     {"on_part", r.on_part},
                     {"unconverged", r.unconverged},
                     {"rounds", r.rounds},
                     {"reviews", rounds},
                     {"leaves_by_diameter", r.leaves_by_diameter},
                     {"boxes", r.boxes},
                     {"points", r.points},
                     {"hausdorff_bound", r.bound},
                     {"hausdorff_percent", percent},
                     {"epsilon_reached", r.reached},
                     {"mesh",
                      {{"complete", mesh.complete},
                       {"vertices", mesh.complex.vertex.size()},
                       {"edges", mesh.complex.edge.size()},
                       {"triangles", mesh.complex.triangle.size()}}},
                     {"time_s", {{"place", r.place_s}, {"mesh", r.mesh_s}, {"bound", r.bound_s}}}};
  std::string text = std::isfinite(r.bound)
                         ? line("geometry   within %.4g %% of the diagonal%s", percent,
                                r.reached ? "" : " (more than --epsilon: budget out)")
                         : std::string("geometry   no bound");
  text += line("; %zu points of %zu off the axis\n", r.unconverged, mesh.complex.vertex.size());
  text +=
      line("           %zu triangles; %zu rounds, %zu boxes; place %.3f, mesh %.3f, bound %.3f s\n",
           mesh.complex.triangle.size(), r.rounds, r.boxes, r.place_s, r.mesh_s, r.bound_s);
  return {"geometry", json.dump(), text};
}

SummarySection smooth_section(const SmoothReport& r, double diagonal) {
  const double percent = 100 * r.largest_displacement / diagonal;
  const Json json = {{"sheets", r.sheets},
                     {"skipped", r.skipped},
                     {"points", r.points},
                     {"largest_displacement", r.largest_displacement},
                     {"percent", percent}};
  return {"smooth", json.dump(),
          line("smooth     for display, NOT certified: %zu sheets, %zu skipped, points moved by at "
               "most %.3g %%\n",
               r.sheets, r.skipped, percent)};
}

SummarySection reconstruction_section(const ReconstructionError& e, double diagonal) {
  const auto percent = [&](double length) { return 100 * length / diagonal; };
  const Json json = {{"balls", e.balls},
                     {"boundary_to_union_percent",
                      {percent(e.boundary_to_union_lo), percent(e.boundary_to_union_hi)}},
                     {"union_to_boundary_sampled_percent", percent(e.union_to_boundary_sampled)},
                     {"border_samples", e.border_samples}};
  return {"reconstruction", json.dump(),
          line("rebuilt    %zu balls; %% of the diagonal: boundary to union %.4g to %.4g, union to "
               "boundary %.4g (%zu samples)\n",
               e.balls, percent(e.boundary_to_union_lo), percent(e.boundary_to_union_hi),
               percent(e.union_to_boundary_sampled), e.border_samples)};
}

}  // namespace blum
