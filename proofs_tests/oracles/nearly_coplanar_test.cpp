// Faces in one plane up to rounding: the production engine against the exact oracle, on rectangles
// of all sizes near their edges and corners.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "oracles/face_compare.hpp"

namespace blum {
namespace {

using test::compare;
using test::log_uniform;
using test::Random;
using test::Scene;
using test::Tally;
using test::uniform;

/// A box of 4 x 4 x 2 whose top is a fan of `rim` triangles around an inner vertex; `rough` bounds
/// how far the inner vertices (one, or one on each spoke too) lie above or below the top.
PolygonMesh rough_top(Random& random, int corners_a_side, bool spokes, double rough) {
  PolygonMesh m;
  m.points = {{5, 5, 5}, {9, 5, 5}, {9, 9, 5}, {5, 9, 5}};
  std::vector<std::uint32_t> rim;
  const double corner[5][2] = {{5, 5}, {9, 5}, {9, 9}, {5, 9}, {5, 5}};
  for (int side = 0; side < 4; ++side) {
    std::vector<std::uint32_t> wall;
    for (int k = 0; k <= corners_a_side; ++k) {
      const double t = double(k) / corners_a_side;
      const bool last = side == 3 && k == corners_a_side;
      if (k == corners_a_side && !last) {
        wall.push_back(static_cast<std::uint32_t>(m.points.size()));
        continue;
      }
      if (last) {
        wall.push_back(rim.front());
        continue;
      }
      rim.push_back(static_cast<std::uint32_t>(m.points.size()));
      wall.push_back(rim.back());
      m.points.push_back({corner[side][0] + t * (corner[side + 1][0] - corner[side][0]),
                          corner[side][1] + t * (corner[side + 1][1] - corner[side][1]), 7});
    }
    std::vector<std::uint32_t> face{static_cast<std::uint32_t>(side),
                                    static_cast<std::uint32_t>((side + 1) % 4)};
    face.insert(face.end(), wall.rbegin(), wall.rend());
    m.faces.push_back(face);
  }
  m.faces.push_back({3, 2, 1, 0});
  const auto center = static_cast<std::uint32_t>(m.points.size());
  const double x = uniform(random, 6.5, 7.5), y = uniform(random, 6.5, 7.5);
  m.points.push_back({x, y, 7 + rough * uniform(random, -1, 1)});
  const std::size_t n = rim.size();
  std::vector<std::uint32_t> inner;
  for (std::size_t k = 0; spokes && k < n; ++k) {
    const double t = uniform(random, 0.3, 0.7);
    inner.push_back(static_cast<std::uint32_t>(m.points.size()));
    const Point3 p = m.points[rim[k]];
    m.points.push_back({x + t * (p.x - x), y + t * (p.y - y), 7 + rough * uniform(random, -1, 1)});
  }
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t j = (k + 1) % n;
    if (!spokes) {
      m.faces.push_back({center, rim[k], rim[j]});
      continue;
    }
    m.faces.push_back({center, inner[k], inner[j]});
    m.faces.push_back({inner[k], rim[k], rim[j]});
    m.faces.push_back({inner[k], rim[j], inner[j]});
  }
  return m;
}

PolygonMesh pythagorean(PolygonMesh mesh) {  // by the quaternion (1, 2, 3, 4), times 30
  const double r[3][3] = {{-20, 4, 22}, {20, -10, 20}, {10, 28, 4}};
  for (Point3& p : mesh.points) {
    const Point3 q = p;
    for (int k = 0; k < 3; ++k) p[k] = r[k][0] * q.x + r[k][1] * q.y + r[k][2] * q.z;
  }
  return mesh;
}

std::vector<Scene> scenes(Random& random) {
  std::vector<Scene> out;
  const auto add = [&](const std::string& name, const PolygonMesh& mesh) {
    if (auto solid = build_solid(mesh); solid.ok())
      out.emplace_back("rotated " + name, std::move(solid.value()));
  };
  for (const double rough : {1e-15, 1e-13, 1e-9, 1e-4}) {
    add("rough top", rough_top(random, 1, false, rough));
    add("rough top of eight", rough_top(random, 2, false, rough));
    add("rough top with spokes", rough_top(random, 1, true, rough));
    add("turned rough top", shapes::rotate_rounded(rough_top(random, 2, false, rough), random()));
  }
  add("plate turned exactly", pythagorean(shapes::plate(2, 6)));
  add("plate", shapes::rotate_rounded(shapes::plate(1, 4), random()));
  add("prism", shapes::rotate_rounded(shapes::prism(7), random()));
  add("lbracket", shapes::rotate_rounded(shapes::lbracket(), random()));
  return out;
}

/// Around a point at any height over a nearly flat edge, or over one of its ends.
std::optional<Rect> rect_over_flat_edge(Random& random, const Scene& scene) {
  const Solid& solid = *scene.solid;
  const SiteGeometry& g = *scene.geometry;
  std::vector<std::uint32_t> flat;
  for (std::uint32_t e = 0; e < solid.edge.size(); ++e) {
    const BallVector &a = g.unit(g.index().face(solid.edge[e].triangle[0])),
                     &b = g.unit(g.index().face(solid.edge[e].triangle[1]));
    if (solid.edge[e].kind != EdgeKind::kFlat && dot(a, b).mid > 0.999) flat.push_back(e);
  }
  if (flat.empty()) return std::nullopt;
  const SolidEdge& edge = solid.edge[flat[random() % flat.size()]];
  const BallVector& n = g.unit(g.index().face(edge.triangle[0]));
  const Point3 &p = solid.point[edge.vertex[0]], &q = solid.point[edge.vertex[1]];
  const double t = random() % 3 == 0 ? 0 : random() % 2 == 0 ? 1 : uniform(random, 0, 1);
  const double height = log_uniform(random, 1e-6, 0.2) * scene.extent();
  const double size = height * log_uniform(random, 1e-9, 1);
  Point3 c;
  for (int k = 0; k < 3; ++k)
    c[k] = p[k] + t * (q[k] - p[k]) - height * n[static_cast<std::size_t>(k)].mid +
           0.5 * size * uniform(random, -1, 1);
  Rect r;
  r.axis = static_cast<int>(random() % 3);
  const int u = u_axis(r.axis), v = v_axis(r.axis);
  r.level = c[r.axis];
  r.u0 = c[u] - size * uniform(random, 0.3, 1);
  r.u1 = c[u] + size * uniform(random, 0.3, 1);
  r.v0 = c[v] - size * uniform(random, 0.3, 1);
  r.v1 = c[v] + size * uniform(random, 0.3, 1);
  if (!(r.u0 < r.u1 && r.v0 < r.v1)) return std::nullopt;
  return r;
}

void run(std::uint64_t seed, int rounds, int rectangles, Tally& tally) {
  Random random(seed);
  for (int round = 0; round < rounds; ++round)
    for (const Scene& scene : scenes(random))
      for (int k = 0; k < rectangles; ++k) {
        const auto r = rect_over_flat_edge(random, scene);
        if (!r) continue;
        const auto near = scene.near(*r);
        if (near.size() <= 12 && scene.curved(near) <= 4) compare(scene, *r, false, tally);
      }
  tally.print("nearly coplanar");
}

TEST(NearlyCoplanar, RectanglesOverFlatEdges_GiveTheMapOfTheOracle) {
  Tally tally;
  run(1, 1, 3, tally);
  EXPECT_GE(tally.same, 20);
  EXPECT_EQ(tally.different, 0);
  EXPECT_LE(tally.rounded_gives_up * 20, tally.rounded);
}

TEST(SweepNearlyCoplanar, RectanglesOverFlatEdges_GiveTheMapOfTheOracle) {
  Tally tally;
  run(2, 10, 12, tally);
  EXPECT_GE(tally.same, 1000);
  EXPECT_EQ(tally.different, 0);
  EXPECT_LE(tally.rounded_gives_up * 20, tally.rounded);
}

}  // namespace
}  // namespace blum
