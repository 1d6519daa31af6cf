/// Complexes with costs, for the tests and the benchmark of the filtration.
#pragma once

#include <algorithm>
#include <random>

#include "blum/medial/filtration.hpp"

namespace blum::test {

/// Random costs, constant on sheets, seams and elsewhere by cell; from `levels` values, so that
/// there are many ties. Cells inside sheets cost what the sheet does, now and then more.
inline CellValues random_costs(const CellComplex& complex, const Parts& parts, unsigned seed,
                               int levels) {
  std::mt19937 random(seed);
  const auto draw = [&] {
    return 180.0 * std::uniform_int_distribution(0, levels)(random) / levels;
  };
  std::vector<double> sheet(parts.sheets), seam(parts.seams);
  for (double& x : sheet) x = draw();
  for (double& x : seam) x = draw();
  CellValues cost;
  cost.vertex.assign(complex.vertex.size(), 0);
  cost.edge.assign(complex.edge.size(), 0);
  for (std::size_t t = 0; t < complex.triangle.size(); ++t) {
    cost.triangle.push_back(sheet[parts.triangle_sheet[t]]);
    for (const auto e : complex.triangle[t].edge)
      cost.edge[e] = std::max(cost.edge[e], cost.triangle[t]);
  }
  for (std::size_t e = 0; e < complex.edge.size(); ++e) {
    if (parts.edge_seam[e] != Parts::kNoSeam) cost.edge[e] = seam[parts.edge_seam[e]];
    for (const auto v : complex.edge[e].vertex)
      cost.vertex[v] = std::max(cost.vertex[v], cost.edge[e]);
  }
  for (double& c : cost.vertex)
    if (std::uniform_int_distribution(0, 9)(random) == 0) c = draw();
  return cost;
}

}  // namespace blum::test
