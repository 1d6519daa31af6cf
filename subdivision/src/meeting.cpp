#include "meeting.hpp"

#include <algorithm>
#include <array>

#include "blum/kernel/ball.hpp"

namespace blum {

std::vector<std::uint32_t> triangles_meeting(const SiteGeometry& geometry,
                                             std::span<const std::uint32_t> triangles,
                                             const Box3& box) {
  const Solid& solid = geometry.solid();
  std::vector<std::uint32_t> kept;
  for (const auto t : triangles) {
    const auto& v = solid.triangle[t].vertex;
    bool apart = false;
    for (int k = 0; k < 3 && !apart; ++k) {
      const double a = solid.point[v[0]][k], b = solid.point[v[1]][k], c = solid.point[v[2]][k];
      apart = std::min({a, b, c}) > box.hi[k] || std::max({a, b, c}) < box.lo[k];
    }
    if (apart) continue;
    // Outside the triangle's plane, or of its prism on one side.
    const SiteId face = geometry.index().face(t);
    const auto beyond = [&](const BallVector& w, const Point3& base, bool both) {
      Point3 c;
      double reach = 0;
      for (int k = 0; k < 3; ++k) {
        c[k] = 0.5 * (box.lo[k] + box.hi[k]);
        reach += w[k].magnitude() * std::max(box.hi[k] - c[k], c[k] - box.lo[k]);
      }
      reach *= 1 + 0x1p-40;
      const Ball h = dot(w, difference(c, base));
      return h.low() > reach || (both && h.high() < -reach);
    };
    apart = beyond(geometry.unit(face), geometry.base(face), true);
    const auto domain = geometry.domain(face);
    for (int k = 0; k < 3 && !apart; ++k)
      apart = beyond(domain[k].w, solid.point[domain[k].base], false);
    if (apart) continue;
    kept.push_back(t);
  }
  return kept;
}

std::optional<bool> edge_crosses(Predicates& predicates, std::uint32_t edge, const Rect& rect) {
  const Solid& solid = predicates.geometry().solid();
  const double a = solid.point[solid.edge[edge].vertex[0]][rect.axis],
               b = solid.point[solid.edge[edge].vertex[1]][rect.axis];
  if (a == rect.level || b == rect.level) return std::nullopt;
  if ((a < rect.level) == (b < rect.level)) return false;
  const auto beyond = [&](int along, double value) {
    return predicates.compare_edge_crossing(edge, rect.axis, rect.level, along, value);
  };
  const int u = u_axis(rect.axis), v = v_axis(rect.axis);
  const std::array above{beyond(u, rect.u0), -beyond(u, rect.u1), beyond(v, rect.v0),
                         -beyond(v, rect.v1)};
  if (std::ranges::find(above, -1) != above.end()) return false;
  if (std::ranges::find(above, 0) != above.end()) return std::nullopt;
  return true;
}

std::optional<bool> is_section(Predicates& predicates, std::uint32_t triangle, const Box3& box) {
  for (int axis = 0; axis < 3; ++axis)
    for (int corner = 0; corner < 4; ++corner) {
      const int ua = u_axis(axis), va = v_axis(axis);
      const double u = (corner & 1) != 0 ? box.hi[ua] : box.lo[ua],
                   v = (corner & 2) != 0 ? box.hi[va] : box.lo[va];
      const int low = predicates.plane_side(point_on(axis, box.lo[axis], u, v), triangle),
                high = predicates.plane_side(point_on(axis, box.hi[axis], u, v), triangle);
      if (low == 0 || high == 0) return std::nullopt;
      if (low == high) continue;
      const auto pierced = predicates.pierces(triangle, axis, u, v);
      if (!pierced) return std::nullopt;
      return *pierced != 0;
    }
  return false;
}

}  // namespace blum
