// The oracle on random rectangles in random solids: every sampled point must lie in a region that
// is labelled with its nearest sites, which are found here by another exact method; Euler's formula
// must hold; and the diagram must not depend on what it should not depend on.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "blum/arrangement/brute_engine.hpp"
#include "blum/kernel/shapes.hpp"

namespace blum {
namespace {

using Vector = std::array<mpq_class, 3>;
using Random = std::mt19937_64;

Vector exact(const Point3& p) { return {p.x, p.y, p.z}; }
Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
mpq_class dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector along(const Vector& a, const mpq_class& k, const Vector& d) {
  return {a[0] + k * d[0], a[1] + k * d[1], a[2] + k * d[2]};
}

struct Nearest {
  mpq_class squared_distance;
  std::set<SiteId> sites;  ///< smallest features that hold a nearest point
};

/// Nearest features by projecting on every closed triangle (barycentric coordinates decide whether
/// the foot lies in the face, on an edge or on a vertex). Shares no formula with the oracle.
Nearest nearest(const Solid& solid, const Vector& x) {
  const SiteIndex index(solid);
  Nearest out;
  bool first = true;
  const auto offer = [&](const mpq_class& d2, SiteId s) {
    if (first || d2 < out.squared_distance) {
      out.squared_distance = d2;
      out.sites.clear();
      first = false;
    }
    if (d2 == out.squared_distance) out.sites.insert(s);
  };
  for (std::uint32_t t = 0; t < solid.triangle.size(); ++t) {
    std::array<Vector, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = exact(solid.point[solid.triangle[t].vertex[k]]);
    const Vector ab = p[1] - p[0], ac = p[2] - p[0], ax = x - p[0];
    const mpq_class b2 = dot(ab, ab), c2 = dot(ac, ac), bc = dot(ab, ac);
    const mpq_class det = b2 * c2 - bc * bc;
    const mpq_class s = (dot(ax, ab) * c2 - dot(ax, ac) * bc) / det;
    const mpq_class r = (dot(ax, ac) * b2 - dot(ax, ab) * bc) / det;
    if (s > 0 && r > 0 && s + r < 1) {
      const Vector w = x - along(along(p[0], s, ab), r, ac);
      offer(dot(w, w), index.face(t));
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector d = p[(k + 1) % 3] - p[k], w = x - p[k];
      const mpq_class f = dot(w, d) / dot(d, d);
      if (f <= 0) {
        offer(dot(w, w), index.vertex(solid.triangle[t].vertex[k]));
      } else if (f < 1) {
        const Vector foot = x - along(p[k], f, d);
        offer(dot(foot, foot), index.edge(solid.triangle[t].edge[k]));
      }
    }
  }
  return out;
}

/// Sites that may govern somewhere on the rectangle: |d(x) - d(c)| <= |x - c| for its centre c.
std::vector<SiteId> candidates(const Solid& solid, const Rect& r) {
  Point3 c;
  c[r.axis] = r.level;
  c[u_axis(r.axis)] = (r.u0 + r.u1) / 2;
  c[v_axis(r.axis)] = (r.v0 + r.v1) / 2;
  const double radius = std::hypot(r.u1 - r.u0, r.v1 - r.v0) / 2;
  const Vector x = exact(c);
  const double limit = std::sqrt(nearest(solid, x).squared_distance.get_d()) + 2 * radius + 1e-9;
  const SiteIndex index(solid);
  std::vector<SiteId> out;
  const auto segment_distance = [&](const Vector& a, const Vector& b) {
    const Vector d = b - a;
    mpq_class f = dot(x - a, d) / dot(d, d);
    f = std::clamp(f, mpq_class(0), mpq_class(1));
    const Vector w = x - along(a, f, d);
    return std::sqrt(dot(w, w).get_d());
  };
  for (std::uint32_t k = 0; k < solid.point.size(); ++k) {
    const Vector w = x - exact(solid.point[k]);
    if (!solid.vertex_degenerate[k] && std::sqrt(dot(w, w).get_d()) <= limit)
      out.push_back(index.vertex(k));
  }
  for (std::uint32_t k = 0; k < solid.edge.size(); ++k) {
    const auto& e = solid.edge[k];
    // A ball in the solid does not touch its boundary on a convex edge.
    if (e.kind == EdgeKind::kReflex &&
        segment_distance(exact(solid.point[e.vertex[0]]), exact(solid.point[e.vertex[1]])) <= limit)
      out.push_back(index.edge(k));
  }
  for (std::uint32_t k = 0; k < solid.triangle.size(); ++k) {
    Solid one;  // the distance to one closed triangle
    one.point = solid.point;
    one.edge = solid.edge;
    one.triangle = {solid.triangle[k]};
    if (std::sqrt(nearest(one, x).squared_distance.get_d()) <= limit) out.push_back(index.face(k));
  }
  return out;
}

std::vector<std::uint32_t> all_triangles(const Solid& solid) {
  std::vector<std::uint32_t> out(solid.triangle.size());
  std::iota(out.begin(), out.end(), 0u);
  return out;
}

/// A star-shaped solid: an octahedron, subdivided `levels` times, with random radii in short
/// dyadics.
PolygonMesh star(Random& random, int levels, bool convexish) {
  PolygonMesh m;
  m.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  m.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
             {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int l = 0; l < levels; ++l) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
    const auto mid = [&](std::uint32_t a, std::uint32_t b) {
      const auto [it, fresh] =
          middle.try_emplace({std::min(a, b), std::max(a, b)}, std::uint32_t(m.points.size()));
      if (fresh) {
        const Point3 p = m.points[a], q = m.points[b];
        m.points.push_back({(p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2});
      }
      return it->second;
    };
    std::vector<std::vector<std::uint32_t>> faces;
    for (const auto& f : m.faces) {
      const auto a = mid(f[0], f[1]), b = mid(f[1], f[2]), c = mid(f[2], f[0]);
      faces.insert(faces.end(), {{f[0], a, c}, {f[1], b, a}, {f[2], c, b}, {a, b, c}});
    }
    m.faces = faces;
  }
  for (Point3& p : m.points) {
    const double length = std::hypot(p.x, p.y, p.z);
    const double radius = convexish ? 1 : std::uniform_real_distribution(0.55, 1.0)(random);
    for (int k = 0; k < 3; ++k)
      p[k] = std::round(64 * (p[k] / length * radius +
                              (std::uniform_real_distribution(-0.1, 0.1)(random)))) /
             64;
  }
  return m;
}

Rect random_rect(Random& random, const Solid& solid, double size) {
  Point3 lo = solid.point[0], hi = lo;
  for (const Point3& p : solid.point)
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  double extent = 0;
  for (int k = 0; k < 3; ++k) extent = std::max(extent, hi[k] - lo[k]);
  const auto pick = [&](int axis) {
    return std::uniform_real_distribution(lo[axis], hi[axis])(random);
  };
  Rect r;
  r.axis = static_cast<int>(random() % 3);
  r.level = pick(r.axis);
  const int u = u_axis(r.axis), v = v_axis(r.axis);
  const auto length = [&] {
    return extent * size * std::uniform_real_distribution(0.3, 1.0)(random);
  };
  r.u0 = pick(u) - extent * size / 4;
  r.u1 = r.u0 + length();
  r.v0 = pick(v) - extent * size / 4;
  r.v1 = r.v0 + length();
  return r;
}

std::uint32_t interval_at(const SegmentDiagram& d, double t) {
  std::uint32_t k = 0;
  while (k < d.breakpoint.size() && d.breakpoint[k].hi <= t) ++k;
  return k;
}

/// V - E + F where every piece is a disk: boundary nodes lie on the piece's only circle.
void expect_euler(const FaceDiagram& d) {
  for (const FacePiece& p : d.piece)
    if (p.boundary_circles != 1) return;
  // Vertices of the quotient: the circles (one a piece), then the inner nodes.
  std::vector<std::size_t> parent(d.piece.size() + d.node.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto find = [&](std::size_t a) {
    while (parent[a] != a) a = parent[a];
    return a;
  };
  const auto vertex = [&](std::uint32_t n) {
    const bool inner =
        d.node[n].kind == FaceNode::Kind::kEvent || d.node[n].kind == FaceNode::Kind::kRim;
    return inner ? d.piece.size() + n : std::size_t{d.node[n].piece};
  };
  for (const FaceArc& a : d.arc) parent[find(vertex(a.from))] = find(vertex(a.to));
  std::set<std::size_t> components;
  for (std::size_t p = 0; p < d.piece.size(); ++p) components.insert(find(p));
  std::size_t inner = 0;
  for (std::uint32_t n = 0; n < d.node.size(); ++n) {
    components.insert(find(vertex(n)));
    inner += vertex(n) >= d.piece.size() ? 1 : 0;
  }
  EXPECT_EQ(d.region.size() + inner, d.arc.size() + components.size());
}

/// Samples points and looks for the region of each along the four axis-parallel ways to the sides.
int expect_labels(const Solid& solid, const FaceProblem& problem, const FaceDiagram& d,
                  Random& random, int samples) {
  const Rect& r = problem.rect;
  const SiteIndex index(solid);
  int located = 0;
  for (int n = 0; n < samples; ++n) {
    const double u = std::uniform_real_distribution(r.u0, r.u1)(random);
    const double v = std::uniform_real_distribution(r.v0, r.v1)(random);
    const Nearest near = nearest(solid, exact(point_on(r.axis, r.level, u, v)));
    for (int side = 0; side < 4; ++side) {
      const bool runs_along_u = side == kLowV || side == kHighV;
      Segment way;  // from the sample to the side
      if (runs_along_u) {
        way = {v_axis(r.axis), r.level, u, side == kLowV ? r.v0 : v, side == kLowV ? v : r.v1};
      } else {
        way = {u_axis(r.axis), v, r.level, side == kLowU ? r.u0 : u, side == kLowU ? u : r.u1};
      }
      const auto s = brute_segment(solid, way, problem.candidates, problem.triangles);
      if (!s) continue;
      const bool sample_is_low = side == kHighV || side == kHighU;
      const auto& at_sample = sample_is_low ? s->interval.front() : s->interval.back();
      const auto& at_side = sample_is_low ? s->interval.back() : s->interval.front();
      const std::uint32_t k =
          interval_at(*d.side[static_cast<std::size_t>(side)], runs_along_u ? u : v);
      const std::uint32_t region = d.side_region[static_cast<std::size_t>(side)][k];
      EXPECT_EQ(at_side.inside, region != FaceDiagram::kOutside);
      if (!s->breakpoint.empty()) continue;
      ++located;
      EXPECT_EQ(at_sample.inside, at_side.inside);
      if (!at_sample.inside) continue;
      for (const SiteId g : near.sites) {
        const bool degenerate =
            (index.kind(g) == SiteKind::kEdge &&
             solid.edge[index.element(g)].kind == EdgeKind::kFlat) ||
            (index.kind(g) == SiteKind::kVertex && solid.vertex_degenerate[index.element(g)]);
        const auto& labels = d.region[region].labels;
        EXPECT_TRUE(degenerate || std::binary_search(labels.begin(), labels.end(), g));
      }
    }
  }
  return located;
}

/// The part of a diagram that does not depend on numbering.
std::multiset<std::vector<SiteId>> labels_of(const FaceDiagram& d) {
  std::multiset<std::vector<SiteId>> out;
  for (const FaceRegion& r : d.region) out.insert(r.labels);
  return out;
}

/// A node's governors tie, and nothing is nearer, as far as a double can tell.
void expect_nodes(const Solid& solid, const FaceDiagram& d) {
  for (const FaceNode& n : d.node) {
    EXPECT_LT(n.u1 - n.u0, 1e-14);
    EXPECT_LT(n.v1 - n.v0, 1e-14);
    if (n.kind == FaceNode::Kind::kConvexEdge) continue;
    const Vector x =
        exact(point_on(d.rect.axis, d.rect.level, (n.u0 + n.u1) / 2, (n.v0 + n.v1) / 2));
    const double distance = std::sqrt(nearest(solid, x).squared_distance.get_d());
    for (const SiteId s : n.governors) {
      const SiteIndex index(solid);
      Solid one;  // the distance to one site
      one.point = solid.point;
      one.edge = solid.edge;
      for (std::uint32_t t = 0; t < solid.triangle.size(); ++t) {
        const auto& v = solid.triangle[t].vertex;
        const auto has = [&](std::uint32_t k) {
          return std::find(v.begin(), v.end(), k) != v.end();
        };
        const std::uint32_t e = index.element(s);
        const bool holds = index.kind(s) == SiteKind::kVertex ? has(e)
                           : index.kind(s) == SiteKind::kEdge
                               ? has(solid.edge[e].vertex[0]) && has(solid.edge[e].vertex[1])
                               : t == e;
        if (holds) one.triangle.push_back(solid.triangle[t]);
      }
      EXPECT_NEAR(std::sqrt(nearest(one, x).squared_distance.get_d()), distance, 1e-14);
    }
  }
}

struct Tally {
  int decided = 0, bad = 0, located = 0, events = 0;
};

void check(const PolygonMesh& mesh, Random& random, double size, int rects, Tally& tally) {
  const auto built = build_solid(mesh);
  if (!built.ok()) return;  // a random star may be invalid after rounding
  const Solid& solid = built.value();
  const auto triangles = all_triangles(solid);
  for (int n = 0; n < rects; ++n) {
    const Rect r = random_rect(random, solid, size);
    const auto sites = candidates(solid, r);
    if (sites.size() > 24) continue;
    const FaceProblem problem{&solid, r, sites, triangles};
    const FaceDiagram d = brute_face(problem);
    if (d.status == FaceStatus::kBadPosition) {
      ++tally.bad;
      continue;
    }
    ++tally.decided;
    for (const FaceNode& node : d.node) tally.events += node.kind == FaceNode::Kind::kEvent ? 1 : 0;
    expect_euler(d);
    expect_nodes(solid, d);
    tally.located += expect_labels(solid, problem, d, random, 6);
    // Fewer triangles than all: those whose box meets the rectangle.
    std::vector<std::uint32_t> near;
    for (const std::uint32_t t : triangles) {
      double lo = 1e9, hi = -1e9;
      for (const auto v : solid.triangle[t].vertex) {
        lo = std::min(lo, solid.point[v][r.axis]);
        hi = std::max(hi, solid.point[v][r.axis]);
      }
      if (lo <= r.level && r.level <= hi) near.push_back(t);
    }
    const FaceDiagram again = brute_face({&solid, r, sites, near});
    EXPECT_EQ(again.arc.size(), d.arc.size());
    EXPECT_EQ(again.side_region, d.side_region);
    EXPECT_EQ(labels_of(again), labels_of(d));
  }
}

/// Labels as sets of vertex tuples: independent of how edges are numbered.
std::multiset<std::set<std::vector<std::uint32_t>>> named_labels(const Solid& solid,
                                                                 const FaceDiagram& d) {
  const SiteIndex index(solid);
  std::multiset<std::set<std::vector<std::uint32_t>>> out;
  for (const FaceRegion& r : d.region) {
    std::set<std::vector<std::uint32_t>> names;
    for (const SiteId s : r.labels) {
      const std::uint32_t e = index.element(s);
      std::vector<std::uint32_t> name{e};
      if (index.kind(s) == SiteKind::kEdge)
        name.assign(solid.edge[e].vertex.begin(), solid.edge[e].vertex.end());
      if (index.kind(s) == SiteKind::kFace)
        name.assign(solid.triangle[e].vertex.begin(), solid.triangle[e].vertex.end());
      std::sort(name.begin(), name.end());
      names.insert(name);
    }
    out.insert(names);
  }
  return out;
}

TEST(BruteRandom, MirroredSolid_HasTheMirroredDiagram) {
  // Swapping y and z turns the sweep round by 90 degrees: all critical abscissae are different.
  Random random(4);
  int decided = 0, arcs = 0;
  for (int n = 0; n < 30; ++n) {
    const PolygonMesh mesh = star(random, n % 2, false);
    PolygonMesh mirror = mesh;
    for (Point3& p : mirror.points) std::swap(p.y, p.z);
    for (auto& f : mirror.faces) std::swap(f[1], f[2]);
    const auto a = build_solid(mesh), b = build_solid(mirror);
    if (!a.ok()) continue;
    ASSERT_TRUE(b.ok());
    Rect r = random_rect(random, a.value(), n % 2 == 0 ? 0.6 : 0.3);
    r.axis = 0;
    const Rect turned{0, r.level, r.v0, r.v1, r.u0, r.u1};
    const auto sites_a = candidates(a.value(), r), sites_b = candidates(b.value(), turned);
    ASSERT_EQ(sites_a.size(), sites_b.size());
    if (sites_a.size() > 24) continue;
    const auto triangles = all_triangles(a.value());
    const FaceDiagram da = brute_face({&a.value(), r, sites_a, triangles});
    const FaceDiagram db = brute_face({&b.value(), turned, sites_b, triangles});
    ASSERT_EQ(da.status, db.status);
    ++decided;
    arcs += static_cast<int>(da.arc.size());
    EXPECT_EQ(da.arc.size(), db.arc.size());
    EXPECT_EQ(da.node.size(), db.node.size());
    EXPECT_EQ(da.piece.size(), db.piece.size());
    EXPECT_EQ(da.trace.size(), db.trace.size());
    EXPECT_EQ(named_labels(a.value(), da), named_labels(b.value(), db));
  }
  EXPECT_GT(decided, 15);
  EXPECT_GT(arcs, 15);
}

TEST(BruteRandom, StarShapedSolids_HaveTheNearestSitesAsLabels) {
  Random random(1);
  Tally tally;
  for (int k = 0; k < 8; ++k) check(star(random, 0, k % 2 == 0), random, 0.5, 4, tally);
  for (int k = 0; k < 8; ++k) check(star(random, 1, k % 2 == 0), random, 0.25, 4, tally);
  EXPECT_GT(tally.decided, 25);
  EXPECT_EQ(tally.bad, 0);
  EXPECT_GT(tally.located, 150);
  EXPECT_GT(tally.events, 5);
}

TEST(BruteRandom, CadSolids_HaveTheNearestSitesAsLabels) {
  Random random(2);
  Tally tally;
  check(shapes::cuboid(4, 3, 2), random, 0.5, 6, tally);
  check(shapes::lbracket(), random, 0.3, 6, tally);
  check(shapes::lpocket(), random, 0.15, 8, tally);
  check(shapes::plate(1, 4), random, 0.2, 6, tally);
  check(shapes::torus(8, 4, 2, 1), random, 0.15, 6, tally);
  EXPECT_GT(tally.decided, 15);
  EXPECT_EQ(tally.bad, 0);
}

TEST(BruteRandom, RotatedSolids_HaveTheNearestSitesAsLabels) {
  Random random(3);
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    check(shapes::rotate_rounded(shapes::cuboid(4, 3, 2), seed), random, 0.25, 3, tally);
    check(shapes::rotate_rounded(shapes::lbracket(), seed), random, 0.2, 3, tally);
    check(shapes::rotate_rounded(shapes::lpocket(), seed), random, 0.1, 3, tally);
  }
  EXPECT_GT(tally.decided, 8);
  EXPECT_EQ(tally.bad, 0);
}

}  // namespace
}  // namespace blum
