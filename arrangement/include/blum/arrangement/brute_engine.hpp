/// The oracle: the diagram of a FaceProblem by exact algebra alone. Slow, and independent of the
/// production engine: it shares the problem and answer types and nothing else.
#pragma once

#include "blum/arrangement/face_diagram.hpp"
#include "blum/arrangement/face_problem.hpp"

namespace blum {

/// The exact diagram on a segment. Candidates, triangles and interior as in FaceProblem.
/// Returns nullopt in bad position (an end on a tie or on ∂O, three essential governors at a
/// point).
[[nodiscard]] std::optional<SegmentDiagram> brute_segment(const Solid& solid,
                                                          const Segment& segment,
                                                          std::span<const SiteId> candidates,
                                                          std::span<const std::uint32_t> triangles,
                                                          bool interior = false,
                                                          DiagramKind kind = DiagramKind::kMedial);

/// The exact diagram. Every event is exact (FaceNode::exact), with all its governors, in a
/// certified rectangle; four and more governors, tangencies, common components, arcs along domain
/// lines and rims are recognised exactly.
[[nodiscard]] FaceDiagram brute_face(const FaceProblem& problem);

}  // namespace blum
