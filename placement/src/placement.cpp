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
#include "leaf_triangles.hpp"
#include "look_ahead.hpp"
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
  /// `failed`: leaves whose bound is too large.
  ReviewVerdict bound(const AssembledAxis& axis, std::size_t& failed);
  [[nodiscard]] double target() const {
    return solid.frame.length_to_working(options.epsilon) * (1 - kSlack);
  }
  [[nodiscard]] double edge_length() const;
  [[nodiscard]] std::function<bool(const Leaf&, int)> look_ahead(const AssembledAxis& axis);

  const Solid& solid;
  const PlacementOptions options;
  const SiteGeometry geometry;
  const SiteTree tree;
  PlacementReport report;
  AxisMesh mesh;
  ConeSides sides;
  std::map<LeafKey, LeafBound> known;  // bounds of leaves, working units
  std::vector<BoundTools> ahead;       // for look_ahead, by thread
  const Clock since_start;
};

double AxisPlacement::Impl::edge_length() const {
  if (options.edge_length > 0) return solid.frame.length_to_working(options.edge_length);
  if (!(options.epsilon > 0)) return std::numeric_limits<double>::infinity();
  return kEdge * std::sqrt(solid.frame.length_to_working(options.epsilon) *
                           diameter(bounds_of(solid.point)));
}

ReviewVerdict AxisPlacement::Impl::look(const AssembledAxis& axis) {
  Clock clock;
  // What was found before, in case that this review does not come to its end.
  PlacementReport report_before = report;
  AxisMesh mesh_before = std::move(mesh);
  ConeSides sides_before = std::move(sides);
  const int threads = axis.engines.threads();
  const auto& cone = axis.complex.cone;
  std::vector<std::size_t> first;  // cones of one leaf follow each other
  for (std::size_t c = 0; c < cone.size(); ++c)
    if (c == 0 || cone[c].leaf != cone[c - 1].leaf) first.push_back(c);
  sides.assign(cone.size(), nullptr);
  for_each_in_parallel(threads, first.size(), [&](int, std::size_t k) {
    const auto leaf =
        std::make_shared<const LeafSides>(geometry, axis.subdivision.leaf[cone[first[k]].leaf]);
    for (std::size_t c = first[k]; c < (k + 1 < first.size() ? first[k + 1] : cone.size()); ++c)
      sides[c] = leaf;
  });
  const InsideOracle& inside = axis.engines.inside();
  PlacementRound round;
  round.leaves = axis.subdivision.leaf.size();
  round.refine_s = axis.time.refine_s;
  round.assemble_s = axis.time.assemble_s;
  const PlacedPoints placed =
      place_points(geometry, inside, axis.parts, sides, axis.complex,
                   {.stop = &axis.engines.watch().flag(), .threads = threads});
  report.place_s += round.place_s = clock.lap();
  report.moved = placed.moved;
  report.on_part = placed.on_part;
  mesh = mesh_of(
      geometry, inside, axis.complex, axis.parts, sides,
      {.edge_length = edge_length(), .stop = &axis.engines.watch().flag(), .threads = threads});
  report.unconverged = placed.unconverged + mesh.unconverged;
  report.mesh_s += round.mesh_s = clock.lap();
  ReviewVerdict verdict{{}, std::numeric_limits<double>::infinity(), {}};
  std::size_t failed = 0;
  if (!axis.undecided) verdict = bound(axis, failed);
  report.bound_s += round.bound_s = clock.lap();
  round.bound = report.bound = verdict.hausdorff_bound;
  round.failed = failed;
  round.since_start_s = Clock(since_start).lap();
  report.round.push_back(round);
  report.reached = !(options.epsilon > 0) || report.bound <= options.epsilon;
  if (!report_before.round.empty() && axis.engines.watch().look() != Stop::kNone &&
      report_before.bound <= report.bound) {
    report_before.round = std::move(report.round);
    report = std::move(report_before);
    mesh = std::move(mesh_before);
    sides = std::move(sides_before);
    return {{}, report.bound, {}, true};
  }
  report.rounds += verdict.divide.empty() ? 0 : 1;
  if (!verdict.divide.empty()) verdict.fine_enough = look_ahead(axis);
  return verdict;
}

