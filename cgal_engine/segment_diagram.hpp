/// The diagram on a segment: all roots on one line, in exact order.
#pragma once

#include "blum/arrangement/face_diagram.hpp"
#include "forms.hpp"
#include "labelled_cells.hpp"

namespace blum::cgal {

/// No test: all is inside. Throws BadPosition.
[[nodiscard]] SegmentDiagram segment_diagram(const Solid& solid, const Segment& segment,
                                             std::span<const SiteId> candidates,
                                             std::span<const std::uint32_t> triangles,
                                             const InsideTest* test);

}  // namespace blum::cgal
