#include "blum/subdivision/local_diagrams.hpp"

#include "blum/kernel/check.hpp"

namespace blum {

void LocalDiagrams::adopt(std::shared_ptr<const FaceDiagram> face) {
  BLUM_REQUIRE(face->status == FaceStatus::kDecided);
  segment_.insert(segment_.end(), face->side.begin(), face->side.end());
  face_.push_back(std::move(face));
}

SegmentAnswer LocalDiagrams::segment(const Segment& segment) {
  for (const auto& known : segment_)
    if (known->segment == segment) return {FaceStatus::kDecided, "", known};
  SegmentAnswer a = engine_.segment(segment, candidates_, triangles_);
  if (a.status == FaceStatus::kDecided) segment_.push_back(a.diagram);
  return a;
}

std::shared_ptr<const FaceDiagram> LocalDiagrams::whole_of(const Rect& rect) {
  for (const auto& w : whole_) {
    const Rect& all = w->rect;
    if (all.axis != rect.axis || all.level != rect.level || all.u0 > rect.u0 || all.u1 < rect.u1 ||
        all.v0 > rect.v0 || all.v1 < rect.v1)
      continue;
    Rect half = all;
    for (double Rect::*end : {&Rect::u0, &Rect::u1, &Rect::v0, &Rect::v1})
      if (half == all) half.*end = rect.*end;
    if (half == rect) return w;
    auto d = face(half);
    if (d->status != FaceStatus::kDecided) return nullptr;
    whole_.insert(whole_.begin(), std::move(d));
    return whole_of(rect);
  }
  return nullptr;
}

std::shared_ptr<const FaceDiagram> LocalDiagrams::face(const Rect& rect) {
  for (const auto& known : face_)
    if (known->rect == rect) return known;
  ++computed_;
  std::array<std::shared_ptr<const SegmentDiagram>, 4> side;
  for (int s = 0; s < 4; ++s) {
    SegmentAnswer a = segment(side_segment(rect, s));
    if (a.status != FaceStatus::kDecided) {
      auto failed = std::make_shared<FaceDiagram>();
      failed->status = a.status;
      failed->reason = a.reason;
      failed->rect = rect;
      return failed;
    }
    side[s] = std::move(a.diagram);
  }
  FaceProblem problem{&solid_, rect, candidates_, triangles_};
  const auto whole = whole_of(rect);
  problem.whole = whole.get();
  auto diagram = std::make_shared<const FaceDiagram>(engine_.face(problem, side));
  if (diagram->status == FaceStatus::kDecided) face_.push_back(diagram);
  return diagram;
}

}  // namespace blum
