#include "axis_run.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <thread>
#include <utility>

#include "blum/kernel/mesh.hpp"
#include "blum/kernel/validate.hpp"
#include "blum/placement/placement.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "interrupt.hpp"
#include "progress_bar.hpp"
#include "report.hpp"

namespace blum::app {
namespace {

double diagonal_of(const PolygonMesh& mesh) {
  Point3 lo = mesh.points.front(), hi = lo;
  for (const Point3& p : mesh.points) {
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  }
  return std::hypot(hi.x - lo.x, hi.y - lo.y, hi.z - lo.z);
}

}  // namespace

void add_axis_options(CLI::App& command, AxisArguments& arguments) {
  MedialOptions& options = arguments.options;
  command.add_option("MODEL", arguments.model, "OFF, OBJ, STL or PLY")->required();
  command
      .add_option("--epsilon", arguments.epsilon,
                  "Refine until the Hausdorff distance to the axis is at most this fraction of\n"
                  "the diagonal; 0: as coarse as the topology allows")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command.add_option("--seed", options.seed, "Of the cutting planes, and of samples")
      ->check(kDigits)
      ->capture_default_str();
  command.add_option("--time-limit", options.time_limit_s, "Seconds of computing; 0: no limit")
      ->check(CLI::Range(0.0, 1e9))
      ->capture_default_str();
  options.threads = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 1024);
  command
      .add_option("--threads", options.threads,
                  "The result does not depend on it (default: the number of cores)")
      ->check(CLI::Range(1, 1024));
}

std::optional<AxisRun> run_axis(AxisArguments arguments, int& code) {
  const Result<PolygonMesh> mesh = read_mesh(arguments.model);
  if (!mesh) {
    code = report(mesh.error());
    return std::nullopt;
  }
  Result<Solid> solid = build_solid(mesh.value());
  if (!solid) {
    code = solid.error().code == ErrorCode::kInvalidSolid
               ? report_invalid(arguments.model, validate_mesh(mesh.value()))
               : report(solid.error());
    return std::nullopt;
  }
  AxisRun run;
  run.diagonal = diagonal_of(mesh.value());
  for (const std::string& warning : solid.value().warnings) {
    std::cerr << "blum: warning: " << arguments.model << ": " << warning << '\n';
  }
  arguments.options.max_leaf_diameter = arguments.epsilon * run.diagonal;
  AngleOptions angles;
  angles.wanted = true;
  AxisPlacement placement(solid.value(), {});
  const DeferInterrupts deferred;
  ProgressBar bar;
  arguments.options.on_progress = [&bar](const Progress& progress) {
    bar.show(progress);
    return interrupted_by() == 0;
  };
  Result<MedialResult> axis =
      compute_medial_axis(solid.value(), arguments.options, angles, {}, placement.review());
  if (interrupted_by() != 0) {
    std::cerr << "blum: interrupted\n";
    code = kSignalBase + interrupted_by();
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
