/// Solids and rectangles for tests of the engines: in general position and in special positions.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "arrangement/cube_minus_octant.hpp"
#include "blum/arrangement/face_problem.hpp"
#include "blum/arrangement/production_engine.hpp"
#include "blum/kernel/closest_point.hpp"
#include "blum/kernel/inside.hpp"
#include "blum/kernel/shapes.hpp"
#include "blum/kernel/site_geometry.hpp"

namespace blum::test {

using Random = std::mt19937_64;

inline double uniform(Random& random, double lo, double hi) {
  return std::uniform_real_distribution(lo, hi)(random);
}

inline double log_uniform(Random& random, double lo, double hi) {
  return std::exp(uniform(random, std::log(lo), std::log(hi)));
}

/// A solid with what the engines want to know of it.
struct Scene {
  std::string name;
  std::unique_ptr<const Solid> solid;
  std::unique_ptr<const SiteGeometry> geometry;
  std::unique_ptr<const InsideOracle> inside;
  Box3 bounds;

  Scene(std::string n, Solid s, DiagramKind kind = DiagramKind::kMedial) : name(std::move(n)) {
    solid = std::make_unique<const Solid>(std::move(s));
    geometry = std::make_unique<const SiteGeometry>(*solid, kind);
    inside = std::make_unique<const InsideOracle>(*solid);
    bounds = {solid->point[0], solid->point[0]};
    for (const Point3& p : solid->point)
      for (int k = 0; k < 3; ++k) {
        bounds.lo[k] = std::min(bounds.lo[k], p[k]);
        bounds.hi[k] = std::max(bounds.hi[k], p[k]);
      }
  }
  Scene(std::string n, const PolygonMesh& mesh, DiagramKind kind = DiagramKind::kMedial)
      : Scene(std::move(n), build_solid(mesh).value(), kind) {}

