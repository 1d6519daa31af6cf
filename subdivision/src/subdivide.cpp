#include "blum/subdivision/subdivision.hpp"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <optional>

#include "blum/kernel/parallel.hpp"
#include "blum/kernel/point_algebra.hpp"
#include "blum/subdivision/engine_set.hpp"
#include "cell_work.hpp"

namespace blum {

const char* undecided_reason_name(UndecidedReason reason) {
  switch (reason) {
    case UndecidedReason::kDepth:
      return "depth";
    case UndecidedReason::kCells:
      return "cells";
    case UndecidedReason::kTime:
      return "time";
    case UndecidedReason::kFaceUndecided:
      return "face_undecided";
    case UndecidedReason::kMemory:
      return "memory";
  }
  return "unknown";
}

namespace {

double volume(const Box3& box) {
  double v = 1;
  for (int k = 0; k < 3; ++k) v *= box.hi[k] - box.lo[k];
  return v;
}

/// The tree, and the cells that wait for a worker. Workers take the latest first: the tree is
/// walked by depth, and few cells wait.
class Subdivider {
 public:
  Subdivider(const SiteGeometry& geometry, const SubdivisionOptions& options, EngineSet& engines)
      : engines_(engines), work_{geometry, options, engines} {}

  Result<Subdivision> run() {
    add_root();
    return finish();
  }
  Result<Subdivision> run(const Subdivision& coarse, std::span<const std::uint32_t> leaves,
                          double fraction);

 private:
  void add_root();
  Result<Subdivision> finish();
  void work(int thread);
  /// Waits for a cell; nothing: there will be none.
  [[nodiscard]] std::optional<Cell> take();
  void put(const Cell& cell, CellOutcome outcome);
  void close(const Cell& cell, Leaf leaf);
  void open(const Cell& cell, Split split);
  [[nodiscard]] Subdivision numbered();

  EngineSet& engines_;
  CellWork work_;
  double root_volume_ = 1;

  std::mutex mutex_;  // of all below
  std::condition_variable changed_;
  std::vector<Cell> stack_;
  int busy_ = 0;
  bool failed_ = false;
  Subdivision result_;  // nodes and leaves in the order in which they came
  std::size_t steps_ = 0;
  double done_ = 0;
};

void Subdivider::add_root() {
  const Solid& solid = work_.geometry.solid();
  Cell cell;
  cell.box = root_box(work_.geometry, work_.options);
  work_.root_diameter = 0;
  for (int k = 0; k < 3; ++k)
    work_.root_diameter = std::max(work_.root_diameter, cell.box.hi[k] - cell.box.lo[k]);
  root_volume_ = volume(cell.box);
  const auto all = work_.geometry.candidates();
  cell.candidates.assign(all.begin(), all.end());
  // In a Voronoi diagram of both sides the boundary is no border.
  if (work_.geometry.kind() == DiagramKind::kMedial || work_.options.side != VoronoiSide::kBoth)
    cell.triangles.resize(solid.triangle.size());
  for (std::uint32_t t = 0; t < cell.triangles.size(); ++t) cell.triangles[t] = t;
  CellNode root;
  root.box = cell.box;
  result_.node.push_back(root);
  stack_.push_back(std::move(cell));
}

std::optional<Cell> Subdivider::take() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return failed_ || !stack_.empty() || busy_ == 0; });
  if (failed_ || stack_.empty()) return std::nullopt;
  Cell cell = std::move(stack_.back());
  stack_.pop_back();
  ++busy_;
  return cell;
}

void Subdivider::put(const Cell& cell, CellOutcome outcome) {
  std::unique_lock lock(mutex_);
  if (auto* leaf = std::get_if<Leaf>(&outcome))
    close(cell, std::move(*leaf));
  else
    open(cell, std::move(std::get<Split>(outcome)));
  --busy_;
  const bool tell = (++steps_ & 7u) == 0;
  const Progress progress{result_.leaf.size(), done_};
  lock.unlock();
  changed_.notify_all();
  if (tell) engines_.watch().report(progress);
}

void Subdivider::close(const Cell& cell, Leaf leaf) {
  leaf.box = cell.box;
  result_.node[cell.node].leaf = static_cast<std::uint32_t>(result_.leaf.size());
  done_ += volume(cell.box) / root_volume_;
  result_.stats.max_depth = std::max(result_.stats.max_depth, cell.depth);
  result_.leaf.push_back(std::move(leaf));
}

void Subdivider::open(const Cell& cell, Split split) {
  CellNode& node = result_.node[cell.node];
  node.axis = static_cast<std::int8_t>(split.axis);
  node.cut = split.cut;
  node.child = split.low.node = static_cast<std::uint32_t>(result_.node.size());
  split.high.node = split.low.node + 1;
  for (const Cell* half : {&split.low, &split.high}) {
    CellNode child;
    child.box = half->box;
    child.depth = static_cast<std::uint16_t>(half->depth);
    result_.node.push_back(child);
  }
  stack_.push_back(std::move(split.high));
  stack_.push_back(std::move(split.low));
}

