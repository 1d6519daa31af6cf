// betti_numbers and read_parts by number of cells, on a grid of leaves crossed by planes (loops,
// seams and clusters in the proportion of their spacing). Arguments: leaves along a side, spacing.

#include <benchmark/benchmark.h>

#include "blum/medial/complex.hpp"
#include "blum/medial/parts.hpp"
#include "medial/parts_builder.hpp"

namespace {

blum::fixtures::PlaneGrid planes(int leaves, int spacing) {
  blum::fixtures::PlaneGrid grid;
  for (auto& layers : grid.has) {
    for (int i = 0; i < leaves; ++i) layers.push_back(i % spacing == spacing / 2);
  }
  return grid;
}

void report(benchmark::State& state, const blum::CellComplex& k) {
  const auto cells = k.vertex.size() + k.edge.size() + k.triangle.size();
  state.counters["cells"] = static_cast<double>(cells);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(cells));
}

void betti(benchmark::State& state) {
  const auto grid = planes(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const blum::CellComplex k = grid.build();
  for (auto _ : state) {
    if (blum::betti_numbers(k) != grid.betti()) state.SkipWithError("wrong Betti numbers");
  }
  report(state, k);
}

void parts(benchmark::State& state) {
  const auto grid = planes(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const blum::CellComplex k = grid.build();
  for (auto _ : state) {
    if (blum::read_parts(k).sheets != grid.sheets()) state.SkipWithError("wrong sheets");
  }
  report(state, k);
}

void sizes(benchmark::internal::Benchmark* b) {
  b->Args({12, 1})->Args({24, 1})->Args({28, 2})->Args({70, 10})->Args({90, 30});
  b->ArgNames({"leaves", "spacing"})->Unit(benchmark::kMillisecond);
}
BENCHMARK(betti)->Apply(sizes);
BENCHMARK(parts)->Apply(sizes);

}  // namespace
