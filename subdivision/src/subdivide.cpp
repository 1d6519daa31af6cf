#include "blum/subdivision/subdivision.hpp"

#include <algorithm>

#include "blum/kernel/parallel.hpp"
#include "subdivider.hpp"

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
  if (refinement_ != nullptr && std::chrono::steady_clock::now() > refinement_->deadline)
    return std::nullopt;
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

void Subdivider::put_back(Cell cell) {
  {
    const std::lock_guard lock(mutex_);
    stack_.push_back(std::move(cell));
    --busy_;
  }
  changed_.notify_all();
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
      if (auto again = to_divide(*cell, outcome, thread))
        put_back(*std::move(again));
      else
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
  r.surface = result_.surface;
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

std::optional<Error> Subdivider::work_on_all() {
  in_parallel(engines_.threads(), [this](int thread) { work(thread); });
  engines_.watch().rethrow();
  if (engines_.watch().look() != Stop::kInterrupted) return std::nullopt;
  return Error{ErrorCode::kInterrupted, "interrupted during subdivision", "", {}};
}

Subdivision Subdivider::finished() {
  Subdivision subdivision = numbered();
  subdivision.stats.stages = engines_.stages();
  return subdivision;
}

/// In a Voronoi diagram the faces of all cells on the box are parts of its six; in a medial one
/// they lie outside the solid.
void Subdivider::find_surface() {
  Cell& root = stack_.back();
  for_each_in_parallel(engines_.threads(), root.face.size(), [&](int thread, std::size_t f) {
    LocalDiagrams diagrams(engines_.diagrams(thread), work_.geometry.solid(), root.candidates, {});
    auto face = diagrams.face(box_face(root.box, static_cast<int>(f)));
    if (face->status == FaceStatus::kDecided) result_.surface[f] = std::move(face);
  });
  root.face = result_.surface;
}

Result<Subdivision> Subdivider::run() {
  add_root();
  if (work_.geometry.kind() == DiagramKind::kVoronoi) find_surface();
  if (auto interrupted = work_on_all()) return *interrupted;
  if (engines_.watch().look() == Stop::kMemory)
    // Numbering must not take more: nothing is assembled then.
    for (Leaf& leaf : result_.leaf) leaf.face = {};
  return finished();
}

Result<Subdivision> subdivide(const SiteGeometry& geometry, const SubdivisionOptions& options,
                              EngineSet& engines) {
  return Subdivider(geometry, options, engines).run();
}

}  // namespace blum
