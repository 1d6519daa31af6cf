#include "blum/subdivision/engine_set.hpp"

#include "blum/arrangement/brute_engine.hpp"

namespace blum {
namespace {

/// The oracle behind the engine interface.
class BruteEngine final : public DiagramEngine {
 public:
  explicit BruteEngine(const Solid& solid) : solid_(solid) {}
  using DiagramEngine::face;
  SegmentAnswer segment(const Segment& segment, std::span<const SiteId> candidates,
                        std::span<const std::uint32_t> triangles) override {
    auto d = brute_segment(solid_, segment, candidates, triangles);
    if (!d) return {FaceStatus::kBadPosition, "segment in bad position", nullptr};
    return {FaceStatus::kDecided, "", std::make_shared<const SegmentDiagram>(std::move(*d))};
  }
  FaceDiagram face(const FaceProblem& problem,
                   const std::array<std::shared_ptr<const SegmentDiagram>, 4>&) override {
    return brute_face(problem);
  }

 private:
  const Solid& solid_;
};

}  // namespace

EngineSet::EngineSet(const SiteGeometry& geometry, Engine engine, std::uint64_t seed,
                     bool part_clusters)
    : inside_(geometry.solid()), production_(geometry, inside_, seed, part_clusters) {
  if (engine == Engine::kBrute) chosen_ = std::make_unique<BruteEngine>(geometry.solid());
  cache_ = std::make_unique<DiagramCache>(chosen_ ? *chosen_ : production_);
}

}  // namespace blum