std::function<bool(const Leaf&, int)> AxisPlacement::Impl::look_ahead(const AssembledAxis& axis) {
  EngineSet& engines = axis.engines;
  ahead.clear();
  for (int t = 0; t < engines.threads(); ++t)
    ahead.push_back(
        {geometry, engines.production(t), tree, engines.inside(), engines.watch().flag()});
  return [this, &engines](const Leaf& leaf, int thread) {
    return fine_enough(geometry, leaf, engines, thread, ahead[static_cast<std::size_t>(thread)],
                       {target(), edge_length()});
  };
}

ReviewVerdict AxisPlacement::Impl::bound(const AssembledAxis& axis, std::size_t& failed) {
  const auto& leaves = axis.subdivision.leaf;
  std::map<std::uint32_t, std::vector<std::uint32_t>> triangles;  // by leaf
  for (std::uint32_t t = 0; t < mesh.triangle.size(); ++t)
    triangles[axis.complex.cone[mesh.complex.triangle[t].cone].leaf].push_back(t);
  struct Task {
    std::uint32_t leaf = 0;
    double diameter = 0;
    LeafBound bound;
    LeafKey key;
    const std::vector<std::uint32_t>* triangles = nullptr;
  };
  std::vector<Task> tasks;
  double most = 0;
  report.leaves_by_diameter = 0;
  for (std::uint32_t l = 0; l < leaves.size(); ++l) {
    if (!leaves[l].has_axis) continue;
    const double size = diameter(leaves[l].box);
    const auto found = triangles.find(l);
    if (!(options.epsilon > 0) || size <= target() || found == triangles.end()) {
      most = std::max(most, size);
      ++report.leaves_by_diameter;
      continue;
    }
    tasks.push_back({l, size, {}, {}, &found->second});
  }
  std::vector<BoundTools> tools;
  for (int t = 0; t < axis.engines.threads(); ++t)
    tools.push_back({geometry, axis.engines.production(t), tree, axis.engines.inside(),
                     axis.engines.watch().flag()});
  for_each_in_parallel(axis.engines.threads(), tasks.size(), [&](int thread, std::size_t k) {
    Task& task = tasks[k];
    const LeafSides& of_leaf = *sides[mesh.complex.triangle[task.triangles->front()].cone];
    const auto list = leaf_triangles(solid.frame, mesh, *task.triangles, of_leaf);
    for (int i = 0; i < 3; ++i) {
      task.key.push_back(of_leaf.box().lo[i]);
      task.key.push_back(of_leaf.box().hi[i]);
    }
    for (const LeafTriangle& t : list)
      for (const Point3& p : t.corner)
        for (int i = 0; i < 3; ++i) task.key.push_back(p[i]);
    const auto it = known.find(task.key);
    task.bound = it != known.end() ? it->second
                                   : least_bound_in_leaf(tools[static_cast<std::size_t>(thread)],
                                                         of_leaf, list, target(), task.diameter);
  });
  std::map<LeafKey, LeafBound> now;
  std::vector<const Task*> coarse;
  failed = 0;
  for (Task& task : tasks) {
    most = std::max(most, task.bound.bound);
    failed += task.bound.bound > target() ? 1 : 0;
    if (!task.bound.fine_enough) coarse.push_back(&task);
    if (task.bound.bound >= task.diameter) ++report.leaves_by_diameter;
    now.emplace(std::move(task.key), task.bound);
  }
  // What was not looked at for want of time is not known.
  if (!axis.engines.watch().flag()) known = std::move(now);
  std::stable_sort(coarse.begin(), coarse.end(),
                   [](const Task* a, const Task* b) { return a->bound.bound > b->bound.bound; });
  ReviewVerdict verdict;
  // Once, leaves are divided that place points badly though the bound is reached.
  for (const Task* task : coarse)
    if (task->bound.bound > target() || report.round.empty()) verdict.divide.push_back(task->leaf);
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
