#include "blum/arrangement/flow.hpp"

#include <algorithm>

#include "local_form.hpp"

namespace blum {

namespace {

/// Do all points inside the solid whose foot is on the reflex edge lie on that side of it? A
/// direction from the foot is in the cone of the inner normals of the two faces.
bool fan_points_out(const SiteGeometry& geometry, std::uint32_t edge, int axis,
                    const Ball& outward) {
  const auto& faces = geometry.solid().edge[edge].triangle;
  return std::ranges::all_of(faces, [&](std::uint32_t t) {
    return (-(geometry.unit(geometry.index().face(t))[axis] * outward)).sign() == 1;
  });
}

}  // namespace

bool never_leaves(const SiteGeometry& geometry, SiteId site, const Rect& rect, int outward) {
  const Ball sign(outward);
  const bool medial = geometry.kind() == DiagramKind::kMedial;
  if (medial && geometry.index().kind(site) == SiteKind::kFace)
    return (-(geometry.unit(site)[rect.axis] * sign)).sign() == 1;
  if (medial && geometry.index().kind(site) == SiteKind::kEdge &&
      fan_points_out(geometry, geometry.index().element(site), rect.axis, sign))
    return true;
  const Range range = Range::of(point_on(rect.axis, rect.level, rect.u0, rect.v0),
                                point_on(rect.axis, rect.level, rect.u1, rect.v1));
  LocalForm form;
  if (!local_form(geometry, site, range, form)) return true;  // governs no point of the rectangle
  if (form.side != 0)
    return (with_sign(geometry.unit(site)[rect.axis], form.side) * sign).sign() == 1;
  double spread = 0;
  for (int k = 0; k < 3; ++k) spread += 2 * form.matrix(rect.axis, k).magnitude() * range.half[k];
  return (form.gradient[rect.axis] * sign).low() > spread * (1 + 0x1p-40);
}

}  // namespace blum
