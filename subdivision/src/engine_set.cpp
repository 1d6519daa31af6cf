#include "blum/subdivision/engine_set.hpp"

#include <atomic>

#include "blum/arrangement/brute_engine.hpp"
#include "blum/arrangement/cgal_engine.hpp"
#include "blum/kernel/check.hpp"

namespace blum {
namespace {

/// The oracle behind the engine interface. It can only be stopped between two diagrams.
class BruteEngine final : public DiagramEngine {
 public:
  BruteEngine(const SiteGeometry& geometry, const std::atomic<bool>& stop)
      : solid_(geometry.solid()), kind_(geometry.kind()), stop_(stop) {}
  using DiagramEngine::face;
  SegmentAnswer segment(const Segment& segment, std::span<const SiteId> candidates,
                        std::span<const std::uint32_t> triangles) override {
    if (stop_) return {FaceStatus::kUndecided, kStopped, nullptr};
    auto d = brute_segment(solid_, segment, candidates, triangles, kind_ == DiagramKind::kVoronoi,
                           kind_);
    if (!d) return {FaceStatus::kBadPosition, "segment in bad position", nullptr};
    return {FaceStatus::kDecided, "", std::make_shared<const SegmentDiagram>(std::move(*d))};
  }
  FaceDiagram face(const FaceProblem& problem,
                   const std::array<std::shared_ptr<const SegmentDiagram>, 4>&) override {
    if (!stop_) {
      FaceProblem asked = problem;
      asked.kind = kind_;
      asked.interior = asked.interior || kind_ == DiagramKind::kVoronoi;
      return brute_face(asked);
    }
    FaceDiagram none;
    none.status = FaceStatus::kUndecided;
    none.reason = kStopped;
    none.rect = problem.rect;
    return none;
  }

 private:
  static constexpr const char* kStopped = "stopped";
  const Solid& solid_;
  const DiagramKind kind_;
  const std::atomic<bool>& stop_;
};

}  // namespace

EngineSet::EngineSet(const SiteGeometry& geometry, const SubdivisionOptions& options,
                     RunWatch& watch)
    : watch_(watch), inside_(geometry.solid()) {
  for (int t = 0; t < options.threads; ++t) {
    // Clusters do not tell which way the boundary cuts them.
    const bool parted = options.resolve || options.side != VoronoiSide::kBoth;
    production_.emplace_back(geometry, inside_, options.seed, parted);
    production_.back().stop_on(&watch_.flag());
    if (options.engine == Engine::kBrute)
      chosen_.push_back(std::make_unique<BruteEngine>(geometry, watch_.flag()));
    if (options.engine == Engine::kCgal) {
      const auto helper = find_cgal_helper();
      BLUM_CHECK(helper);
      auto engine = std::make_unique<CgalEngine>(geometry.solid(), *helper);
      engine->stop_on(&watch_.flag());
      chosen_.push_back(std::move(engine));
    }
  }
}

DiagramEngine& EngineSet::diagrams(int thread) {
  if (chosen_.empty()) return production_[thread];
  return *chosen_[thread];
}

StageCounts EngineSet::stages() {
  StageCounts sum;
  for (ProductionEngine& engine : production_) sum += engine.predicates().stages();
  return sum;
}

}  // namespace blum