  [[nodiscard]] double extent() const {
    return std::max(
        {bounds.hi.x - bounds.lo.x, bounds.hi.y - bounds.lo.y, bounds.hi.z - bounds.lo.z});
  }
  [[nodiscard]] double working(int axis, double model) const {
    return std::ldexp(model - solid->frame.origin[axis], -solid->frame.exponent);
  }
  [[nodiscard]] Rect rect(int axis, double level, double u0, double u1, double v0,
                          double v1) const {  // model units
    const int u = u_axis(axis), v = v_axis(axis);
    return {axis,           working(axis, level), working(u, u0),
            working(u, u1), working(v, v0),       working(v, v1)};
  }
  [[nodiscard]] std::vector<std::uint32_t> all_triangles() const {
    std::vector<std::uint32_t> t(solid->triangle.size());
    std::iota(t.begin(), t.end(), 0u);
    return t;
  }
  [[nodiscard]] std::vector<SiteId> all_candidates() const {
    return {geometry->candidates().begin(), geometry->candidates().end()};
  }
  /// Candidates by d(x) <= d(c) + |x - c| on both sides, c the centre of the box [lo, hi].
  [[nodiscard]] std::vector<SiteId> near(const Point3& lo, const Point3& hi) const {
    const Point3 c{(lo.x + hi.x) / 2, (lo.y + hi.y) / 2, (lo.z + hi.z) / 2};
    const double radius = std::hypot(hi.x - lo.x, hi.y - lo.y, hi.z - lo.z) / 2;
    double least = std::numeric_limits<double>::infinity();
    std::vector<double> d;
    for (const SiteId s : geometry->candidates()) {
      d.push_back(distance_estimate(*geometry, s, c));
      least = std::min(least, d.back());
    }
    std::vector<SiteId> out;
    for (std::size_t k = 0; k < d.size(); ++k)
      if (d[k] <= least + 2 * radius + 1e-9) out.push_back(geometry->candidates()[k]);
    return out;
  }
  /// The same with the box cut in n x n x n parts (n = 1 along axes where it has no length).
  [[nodiscard]] std::vector<SiteId> near_parts(const Point3& lo, const Point3& hi, int n) const {
    std::array<int, 3> count{};
    for (int k = 0; k < 3; ++k) count[static_cast<std::size_t>(k)] = lo[k] < hi[k] ? n : 1;
    std::vector<SiteId> out;
    for (int i = 0; i < count[0]; ++i)
      for (int j = 0; j < count[1]; ++j)
        for (int k = 0; k < count[2]; ++k) {
          const std::array<int, 3> at{i, j, k};
          Point3 a, b;
          for (int c = 0; c < 3; ++c) {
            const auto m = static_cast<std::size_t>(c);
            a[c] = lo[c] + (hi[c] - lo[c]) * at[m] / count[m];
            b[c] = lo[c] + (hi[c] - lo[c]) * (at[m] + 1) / count[m];
          }
          const auto part = near(a, b);
          out.insert(out.end(), part.begin(), part.end());
        }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }
  [[nodiscard]] std::vector<SiteId> near(const Rect& r) const {
    return near_parts(point_on(r.axis, r.level, r.u0, r.v0), point_on(r.axis, r.level, r.u1, r.v1),
                      12);
  }
  [[nodiscard]] std::vector<SiteId> near(const Segment& s) const {
    return near_parts(point_on(s.axis, s.t0, s.u, s.v), point_on(s.axis, s.t1, s.u, s.v), 12);
  }
  /// How many of the sites are edges or vertices: those make the oracle slow.
  [[nodiscard]] std::size_t curved(const std::vector<SiteId>& sites) const {
    return static_cast<std::size_t>(std::count_if(sites.begin(), sites.end(), [&](SiteId s) {
      return geometry->index().kind(s) != SiteKind::kFace;
    }));
  }
  [[nodiscard]] ProductionEngine engine(std::uint64_t seed = 1) const {
    return {*geometry, *inside, seed};
  }
};

/// A star-shaped solid: an octahedron, subdivided `levels` times, random radii in short dyadics.
inline PolygonMesh star(Random& random, int levels) {
  PolygonMesh m;
  m.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  m.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
             {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int l = 0; l < levels; ++l) {
    std::vector<std::vector<std::uint32_t>> faces;
    const auto mid = [&](std::uint32_t a, std::uint32_t b) {
      const Point3 p = m.points[a], q = m.points[b];
      const Point3 c{(p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2};
      const auto it = std::find(m.points.begin(), m.points.end(), c);
      if (it != m.points.end()) return static_cast<std::uint32_t>(it - m.points.begin());
      m.points.push_back(c);
      return static_cast<std::uint32_t>(m.points.size() - 1);
    };
    for (const auto& f : m.faces) {
      const auto a = mid(f[0], f[1]), b = mid(f[1], f[2]), c = mid(f[2], f[0]);
      faces.insert(faces.end(), {{f[0], a, c}, {f[1], b, a}, {f[2], c, b}, {a, b, c}});
    }
    m.faces = faces;
  }
  for (Point3& p : m.points) {
    const double length = std::hypot(p.x, p.y, p.z), radius = uniform(random, 0.55, 1.0);
    for (int k = 0; k < 3; ++k)
      p[k] = std::round(64 * (p[k] / length * radius + uniform(random, -0.1, 0.1))) / 64;
  }
  return m;
}

/// Moved away from the origin, rounded: the exact oracle is slow where a tie lies at coordinate 0.
inline PolygonMesh moved(PolygonMesh mesh) {
  for (Point3& p : mesh.points)
    for (int k = 0; k < 3; ++k) p[k] += 5;
  return mesh;
}

/// A pyramid over an n-gon of radius 1, its corners and tip moved by up to `by`.
inline PolygonMesh pyramid(Random& random, int n, double height, double by) {
  PolygonMesh m;
  const auto moved = [&](double x) { return x + by * uniform(random, -1, 1); };
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * (k + 0.3) / n;
    m.points.push_back({moved(5 + std::cos(angle)), moved(5 + std::sin(angle)), 5});
  }
  m.points.push_back({moved(5), moved(5), 5 + height});
  const auto tip = static_cast<std::uint32_t>(n);
  m.faces.emplace_back();
  for (std::uint32_t k = 0; k < tip; ++k) {
    m.faces[0].push_back(tip - 1 - k);
    m.faces.push_back({k, (k + 1) % tip, tip});
  }
  return m;
}

/// The catalogue: every kind of solid the engines must master.
inline std::vector<Scene> catalogue(Random& random) {
  std::vector<Scene> out;
  const auto add = [&](std::string name, const PolygonMesh& mesh) {
    if (auto solid = build_solid(mesh); solid.ok())
      out.emplace_back(name, std::move(solid.value()));
  };
  add("cuboid", shapes::cuboid(4, 3, 2));
  add("square cuboid", shapes::cuboid(4, 2, 2));
  add("cube", shapes::cuboid(2, 2, 2));
  add("lbracket", shapes::lbracket());
  add("lpocket", shapes::lpocket());
  for (int n = 3; n <= 8; ++n) add("prism " + std::to_string(n), moved(shapes::prism(n)));
  add("plate 1", shapes::plate(1, 6));
  add("plate 2", shapes::plate(2, 4));
  add("torus", moved(shapes::torus(8, 4, 2, 1)));
  add("nested", shapes::nested_voids(1));
  add("nested 2", shapes::nested_voids(2));
  add("octant", cube_minus_octant());
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const std::string s = " " + std::to_string(seed);
    add("rotated cuboid" + s, shapes::rotate_rounded(shapes::cuboid(4, 3, 2), random()));
    add("rotated square cuboid" + s, shapes::rotate_rounded(shapes::cuboid(4, 2, 2), random()));
    add("rotated lbracket" + s, shapes::rotate_rounded(shapes::lbracket(), random()));
    add("rotated lpocket" + s, shapes::rotate_rounded(shapes::lpocket(), random()));
    add("rotated octant" + s, shapes::rotate_rounded(cube_minus_octant(), random()));
    add("rotated prism" + s, shapes::rotate_rounded(shapes::prism(5), random()));
    add("triangulated plate" + s, shapes::triangulate_facets(shapes::plate(1, 4), random()));
    add("split lpocket" + s, shapes::split_edges(shapes::lpocket(), random()));
    add("split octant" + s,
        shapes::triangulate_facets(shapes::split_edges(cube_minus_octant(), random()), random()));
    add("star 0" + s, moved(star(random, 0)));
    add("star 1" + s, moved(star(random, 1)));
  }
  return out;
}

