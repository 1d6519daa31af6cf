#include "exact_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "blum/kernel/check.hpp"
#include "exact_geometry_number.hpp"

namespace blum::exact {
namespace {

// Shewchuk, "Adaptive precision floating-point arithmetic" (1997), section 4: the forward error of
// the straightforward evaluation is at most (3 + 16 u) u, respectively (7 + 56 u) u, times the
// permanent, u = 2^-53; rounded up here. His bounds suppose no underflow: an underflowing product
// errs by at most 2^-1074, times a difference of at most 2^301 in orient3d, six times; the floors
// below are far above that. Overflow makes the bound infinite or NaN, and the exact stage decides.
constexpr double kOrient2dBound = 4e-16;
constexpr double kOrient2dFloor = 1e-300;
constexpr double kOrient3dBound = 8e-16;
constexpr double kOrient3dFloor = 1e-220;

int sign(double x) { return (x > 0) - (x < 0); }

}  // namespace

int orient2d_exact(double ax, double ay, double bx, double by, double cx, double cy) {
  const Dyadic x(ax), y(ay);
  return compare((Dyadic(bx) - x) * (Dyadic(cy) - y), (Dyadic(by) - y) * (Dyadic(cx) - x));
}

int orient2d(double ax, double ay, double bx, double by, double cx, double cy) {
  const double left = (bx - ax) * (cy - ay);
  const double right = (by - ay) * (cx - ax);
  const double det = left - right;
  const double bound = kOrient2dBound * (std::abs(left) + std::abs(right)) + kOrient2dFloor;
  if (std::abs(det) > bound) return sign(det);
  // Exact zeros are common in made models, and a zero difference is exact.
  if ((bx == ax || cy == ay) && (by == ay || cx == ax)) return 0;
  return orient2d_exact(ax, ay, bx, by, cx, cy);
}

int orient2d_along(int axis, const Point3& a, const Point3& b, const Point3& c) {
  const int u = u_axis(axis), v = v_axis(axis);
  return orient2d(a[u], a[v], b[u], b[v], c[u], c[v]);
}

int orient3d_exact(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const Dyadic ax(a.x), ay(a.y), az(a.z);
  const Dyadic bx = Dyadic(b.x) - ax, by = Dyadic(b.y) - ay, bz = Dyadic(b.z) - az;
  const Dyadic cx = Dyadic(c.x) - ax, cy = Dyadic(c.y) - ay, cz = Dyadic(c.z) - az;
  const Dyadic dx = Dyadic(d.x) - ax, dy = Dyadic(d.y) - ay, dz = Dyadic(d.z) - az;
  return (dx * (by * cz - bz * cy) + dy * (bz * cx - bx * cz) + dz * (bx * cy - by * cx)).sign();
}

int orient3d(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const double bx = b.x - a.x, by = b.y - a.y, bz = b.z - a.z;
  const double cx = c.x - a.x, cy = c.y - a.y, cz = c.z - a.z;
  const double dx = d.x - a.x, dy = d.y - a.y, dz = d.z - a.z;
  const double yz = by * cz, zy = bz * cy;
  const double zx = bz * cx, xz = bx * cz;
  const double xy = bx * cy, yx = by * cx;
  const double det = dx * (yz - zy) + dy * (zx - xz) + dz * (xy - yx);
  const double permanent = std::abs(dx) * (std::abs(yz) + std::abs(zy)) +
                           std::abs(dy) * (std::abs(zx) + std::abs(xz)) +
                           std::abs(dz) * (std::abs(xy) + std::abs(yx));
  if (std::abs(det) > kOrient3dBound * permanent + kOrient3dFloor) return sign(det);
  // Four points in one axis-parallel plane: the commonest exact zero.
  if ((bx == 0 && cx == 0 && dx == 0) || (by == 0 && cy == 0 && dy == 0) ||
      (bz == 0 && cz == 0 && dz == 0)) {
    return 0;
  }
  return orient3d_exact(a, b, c, d);
}

int projection_axis(const Point3& a, const Point3& b, const Point3& c) {
  const double bx = b.x - a.x, by = b.y - a.y, bz = b.z - a.z;
  const double cx = c.x - a.x, cy = c.y - a.y, cz = c.z - a.z;
  const std::array<double, 3> n = {std::abs(by * cz - bz * cy), std::abs(bz * cx - bx * cz),
                                   std::abs(bx * cy - by * cx)};
  std::array<int, 3> order = {0, 1, 2};
  // The rounded size only orders the trials; each is decided exactly.
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return n[i] > n[j]; });
  for (const int axis : order) {
    if (orient2d_along(axis, a, b, c) != 0) return axis;
  }
  return -1;
}

