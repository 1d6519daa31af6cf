// Whole runs: torus 8x4, 16x8, 32x16, 64x32 and a few CAD shapes, medial; the tori with cells of
// any number of sites (`--cell-sites 0`); and, in both modes on two threads, models with the counts
// of the thesis' spoon (1.7 s there) and chisel (130.3 s, 2006); with sites, time by phase,
// decisions by stage, leaves and peak memory as counters. `compare.py
// --growth RUN.json` fits the exponents of growth in sites.
//
// One iteration each: a run is long and deterministic. One thread, so that the processor time
// compares on a busy machine too. The kernel's mark of peak memory is put back before each run.

#include <benchmark/benchmark.h>

#include <fstream>
#include <functional>
#include <string>
#include <utility>

#include "blum/kernel/shapes.hpp"
#include "blum/kernel/site.hpp"
#include "blum/medial/medial_axis.hpp"
#include "blum/medial/summary.hpp"

namespace {

constexpr double kTimeLimit_s = 900;

void reset_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

void run(benchmark::State& state, const std::function<blum::PolygonMesh()>& make,
         blum::DiagramKind kind, blum::MedialOptions options) {
  const blum::Result<blum::Solid> solid = blum::build_solid(make());
  if (!solid) {
    state.SkipWithError(solid.error().message.c_str());
    return;
  }
  const blum::SiteCounts sites = blum::count_sites(solid.value());
  options.time_limit_s = kTimeLimit_s;
  reset_peak();
  for (auto _ : state) {
    const blum::Result<blum::MedialResult> result =
        kind == blum::DiagramKind::kMedial ? blum::compute_medial_axis(solid.value(), options)
                                           : blum::compute_voronoi_diagram(solid.value(), options);
    if (!result) {
      state.SkipWithError(result.error().message.c_str());
      return;
    }
    const blum::MedialResult& r = result.value();
    const auto count = [&](const char* name, auto value) {
      state.counters[name] = static_cast<double>(value);
    };
    count("faces", solid.value().triangle.size());
    count("sites", sites.vertices + sites.edges + sites.faces);
    count("certified", r.certified ? 1 : 0);
    count("undecided", r.undecided.size());
    count("leaves", r.leaves);
    count("max_depth", r.max_depth);
    count("triangles", r.complex.triangle.size());
    count("subdivide_s", r.time.subdivide_s);
    count("assemble_s", r.time.assemble_s);
    count("filter", r.stages.filter);
    count("extended", r.stages.extended);
    count("exact", r.stages.exact);
    count("peak_bytes", static_cast<double>(blum::peak_memory_bytes()));
  }
}

void add(const std::string& name, std::function<blum::PolygonMesh()> make,
         blum::DiagramKind kind = blum::DiagramKind::kMedial, int threads = 1,
         std::size_t cell_sites = blum::MedialOptions().max_candidates) {
  blum::MedialOptions options;
  options.threads = threads;
  options.max_candidates = cell_sites;
  benchmark::RegisterBenchmark(name.c_str(), run, std::move(make), kind, options)
      ->Iterations(1)
      ->Unit(benchmark::kSecond);
}

const bool kRegistered = [] {
  using namespace blum::shapes;
  add("medial/box", [] { return cuboid(4, 3, 2); });
  add("medial/lbracket", [] { return lbracket(); });
  add("medial/lbracket_rotated", [] { return rotate_rounded(lbracket(), 1); });
  add("medial/plate_2_holes", [] { return plate(2, 8); });
  for (const int n : {8, 16, 32, 64}) {
    const auto make = [n] { return torus(n, n / 2, 2, 0.75); };
    const std::string size = std::to_string(n) + "x" + std::to_string(n / 2);
    add("medial/torus/" + size, make);
    add("medial/torus_any_cell/" + size, make, blum::DiagramKind::kMedial, 1, 0);
  }
  for (const auto& [mode, kind] : {std::pair{"medial/", blum::DiagramKind::kMedial},
                                   std::pair{"voronoi/", blum::DiagramKind::kVoronoi}}) {
    add(
        std::string(mode) + "spoon/2_threads", [] { return spoon(); }, kind, 2);
    add(
        std::string(mode) + "chisel/2_threads", [] { return chisel(); }, kind, 2);
  }
  return true;
}();

}  // namespace
