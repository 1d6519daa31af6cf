#include "blum/arrangement/diagram_engine.hpp"

namespace blum {

FaceDiagram DiagramEngine::face(const FaceProblem& problem) {
  std::array<std::shared_ptr<const SegmentDiagram>, 4> side;
  for (int s = 0; s < 4; ++s) {
    SegmentAnswer a = segment(side_segment(problem.rect, s), problem.candidates, problem.triangles);
    if (a.status != FaceStatus::kDecided) {
      FaceDiagram d;
      d.status = a.status;
      d.reason = a.reason;
      d.rect = problem.rect;
      return d;
    }
    side[s] = std::move(a.diagram);
  }
  return face(problem, side);
}

}  // namespace blum
