// Closest points lie on their site and are as near as the certified distance says.
#include "blum/kernel/closest_point.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "blum/kernel/shapes.hpp"
#include "blum/kernel/site_tree.hpp"

namespace blum {
namespace {

TEST(ClosestPoint, RandomPoints_AreAsNearAsTheCertifiedDistance) {
  std::mt19937_64 random(1);
  for (const PolygonMesh& mesh : {shapes::lpocket(), shapes::torus(8, 4, 2, 1),
                                  shapes::rotate_rounded(shapes::lbracket(), 1)}) {
    const Solid solid = build_solid(mesh).value();
    const SiteGeometry geometry(solid);
    for (int n = 0; n < 300; ++n) {
      const auto pick = [&] { return std::uniform_real_distribution(-1.0, 1.0)(random); };
      const Point3 x{pick(), pick(), pick()};
      for (std::uint32_t t = 0; t < solid.triangle.size(); ++t) {
        const auto& v = solid.triangle[t].vertex;
        const std::array<Point3, 3> corners{solid.point[v[0]], solid.point[v[1]],
                                            solid.point[v[2]]};
        const SiteId s = geometry.index().face(t);
        const auto certified = squared_distance_to_triangle(x, corners);
        const double d = distance_estimate(geometry, s, x);
        EXPECT_GE(d, std::sqrt(std::max(0.0, certified.lo)) - 1e-13);
        EXPECT_LE(d, std::sqrt(certified.hi) + 1e-12);
        // The point lies on the triangle.
        const auto on = squared_distance_to_triangle(closest_point(geometry, s, x), corners);
        EXPECT_LE(std::sqrt(std::max(0.0, on.lo)), kOnSite);
      }
    }
  }
}

TEST(ClosestPoint, VerticesAndEdges_AreClamped) {
  const Solid solid = build_solid(shapes::lbracket()).value();
  const SiteGeometry geometry(solid);
  for (std::uint32_t v = 0; v < solid.point.size(); ++v)
    EXPECT_EQ(closest_point(geometry, geometry.index().vertex(v), {1, 1, 1}), solid.point[v]);
  for (std::uint32_t e = 0; e < solid.edge.size(); ++e) {
    const Point3 &a = solid.point[solid.edge[e].vertex[0]],
                 &b = solid.point[solid.edge[e].vertex[1]];
    Point3 beyond;
    for (int k = 0; k < 3; ++k) beyond[k] = b[k] + (b[k] - a[k]);
    const Point3 p = closest_point(geometry, geometry.index().edge(e), beyond);
    EXPECT_LE(std::hypot(p.x - b.x, p.y - b.y, p.z - b.z), kOnSite);
  }
}

}  // namespace
}  // namespace blum
