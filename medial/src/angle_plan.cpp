#include "angle_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace blum {
namespace {

constexpr std::size_t kStarts = 24;  // places a part where a witness is looked for

}  // namespace

AnglePlan angle_plan(const Solid& solid, const std::vector<LeafParts>& leaves,
                     const CellComplex& complex, const Parts& parts, const PartNumbers& number) {
  AnglePlan plan;
  plan.tasks.resize(number.count());
  plan.starts.resize(number.count());
  std::vector<std::uint32_t> list_of;  // leaf -> index in `leaves`
  for (std::uint32_t l = 0; l < leaves.size(); ++l) {
    const LeafParts& leaf = leaves[l];
    if (leaf.leaf >= list_of.size()) list_of.resize(leaf.leaf + 1, 0);
    list_of[leaf.leaf] = l;
    for (const auto& a : leaf.arc)
      plan.tasks[a.sheet].push_back({l, {AngleRole::Kind::kArc, a.a, a.b}});
    for (const auto& s : leaf.seam)
      plan.tasks[number.seam(s.seam)].push_back(
          {l, {AngleRole::Kind::kSeam, s.groups, 0, s.distinct()}});
    if (leaf.rest != VertexParts::kNone)
      plan.tasks[leaf.rest].push_back({l, {AngleRole::Kind::kRest, 0, 0}});
  }
  const auto offer = [&](std::uint32_t part, AngleStart start, std::uint32_t leaf) {
    auto& starts = plan.starts[part];
    if (starts.size() >= 8 * kStarts) return;
    const auto& tasks = plan.tasks[part];
    for (start.task = 0; start.task < tasks.size(); ++start.task)
      if (tasks[start.task].leaf == leaf && tasks[start.task].role.kind != AngleRole::Kind::kRest) {
        starts.push_back(start);
        return;
      }
  };
  const auto between = [](const Point3& p, const Point3& q, double s) {
    return Point3{p.x + s * (q.x - p.x), p.y + s * (q.y - p.y), p.z + s * (q.z - p.z)};
  };
  for (std::uint32_t t = 0; t < complex.triangle.size(); ++t) {
    const ComplexTriangle& triangle = complex.triangle[t];
    const auto l = list_of[complex.cone[triangle.cone].leaf];
    const Point3 apex =
        solid.frame.to_working(complex.vertex[complex.cone[triangle.cone].apex].position);
    const auto& base = complex.edge[triangle.edge[0]].vertex;
    const std::array<Point3, 2> end{solid.frame.to_working(complex.vertex[base[0]].position),
                                    solid.frame.to_working(complex.vertex[base[1]].position)};
    for (const double along : {0.5, 0.1, 0.9})
      for (const double up : {0.0, 0.3})
        offer(parts.triangle_sheet[t],
              {0, between(between(end[0], end[1], along), apex, up), 0, triangle.governors[0],
               triangle.governors[1]},
              l);
    for (std::size_t k = 0; k < 2; ++k) {
      const auto seam = parts.edge_seam[triangle.edge[1 + k]];
      if (seam == Parts::kNoSeam) continue;
      const double length = std::hypot(apex.x - end[k].x, apex.y - end[k].y, apex.z - end[k].z);
      for (const auto& [up, reach] : {std::pair{0.0, 0.0}, {0.15, 0.1}, {0.5, 0.3}})
        offer(number.seam(seam), {0, between(end[k], apex, up), reach * length, {}, {}}, l);
    }
  }
  for (auto& starts : plan.starts) {
    std::vector<AngleStart> some;
    const std::size_t step = std::max<std::size_t>(1, starts.size() / kStarts);
    for (std::size_t k = 0; k < starts.size(); k += step) some.push_back(starts[k]);
    starts = std::move(some);
  }
  return plan;
}

}  // namespace blum
