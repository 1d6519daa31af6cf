#include "meeting.hpp"

#include <algorithm>

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

}  // namespace blum