/// A random point of the solid near its medial axis: away from the nearest site until another one
/// is nearest. Falls back to a point of the bounding box.
inline Point3 random_axis_point(Random& random, const Scene& scene) {
  const Box3& b = scene.bounds;
  const auto nearest = [&](const Point3& x, Point3* foot) {
    double least = std::numeric_limits<double>::infinity();
    SiteId best{};
    for (const SiteId s : scene.geometry->candidates())
      if (const double d = distance_estimate(*scene.geometry, s, x); d < least) {
        least = d;
        best = s;
        if (foot != nullptr) *foot = closest_point(*scene.geometry, s, x);
      }
    return best;
  };
  Point3 x;
  for (int attempt = 0; attempt < 50; ++attempt) {
    for (int k = 0; k < 3; ++k) x[k] = uniform(random, b.lo[k], b.hi[k]);
    if (scene.inside->locate(x) != InsideOracle::Where::kInside) continue;
    Point3 foot;
    const SiteId first = nearest(x, &foot);
    for (int step = 0; step < 200; ++step) {
      Point3 y;
      for (int k = 0; k < 3; ++k) y[k] = x[k] + 0.02 * (x[k] - foot[k]);
      if (nearest(y, nullptr) != first) break;
      x = y;
    }
    break;
  }
  return x;
}

