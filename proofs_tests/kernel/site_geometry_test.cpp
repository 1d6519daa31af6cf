// Candidates of the medial axis and their domains.
#include "blum/kernel/site_geometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "blum/kernel/closest_point.hpp"
#include "blum/kernel/inside.hpp"
#include "blum/kernel/predicates.hpp"
#include "blum/kernel/shapes.hpp"
#include "blum/kernel/site_tree.hpp"

namespace blum {
namespace {

std::vector<PolygonMesh> meshes() {
  return {shapes::cuboid(4, 3, 2),
          shapes::lbracket(),
          shapes::lpocket(),
          shapes::plate(1, 6),
          shapes::nested_voids(1),
          shapes::torus(8, 4, 2, 1),
          shapes::prism(5),
          shapes::split_edges(shapes::lpocket(), 1),
          shapes::rotate_rounded(shapes::lpocket(), 2)};
}

TEST(SiteGeometry, Candidates_AreFacesReflexEdgesAndVerticesWithAReflexEdge) {
  for (const PolygonMesh& mesh : meshes()) {
    const Solid solid = build_solid(mesh).value();
    const SiteGeometry geometry(solid);
    const auto candidates = geometry.candidates();
    ASSERT_TRUE(std::is_sorted(candidates.begin(), candidates.end()));
    const auto has = [&](SiteId s) {
      return std::binary_search(candidates.begin(), candidates.end(), s);
    };
    const SiteIndex& index = geometry.index();
    for (std::uint32_t t = 0; t < solid.triangle.size(); ++t) EXPECT_TRUE(has(index.face(t)));
    for (std::uint32_t e = 0; e < solid.edge.size(); ++e)
      EXPECT_EQ(has(index.edge(e)), solid.edge[e].kind == EdgeKind::kReflex);
    for (std::uint32_t v = 0; v < solid.point.size(); ++v) {
      bool reflex = false;
      for (const auto e : solid.edges_at(v)) reflex |= solid.edge[e].kind == EdgeKind::kReflex;
      EXPECT_EQ(has(index.vertex(v)), reflex && !solid.vertex_degenerate[v]);
    }
    for (const SiteId s : candidates) {
      EXPECT_FALSE(geometry.domain(s).empty());
      EXPECT_LE(geometry.own_conditions(s), geometry.domain(s).size());
    }
  }
}

TEST(SiteGeometry, UnitVectors_HaveLengthOne) {
  for (const PolygonMesh& mesh : meshes()) {
    const Solid solid = build_solid(mesh).value();
    const SiteGeometry geometry(solid);
    for (const SiteId s : geometry.candidates()) {
      if (geometry.index().kind(s) == SiteKind::kVertex) continue;
      const Ball l = dot(geometry.unit(s), geometry.unit(s));
      EXPECT_LE(l.low(), 1);
      EXPECT_GE(l.high(), 1);
      EXPECT_LT(l.rad, 1e-12);
    }
  }
}

TEST(SiteGeometry, PointsInside_AreGovernedByACandidateAtTheDistanceToTheBoundary) {
  std::mt19937_64 random(1);
  for (const PolygonMesh& mesh : meshes()) {
    const Solid solid = build_solid(mesh).value();
    const SiteGeometry geometry(solid);
    const InsideOracle inside(solid);
    Predicates predicates(geometry);
    std::vector<SiteId> governors;
    int points = 0;
    for (int n = 0; n < 4000 && points < 600; ++n) {
      const auto pick = [&] { return std::uniform_real_distribution(-1.0, 1.0)(random); };
      const Point3 x{pick(), pick(), pick()};
      if (inside.locate(x) != InsideOracle::Where::kInside) continue;
      ++points;
      double lo = 1e9, hi = 1e9;
      for (const auto& t : solid.triangle) {
        const auto b = squared_distance_to_triangle(
            x, {solid.point[t.vertex[0]], solid.point[t.vertex[1]], solid.point[t.vertex[2]]});
        lo = std::min(lo, b.lo);
        hi = std::min(hi, b.hi);
      }
      predicates.governors(x, geometry.candidates(), governors);
      ASSERT_FALSE(governors.empty());
      for (const SiteId s : governors) {
        const double d = distance_estimate(geometry, s, x);
        EXPECT_GE(d, std::sqrt(lo) - 1e-13);
        EXPECT_LE(d, std::sqrt(hi) + 1e-13);
      }
    }
    EXPECT_GT(points, 30);
  }
}

}  // namespace
}  // namespace blum
