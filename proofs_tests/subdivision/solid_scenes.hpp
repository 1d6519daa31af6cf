/// Solids for the tests of subdivision and medial axis, and plain computations to compare with.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "blum/kernel/mesh.hpp"
#include "blum/kernel/shapes.hpp"
#include "blum/kernel/site_geometry.hpp"
#include "blum/kernel/solid.hpp"
#include "blum/subdivision/engine_set.hpp"
#include "blum/subdivision/subdivision.hpp"

namespace blum::test {

struct Scene {
  std::string name;
  PolygonMesh mesh;
};

inline Solid solid_of(const PolygonMesh& mesh) {
  Result<Solid> solid = build_solid(mesh);
  if (!solid) throw std::runtime_error("not a solid: " + solid.error().message);
  return std::move(solid).value();
}

/// A box with a void shaped as a double pyramid over a star of `points` points: at its two apexes
/// convex and reflex edges alternate and the polar cone has an interior, so that near them the axis
/// falls apart into one sheet per convex edge. Requires points >= 3. Betti numbers 1 0 1.
inline PolygonMesh star_void(int points, double height = 4) {
  PolygonMesh m = shapes::cuboid(16, 18, 20);
  for (Point3& p : m.points) p = {p.x - 8, p.y - 9, p.z - 10};
  const auto base = static_cast<std::uint32_t>(m.points.size());
  const auto n = static_cast<std::uint32_t>(2 * points);
  for (std::uint32_t k = 0; k < n; ++k) {
    const double a = 2 * M_PI * k / n, r = k % 2 == 0 ? 3 : 0.5;
    m.points.push_back({std::round(r * std::cos(a) * 64) / 64 + 0.125,
                        std::round(r * std::sin(a) * 64) / 64 + 0.25, 0.5});
  }
  m.points.push_back({0.125, 0.25, 0.5 + height});
  m.points.push_back({0.125, 0.25, 0.5 - height});
  for (std::uint32_t k = 0; k < n; ++k) {
    const auto a = base + k, b = base + (k + 1) % n;
    m.faces.push_back({b, a, base + n});  // normals point into the void
    m.faces.push_back({a, b, base + n + 1});
  }
  return m;
}

/// A box whose roof has a pass: at the vertex in the middle two convex edges (ridges) and two
/// reflex ones (valleys) alternate. Betti numbers 1 0 0.
inline PolygonMesh saddle_roof(double ridge = 4, double valley = 1.5) {
  PolygonMesh m;
  const double s = 2;
  for (const double z : {0.0, 2.5})
    for (const auto& [x, y] : {std::pair{-s, -s}, {s, -s}, {s, s}, {-s, s}})
      m.points.push_back({x, y, z});
  // Middles of the roof's four sides: high along x, low along y; the pass between them.
  m.points.insert(m.points.end(),
                  {{s, 0, ridge}, {0, s, valley}, {-s, 0, ridge}, {0, -s, valley}, {0, 0, 3}});
  m.faces = {{0, 3, 2, 1},  // floor
             {1, 2, 6, 8, 5},
             {2, 3, 7, 9, 6},
             {3, 0, 4, 10, 7},
             {0, 1, 5, 11, 4}};
  const std::uint32_t ring[] = {8, 6, 9, 7, 10, 4, 11, 5};
  for (int k = 0; k < 8; ++k) m.faces.push_back({ring[k], ring[(k + 1) % 8], 12});
  return m;
}

inline PolygonMesh rotated(const PolygonMesh& mesh, std::uint64_t seed = 1) {
  return shapes::rotate_rounded(mesh, seed);
}

/// x -> (x[order[0]], x[order[1]], x[order[2]]), then negated on the axes of `mirror`; the faces
/// are flipped where that reverses the orientation. Exact.
inline PolygonMesh permuted(PolygonMesh m, std::array<int, 3> order,
                            std::array<bool, 3> mirror = {}) {
  for (Point3& p : m.points) {
    const Point3 q = p;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      p[k] = mirror[i] ? -q[order[i]] : q[order[i]];
    }
  }
  bool odd = order[1] != (order[0] + 1) % 3;
  for (const bool b : mirror) odd = odd != b;
  if (odd)
    for (auto& f : m.faces) std::reverse(f.begin(), f.end());
  return m;
}

