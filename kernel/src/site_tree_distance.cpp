#include "site_tree_distance.hpp"

#include <algorithm>
#include <cmath>

#include "blum/kernel/site_tree.hpp"

namespace blum {
namespace {

struct Vector {
  double x = 0, y = 0, z = 0;
};
Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vector operator*(double s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double size(const Vector& a) { return std::abs(a.x) + std::abs(a.y) + std::abs(a.z); }

/// A point of the triangle abc near the one nearest to the origin, and a direction in which the
/// triangle keeps away from the origin. Neither has to be accurate for the bounds to hold.
struct Foot {
  Vector point;
  Vector direction;
};

Foot on_edge(const Vector& a, const Vector& b, double s) {
  const Vector e = b - a;
  s = std::clamp(s, 0.0, 1.0);
  const Vector p = s < 0.5 ? a + s * e : b - (1 - s) * e;
  const double ee = dot(e, e);
  // Made orthogonal again: rounding along a long edge would spoil the lower bound.
  return {p, s > 0 && s < 1 && ee > 0 ? p - (dot(p, e) / ee) * e : p};
}

/// After C. Ericson, Real-Time Collision Detection, section 5.1.5.
Foot approximate_foot(const Vector& a, const Vector& b, const Vector& c) {
  const Vector ab = b - a, ac = c - a;
  const double d1 = -dot(ab, a), d2 = -dot(ac, a);
  if (d1 <= 0 && d2 <= 0) return {a, a};
  const double d3 = -dot(ab, b), d4 = -dot(ac, b);
  if (d3 >= 0 && d4 <= d3) return {b, b};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return on_edge(a, b, d1 / (d1 - d3));
  const double d5 = -dot(ab, c), d6 = -dot(ac, c);
  if (d6 >= 0 && d5 <= d6) return {c, c};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return on_edge(a, c, d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    return on_edge(b, c, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
  }
  const double v = std::clamp(vb / (va + vb + vc), 0.0, 1.0);
  const double w = std::clamp(vc / (va + vb + vc), 0.0, 1.0 - v);
  const Vector n = cross(ab, ac);
  return {a + v * ab + w * ac, dot(n, a) < 0 ? -1.0 * n : n};
}

}  // namespace

SquaredDistanceBounds squared_distance_to_triangle(const Point3& q,
                                                   const std::array<Point3, 3>& triangle,
                                                   Point3* foot) {
  std::array<Vector, 3> v;
  double reach = 0;
  for (int k = 0; k < 3; ++k) {
    v[k] = {triangle[k].x - q.x, triangle[k].y - q.y, triangle[k].z - q.z};
    reach = std::max(reach, size(v[k]));
  }
  Foot f = approximate_foot(v[0], v[1], v[2]);
  if (!(size(f.point) <= 2 * reach)) f = {v[0], v[0]};  // NaN from a sliver
  if (foot != nullptr) *foot = {q.x + f.point.x, q.y + f.point.y, q.z + f.point.z};

  // Let u = 2^-53 and R = reach, the largest 1-norm of the v[k], each of which errs by u R. The
  // computed foot lies within 20 u R of a true convex combination of the true vertices: its weights
  // sum to 1 up to 2u, edges are at most 2R long and err by 4 u R, and there are a handful of
  // rounded operations on numbers up to 3R. So distance <= |foot| + 20 u R; the norm itself adds
  // 4 u R. From below: for any direction w the distance is at least min_k v[k].w / |w|; the dot
  // product errs by at most 4 u R |w|, the vertices by u R. Both are covered by 64 u R; squaring
  // adds 4u. The constants 1e-150 and 1e-290 keep underflow out.
  const double slack = 64 * 0x1p-53 * reach + 1e-150;
  const double up = std::sqrt(dot(f.point, f.point)) + slack;
  double down = 0;
  const double ww = dot(f.direction, f.direction);
  if (ww > 1e-290) {
    const double least =
        std::min({dot(v[0], f.direction), dot(v[1], f.direction), dot(v[2], f.direction)});
    down = std::max(0.0, least / std::sqrt(ww) - slack);
  }
  return {down * down * (1 - 1e-15), up * up * (1 + 1e-15)};
}

ExactSquaredDistance exact_squared_distance(const Point3& q, const std::array<Point3, 3>& t) {
  using exact::Dyadic;
  using V = std::array<Dyadic, 3>;
  const auto sub = [](const V& a, const V& b) { return V{a[0] - b[0], a[1] - b[1], a[2] - b[2]}; };
  const auto dot3 = [](const V& a, const V& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const V o = {q.x, q.y, q.z};
  std::array<V, 3> v;
  for (int k = 0; k < 3; ++k) v[k] = sub(V{t[k].x, t[k].y, t[k].z}, o);

  // The foot is inside edge k iff it is between its ends on the edge's line and the origin is not
  // on the inner side of the edge, seen in the triangle's plane.
  const V e01 = sub(v[1], v[0]), e02 = sub(v[2], v[0]);
  const V n = {e01[1] * e02[2] - e01[2] * e02[1], e01[2] * e02[0] - e01[0] * e02[2],
               e01[0] * e02[1] - e01[1] * e02[0]};
  bool inside = true;
  for (int k = 0; k < 3; ++k) {
    const V &a = v[k], &b = v[(k + 1) % 3];
    const V e = sub(b, a);
    const V inward = {n[1] * e[2] - n[2] * e[1], n[2] * e[0] - n[0] * e[2],
                      n[0] * e[1] - n[1] * e[0]};
    if (dot3(inward, a).sign() <= 0) continue;  // the origin is inside of this edge, or on it
    inside = false;
    const Dyadic along = dot3(e, a);  // minus the parameter of the origin, times |e|^2
    const Dyadic ee = dot3(e, e);
    if (along.sign() <= 0 && (along + ee).sign() >= 0) {
      return {dot3(a, a) * ee - along * along, ee};
    }
  }
  if (inside) {
    const Dyadic h = dot3(n, v[0]);
    return {h * h, dot3(n, n)};
  }
  Dyadic least = dot3(v[0], v[0]);
  for (int k = 1; k < 3; ++k) {
    const Dyadic d = dot3(v[k], v[k]);
    if (compare(d, least) < 0) least = d;
  }
  return {least, Dyadic(1)};
}

int compare(const ExactSquaredDistance& a, const ExactSquaredDistance& b) {
  return compare(a.numerator * b.denominator, b.numerator * a.denominator);
}

int compare(const ExactSquaredDistance& a, double b) {
  return compare(a.numerator, exact::Dyadic(b) * a.denominator);
}

int compare_distance_to_triangles(const Point3& q, const std::array<Point3, 3>& s,
                                  const std::array<Point3, 3>& t) {
  const SquaredDistanceBounds a = squared_distance_to_triangle(q, s);
  const SquaredDistanceBounds b = squared_distance_to_triangle(q, t);
  if (a.hi < b.lo) return -1;
  if (b.hi < a.lo) return 1;
  return compare(exact_squared_distance(q, s), exact_squared_distance(q, t));
}

}  // namespace blum
