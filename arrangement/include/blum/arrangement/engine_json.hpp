/// Solids, problems and diagrams as JSON, one document a line: what a helper executable is asked
/// and answers. Doubles survive the way there and back (shortest digits that read back the same).
///
/// A text that is not what it should be (syntax, missing parts, wrong types, indices out of range)
/// gives ErrorCode::kBadArgument.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "blum/arrangement/face_diagram.hpp"
#include "blum/arrangement/face_problem.hpp"
#include "blum/kernel/result.hpp"

namespace blum {

/// What a helper is asked about the solid that it was given last.
struct EngineRequest {
  enum class Kind : std::uint8_t { kSolid, kSegment, kFace };
  Kind kind = Kind::kFace;
  Solid solid;      ///< kSolid
  Segment segment;  ///< kSegment
  Rect rect;        ///< kFace
  bool interior = false;
  std::vector<SiteId> candidates;
  std::vector<std::uint32_t> triangles;
};

[[nodiscard]] std::string solid_request(const Solid& solid);
[[nodiscard]] std::string segment_request(const Segment& segment,
                                          std::span<const SiteId> candidates,
                                          std::span<const std::uint32_t> triangles);
[[nodiscard]] std::string face_request(const FaceProblem& problem);
[[nodiscard]] Result<EngineRequest> read_request(std::string_view text);

/// A segment or face in bad position, or undecided, has no diagram but a reason.
[[nodiscard]] std::string failure_answer(FaceStatus status, std::string_view reason);
[[nodiscard]] std::string segment_answer(const SegmentDiagram& diagram);
[[nodiscard]] std::string face_answer(const FaceDiagram& diagram);

struct SegmentReply {
  FaceStatus status = FaceStatus::kUndecided;
  std::string reason;
  std::shared_ptr<const SegmentDiagram> diagram;  ///< kDecided
};
[[nodiscard]] Result<SegmentReply> read_segment_answer(std::string_view text);
[[nodiscard]] Result<FaceDiagram> read_face_answer(std::string_view text);

}  // namespace blum
