#include "blum/placement/placement.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>

#include "blum/kernel/check.hpp"
#include "blum/kernel/parallel.hpp"
#include "blum/kernel/point_algebra.hpp"
#include "leaf_bound.hpp"
#include "place.hpp"

namespace blum {
namespace {

/// With a bound asked for and no edge length, edges of this times the root of epsilon times the
/// diagonal: as a curve leaves its chord by the square of its length, short enough for sheets of
/// usual radii (leaves where it is not are divided), long enough to keep meshes small.
constexpr double kEdge = 0.4;
/// Kept for roundings of positions in model units, as a part of the bound.
constexpr double kSlack = 1e-9;

class Clock {
 public:
  /// Seconds since the construction or the last lap.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> time = now - start_;
    start_ = now;
    return time.count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// What a leaf's bound depends on, so that it need not be found anew where neither the leaf nor
/// its mesh has changed.
using LeafKey = std::vector<double>;

}  // namespace

struct AxisPlacement::Impl {
  Impl(const Solid& s, const PlacementOptions& o) : solid(s), options(o), geometry(s), tree(s) {
    report.reached = !(o.epsilon > 0);
  }

  ReviewVerdict look(const AssembledAxis& axis);
  ReviewVerdict bound(const AssembledAxis& axis);
  [[nodiscard]] std::vector<LeafTriangle> triangles_of(
      const std::vector<std::uint32_t>& which) const;

