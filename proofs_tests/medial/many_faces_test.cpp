// Solids of which very many faces nearly meet in a point or along a line: round bars and cones, as
// CAD systems write them.
#include <gtest/gtest.h>

#include "arrangement/face_scenes.hpp"
#include "blum/medial/medial_axis.hpp"
#include "patience.hpp"

namespace blum {
namespace {

void expect_certified(const std::string& name, const PolygonMesh& mesh, std::size_t most_leaves) {
  SCOPED_TRACE(name);
  const auto solid = build_solid(mesh);
  ASSERT_TRUE(solid.ok()) << name;
  MedialOptions o;
  o.time_limit_s = test::patience_s(120);
  const auto r = compute_medial_axis(solid.value(), o);
  ASSERT_TRUE(r.ok()) << r.error().message;
  EXPECT_TRUE(r.value().certified) << r.value().undecided.size() << " cells undecided";
  EXPECT_EQ(r.value().betti, r.value().solid_betti);
  EXPECT_LE(r.value().leaves, most_leaves);
}

/// Corners moved by up to `by`, facets triangulated so that they stay planar.
PolygonMesh rough(PolygonMesh mesh, test::Random& random, double by) {
  mesh = shapes::triangulate_facets(mesh, random());
  for (Point3& p : mesh.points)
    for (int k = 0; k < 3; ++k) p[k] += by * test::uniform(random, -1, 1);
  return mesh;
}

// More groups than are compared pair by pair at once, and more candidates than a cell is tested
// with.
TEST(ManyFaces, ConesAreCertified) {
  test::Random random(1);
  for (const double by : {0.0, 1e-15, 1e-9})
    expect_certified("cone", test::pyramid(random, 64, 3, by), 60);
}

TEST(ManyFaces, DoubleConeOf128FacesIsCertified) {
  PolygonMesh m;
  constexpr std::uint32_t n = 64;
  for (std::uint32_t k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * k / n;
    m.points.push_back({std::cos(angle), std::sin(angle), 0});
  }
  m.points.push_back({0, 0, 1});
  m.points.push_back({0, 0, -0.5});
  for (std::uint32_t k = 0; k < n; ++k) {
    m.faces.push_back({k, (k + 1) % n, n});
    m.faces.push_back({(k + 1) % n, k, n + 1});
  }
  expect_certified("double cone", m, 60);
}

TEST(ManyFaces, TriangulatedBarIsCertified) {
  test::Random random(2);
  expect_certified("bar", rough(shapes::prism(40, 1, 5), random, 1e-12), 200);
}

TEST(SweepManyFaces, BarsAndConesAreCertified) {
  test::Random random(3);
  for (const int n : {24, 33, 48, 64, 96})
    for (const double by : {0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3})
      for (const double height : {0.5, 2.0, 8.0}) {
        const auto name = std::to_string(n) + " sides, height " + std::to_string(height) +
                          ", moved by " + std::to_string(by);
        expect_certified("cone of " + name, test::pyramid(random, n, height, by), 2'000);
        if (n <= 64)
          expect_certified("bar of " + name, rough(shapes::prism(n, 1, height), random, by), 2'000);
      }
}

}  // namespace
}  // namespace blum
