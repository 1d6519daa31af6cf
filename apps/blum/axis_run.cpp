#include "axis_run.hpp"

#include <iostream>
#include <utility>

#include "blum/kernel/mesh.hpp"
#include "blum/kernel/point_algebra.hpp"
#include "blum/placement/placement.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "interrupt.hpp"
#include "progress_bar.hpp"
#include "report.hpp"
#include "threads_option.hpp"

namespace blum::app {
void add_axis_options(CLI::App& command, AxisArguments& arguments) {
  MedialOptions& options = arguments.options;
  command.add_option("MODEL", arguments.model, "OFF, OBJ, STL or PLY")->required();
  command
      .add_option(
          "--epsilon", arguments.epsilon,
          "Divide all leaves that meet the axis down to this fraction of the diagonal, which\n"
          "then bounds how far the complex is from the axis; 0: as coarse as the topology\n"
          "allows")
      ->check(CLI::Range(0.0, 1.0))
      ->check(kNotNan)
      ->capture_default_str();
  command.add_option("--seed", options.seed, "Of the cutting planes, and of samples")
      ->check(kDigits)
      ->capture_default_str();
  command.add_option("--time-limit", options.time_limit_s, "Seconds of computing; 0: no limit")
      ->check(CLI::Range(0.0, 1e9))
      ->check(kNotNan)
      ->capture_default_str();
  add_threads_option(command, options.threads);
}

std::optional<AxisRun> run_axis(AxisArguments arguments, int& code) {
  const Result<PolygonMesh> mesh = read_mesh(arguments.model);
  if (!mesh) {
    code = report(mesh.error());
    return std::nullopt;
  }
  Result<Solid> solid = build_solid(mesh.value());
  if (!solid) {
    code = report_no_solid(solid.error(), arguments.model, mesh.value());
    return std::nullopt;
  }
  AxisRun run;
  run.diagonal = diameter(bounds_of(mesh.value().points));
  for (const std::string& warning : solid.value().warnings) {
    std::cerr << "blum: warning: " << arguments.model << ": " << warning << '\n';
  }
  arguments.options.max_leaf_diameter = arguments.epsilon * run.diagonal;
  AngleOptions angles;
  angles.wanted = true;
  AxisPlacement placement(solid.value(), {});
  defer_interrupts();
  ProgressBar bar;
  arguments.options.on_progress = [&bar](const Progress& progress) {
    bar.show(progress);
    return interrupted_by() == 0;
  };
  Result<MedialResult> axis =
      compute_medial_axis(solid.value(), arguments.options, angles, {}, placement.review());
  if (interrupted_by() != 0) {
    code = report_interrupted();
    return std::nullopt;
  }
  if (!axis) {
    code = report(axis.error());
    return std::nullopt;
  }
  run.axis = placement.realized(axis.value());
  run.solid = std::move(solid.value());
  return run;
}

}  // namespace blum::app