/// A random point on a rim inside the solid (theory section 1), if there is one: two reflex edges
/// at a vertex, and the vertex is nearest.
inline std::optional<Point3> random_rim_point(Random& random, const Scene& scene) {
  const Solid& solid = *scene.solid;
  const auto way = [&](std::uint32_t e) {
    const Point3 &p = solid.point[solid.edge[e].vertex[0]],
                 &q = solid.point[solid.edge[e].vertex[1]];
    return Point3{q.x - p.x, q.y - p.y, q.z - p.z};
  };
  std::vector<Point3> found;
  for (std::uint32_t v = 0; v < solid.point.size(); ++v) {
    const auto edges = solid.edges_at(v);
    bool convex = false;
    for (const auto e : edges) convex |= solid.edge[e].kind == EdgeKind::kConvex;
    if (!convex) continue;
    for (std::size_t i = 0; i < edges.size(); ++i)
      for (std::size_t j = i + 1; j < edges.size(); ++j) {
        if (solid.edge[edges[i]].kind != EdgeKind::kReflex ||
            solid.edge[edges[j]].kind != EdgeKind::kReflex)
          continue;
        const Point3 p = way(edges[i]), q = way(edges[j]);
        const Point3 n{p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
        const double length = std::hypot(n.x, n.y, n.z);
        if (!(length > 1e-9)) continue;
        for (const int sign : {-1, 1}) {
          const double t = sign * uniform(random, 0.02, 0.2) * scene.extent();
          const Point3& c = solid.point[v];
          const Point3 x{c.x + t * n.x / length, c.y + t * n.y / length, c.z + t * n.z / length};
          if (scene.inside->locate(x) != InsideOracle::Where::kInside) continue;
          bool nearest = true;
          for (const SiteId s : scene.geometry->candidates())
            nearest =
                nearest && distance_estimate(*scene.geometry, s, x) > std::abs(t) * (1 - 1e-9);
          if (nearest) found.push_back(x);
        }
      }
  }
  if (found.empty()) return std::nullopt;
  return found[random() % found.size()];
}

/// A rectangle in general position; `size` is about its share of the solid's extent. Most lie
/// across the medial axis, some across a rim inside the solid.
inline Rect random_rect(Random& random, const Scene& scene, double size) {
  Rect r;
  r.axis = static_cast<int>(random() % 3);
  const int u = u_axis(r.axis), v = v_axis(r.axis);
  Point3 c;
  for (int k = 0; k < 3; ++k) c[k] = uniform(random, scene.bounds.lo[k], scene.bounds.hi[k]);
  const double hu = scene.extent() * size * uniform(random, 0.2, 0.6);
  const double hv = scene.extent() * size * uniform(random, 0.2, 0.6);
  if (random() % 4 != 0) {
    c = random_axis_point(random, scene);
    if (random() % 3 == 0)
      if (const auto rim = random_rim_point(random, scene)) c = *rim;
    c[r.axis] += 0.1 * hu * uniform(random, -1, 1);
    c[u] += 0.9 * hu * uniform(random, -1, 1);
    c[v] += 0.9 * hv * uniform(random, -1, 1);
  }
  r.level = c[r.axis];
  r.u0 = c[u] - hu;
  r.u1 = c[u] + hu;
  r.v0 = c[v] - hv;
  r.v1 = c[v] + hv;
  return r;
}

/// Multiples of 1/16 of the extents, coordinates of vertices, middles between them; as they are, an
/// ulp beside or 1e-12 beside. A level is not put 1e-12 beside: where a seam runs along the plane
/// at distance e, the production engine takes about 1/e boxes
/// (SweepProductionFace.SeamAlongThePlane...).
inline double special_coordinate(Random& random, const Scene& scene, int axis, bool level = false) {
  const Box3& b = scene.bounds;
  const auto vertex = [&] {
    return scene.solid->point[random() % scene.solid->point.size()][axis];
  };
  double x = 0;
  switch (random() % 4) {
    case 0:
      x = b.lo[axis] + (b.hi[axis] - b.lo[axis]) * static_cast<double>(random() % 17) / 16;
      break;
    case 1:
      x = (vertex() + vertex()) / 2;
      break;
    case 2:
      x = (vertex() + vertex() + vertex() + vertex()) / 4;
      break;
    case 3:
      x = uniform(random, b.lo[axis], b.hi[axis]);
      break;
  }
  switch (level ? random() % 4 : random() % 6) {
    case 0:
      return std::abs(x) > 1e-6 ? std::nextafter(x, 10) : x + 0x1p-53;
    case 1:
      return std::abs(x) > 1e-6 ? std::nextafter(x, -10) : x - 0x1p-53;
    case 4:
      return x + 1e-12;
    case 5:
      return x - 1e-12;
    default:
      return x;
  }
}

/// A rectangle in special position: each coordinate special, or symmetric about a special centre.
inline Rect special_rect(Random& random, const Scene& scene) {
  const double size = 0.4 * scene.extent();
  Rect r;
  r.axis = static_cast<int>(random() % 3);
  r.level = special_coordinate(random, scene, r.axis, true);
  const auto range = [&](int axis, double& lo, double& hi) {
    if (random() % 2 == 0) {
      const double c = special_coordinate(random, scene, axis);
      const double h = std::ldexp(std::round(std::ldexp(uniform(random, 0.1, 1) * size, 6)), -6);
      lo = c - h;
      hi = c + h;
    } else {
      do {
        lo = special_coordinate(random, scene, axis);
        hi = special_coordinate(random, scene, axis);
        if (lo > hi) std::swap(lo, hi);
      } while (!(hi - lo > 0.02 * size));
      if (hi - lo > 2 * size) hi = lo + 2 * size;
    }
  };
  range(u_axis(r.axis), r.u0, r.u1);
  range(v_axis(r.axis), r.v0, r.v1);
  return r;
}

inline std::string describe(const Scene& scene, const Rect& r) {
  char text[400];
  std::snprintf(text, sizeof text, "%s {%d, %a, %a, %a, %a, %a} (%g; %g..%g; %g..%g)",
                scene.name.c_str(), r.axis, r.level, r.u0, r.u1, r.v0, r.v1, r.level, r.u0, r.u1,
                r.v0, r.v1);
  return text;
}

inline std::string describe(const Scene& scene, const Segment& s) {
  char text[400];
  std::snprintf(text, sizeof text, "%s {%d, %a, %a, %a, %a} (%g %g; %g..%g)", scene.name.c_str(),
                s.axis, s.u, s.v, s.t0, s.t1, s.u, s.v, s.t0, s.t1);
  return text;
}

}  // namespace blum::test
