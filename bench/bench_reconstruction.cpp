// The error of the union of balls by the number of balls: the axis of a plate with two holes,
// meshed finer and finer. Argument: how many edges to the diagonal.

#include <benchmark/benchmark.h>

#include "blum/kernel/point_algebra.hpp"
#include "blum/kernel/shapes.hpp"
#include "blum/placement/placement.hpp"
#include "blum/placement/reconstruction.hpp"

namespace {

void reconstruction(benchmark::State& state) {
  const blum::PolygonMesh mesh = blum::shapes::plate(2, 6);
  const blum::Solid solid = blum::build_solid(mesh).value();
  const double diagonal = blum::diameter(blum::bounds_of(mesh.points));
  blum::AxisPlacement placement(solid, {0, diagonal / static_cast<double>(state.range(0))});
  if (!blum::compute_medial_axis(solid, {}, {}, {}, placement.review())) {
    state.SkipWithError("no axis");
    return;
  }
  blum::ReconstructionError error;
  for (auto _ : state) {
    error = blum::reconstruction_error(solid, placement.mesh().complex, {});
    benchmark::DoNotOptimize(error);
  }
  state.counters["balls"] = static_cast<double>(error.balls);
  state.SetComplexityN(static_cast<std::int64_t>(error.balls));
}

BENCHMARK(reconstruction)
    ->RangeMultiplier(2)
    ->Range(25, 256)
    ->Unit(benchmark::kMillisecond)
    ->Complexity();

}  // namespace
