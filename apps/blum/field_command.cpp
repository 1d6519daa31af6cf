// `blum field`: the discrete Voronoi diagram and distance field of a mesh, as files.
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <thread>

#include "blum/gpu/field.hpp"
#include "blum/gpu/field_io.hpp"
#include "blum/gpu/nearest_sites.hpp"
#include "blum/gpu/sides.hpp"
#include "blum/kernel/mesh_or_points.hpp"
#include "blum/kernel/solid.hpp"
#include "blum/kernel/validate.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "field_arguments.hpp"
#include "field_output.hpp"
#include "image_field.hpp"
#include "interrupt.hpp"
#include "report.hpp"
#include "voxel_image.hpp"

namespace blum::app {
namespace {

/// Everything a run has computed.
struct FieldOutcome {
  DistanceField field;
  NearestSites nearest;
  FieldSides sides;
  std::vector<double> signed_distance;
};

std::uint64_t needed_bytes(const FieldArguments& arguments, const SiteSet& sites,
                           const VoxelGrid& grid) {
  if (arguments.order > 1) return (12 * arguments.order) * grid.voxels() + 400 * sites.size();
  return field_memory_bytes(sites, grid, arguments.options) +
         (arguments.is_signed ? 9 * grid.voxels() : 0);
}

void print_plan(const SiteSet& sites, const VoxelGrid& grid, const FieldArguments& arguments,
                const std::string& reason) {
  std::size_t used = 0;
  for (std::uint32_t v = 0; v < sites.points().size(); ++v) used += sites.is_used(v);
  std::cout << "sites:    " << used << " vertices, " << sites.edges().size() << " edges, "
            << sites.polygons() << " faces\n";
  print_grid(grid);
  std::cout << "backend:  " << field_backend_name(arguments.options.backend) << " (" << reason
            << "), " << arguments.options.threads << " threads\n"
            << "memory:   about " << mib(needed_bytes(arguments, sites, grid)) << '\n';
}

Result<FieldOutcome> compute(const FieldArguments& arguments, const SiteSet& sites,
                             const VoxelGrid& grid, const Result<Solid>* solid) {
  FieldOutcome out;
  if (arguments.order > 1) {
    Result<NearestSites> nearest = nearest_sites(sites, grid, arguments.order, arguments.options);
    if (!nearest) return nearest.error();
    out.nearest = std::move(nearest).value();
    return out;
  }
  Result<DistanceField> field = compute_field(sites, grid, arguments.options);
  if (!field) return field.error();
  out.field = std::move(field).value();
  if (solid == nullptr) return out;
  out.sides = sides_of(*solid, out.field, arguments.options.threads);
  out.signed_distance.resize(grid.voxels());
  for (std::size_t v = 0; v < grid.voxels(); ++v) {
    out.signed_distance[v] = signed_distance(out.field, out.sides, v);
  }
  return out;
}

FieldImage image_of(const FieldOutcome& o, const VoxelGrid& grid, std::uint32_t order) {
  if (order > 1) return {grid, order, o.nearest.distance, o.nearest.site, {}};
  const bool is_signed = !o.signed_distance.empty();
  return {grid, 1, is_signed ? o.signed_distance : o.field.distance, o.field.site, o.sides.side};
}

void print_result(const FieldOutcome& o, std::uint32_t order, double seconds) {
  const FieldBound& bound = order > 1 ? o.nearest.bound : o.field.bound;
  std::cout << "bound:    computed - " << number(bound.below) << " <= distance <= computed + "
            << number(bound.above) << ", and " << number(bound.relative) << " relative\n";
  if (is_opengl(o.field.backend) && order == 1) {
    std::cout << "regret:   at most " << number(bound.regret) << '\n';
  }
  const FieldStatistics& s = o.field.statistics;
  if (s.blocks > 0) {
    const auto voxels = static_cast<double>(o.field.site.size());
    std::cout << "work:     " << number(static_cast<double>(s.fragments) / voxels)
              << " evaluations a voxel; " << s.blocks << " parts with "
              << number(static_cast<double>(s.block_sites) / static_cast<double>(s.blocks))
              << " sites each, of which "
              << number(static_cast<double>(s.owner_sites) / static_cast<double>(s.blocks))
              << " own a sample\n"
              << "culling:  efficiency " << number(culling_efficiency(s)) << ", of clamping "
              << number(clamping_efficiency(s, o.field.site.size()));
    if (s.queries > 0) std::cout << "; " << s.queries << " occlusion queries";
    if (s.holes > 0) std::cout << "; " << s.holes << " holes filled by the CPU";
    std::cout << '\n';
  }
  if (!o.sides.side.empty()) {
    std::cout << "sides:    " << o.sides.exact_tests << " samples by the exact test\n";
  }
  std::cout << "time:     " << number(std::round(1000 * seconds) / 1000) << " s\n";
}

int run_mesh_field(FieldArguments arguments) {
  const Result<std::string> reason = resolve_backend(arguments);
  if (const std::string problem = resolved_problem(arguments); !problem.empty()) {
    return report_usage(problem);
  }
  if (!reason) return report(reason.error());
  const Result<PolygonMesh> mesh = read_mesh_or_points(arguments.model);
  if (!mesh) return report(mesh.error());
  const Result<SiteSet> sites = SiteSet::build(soup_of(mesh.value()));
  if (!sites) {
    Error error = sites.error();
    error.file = arguments.model;
    report(error);
    return kInput;
  }
  const Result<VoxelGrid> grid = grid_of(arguments, sites.value().box());
  if (!grid) return report(grid.error());
  std::optional<Result<Solid>> solid;
  if (arguments.is_signed) {
    solid.emplace(build_solid(mesh.value()));
    if (!*solid) return report_invalid(arguments.model, validate_mesh(mesh.value()));
  }
  print_plan(sites.value(), grid.value(), arguments, reason.value());
  const std::uint64_t needed = needed_bytes(arguments, sites.value(), grid.value());
  if (const auto shortage = memory_shortage(needed)) {
    return report_too_large(*shortage + "; --resolution " + size_that_fits(needed, grid.value()) +
                            " would fit");
  }
  if (arguments.is_dry_run) return kSuccess;

  defer_interrupts();
  const auto start = std::chrono::steady_clock::now();
  FieldProgress progress;
  FieldArguments with_progress = arguments;
  with_progress.options.on_progress = [&](double part) { return progress.show(part); };
  const Result<FieldOutcome> outcome =
      compute(with_progress, sites.value(), grid.value(), solid ? &*solid : nullptr);
  if (interrupted_by() != 0) {
    return report_interrupted();
  }
  if (!outcome) return report(outcome.error());
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  print_result(outcome.value(), arguments.order, time.count());

  return write_outputs(image_of(outcome.value(), grid.value(), arguments.order), arguments);
}

int run_field(FieldArguments arguments) {
  if (const std::string problem = arguments_problem(arguments); !problem.empty()) {
    return report_usage(problem);
  }
  return is_voxel_image(arguments.model) ? run_image_field(arguments) : run_mesh_field(arguments);
}

}  // namespace

Command add_field_command(CLI::App& app) {
  CLI::App* field = app.add_subcommand(
      "field", "Compute the distance field and discrete Voronoi diagram of a mesh");
  const auto arguments = std::make_shared<FieldArguments>();
  add_field_options(*field, *arguments);
  return [arguments] { return run_field(*arguments); };
}

}  // namespace blum::app
