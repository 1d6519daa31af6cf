#include "blum/arrangement/production_engine.hpp"

#include "face_engine.hpp"
#include "segment_engine.hpp"

namespace blum {

struct ProductionEngine::Impl {
  EngineContext context;
  Impl(const SiteGeometry& g, const InsideOracle& i, std::uint64_t seed) : context(g, i, seed) {}
};

ProductionEngine::ProductionEngine(const SiteGeometry& geometry, const InsideOracle& inside,
                                   std::uint64_t seed)
    : impl_(std::make_unique<Impl>(geometry, inside, seed)) {}
ProductionEngine::~ProductionEngine() = default;
ProductionEngine::ProductionEngine(ProductionEngine&&) noexcept = default;

SegmentAnswer ProductionEngine::segment(const Segment& segment, std::span<const SiteId> candidates,
                                        std::span<const std::uint32_t> triangles) {
  SegmentEngine engine(impl_->context);
  auto diagram = std::make_shared<SegmentDiagram>();
  const Trouble t = engine.solve(segment, candidates, triangles, *diagram);
  if (t) return {t.status, t.reason, nullptr};
  return {FaceStatus::kDecided, "", std::move(diagram)};
}

FaceDiagram ProductionEngine::face(
    const FaceProblem& problem, const std::array<std::shared_ptr<const SegmentDiagram>, 4>& side) {
  return FaceEngine(impl_->context, problem).solve(side);
}

std::vector<SiteId> ProductionEngine::prune(std::span<const SiteId> candidates, const Point3& lo,
                                            const Point3& hi) const {
  std::vector<LocalForm> forms;
  blum::prune(impl_->context.geometry, candidates, Range::of(lo, hi), forms);
  std::vector<SiteId> kept;
  kept.reserve(forms.size());
  for (const LocalForm& f : forms) kept.push_back(f.site);
  return kept;
}

std::vector<std::vector<SiteId>> ProductionEngine::tie_groups(std::span<const SiteId> candidates,
                                                              const Point3& lo, const Point3& hi) {
  std::vector<LocalForm> forms;
  blum::prune(impl_->context.geometry, candidates, Range::of(lo, hi), forms);
  const Groups groups = Groups::make(impl_->context, forms);
  if (!groups.cliques) return {};
  std::vector<std::vector<SiteId>> sites(groups.count);
  for (std::size_t i = 0; i < forms.size(); ++i) sites[groups.of[i]].push_back(forms[i].site);
  return sites;
}

Predicates& ProductionEngine::predicates() { return impl_->context.predicates; }
const EngineCounts& ProductionEngine::counts() const { return impl_->context.counts; }

}  // namespace blum
