// The checker's own geometry beside the rest of the program, which it does not use: they were
// written apart, so both are right where they agree.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "blum/kernel/inside.hpp"
#include "blum/kernel/shapes.hpp"
#include "blum/kernel/site_geometry.hpp"
#include "exclusion.hpp"

namespace blum::test {
namespace {

struct Both {
  Solid solid;
  verify::Shape shape;
  explicit Both(const PolygonMesh& mesh)
      : solid(build_solid(mesh).value()), shape(solid.point, triangles(solid)) {}
  static std::vector<std::array<std::uint32_t, 3>> triangles(const Solid& s) {
    std::vector<std::array<std::uint32_t, 3>> t;
    for (const SolidTriangle& x : s.triangle) t.push_back(x.vertex);
    return t;
  }
};

std::vector<PolygonMesh> meshes() {
  return {shapes::lbracket(),
          shapes::lpocket(),
          shapes::plate(2, 6),
          shapes::nested_voids(2),
          shapes::torus(8, 4, 2, 0.75),
          shapes::rotate_rounded(shapes::lpocket(), 3),
          shapes::split_edges(shapes::prism(5), 2),
          shapes::rotate_rounded(shapes::plate(2, 5), 4)};
}

verify::Site site(const Both& b, const SiteIndex& index, SiteId s) {
  const auto i = index.element(s);
  switch (index.kind(s)) {
    case SiteKind::kVertex:
      return b.shape.vertex_site(i);
    case SiteKind::kEdge:
      return b.shape.edge_site(
          b.shape.edge_between(b.solid.edge[i].vertex[0], b.solid.edge[i].vertex[1]).value());
    case SiteKind::kFace:
      break;
  }
  return b.shape.face_site(i);
}

TEST(VerifyShape, CandidatesAndBettiNumbers_AsTheProgram) {
  for (const PolygonMesh& mesh : meshes()) {
    const Both b(mesh);
    ASSERT_EQ(b.shape.defect(), "");
    EXPECT_EQ(b.shape.betti(), b.solid.betti());
    const SiteGeometry geometry(b.solid);
    std::vector<verify::Site> candidates;
    for (const SiteId s : geometry.candidates()) candidates.push_back(site(b, geometry.index(), s));
    std::ranges::sort(candidates);
    EXPECT_EQ(candidates, b.shape.candidates());
  }
}

TEST(VerifyShape, BrokenSurfaces_Refused) {
  const Both b(shapes::cuboid(1, 2, 3));
  auto t = Both::triangles(b.solid);
  t.pop_back();
  EXPECT_NE(verify::Shape(b.solid.point, t).defect(), "");
  t = Both::triangles(b.solid);
  std::swap(t[0][0], t[0][1]);
  EXPECT_NE(verify::Shape(b.solid.point, t).defect(), "");
  t = Both::triangles(b.solid);
  t[0][0] = 1000;
  EXPECT_NE(verify::Shape(b.solid.point, t).defect(), "");
  auto p = b.solid.point;
  p[0].x = 3;
  EXPECT_NE(verify::Shape(p, Both::triangles(b.solid)).defect(), "");
  p[0].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(verify::Shape(p, Both::triangles(b.solid)).defect(), "");
  p = b.solid.point;
  t = Both::triangles(b.solid);
  p[t[0][1]] = p[t[0][0]];
  EXPECT_NE(verify::Shape(p, t).defect(), "");
}

TEST(VerifyInside, RandomPointsAndPointsOnTheBoundary_AsTheProgram) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (const PolygonMesh& mesh : meshes()) {
    const Both b(mesh);
    const InsideOracle oracle(b.solid);
    int known = 0;
    for (int k = 0; k < 200; ++k) {
      Point3 x{coordinate(random), coordinate(random), coordinate(random)};
      // Now and then in line with a vertex.
      const Point3& v = b.solid.point[random() % b.solid.point.size()];
      if (k % 5 == 0) x.x = v.x;
      if (k % 7 == 0) x.y = v.y;
      if (k % 50 == 0) x.z = v.z;
      const auto found = verify::is_inside(b.shape, x);
      if (!found) continue;
      ++known;
      EXPECT_EQ(*found, oracle.locate(x) == InsideOracle::Where::kInside) << k;
    }
    EXPECT_GT(known, 100);
  }
}

/// What is excluded from a box governs no point in it, by the distances of all sites.
TEST(VerifyExclusion, SitesThatGovernNothing_AreNearestNowhere) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> coordinate(-1, 1), size(0, 0.6);
  for (const PolygonMesh& mesh : meshes()) {
    const Both b(mesh);
    const verify::Sites sites(b.shape);
    const verify::Exclusion exclusion(sites);
    const auto& all = b.shape.candidates();
    std::size_t excluded = 0, governed = 0;
    for (int k = 0; k < 20; ++k) {
      Box3 box;
      const Point3& near = b.solid.point[random() % b.solid.point.size()];
      for (int a = 0; a < 3; ++a) {
        box.lo[a] = near[a] + 0.3 * coordinate(random);
        box.hi[a] = box.lo[a] + size(random);
      }
      const auto kept = exclusion.remaining(all, box);
      excluded += all.size() - kept.size();
      for (int n = 0; n < 60; ++n) {
        Point3 x;
        for (int a = 0; a < 3; ++a)
          x[a] = box.lo[a] + (box.hi[a] - box.lo[a]) * (0.5 + 0.5 * coordinate(random));
        const auto inside = verify::is_inside(b.shape, x);
        if (!inside || !*inside) continue;
        ++governed;
        for (const verify::Site s : sites.governors(x, all))
          EXPECT_TRUE(std::ranges::binary_search(kept, s));
      }
    }
    EXPECT_GT(excluded, 0u);
    EXPECT_GT(governed, 0u);
  }
}

}  // namespace
}  // namespace blum::test
