#include "planar_cells.hpp"

#include <algorithm>
#include <stdexcept>

namespace blum::cgal {

void sample_faces(PlanarCells& cells, const CurveTable& curves, const Window& window,
                  const std::vector<int>& above) {
  for (std::size_t e = 0; e < cells.edge.size(); ++e) {
    const PlanarCells::Edge& edge = cells.edge[e];
    if (above[e] < 0) continue;
    const Rational u = edge.sample.u.a0();
    const auto wanted = [&](int side) {
      const int f = edge.face[static_cast<std::size_t>(side)];
      return f >= 0 && !cells.face[static_cast<std::size_t>(f)].found;
    };
    if (!wanted(0) && !wanted(1)) continue;
    Root up = Root(window.v.hi), down = Root(window.v.lo);
    for (const Curve& c : curves.all()) {
      const Quadratic q = quadratic(c);
      if (q.vv == 0 && q.uv * u + q.v == 0) continue;  // no root over u, or the vertical line there
      const Roots r = roots(q.vv, q.uv * u + q.v, (q.uu * u + q.u) * u + q.c);
      for (int k = 0; k < r.count; ++k) {
        const Root& v = r.root[static_cast<std::size_t>(k)];
        const auto order = CGAL::compare(v, edge.sample.v);
        if (order == CGAL::LARGER && CGAL::compare(v, up) == CGAL::SMALLER) up = v;
        if (order == CGAL::SMALLER && CGAL::compare(v, down) == CGAL::LARGER) down = v;
      }
    }
    for (const int side : {0, 1}) {
      if (!wanted(side)) continue;
      auto& face = cells.face[static_cast<std::size_t>(edge.face[static_cast<std::size_t>(side)])];
      const Rational v =
          side == above[e] ? between(edge.sample.v, up) : between(down, edge.sample.v);
      face.sample = {Root(u), Root(v)};
      face.found = true;
    }
  }
  for (const auto& face : cells.face)
    if (!face.found) throw std::logic_error("a face without a sample");
}

int sign_at(const Quadratic& q, const ExactPoint& p, const CurveTable& curves,
            const std::vector<int>& incident) {
  constexpr int kFirstBits = 64, kLastBits = 1 << 16;
  const auto decided = [&](int bits) {
    const Range r = bounds(q, p.box(bits));
    return r.lo > 0 ? 1 : r.hi < 0 ? -1 : 0;
  };
  if (const int s = decided(kFirstBits); s != 0) return s;
  const Zeros z = zeros(q);
  if (z.everywhere) return 0;
  for (const Curve& c : z.on) {
    const int k = curves.find(c);
    if (k >= 0 && std::find(incident.begin(), incident.end(), k) != incident.end()) return 0;
  }
  // Bounds cannot show a zero: ask whether it is one, but not before they are narrow.
  if (const int s = decided(4 * kFirstBits); s != 0) return s;
  for (const Curve& c : z.on)
    if (p.is_on(c)) return 0;
  for (int bits = 8 * kFirstBits; bits <= kLastBits; bits *= 2)
    if (const int s = decided(bits); s != 0) return s;
  throw std::runtime_error("a sign that no precision decides");
}

}  // namespace blum::cgal
