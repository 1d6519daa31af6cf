/// The tree, and the cells that wait for a worker.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <vector>

#include "blum/subdivision/engine_set.hpp"
#include "blum/subdivision/refine.hpp"
#include "cell_work.hpp"

namespace blum {

inline double volume(const Box3& box) {
  double v = 1;
  for (int k = 0; k < 3; ++k) v *= box.hi[k] - box.lo[k];
  return v;
}

/// Workers take the latest first: the tree is walked by depth, and few cells wait.
class Subdivider {
 public:
  Subdivider(const SiteGeometry& geometry, const SubdivisionOptions& options, EngineSet& engines)
      : engines_(engines), work_{geometry, options, engines} {}

  Result<Subdivision> run();
  Result<Refined> run(const Subdivision& coarse, const Refinement& refinement);

 private:
  void add_root();
  void find_surface();
  /// The leaf as a cell whose leaves will have at most `fraction` of its diameter.
  [[nodiscard]] static Cell cell_of(const Leaf& leaf, std::uint32_t node, int depth,
                                    double fraction);
  /// A leaf that is not fine enough, as a cell.
  [[nodiscard]] std::optional<Cell> to_divide(const Cell& cell, const CellOutcome& outcome,
                                              int thread) const;
  /// Leaves with a part that is not accepted are as they were. Returns how many are divided.
  [[nodiscard]] std::size_t undo_unfinished(const Subdivision& coarse,
                                            const std::vector<std::uint32_t>& roots);
  /// The error, if the run was interrupted.
  [[nodiscard]] std::optional<Error> work_on_all();
  [[nodiscard]] Subdivision finished();
  void work(int thread);
  /// Waits for a cell; nothing: there will be none, or time is up.
  [[nodiscard]] std::optional<Cell> take();
  void put(const Cell& cell, CellOutcome outcome);
  void put_back(Cell cell);
  void close(const Cell& cell, Leaf leaf);
  void open(const Cell& cell, Split split);
  [[nodiscard]] Subdivision numbered();

  EngineSet& engines_;
  CellWork work_;
  const Refinement* refinement_ = nullptr;
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

}  // namespace blum
