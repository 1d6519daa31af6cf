// The filtration by number of sheets. "comb": many parallel planes and two that cross them all; it
// is contractible and comes off sheet by sheet. "rooms": a grid of planes with closed rooms, of
// which only what sticks out can go. Costs are random, as many different ones as sheets or only
// ten. Arguments: planes along x, different costs.

#include <benchmark/benchmark.h>

#include "blum/medial/filtration.hpp"
#include "medial/filtration_tools.hpp"
#include "medial/parts_builder.hpp"

namespace {

std::vector<bool> layers(int planes) {
  std::vector<bool> has;
  for (int i = 0; i < planes; ++i) {
    has.push_back(true);
    has.push_back(false);
  }
  return has;
}

void prune(benchmark::State& state, const blum::fixtures::PlaneGrid& grid) {
  const blum::CellComplex k = grid.build();
  const blum::Parts parts = blum::read_parts(k);
  const auto cost = blum::test::random_costs(k, parts, 1, static_cast<int>(state.range(1)));
  std::size_t removed = 0;
  for (auto _ : state) {
    const blum::Filtration f = blum::filter(k, parts, cost);
    removed = 0;
    for (const auto& step : f.step) removed += step.is_sheet ? 1 : 0;
  }
  state.counters["sheets"] = parts.sheets;
  state.counters["removed"] = static_cast<double>(removed);
  state.counters["triangles"] = static_cast<double>(k.triangle.size());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(parts.sheets));
}

void comb(benchmark::State& state) {
  prune(state,
        {{layers(static_cast<int>(state.range(0))), {false, true, false}, {false, true, false}}});
}

void rooms(benchmark::State& state) {
  const auto n = layers(static_cast<int>(state.range(0)));
  prune(state, {{n, n, n}});
}

BENCHMARK(comb)
    ->ArgsProduct({{1250, 3750, 11250, 33750}, {10, 1000000}})
    ->ArgNames({"planes", "costs"})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(rooms)
    ->ArgsProduct({{10, 21, 30}, {10, 1000000}})
    ->ArgNames({"planes", "costs"})
    ->Unit(benchmark::kMillisecond);

}  // namespace