bool collinear(const Point3& a, const Point3& b, const Point3& c) {
  return projection_axis(a, b, c) < 0;
}

bool segments_meet_along(int axis, const Point3& p, const Point3& q, const Point3& a,
                         const Point3& b) {
  const int u = u_axis(axis), v = v_axis(axis);
  for (const int k : {u, v}) {
    if (std::max(p[k], q[k]) < std::min(a[k], b[k])) return false;
    if (std::max(a[k], b[k]) < std::min(p[k], q[k])) return false;
  }
  const int pqa = orient2d_along(axis, p, q, a), pqb = orient2d_along(axis, p, q, b);
  if (pqa * pqb > 0) return false;
  const int abp = orient2d_along(axis, a, b, p), abq = orient2d_along(axis, a, b, q);
  // Collinear segments meet when their boxes do (tested above).
  return abp * abq <= 0;
}

namespace {

/// p in the closed triangle t, both projected along `axis`. Requires: projection not degenerate.
bool point_in_triangle_along(int axis, const Point3& p, const Triangle& t) {
  const int s0 = orient2d_along(axis, t[0], t[1], p);
  const int s1 = orient2d_along(axis, t[1], t[2], p);
  if (s0 * s1 < 0) return false;
  const int s2 = orient2d_along(axis, t[2], t[0], p);
  return s0 * s2 >= 0 && s1 * s2 >= 0;
}

bool coplanar_segment_meets_triangle(const Point3& p, const Point3& q, const Triangle& t) {
  const int axis = projection_axis(t[0], t[1], t[2]);
  BLUM_CHECK(axis >= 0);
  return point_in_triangle_along(axis, p, t) || segments_meet_along(axis, p, q, t[0], t[1]) ||
         segments_meet_along(axis, p, q, t[1], t[2]) || segments_meet_along(axis, p, q, t[2], t[0]);
}

/// `sp` and `sq` are the sides of p and q of the plane of t.
bool segment_meets_triangle(const Point3& p, const Point3& q, int sp, int sq, const Triangle& t) {
  if (sp * sq > 0) return false;
  if (sp == 0 && sq == 0) return coplanar_segment_meets_triangle(p, q, t);
  // The line pq crosses the plane in one point, which lies in the segment: is it in t?
  const int s0 = orient3d(p, q, t[0], t[1]);
  const int s1 = orient3d(p, q, t[1], t[2]);
  if (s0 * s1 < 0) return false;
  const int s2 = orient3d(p, q, t[2], t[0]);
  return s0 * s2 >= 0 && s1 * s2 >= 0;
}

std::array<int, 3> sides(const Triangle& plane, const Triangle& of) {
  return {orient3d(plane[0], plane[1], plane[2], of[0]),
          orient3d(plane[0], plane[1], plane[2], of[1]),
          orient3d(plane[0], plane[1], plane[2], of[2])};
}

}  // namespace

bool point_in_triangle(const Point3& p, const Triangle& t) {
  if (orient3d(t[0], t[1], t[2], p) != 0) return false;
  const int axis = projection_axis(t[0], t[1], t[2]);
  BLUM_CHECK(axis >= 0);
  return point_in_triangle_along(axis, p, t);
}

bool segment_meets_triangle(const Point3& p, const Point3& q, const Triangle& t) {
  return segment_meets_triangle(p, q, orient3d(t[0], t[1], t[2], p), orient3d(t[0], t[1], t[2], q),
                                t);
}

bool triangles_meet_improperly(std::span<const Point3> points,
                               const std::array<std::uint32_t, 3>& s,
                               const std::array<std::uint32_t, 3>& t) {
  // Bring the common vertices to the front of both.
  std::array<std::uint32_t, 3> i = s, j = t;
  int common = 0;
  for (int a = 0; a < 3; ++a) {
    for (int b = common; b < 3; ++b) {
      if (i[a] == j[b]) {
        std::swap(i[common], i[a]);
        std::swap(j[common], j[b]);
        ++common;
        break;
      }
    }
  }
  if (common == 3) return true;
  const Triangle f = {points[i[0]], points[i[1]], points[i[2]]};
  const Triangle g = {points[j[0]], points[j[1]], points[j[2]]};
  if (common == 2) {
    if (orient3d(f[0], f[1], f[2], g[2]) != 0) return false;
    const int axis = projection_axis(f[0], f[1], f[2]);
    BLUM_CHECK(axis >= 0);
    return orient2d_along(axis, f[0], f[1], f[2]) == orient2d_along(axis, f[0], f[1], g[2]);
  }
  const std::array<int, 3> side_g = sides(f, g);
  const auto one_side = [common](const std::array<int, 3>& d) {
    return common == 1 ? d[1] * d[2] > 0 : d[0] * d[1] > 0 && d[1] * d[2] > 0;
  };
  if (one_side(side_g)) return false;
  const std::array<int, 3> side_f = sides(g, f);
  if (one_side(side_f)) return false;
  if (common == 1) {
    // The intersection is convex and contains the common vertex; the ray from there through another
    // point of it leaves one of the triangles first, by the opposite edge, inside the other one.
    return segment_meets_triangle(f[1], f[2], side_f[1], side_f[2], g) ||
           segment_meets_triangle(g[1], g[2], side_g[1], side_g[2], f);
  }
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3;
    if (segment_meets_triangle(f[k], f[l], side_f[k], side_f[l], g)) return true;
    if (segment_meets_triangle(g[k], g[l], side_g[k], side_g[l], f)) return true;
  }
  return false;
}

