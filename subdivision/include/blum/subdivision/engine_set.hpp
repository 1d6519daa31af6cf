/// What one run computes diagrams with: the production engine (always, for pruning), the engine
/// that was asked for, and the cache of diagrams.
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "blum/arrangement/production_engine.hpp"
#include "blum/kernel/inside.hpp"
#include "blum/kernel/site_geometry.hpp"
#include "blum/subdivision/subdivision.hpp"

namespace blum {

class EngineSet {
 public:
  EngineSet(const SiteGeometry& geometry, Engine engine, std::uint64_t seed,
            bool part_clusters = false);

  [[nodiscard]] ProductionEngine& production() { return production_; }
  [[nodiscard]] const InsideOracle& inside() const { return inside_; }
  [[nodiscard]] DiagramCache& cache() { return *cache_; }

 private:
  InsideOracle inside_;
  ProductionEngine production_;
  std::unique_ptr<DiagramEngine> chosen_;  // null: production
  std::unique_ptr<DiagramCache> cache_;
};

}  // namespace blum
