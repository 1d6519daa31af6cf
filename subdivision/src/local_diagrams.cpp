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
  for (const auto& w : whole_)
    if (w->rect.axis == rect.axis && w->rect.level == rect.level) problem.whole = w.get();
  auto diagram = std::make_shared<const FaceDiagram>(engine_.face(problem, side));
  if (diagram->status == FaceStatus::kDecided) face_.push_back(diagram);
  return diagram;
}

}  // namespace blum
