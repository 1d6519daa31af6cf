// Table 2.1 of the thesis again: the same grids, on the same model (triceratops) or the nearest
// ones that there are, by all of our ways: the CPU backend; OpenGL with our block culling; HAVOC as
// in 1999 (no culling), with domain polytopes (the thesis' HAVOC+CSC), and DiFi's sweep and ranges.
// Accuracy beside time: the greatest regret against the CPU's field, in voxels, and its bound.
// BLUM_MODELS_DIR=FOLDER, BLUM_FIELD_BACKEND=osmesa, BLUM_FIELD_THREADS=N. What goes through every
// site in every slice takes minutes without a GPU: choose with --benchmark_filter.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <string>

#include "blum/gpu/field.hpp"
#include "blum/kernel/mesh.hpp"

namespace blum {
namespace {

struct Row {
  const char* name;  // in the table
  const char* file;
  std::array<std::uint32_t, 3> size;
};
constexpr Row kRows[] = {
    {"Rotor", "rotor_small.off", {4, 128, 128}},
    {"Rotor", "rotor_small.off", {8, 254, 254}},
    {"Triceratops", "triceratops.off", {128, 56, 42}},
    {"Triceratops", "triceratops.off", {254, 111, 84}},
    {"Hugo", "hand_closed.off", {73, 45, 128}},
    {"Hugo", "hand_closed.off", {145, 90, 254}},
    {"Cassini", "skull_100k.off", {186, 254, 188}},
    {"Dragon", "dirty_dragon_100k.off", {57, 90, 128}},
};

struct Way {
  const char* name;
  bool is_cpu;
  FieldMethod method;
  FieldCulling culling;
};
constexpr FieldCulling kNothing = {false, false, false, false, false};
constexpr FieldCulling kDomains = {false, true, false, false, false};
constexpr FieldCulling kBlocks = {true, true, false, false, false};
constexpr FieldCulling kSweep = {false, true, true, true, false};
constexpr FieldCulling kRanges = {false, true, false, false, true};
constexpr Way kWays[] = {
    {"cpu", true, FieldMethod::kFragments, kBlocks},
    {"fragments", false, FieldMethod::kFragments, kBlocks},
    {"gather", false, FieldMethod::kGather, kBlocks},
    {"havoc_blocks", false, FieldMethod::kDistanceMeshes, kBlocks},
    {"difi_blocks", false, FieldMethod::kLinearFactorization, kBlocks},
    {"havoc", false, FieldMethod::kDistanceMeshes, kNothing},
    {"havoc_csc", false, FieldMethod::kDistanceMeshes, kDomains},
    {"difi", false, FieldMethod::kLinearFactorization, kSweep},
    {"difi_ranges", false, FieldMethod::kLinearFactorization, kRanges},
};

std::string folder() {
  const char* text = std::getenv("BLUM_MODELS_DIR");
  return text == nullptr ? BLUM_BENCH_MODELS_DIR : text;
}

FieldBackend driver() {
  const char* text = std::getenv("BLUM_FIELD_BACKEND");
  return text != nullptr && std::string(text) == "osmesa" ? FieldBackend::kOsmesa
                                                          : FieldBackend::kEgl;
}

void run(benchmark::State& state, const Row& row, const Way& way) {
  const auto mesh = read_mesh(folder() + "/" + row.file);
  if (!mesh) return state.SkipWithError(mesh.error().message.c_str());
  const SiteSet sites = SiteSet::build(soup_of(mesh.value())).value();
  Box3 box = sites.box();
  for (int k = 0; k < 3; ++k) {
    const double more = 0.05 * (box.hi[k] - box.lo[k]);
    box.lo[k] -= more;
    box.hi[k] += more;
  }
  const VoxelGrid grid = make_grid(box, row.size).value();
  const char* threads = std::getenv("BLUM_FIELD_THREADS");
  FieldOptions options;
  options.threads = threads == nullptr ? 1 : std::max(1, std::atoi(threads));
  const DistanceField reference = compute_field(sites, grid, options).value();
  options.backend = way.is_cpu ? FieldBackend::kCpu : driver();
  options.method = way.method;
  options.culling = way.culling;
  std::optional<Result<DistanceField>> field;
  for (auto _ : state) field.emplace(compute_field(sites, grid, options));
  if (!*field) return state.SkipWithError(field->error().message.c_str());
  const DistanceField& f = field->value();
  double regret = 0;
  for (std::size_t v = 0; v < f.distance.size(); ++v) {
    regret = std::max(regret, f.distance[v] - reference.distance[v]);
  }
  const double voxel = std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z});
  const FieldStatistics& s = f.statistics;
  const auto parts = static_cast<double>(std::max<std::uint64_t>(1, s.blocks));
  state.counters["triangles"] = static_cast<double>(sites.triangles().size());
  state.counters["fragments_per_voxel"] =
      static_cast<double>(s.fragments) / static_cast<double>(grid.voxels());
  state.counters["sites_per_part"] = static_cast<double>(s.block_sites) / parts;
  state.counters["culling"] = culling_efficiency(s);
  state.counters["clamping"] = clamping_efficiency(s, grid.voxels());
  state.counters["regret_voxels"] = regret / voxel;
  state.counters["regret_bound_voxels"] = f.bound.regret / voxel;
  state.counters["holes"] = static_cast<double>(s.holes);
}

const bool kIsRegistered = [] {
  for (const Row& row : kRows) {
    for (const Way& way : kWays) {
      const std::string name = std::string(row.name) + "/" + std::to_string(row.size[0]) + "x" +
                               std::to_string(row.size[1]) + "x" + std::to_string(row.size[2]) +
                               "/" + way.name;
      benchmark::RegisterBenchmark(name.c_str(),
                                   [&row, &way](benchmark::State& state) { run(state, row, way); })
          ->Unit(benchmark::kMillisecond)
          ->Iterations(1)
          ->MeasureProcessCPUTime();
    }
  }
  return true;
}();

}  // namespace
}  // namespace blum
