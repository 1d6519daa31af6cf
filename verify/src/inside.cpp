#include "inside.hpp"

#include <algorithm>

namespace blum::verify {

int turn(int axis, const Point3& p, const Point3& q, double u, double v) {
  const int ua = u_axis(axis), va = v_axis(axis);
  return decide([&]<class N>(const N&) {
    return sign_of(
        N((N(q[ua]) - N(p[ua])) * (N(v) - N(p[va])) - (N(q[va]) - N(p[va])) * (N(u) - N(p[ua]))));
  });
}

std::optional<bool> is_inside(const Shape& shape, const Point3& x) {
  for (int axis = 0; axis < 3; ++axis) {
    const int u = u_axis(axis), v = v_axis(axis);
    bool touches = false, inside = false;
    for (std::uint32_t t = 0; t < shape.triangle.size() && !touches; ++t) {
      const auto corner = [&](int k) -> const Point3& {
        return shape.point[shape.triangle[t].vertex[static_cast<std::size_t>(k % 3)]];
      };
      const auto apart = [&](int a, bool ahead_only) {
        const double p = corner(0)[a], q = corner(1)[a], r = corner(2)[a];
        return std::max({p, q, r}) < x[a] || (!ahead_only && std::min({p, q, r}) > x[a]);
      };
      if (apart(u, false) || apart(v, false) || apart(axis, true)) continue;
      int left = 0, right = 0;
      for (int k = 0; k < 3; ++k) {
        const int s = turn(axis, corner(k), corner(k + 1), x[u], x[v]);
        left += s > 0;
        right += s < 0;
      }
      if (left > 0 && right > 0) continue;
      const int side = shape.side_of_plane(t, x);
      touches = left + right < 3 || side == 0;
      // Ahead along the axis: counter-clockwise triangles (left) face it.
      if (!touches && (side < 0) == (left > 0)) inside = !inside;
    }
    if (!touches) return inside;
  }
  return std::nullopt;
}

}  // namespace blum::verify
