/// What one run computes with: an engine for every thread, and what ends the run.
#pragma once

#include <memory>
#include <vector>

#include "blum/arrangement/production_engine.hpp"
#include "blum/kernel/inside.hpp"
#include "blum/kernel/site_geometry.hpp"
#include "blum/subdivision/run_watch.hpp"
#include "blum/subdivision/subdivision.hpp"

namespace blum {

/// Requires options.threads >= 1; the watch is made from the same options and outlives this.
/// `thread` below: less than threads(); what it gives must be used by one thread at a time.
class EngineSet {
 public:
  EngineSet(const SiteGeometry& geometry, const SubdivisionOptions& options, RunWatch& watch);

  [[nodiscard]] int threads() const { return static_cast<int>(production_.size()); }
  /// Always there, for pruning.
  [[nodiscard]] ProductionEngine& production(int thread = 0) { return production_[thread]; }
  /// ProductionEngine::prefer_plain_reasons, for all.
  void prefer_plain_reasons() {
    for (ProductionEngine& engine : production_) engine.prefer_plain_reasons();
  }
  /// The engine that was asked for.
  [[nodiscard]] DiagramEngine& diagrams(int thread = 0);
  [[nodiscard]] const InsideOracle& inside() const { return inside_; }
  [[nodiscard]] RunWatch& watch() { return watch_; }

  /// Decisions of all production engines. Depends on the number of threads: each engine remembers
  /// what it has decided.
  [[nodiscard]] StageCounts stages();

 private:
  RunWatch& watch_;
  InsideOracle inside_;
  std::vector<ProductionEngine> production_;
  std::vector<std::unique_ptr<DiagramEngine>> chosen_;  // empty: production
};

}  // namespace blum