  const Solid& solid;
  const PlacementOptions options;
  const SiteGeometry geometry;
  const SiteTree tree;
  PlacementReport report;
  AxisMesh mesh;
  ConeSides sides;
  std::map<LeafKey, double> known;  // bounds of leaves, working units
};

ReviewVerdict AxisPlacement::Impl::look(const AssembledAxis& axis) {
  Clock clock;
  const auto& cone = axis.complex.cone;
  sides.clear();
  for (std::size_t c = 0; c < cone.size(); ++c)
    sides.push_back(
        c > 0 && cone[c].leaf == cone[c - 1].leaf
            ? sides.back()
            : std::make_shared<const LeafSides>(geometry, axis.subdivision.leaf[cone[c].leaf]));
  const InsideOracle& inside = axis.engines.inside();
  const PlacedPoints placed = place_points(geometry, inside, axis.parts, sides, axis.complex);
  report.place_s += clock.lap();
  report.moved = placed.moved;
  report.on_part = placed.on_part;
  const double edge = options.edge_length > 0
                          ? solid.frame.length_to_working(options.edge_length)
                          : kEdge * std::sqrt(solid.frame.length_to_working(options.epsilon) *
                                              diameter(bounds_of(solid.point)));
  mesh = mesh_of(geometry, inside, axis.complex, axis.parts, sides,
                 {.edge_length = edge > 0 ? edge : std::numeric_limits<double>::infinity(),
                  .stop = &axis.engines.watch().flag()});
  report.unconverged = placed.unconverged + mesh.unconverged;
  report.mesh_s += clock.lap();
  ReviewVerdict verdict{{}, std::numeric_limits<double>::infinity()};
  if (!axis.undecided) verdict = bound(axis);
  report.bound_s += clock.lap();
  report.bound = verdict.hausdorff_bound;
  report.reached = !(options.epsilon > 0) || report.bound <= options.epsilon;
  report.rounds += verdict.divide.empty() ? 0 : 1;
  return verdict;
}

std::vector<LeafTriangle> AxisPlacement::Impl::triangles_of(
    const std::vector<std::uint32_t>& which) const {
  std::vector<LeafTriangle> list;
  for (const auto t : which) {
    const ComplexTriangle& triangle = mesh.complex.triangle[t];
    LeafTriangle l;
    const auto corner = corners(mesh.complex, triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      const ComplexVertex& v = mesh.complex.vertex[corner[k]];
      l.corner[k] = solid.frame.to_working(v.position);
      l.on_rim[k] = v.on_axis && v.radius == 0;
    }
    const auto side = sides[triangle.cone]->sides_of(triangle.governors);
    l.a = side.front();
    l.b = side.back();
    list.push_back(std::move(l));
  }
  return list;
}

ReviewVerdict AxisPlacement::Impl::bound(const AssembledAxis& axis) {
  const auto& leaves = axis.subdivision.leaf;
  const double target = solid.frame.length_to_working(options.epsilon) * (1 - kSlack);
  std::map<std::uint32_t, std::vector<std::uint32_t>> triangles;  // by leaf
  for (std::uint32_t t = 0; t < mesh.triangle.size(); ++t)
    triangles[axis.complex.cone[mesh.complex.triangle[t].cone].leaf].push_back(t);
  struct Task {
    std::uint32_t leaf = 0;
    double diameter = 0;
    std::optional<double> bound;
    LeafKey key;
    const LeafSides* sides = nullptr;
    std::vector<LeafTriangle> triangles;
  };
  std::vector<Task> tasks;
  double most = 0;
  report.leaves_by_diameter = 0;
  for (std::uint32_t l = 0; l < leaves.size(); ++l) {
    if (!leaves[l].has_axis) continue;
    const double size = diameter(leaves[l].box);
    const auto found = triangles.find(l);
    if (!(options.epsilon > 0) || size <= target || found == triangles.end()) {
      most = std::max(most, size);
      ++report.leaves_by_diameter;
      continue;
    }
    Task task;
    task.leaf = l;
    task.diameter = size;
    task.sides = sides[mesh.complex.triangle[found->second.front()].cone].get();
    task.triangles = triangles_of(found->second);
    for (int k = 0; k < 3; ++k) {
      task.key.push_back(leaves[l].box.lo[k]);
      task.key.push_back(leaves[l].box.hi[k]);
    }
    for (const LeafTriangle& t : task.triangles)
      for (const Point3& p : t.corner)
        for (int k = 0; k < 3; ++k) task.key.push_back(p[k]);
    tasks.push_back(std::move(task));
  }
  std::vector<BoundTools> tools;
  for (int t = 0; t < axis.engines.threads(); ++t)
    tools.push_back({geometry, axis.engines.production(t), tree, axis.engines.inside(),
                     axis.engines.watch().flag()});
  for_each_in_parallel(axis.engines.threads(), tasks.size(), [&](int thread, std::size_t k) {
    Task& task = tasks[k];
    if (const auto it = known.find(task.key); it != known.end())
      task.bound = it->second;
    else
      task.bound = bound_in_leaf(tools[static_cast<std::size_t>(thread)], *task.sides,
                                 task.triangles, target);
  });
  std::map<LeafKey, double> now;
  ReviewVerdict verdict;
  for (Task& task : tasks) {
    if (task.bound) {
      most = std::max(most, std::min(*task.bound, task.diameter));
      now.emplace(std::move(task.key), *task.bound);
    } else {
      most = std::max(most, task.diameter);
      ++report.leaves_by_diameter;
      verdict.divide.push_back(task.leaf);
    }
  }
  known = std::move(now);
  for (const BoundTools& t : tools) {
    report.boxes += t.boxes;
    report.points += t.points;
  }
  verdict.hausdorff_bound = solid.frame.length_to_model(most * (1 + kSlack));
  return verdict;
}

AxisPlacement::AxisPlacement(const Solid& solid, const PlacementOptions& options)
    : impl_(std::make_unique<Impl>(solid, options)) {
  BLUM_REQUIRE(options.epsilon >= 0 && options.edge_length >= 0);
}
AxisPlacement::~AxisPlacement() = default;

AxisReview AxisPlacement::review() {
  return [this](const AssembledAxis& axis) { return impl_->look(axis); };
}
const PlacementReport& AxisPlacement::report() const { return impl_->report; }
const AxisMesh& AxisPlacement::mesh() const { return impl_->mesh; }
const ConeSides& AxisPlacement::sides() const { return impl_->sides; }
const SiteGeometry& AxisPlacement::geometry() const { return impl_->geometry; }

MedialResult AxisPlacement::realized(const MedialResult& result) const {
  return with_mesh(result, impl_->mesh);
}

}  // namespace blum
