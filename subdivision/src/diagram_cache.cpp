#include <bit>
#include <unordered_map>

#include "blum/subdivision/subdivision.hpp"

namespace blum {
namespace {

struct Hash {
  static std::size_t mix(std::size_t h, double x) {
    h ^= std::bit_cast<std::uint64_t>(x) + 0x9e3779b97f4a7c15u + (h << 6) + (h >> 2);
    return h * 0xbf58476d1ce4e5b9u;
  }
  std::size_t operator()(const Segment& s) const {
    std::size_t h = static_cast<std::size_t>(s.axis);
    for (const double x : {s.u, s.v, s.t0, s.t1}) h = mix(h, x);
    return h;
  }
  std::size_t operator()(const Rect& r) const {
    std::size_t h = static_cast<std::size_t>(r.axis);
    for (const double x : {r.level, r.u0, r.u1, r.v0, r.v1}) h = mix(h, x);
    return h;
  }
};

}  // namespace

struct DiagramCache::Impl {
  DiagramEngine& engine;
  std::unordered_map<Rect, std::weak_ptr<const FaceDiagram>, Hash> face;
  std::unordered_map<Segment, std::weak_ptr<const SegmentDiagram>, Hash> segment;
  std::size_t computed = 0;
  std::size_t next_sweep = 1 << 16;
};

DiagramCache::DiagramCache(DiagramEngine& engine) : impl_(new Impl{engine, {}, {}, 0, 1 << 16}) {}
DiagramCache::~DiagramCache() = default;

SegmentAnswer DiagramCache::segment(const Segment& segment, std::span<const SiteId> candidates,
                                    std::span<const std::uint32_t> triangles) {
  auto& slot = impl_->segment[segment];
  if (auto known = slot.lock()) return {FaceStatus::kDecided, "", std::move(known)};
  SegmentAnswer a = impl_->engine.segment(segment, candidates, triangles);
  slot = a.diagram;
  return a;
}

std::shared_ptr<const FaceDiagram> DiagramCache::face(const Solid& solid, const Rect& rect,
                                                      std::span<const SiteId> candidates,
                                                      std::span<const std::uint32_t> triangles) {
  if (auto known = impl_->face[rect].lock()) return known;
  ++impl_->computed;
  const auto failed = [&](FaceStatus status, const char* reason) {
    auto d = std::make_shared<FaceDiagram>();
    d->status = status;
    d->reason = reason;
    d->rect = rect;
    return d;
  };
  std::array<std::shared_ptr<const SegmentDiagram>, 4> side;
  for (int s = 0; s < 4; ++s) {
    SegmentAnswer a = segment(side_segment(rect, s), candidates, triangles);
    if (a.status != FaceStatus::kDecided) return failed(a.status, a.reason);
    side[s] = std::move(a.diagram);
  }
  const FaceProblem problem{&solid, rect, candidates, triangles};
  std::shared_ptr<const FaceDiagram> d =
      std::make_shared<const FaceDiagram>(impl_->engine.face(problem, side));
  impl_->face[rect] = d;
  if (impl_->face.size() + impl_->segment.size() > impl_->next_sweep) sweep();
  return d;
}

void DiagramCache::sweep() {
  std::erase_if(impl_->face, [](const auto& e) { return e.second.expired(); });
  std::erase_if(impl_->segment, [](const auto& e) { return e.second.expired(); });
  impl_->next_sweep = 2 * (impl_->face.size() + impl_->segment.size()) + (1 << 16);
}

std::size_t DiagramCache::faces_computed() const { return impl_->computed; }

}  // namespace blum
