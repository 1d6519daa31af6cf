#include "part_angles.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <optional>
#include <set>

#include "blum/kernel/parallel.hpp"
#include "part_bound.hpp"

namespace blum {

PartAngles part_angles(const SiteGeometry& geometry, const Subdivision& subdivision,
                       EngineSet& engines, const CellComplex& complex, const Parts& parts,
                       const AngleLook& look, AngleMemo& memo) {
  const PartNumbers number = part_numbers(complex, parts);
  const VertexParts vertex = vertex_parts(complex, parts);
  const auto leaves = leaf_parts(geometry, subdivision, complex, parts);
  const AnglePlan plan = angle_plan(geometry.solid(), leaves, complex, parts, number);

  memo.number(leaves, subdivision);

  std::vector<AngleMemo::Known> known(number.count(), {{0, 0}, 0, {}, {}});
  std::vector<std::optional<AngleMemo::Key>> keys(number.count());
  std::vector<AngleTools> tools;
  for (int t = 0; t < engines.threads(); ++t) {
    ProductionEngine& engine = engines.production(t);
    tools.push_back({engine, TiePairs(engine), AngleWitness(geometry, engine, engines.inside())});
  }
  const std::atomic<bool>& stop = engines.watch().flag();
  for_each_in_parallel(engines.threads(), number.count(), [&](int thread, std::size_t p) {
    const auto& tasks = plan.tasks[p];
    if (tasks.empty()) return;
    AngleMemo::Key key = memo.key(tasks, plan.starts[p]);
    if (const auto* before = memo.find(key, look)) {
      known[p] = *before;
    } else {
      PartBound bound(geometry, subdivision, leaves, tasks, look, stop,
                      tools[static_cast<std::size_t>(thread)]);
      known[p] = {bound.run(plan.starts[p]), bound.boxes(), {}, look};
      if (known[p].interval.width() > look.tolerance_deg) known[p].coarse = bound.coarse_tasks();
      if (stop) return;
    }
    keys[p] = std::move(key);
  });
  std::map<AngleMemo::Key, AngleMemo::Known> parts_now;
  for (std::size_t p = 0; p < known.size(); ++p)
    if (keys[p]) parts_now.emplace(std::move(*keys[p]), known[p]);
  memo.keep(std::move(parts_now));
  const auto interval = [&](std::uint32_t part) { return known[part].interval; };

  PartAngles angles;
  angles.is_node = vertex.is_node;
  for (std::uint32_t p = 0; p < number.sheets; ++p) angles.sheet.push_back(interval(p));
  for (std::uint32_t k = 0; k < number.seams; ++k) angles.seam.push_back(interval(number.seam(k)));
  for (std::uint32_t v = 0; v < complex.vertex.size(); ++v)
    angles.vertex.push_back(vertex.part[v] == VertexParts::kNone ? AngleInterval{0, 0}
                                                                 : interval(vertex.part[v]));
  for (const auto& k : known) angles.boxes += k.boxes;
  std::vector<std::uint32_t> wide;  // parts
  const auto count = [&](std::uint32_t part) {
    const double width = interval(part).width();
    angles.widest_deg = std::max(angles.widest_deg, width);
    if (width > look.tolerance_deg) wide.push_back(part);
  };
  for (std::uint32_t p = 0; p < number.sheets + number.seams; ++p) count(p);
  for (std::uint32_t c = 0; c < complex.cone.size(); ++c)
    if (parts.cone_shape[c] == ConeShape::kJunction) count(vertex.part[complex.cone[c].apex]);
  angles.wide = wide.size();
  std::ranges::stable_sort(wide, std::greater(), [&](auto p) { return interval(p).width(); });
  std::set<std::uint32_t> listed;
  for (const auto p : wide)
    for (const auto t : known[p].coarse) {
      const auto leaf = leaves[plan.tasks[p][t].leaf].leaf;
      if (listed.insert(leaf).second) angles.coarse_leaves.push_back(leaf);
    }
  return angles;
}

CellValues cell_costs(const CellComplex& complex, const Parts& parts, const PartAngles& angles) {
  CellValues cost;
  for (const AngleInterval& i : angles.vertex) cost.vertex.push_back(i.hi);
  cost.edge.assign(complex.edge.size(), 0);
  for (std::size_t t = 0; t < complex.triangle.size(); ++t) {
    cost.triangle.push_back(angles.sheet[parts.triangle_sheet[t]].hi);
    for (const auto e : complex.triangle[t].edge)
      if (complex.edge[e].kind != ComplexEdge::Kind::kConvexEdge)
        cost.edge[e] = std::max(cost.edge[e], cost.triangle[t]);
  }
  for (std::size_t e = 0; e < complex.edge.size(); ++e)
    if (parts.edge_seam[e] != Parts::kNoSeam) cost.edge[e] = angles.seam[parts.edge_seam[e]].hi;
  return cost;
}

}  // namespace blum