void Subdivider::work(int thread) {
  CellWorker worker(work_, thread);
  try {
    while (auto cell = take()) {
      CellOutcome outcome;
      if (engines_.watch().look() == Stop::kNone) outcome = worker.work(*cell);
      if (const Stop stop = engines_.watch().look(); stop != Stop::kNone) {
        Leaf undecided;
        undecided.reason =
            stop == Stop::kMemory ? UndecidedReason::kMemory : UndecidedReason::kTime;
        outcome = std::move(undecided);
      }
      put(*cell, std::move(outcome));
    }
  } catch (...) {
    {
      const std::lock_guard lock(mutex_);
      failed_ = true;
    }
    changed_.notify_all();
    throw;
  }
  const std::lock_guard lock(mutex_);
  SubdivisionStats& sum = result_.stats;
  const SubdivisionStats& part = worker.stats();
  sum.cells_tested += part.cells_tested;
  sum.faces_computed += part.faces_computed;
  sum.planes_moved += part.planes_moved;
  sum.planes_tried += part.planes_tried;
  sum.site_pairs += part.site_pairs;
  for (std::size_t k = 0; k < sum.rejected.size(); ++k) sum.rejected[k] += part.rejected[k];
}

Subdivision Subdivider::numbered() {
  Subdivision r;
  r.side = work_.options.side;
  r.stats = result_.stats;
  r.stats.leaves_cut = r.stats.tubes = 0;
  r.node.reserve(result_.node.size());
  r.leaf.reserve(result_.leaf.size());
  r.node.push_back(result_.node[0]);
  std::vector<std::uint32_t> stack{0};
  while (!stack.empty()) {
    const std::uint32_t n = stack.back();
    stack.pop_back();
    if (r.node[n].axis < 0) {
      r.leaf.push_back(std::move(result_.leaf[r.node[n].leaf]));
      r.stats.leaves_cut += r.leaf.back().cut.empty() ? 0 : 1;
      r.stats.tubes += r.leaf.back().tube.empty() ? 0 : 1;
      r.node[n].leaf = static_cast<std::uint32_t>(r.leaf.size() - 1);
      continue;
    }
    const std::uint32_t before = r.node[n].child, now = static_cast<std::uint32_t>(r.node.size());
    r.node[n].child = now;
    r.node.push_back(result_.node[before]);
    r.node.push_back(result_.node[before + 1]);
    stack.push_back(now + 1);
    stack.push_back(now);
  }
  return r;
}

Result<Subdivision> Subdivider::run(const Subdivision& coarse,
                                    std::span<const std::uint32_t> leaves, double fraction) {
  add_root();
  stack_.clear();
  result_ = coarse;
  work_.nodes = coarse.node.size();
  std::vector<bool> again(coarse.leaf.size(), false);
  for (const auto l : leaves) again[l] = true;
  for (std::uint32_t n = 0; n < coarse.node.size(); ++n) {
    const CellNode& node = coarse.node[n];
    if (node.axis >= 0) continue;
    const Leaf& leaf = coarse.leaf[node.leaf];
    if (!again[node.leaf]) {
      done_ += volume(leaf.box) / root_volume_;
      continue;
    }
    Cell cell;
    cell.node = n;
    cell.box = leaf.box;
    cell.depth = node.depth;
    cell.largest_diameter = fraction * diameter(leaf.box);
    cell.candidates = leaf.candidates;
    cell.triangles = leaf.triangles;
    cell.face = leaf.face;
    stack_.push_back(std::move(cell));
  }
  return finish();
}

Result<Subdivision> Subdivider::finish() {
  in_parallel(engines_.threads(), [this](int thread) { work(thread); });
  engines_.watch().rethrow();
  const Stop stop = engines_.watch().look();
  if (stop == Stop::kInterrupted)
    return Error{ErrorCode::kInterrupted, "interrupted during subdivision", "", {}};
  if (stop == Stop::kMemory)  // Numbering must not take more: nothing is assembled then.
    for (Leaf& leaf : result_.leaf) leaf.face = {};
  Subdivision subdivision = numbered();
  subdivision.stats.stages = engines_.stages();
  return subdivision;
}

}  // namespace

Result<Subdivision> subdivide(const SiteGeometry& geometry, const SubdivisionOptions& options,
                              EngineSet& engines) {
  return Subdivider(geometry, options, engines).run();
}

Result<Subdivision> refine(const SiteGeometry& geometry, const SubdivisionOptions& options,
                           EngineSet& engines, const Subdivision& coarse,
                           std::span<const std::uint32_t> leaves, double fraction) {
  return Subdivider(geometry, options, engines).run(coarse, leaves, fraction);
}

}  // namespace blum
