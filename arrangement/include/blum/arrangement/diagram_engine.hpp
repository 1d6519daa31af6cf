/// The interface behind which the production engine and its oracle stand.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "blum/arrangement/face_diagram.hpp"
#include "blum/arrangement/face_problem.hpp"

namespace blum {

/// Answer for a segment: `diagram` is set iff status is kDecided.
struct SegmentAnswer {
  FaceStatus status = FaceStatus::kDecided;
  const char* reason = "";
  std::shared_ptr<const SegmentDiagram> diagram;
};

class DiagramEngine {
 public:
  virtual ~DiagramEngine() = default;

  /// Candidates, triangles: supersets as in FaceProblem.
  [[nodiscard]] virtual SegmentAnswer segment(const Segment& segment,
                                              std::span<const SiteId> candidates,
                                              std::span<const std::uint32_t> triangles) = 0;

  /// `side[k]` must be the diagram of side_segment(problem.rect, k), by the same engine.
  [[nodiscard]] virtual FaceDiagram face(
      const FaceProblem& problem,
      const std::array<std::shared_ptr<const SegmentDiagram>, 4>& side) = 0;

  /// The same with sides computed here.
  [[nodiscard]] FaceDiagram face(const FaceProblem& problem);
};

}  // namespace blum