inline PolygonMesh scaled(PolygonMesh m, int exponent) {
  for (Point3& p : m.points)
    p = {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
  return m;
}

inline PolygonMesh translated(PolygonMesh m, const Point3& by) {
  for (Point3& p : m.points) p = {p.x + by.x, p.y + by.y, p.z + by.z};
  return m;
}

/// A closed box of outer sides a, b, c with a void at distance `wall` from all its sides.
inline PolygonMesh thin_walled_box(double a, double b, double c, double wall) {
  PolygonMesh m = shapes::cuboid(a, b, c);
  PolygonMesh inner = shapes::cuboid(a - 2 * wall, b - 2 * wall, c - 2 * wall);
  for (const Point3& p : inner.points) m.points.push_back({p.x + wall, p.y + wall, p.z + wall});
  for (auto f : inner.faces) {
    std::reverse(f.begin(), f.end());
    for (auto& v : f) v += 8;
    m.faces.push_back(std::move(f));
  }
  return m;
}

/// Every kind of local geometry; each takes well under a second.
inline std::vector<Scene> scenes() {
  return {{"cuboid", shapes::cuboid(1, 1.25, 2)},
          {"square_bar", shapes::cuboid(1, 1, 2)},
          {"cube", shapes::cuboid(1, 1, 1)},
          {"thin_plate", shapes::cuboid(1, 1.5, 0x1p-7)},
          {"lbracket", shapes::lbracket()},
          {"lpocket", shapes::lpocket()},
          {"prism_3", shapes::prism(3)},
          {"prism_5", shapes::prism(5)},
          {"prism_6_moved", shapes::prism(6, 1, 1, {1e-12, 0})},
          {"plate_1", shapes::plate(1, 6)},
          {"plate_2", shapes::plate(2, 6)},
          {"voids_1", shapes::nested_voids(1)},
          {"voids_2", shapes::nested_voids(2)},
          {"torus_8_4", shapes::torus(8, 4, 2, 0.75)},
          {"star_void_3", star_void(3)},
          {"star_void_4", star_void(4)},
          {"saddle_roof", saddle_roof()},
          {"rotated_cuboid", rotated(shapes::cuboid(1, 1.25, 2))},
          {"rotated_lbracket", rotated(shapes::lbracket())},
          {"rotated_plate", rotated(shapes::plate(1, 6))}};
}

/// A solid, its sites and one run of the subdivision; immovable, as the parts point at each other.
struct Subdivided {
  Subdivided(const PolygonMesh& mesh, const SubdivisionOptions& options)
      : solid(solid_of(mesh)),
        geometry(solid),
        watch(options),
        engines(geometry, options, watch),
        result(subdivide(geometry, options, engines)) {}
  Subdivided(const Subdivided&) = delete;

  [[nodiscard]] const Subdivision& tree() const { return result.value(); }

  const Solid solid;
  const SiteGeometry geometry;
  RunWatch watch;
  EngineSet engines;
  const Result<Subdivision> result;
};

inline SubdivisionOptions seeded(std::uint64_t seed, double max_leaf_diameter = 0) {
  SubdivisionOptions o;
  o.seed = seed;
  o.max_leaf_diameter = max_leaf_diameter;
  return o;
}

/// Diameter of the vertices' bounding box.
inline double extent(const std::vector<Point3>& points) {
  Point3 lo = points.front(), hi = lo;
  for (const Point3& p : points)
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  return std::hypot(hi.x - lo.x, hi.y - lo.y, hi.z - lo.z);
}

using LongPoint = std::array<long double, 3>;
inline LongPoint minus(const LongPoint& a, const LongPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline long double dot(const LongPoint& a, const LongPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline LongPoint wide(const Point3& p) { return {p.x, p.y, p.z}; }

/// Point of a triangle nearest to q, by clamping alone.
inline LongPoint nearest_on_triangle(const LongPoint& q, const std::array<LongPoint, 3>& t) {
  const auto at = [](const LongPoint& a, const LongPoint& u, long double s) {
    return LongPoint{a[0] + s * u[0], a[1] + s * u[1], a[2] + s * u[2]};
  };
  const LongPoint u = minus(t[1], t[0]), v = minus(t[2], t[0]), w = minus(q, t[0]);
  const long double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), wu = dot(w, u), wv = dot(w, v);
  const long double det = uu * vv - uv * uv, s = (vv * wu - uv * wv) / det,
                    r = (uu * wv - uv * wu) / det;
  if (s >= 0 && r >= 0 && s + r <= 1) return at(at(t[0], u, s), v, r);
  LongPoint best{};
  long double least = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const LongPoint &a = t[k], e = minus(t[(k + 1) % 3], a);
    const LongPoint y = at(a, e, std::clamp(dot(minus(q, a), e) / dot(e, e), 0.0L, 1.0L));
    const long double d = dot(minus(q, y), minus(q, y));
    if (least < 0 || d < least) {
      least = d;
      best = y;
    }
  }
  return best;
}

/// Distance from a point to a segment and to a triangle, in long double, by clamping alone.
inline long double segment_distance(const LongPoint& q, const LongPoint& a, const LongPoint& b) {
  const LongPoint u = minus(b, a), w = minus(q, a);
  const long double t = std::clamp(dot(w, u) / dot(u, u), 0.0L, 1.0L);
  const LongPoint d{w[0] - t * u[0], w[1] - t * u[1], w[2] - t * u[2]};
  return std::sqrt(dot(d, d));
}
inline long double triangle_distance(const LongPoint& q, const std::array<LongPoint, 3>& t) {
  const LongPoint u = minus(t[1], t[0]), v = minus(t[2], t[0]), w = minus(q, t[0]);
  const LongPoint n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                    u[0] * v[1] - u[1] * v[0]};
  const long double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), wu = dot(w, u), wv = dot(w, v);
  const long double det = uu * vv - uv * uv;
  const long double s = (vv * wu - uv * wv) / det, r = (uu * wv - uv * wu) / det;
  if (s >= 0 && r >= 0 && s + r <= 1) return std::abs(dot(w, n)) / std::sqrt(dot(n, n));
  return std::min({segment_distance(q, t[0], t[1]), segment_distance(q, t[1], t[2]),
                   segment_distance(q, t[2], t[0])});
}

/// Distance to the boundary, all triangles, in the frame in which the points are given.
inline double boundary_distance(const Solid& solid, const std::vector<Point3>& points,
                                const Point3& q) {
  long double best = std::numeric_limits<long double>::infinity();
  for (const SolidTriangle& t : solid.triangle)
    best = std::min(
        best, triangle_distance(wide(q), {wide(points[t.vertex[0]]), wide(points[t.vertex[1]]),
                                          wide(points[t.vertex[2]])}));
  return static_cast<double>(best);
}

inline std::vector<Point3> model_points(const Solid& solid) {
  std::vector<Point3> points;
  for (const Point3& p : solid.point) points.push_back(solid.frame.to_model(p));
  return points;
}

inline std::string as_off(const PolygonMesh& mesh) {
  std::ostringstream out;
  out.precision(17);
  out << "OFF\n" << mesh.points.size() << ' ' << mesh.faces.size() << " 0\n";
  for (const Point3& p : mesh.points) out << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (const auto& f : mesh.faces) {
    out << f.size();
    for (const auto v : f) out << ' ' << v;
    out << '\n';
  }
  return out.str();
}

}  // namespace blum::test