int volume_sign(std::span<const Triangle> surface) {
  if (surface.empty()) return 0;
  const Point3 o = surface.front()[0];
  double sum = 0, size = 0;
  for (const Triangle& t : surface) {
    const double ax = t[0].x - o.x, ay = t[0].y - o.y, az = t[0].z - o.z;
    const double bx = t[1].x - o.x, by = t[1].y - o.y, bz = t[1].z - o.z;
    const double cx = t[2].x - o.x, cy = t[2].y - o.y, cz = t[2].z - o.z;
    sum += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
    size += std::abs(ax) * (std::abs(by * cz) + std::abs(bz * cy)) +
            std::abs(ay) * (std::abs(bz * cx) + std::abs(bx * cz)) +
            std::abs(az) * (std::abs(bx * cy) + std::abs(by * cx));
  }
  // Each determinant errs by 7u of its permanent (above), summing n of them by (n-1)u of the total.
  const double bound = (static_cast<double>(surface.size()) + 16) * 2.3e-16 * size;
  if (std::abs(sum) > bound + kOrient3dFloor) return sign(sum);
  Dyadic exact;
  const Dyadic ox(o.x), oy(o.y), oz(o.z);
  for (const Triangle& t : surface) {
    const Dyadic ax = Dyadic(t[0].x) - ox, ay = Dyadic(t[0].y) - oy, az = Dyadic(t[0].z) - oz;
    const Dyadic bx = Dyadic(t[1].x) - ox, by = Dyadic(t[1].y) - oy, bz = Dyadic(t[1].z) - oz;
    const Dyadic cx = Dyadic(t[2].x) - ox, cy = Dyadic(t[2].y) - oy, cz = Dyadic(t[2].z) - oz;
    exact += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
  }
  return exact.sign();
}

std::vector<std::size_t> polar_cone_sides(const Point3& v, std::span<const Point3> tips) {
  // The open cone {x : x.e < 0 for all e} is kept as a convex spherical polygon: its sides in order
  // (indices of tips), corner k being the ray e[side k] x e[side k+1].
  const auto det = [&](std::size_t i, std::size_t j, std::size_t k) {
    return orient3d(v, tips[i], tips[j], tips[k]);
  };
  std::size_t second = 0, third = 0;
  for (std::size_t j = 1; j < tips.size() && third == 0; ++j) {
    if (collinear(v, tips[0], tips[j])) continue;
    second = j;
    for (std::size_t k = 1; k < tips.size(); ++k) {
      if (det(0, j, k) != 0) {
        third = k;
        break;
      }
    }
    break;
  }
  if (third == 0) return {};  // all in one plane, which they surround
  std::vector<std::size_t> side = {0, second, third};
  if (det(0, second, third) > 0) std::swap(side[1], side[2]);
  std::vector<int> at;
  std::vector<std::size_t> next;
  for (std::size_t e = 1; e < tips.size(); ++e) {
    if (e == second || e == third) continue;
    const std::size_t m = side.size();
    at.resize(m);
    for (std::size_t k = 0; k < m; ++k) at[k] = det(side[k], side[(k + 1) % m], e);
    const auto inside = [&](std::size_t k) { return at[k % m] < 0; };
    std::size_t first = m;  // the first kept corner after a corner cut away
    bool any_cut = false, any_positive = false;
    for (std::size_t k = 0; k < m; ++k) {
      any_cut |= !inside(k);
      any_positive |= at[k] > 0;
      if (inside(k) && !inside(k + m - 1)) first = k;
    }
    if (!any_cut || (first != m && !any_positive)) continue;
    if (first == m) return {};  // no corner is strictly inside: nothing is left
    next.clear();
    next.push_back(side[first]);
    for (std::size_t k = first; inside(k); ++k) next.push_back(side[(k + 1) % m]);
    next.push_back(e);
    side.swap(next);
  }
  return side;
}

}  // namespace blum::exact
