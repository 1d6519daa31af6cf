#include "inside.hpp"

#include <algorithm>
#include <numeric>

namespace blum::verify {

std::optional<std::vector<std::uint32_t>> triangles_crossed(
    const Shape& shape, const Segment& segment, std::span<const std::uint32_t> triangles) {
  const int axis = segment.axis, u = u_axis(axis), v = v_axis(axis);
  const Point3 first = point_on(axis, segment.t0, segment.u, segment.v),
               last = point_on(axis, segment.t1, segment.u, segment.v);
  std::vector<std::uint32_t> crossed;
  for (const auto t : triangles) {
    const auto corner = [&](int k) { return shape.point[shape.triangle[t].vertex[k % 3]]; };
    const auto apart = [&](int a) {
      const double p = corner(0)[a], q = corner(1)[a], r = corner(2)[a];
      return std::max({p, q, r}) < first[a] || std::min({p, q, r}) > last[a];
    };
    if (apart(0) || apart(1) || apart(2)) continue;
    int left = 0, right = 0;
    for (int k = 0; k < 3; ++k) {
      const Point3 p = corner(k), q = corner(k + 1);
      const int turn = decide([&]<class N>(const N&) {
        return sign_of(N((N(q[u]) - N(p[u])) * (N(segment.v) - N(p[v])) -
                         (N(q[v]) - N(p[v])) * (N(segment.u) - N(p[u]))));
      });
      left += turn > 0;
      right += turn < 0;
    }
    if (left > 0 && right > 0) continue;
    const int s0 = shape.side_of_plane(t, first), s1 = shape.side_of_plane(t, last);
    if (s0 * s1 > 0) continue;
    if (left + right < 3 || s0 * s1 == 0) return std::nullopt;
    crossed.push_back(t);
  }
  return crossed;
}

std::optional<bool> is_inside(const Shape& shape, const Point3& x) {
  std::vector<std::uint32_t> all(shape.triangle.size());
  std::iota(all.begin(), all.end(), 0u);
  for (int axis = 0; axis < 3; ++axis)
    if (const auto crossed =
            triangles_crossed(shape, {axis, x[u_axis(axis)], x[v_axis(axis)], x[axis], 2}, all))
      return crossed->size() % 2 == 1;
  return std::nullopt;
}

}  // namespace blum::verify
