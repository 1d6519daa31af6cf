#include "blum/arrangement/production_engine.hpp"

#include <limits>
#include <utility>

#include "blum/arrangement/brute_engine.hpp"
#include "face_engine.hpp"
#include "segment_engine.hpp"

namespace blum {

struct ProductionEngine::Impl {
  EngineContext context;
  bool plain_first = false;
  Impl(const SiteGeometry& g, const InsideOracle& i, std::uint64_t seed, bool part_clusters)
      : context(g, i, seed) {
    context.part_clusters = part_clusters;
  }
};

ProductionEngine::ProductionEngine(const SiteGeometry& geometry, const InsideOracle& inside,
                                   std::uint64_t seed, bool part_clusters)
    : impl_(std::make_unique<Impl>(geometry, inside, seed, part_clusters)) {}
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
  EngineContext& context = impl_->context;
  if (problem.whole != nullptr && (impl_->plain_first || context.parts != nullptr)) {
    FaceProblem alone = problem;  // a certificate has reasons for each face of its own
    alone.whole = nullptr;
    return face(alone, side);
  }
  if (impl_->plain_first) {
    context.plain = true;
    FaceDiagram d = FaceEngine(context, problem).solve(side);
    context.plain = false;
    if (d.status != FaceStatus::kUndecided || context.stopped()) return d;
    if (context.parts != nullptr) context.parts->clear();
    // A checker may look at the parts by exact algebra, which knows no clusters.
    const bool parted = std::exchange(context.part_clusters, true);
    d = FaceEngine(context, problem).solve(side);
    context.part_clusters = parted;
    return d;
  }
  return FaceEngine(context, problem).solve(side);
}

FaceDiagram ProductionEngine::face(const FaceProblem& problem,
                                   const std::array<std::shared_ptr<const SegmentDiagram>, 4>& side,
                                   std::vector<PartRecord>& parts) {
  impl_->context.parts = &parts;
  FaceDiagram d = face(problem, side);
  impl_->context.parts = nullptr;
  return d;
}

std::vector<SiteId> ProductionEngine::prune(std::span<const SiteId> candidates, const Point3& lo,
                                            const Point3& hi, const DistanceHint& hint) const {
  std::vector<LocalForm> forms;
  const Range range = Range::of(lo, hi);
  blum::prune(impl_->context.geometry, candidates, range, forms, nullptr,
              hint ? hint(range.center) : std::numeric_limits<double>::infinity());
  std::vector<SiteId> kept;
  kept.reserve(forms.size());
  for (const LocalForm& f : forms) kept.push_back(f.site);
  return kept;
}

std::vector<std::vector<SiteId>> ProductionEngine::tie_groups(std::span<const SiteId> candidates,
                                                              const Point3& lo, const Point3& hi) {
  std::vector<LocalForm> forms;
  const Range range = Range::of(lo, hi);
  blum::prune(impl_->context.geometry, candidates, range, forms);
  Groups groups = Groups::by_ties(impl_->context, forms);
  if (!groups.cliques) groups = Groups::by_feet(impl_->context, forms, range);
  if (!groups.cliques) return {};
  std::vector<std::vector<SiteId>> sites(groups.count);
  for (std::size_t i = 0; i < forms.size(); ++i) sites[groups.of[i]].push_back(forms[i].site);
  return sites;
}

void ProductionEngine::decide_clusters(const FaceProblem& problem, FaceDiagram& diagram) const {
  for (FaceNode& node : diagram.node) {
    if (node.exact) continue;
    const int axis = problem.rect.axis;
    const Rect part{axis, problem.rect.level, node.u0, node.u1, node.v0, node.v1};
    const auto candidates = prune(problem.candidates, point_on(axis, part.level, part.u0, part.v0),
                                  point_on(axis, part.level, part.u1, part.v1));
    FaceProblem exact = problem;
    exact.kind = impl_->context.geometry.kind();
    exact.interior = exact.interior || impl_->context.voronoi();
    exact.rect = part;
    exact.candidates = candidates;
    const FaceDiagram d = brute_face(exact);
    if (d.status != FaceStatus::kDecided) continue;
    const FaceNode* only = nullptr;
    std::size_t events = 0;
    for (const FaceNode& n : d.node)
      if (n.kind == FaceNode::Kind::kEvent) {
        ++events;
        only = &n;
      }
    if (events != 1) continue;
    node.exact = true;
    node.governors = only->governors;
  }
}

void ProductionEngine::prefer_plain_reasons() { impl_->plain_first = true; }
void ProductionEngine::prefer_slices() { impl_->context.slices_first = true; }
void ProductionEngine::prefer_links() { impl_->context.links_first = true; }
void ProductionEngine::stop_on(const std::atomic<bool>* stop) { impl_->context.stop = stop; }
Predicates& ProductionEngine::predicates() { return impl_->context.predicates; }
const EngineCounts& ProductionEngine::counts() const { return impl_->context.counts; }

}  // namespace blum
