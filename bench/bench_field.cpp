// Distance fields: our CPU backend, and, where their packages are there, Embree 3 point queries,
// the CGAL AABB tree and OpenVDB's meshToVolume, on the same mesh and grid, one thread each.
// BLUM_FIELD_MODEL=FILE replaces the bumpy torus, BLUM_FIELD_THREADS=N one thread.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "blum/gpu/field.hpp"
#include "blum/kernel/shapes.hpp"
#include "field_peers.hpp"

namespace blum {
namespace {

/// n facets around the axis, n / 2 about the tube: n^2 triangles, moved a little in and out.
PolygonMesh bumpy_torus(int n) {
  PolygonMesh mesh = shapes::torus(n, n / 2, 2, 0.75);
  for (Point3& p : mesh.points) {
    const double bump = 1 + 0.04 * std::sin(7 * p.x) * std::cos(5 * p.y + 3 * p.z);
    p = {bump * p.x, bump * p.y, bump * p.z};
  }
  return mesh;
}

PolygonMesh model(int n) {
  const char* file = std::getenv("BLUM_FIELD_MODEL");
  return file == nullptr ? bumpy_torus(n) : read_mesh(file).value();
}

int threads() {
  const char* text = std::getenv("BLUM_FIELD_THREADS");
  return text == nullptr ? 1 : std::max(1, std::atoi(text));
}

struct Scene {
  PolygonMesh mesh;
  SiteSet sites;
  VoxelGrid grid;
};

/// The model's box and a tenth more, in cubes, `resolution` along its longest side.
Scene make_scene(int triangles_root, std::uint32_t resolution) {
  const PolygonMesh mesh = model(triangles_root);
  const SiteSet sites = SiteSet::build(soup_of(mesh)).value();
  Box3 box = sites.box();
  double longest = 0;
  for (int k = 0; k < 3; ++k) longest = std::max(longest, box.hi[k] - box.lo[k]);
  for (int k = 0; k < 3; ++k) {
    const double middle = 0.5 * (box.lo[k] + box.hi[k]);
    box.lo[k] = middle - 0.6 * longest;
    box.hi[k] = middle + 0.6 * longest;
  }
  return {mesh, sites, make_grid(box, {resolution, resolution, resolution}).value()};
}

Scene scene_of(const benchmark::State& state) {
  return make_scene(static_cast<int>(state.range(0)), static_cast<std::uint32_t>(state.range(1)));
}

void report(benchmark::State& state, const Scene& scene) {
  state.counters["triangles"] = static_cast<double>(scene.sites.triangles().size());
  state.counters["voxels_per_s"] = benchmark::Counter(
      static_cast<double>(scene.grid.voxels()), benchmark::Counter::kIsIterationInvariantRate);
}

FieldOptions options_with_band(const Scene& scene, double voxels) {
  FieldOptions options;
  options.threads = threads();
  options.band = voxels * scene.grid.spacing.x;
  return options;
}

void cpu(benchmark::State& state, double band_voxels) {
  const Scene scene = scene_of(state);
  FieldStatistics statistics;
  for (auto _ : state) {
    const auto sites = SiteSet::build(soup_of(scene.mesh));
    const auto field =
        compute_field(sites.value(), scene.grid, options_with_band(scene, band_voxels));
    benchmark::DoNotOptimize(field.value().distance.data());
    statistics = field.value().statistics;
  }
  report(state, scene);
  const auto voxels = static_cast<double>(scene.grid.voxels());
  state.counters["fragments_per_voxel"] = static_cast<double>(statistics.fragments) / voxels;
  state.counters["culling"] = culling_efficiency(statistics);
}

/// Largest error against our field, in voxels.
double worst_error(const Scene& scene, const std::vector<float>& distance) {
  const auto field = compute_field(scene.sites, scene.grid, options_with_band(scene, 1e300));
  double worst = 0;
  for (std::size_t v = 0; v < distance.size(); ++v) {
    worst = std::max(worst, std::abs(distance[v] - field.value().distance[v]));  // NaN: no answer
  }
  return worst / scene.grid.spacing.x;
}

void peer(benchmark::State& state,
          std::vector<float> (*compute)(const SiteSet&, const VoxelGrid&, int)) {
  const Scene scene = scene_of(state);
  std::vector<float> distance;
  for (auto _ : state) distance = compute(scene.sites, scene.grid, threads());
  report(state, scene);
  state.counters["worst_error_voxels"] = worst_error(scene, distance);
}

/// About 1,000, 10,000 and 100,000 triangles.
void sizes_to(benchmark::internal::Benchmark* b, int greatest) {
  for (const int root : {32, 100, 316}) {
    for (int resolution = 64; resolution <= greatest; resolution *= 2) b->Args({root, resolution});
  }
  b->Unit(benchmark::kMillisecond)->Iterations(1)->MeasureProcessCPUTime();
}
void sizes(benchmark::internal::Benchmark* b) { sizes_to(b, 256); }
void more_sizes(benchmark::internal::Benchmark* b) { sizes_to(b, 512); }

BENCHMARK_CAPTURE(cpu, full, 1e300)->Apply(more_sizes);
BENCHMARK_CAPTURE(cpu, band3, 3)->Apply(more_sizes);
#ifdef BLUM_HAS_EMBREE
BENCHMARK_CAPTURE(peer, embree, bench::embree_distances)->Apply(sizes);
#endif
#ifdef BLUM_HAS_OPENVDB
BENCHMARK_CAPTURE(peer, openvdb, bench::openvdb_distances)->Apply(sizes);
BENCHMARK_CAPTURE(peer, openvdb_band3, bench::openvdb_band3)->Apply(sizes);
#endif
#ifdef BLUM_HAS_CGAL
BENCHMARK_CAPTURE(peer, cgal, bench::cgal_distances)->Apply(sizes);
#endif

}  // namespace
}  // namespace blum
