#include "voronoi_place.hpp"

#include <algorithm>
#include <bit>
#include <optional>

#include "blum/subdivision/cell_test.hpp"
#include "meeting.hpp"

namespace blum {
namespace {

Point3 centre(const Box3& box) {
  Point3 c;
  for (int k = 0; k < 3; ++k) c[k] = 0.5 * (box.lo[k] + box.hi[k]);
  return c;
}

/// Bound of |w.(x - centre)| over the box.
double reach(const BallVector& w, const Box3& box) {
  const Point3 c = centre(box);
  double r = 0;
  for (int k = 0; k < 3; ++k) r += w[k].magnitude() * std::max(box.hi[k] - c[k], c[k] - box.lo[k]);
  return r * (1 + 0x1p-40);
}

Place by_bounds(const SiteGeometry& geometry, SiteId site, const Box3& box) {
  const Solid& solid = geometry.solid();
  int n = 0;
  const auto corner = geometry.corners(site, n);
  bool within = true;
  for (int axis = 0; axis < 3; ++axis) {
    bool below = true, above = true;
    for (int k = 0; k < n; ++k) {
      const double x = solid.point[corner[k]][axis];
      below &= x < box.lo[axis];
      above &= x > box.hi[axis];
      within &= x > box.lo[axis] && x < box.hi[axis];
    }
    if (below || above) return Place::kApart;
  }
  if (within) return Place::kWithin;
  const Point3 c = centre(box);
  // Conditions of the site's own extent; those of incidence say nothing about where it lies.
  const auto domain = geometry.domain(site);
  for (std::uint32_t k = 0; k < geometry.own_conditions(site); ++k)
    if (dot(domain[k].w, difference(c, solid.point[domain[k].base])).low() >
        reach(domain[k].w, box))
      return Place::kApart;
  const BallVector d = difference(c, geometry.base(site));
  const BallVector& u = geometry.unit(site);
  if (geometry.index().kind(site) == SiteKind::kFace) {
    if (side_of_plane(geometry, site, box) != 0) return Place::kApart;
  } else if (geometry.index().kind(site) == SiteKind::kEdge) {
    // Across the line, in the directions of the axes.
    for (int axis = 0; axis < 3; ++axis) {
      BallVector e{};
      e[axis] = Ball(1.0);
      const BallVector w = cross(u, e);
      const Ball h = dot(d, w);
      if (h.low() > reach(w, box) || h.high() < -reach(w, box)) return Place::kApart;
    }
  }
  return Place::kMeets;
}

/// The faces of the box that a boundary edge crosses, as bits; nullopt: a face's border or a plane
/// of the box is hit exactly.
std::optional<std::uint8_t> crossings(Predicates& predicates, std::uint32_t edge, const Box3& box) {
  std::uint8_t faces = 0;
  for (int f = 0; f < 6; ++f) {
    const auto crossed = edge_crosses(predicates, edge, box_face(box, f));
    if (!crossed) return std::nullopt;
    if (*crossed) faces |= static_cast<std::uint8_t>(1 << f);
  }
  return faces;
}

}  // namespace

int side_of_plane(const SiteGeometry& geometry, SiteId triangle, const Box3& box) {
  const BallVector& n = geometry.unit(triangle);
  const Ball h = dot(difference(centre(box), geometry.base(triangle)), n);
  const double r = reach(n, box);
  return h.low() > r ? 1 : h.high() < -r ? -1 : 0;
}

SitePlace place_of(Predicates& predicates, SiteId site, const Box3& box) {
  const SiteGeometry& geometry = predicates.geometry();
  SitePlace p{by_bounds(geometry, site, box)};
  if (p.place != Place::kMeets) return p;
  const auto element = geometry.index().element(site);
  if (geometry.index().kind(site) == SiteKind::kEdge) {
    // The bounds may have missed that it does not meet the box.
    if (const auto faces = crossings(predicates, element, box)) {
      if (*faces == 0) p.place = Place::kApart;
      p.traces = std::popcount(*faces);
      p.crossed = *faces;
    }
    return p;
  }
  int n = 0;
  for (const auto e : geometry.solid().triangle[element].edge) {
    const auto faces = crossings(predicates, e, box);
    if (!faces) return p;
    n += std::popcount(*faces);
    p.crossed |= *faces;
  }
  // Two crossings end each component of the trace.
  p.traces = n / 2;
  if (n > 0) return p;
  if (const auto section = is_section(predicates, element, box)) {
    if (!*section) p.place = Place::kApart;
    p.traces = *section ? 1 : 0;
    p.section = *section;
  }
  return p;
}

}  // namespace blum
