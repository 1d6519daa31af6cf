// Every generated shape is a valid solid with the stated topology, and the changes of a mesh leave
// the solid as it is.
#include "blum/kernel/shapes.hpp"
#include "blum/kernel/site.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "blum/kernel/solid.hpp"
#include "blum/kernel/validate.hpp"

namespace blum {
namespace {

struct Case {
  std::string name;
  PolygonMesh mesh;
  std::array<long, 3> betti;
  std::uint32_t facets;  ///< 0: not stated
};

std::vector<Case> cad_cases() {
  std::vector<Case> cases{
      {"cuboid", shapes::cuboid(1, 2, 3), {1, 0, 0}, 6},
      {"square_cuboid", shapes::cuboid(2, 2, 3), {1, 0, 0}, 6},
      {"lbracket", shapes::lbracket(), {1, 0, 0}, 8},
      {"lpocket", shapes::lpocket(), {1, 0, 0}, 13},
      {"plate_0", shapes::plate(0, 6), {1, 0, 0}, 6},
  };
  for (int n = 3; n <= 16; ++n) {
    const auto facets = static_cast<std::uint32_t>(n + 2);
    cases.push_back({"prism_" + std::to_string(n), shapes::prism(n), {1, 0, 0}, facets});
  }
  for (int count = 1; count <= 3; ++count) {
    for (const int sides : {3, 4, 5, 8, 13}) {
      cases.push_back({"plate_" + std::to_string(count) + "_" + std::to_string(sides),
                       shapes::plate(count, sides),
                       {1, count, 0},
                       static_cast<std::uint32_t>(6 + count * sides)});
    }
  }
  for (int k = 1; k <= 5; ++k) {
    cases.push_back({"voids_" + std::to_string(k),
                     shapes::nested_voids(k),
                     {k, 0, k},
                     static_cast<std::uint32_t>(12 * k)});
  }
  return cases;
}

std::vector<Case> triangle_cases() {
  std::vector<Case> cases{
      {"torus_8_4", shapes::torus(8, 4, 2, 0.75), {1, 1, 0}, 0},
      {"torus_16_8", shapes::torus(16, 8, 2, 0.75), {1, 1, 0}, 0},
      {"torus_32_16", shapes::torus(32, 16, 2, 0.5), {1, 1, 0}, 0},
      {"torus_3_3", shapes::torus(3, 3, 2, 0.5), {1, 1, 0}, 0},
      {"knot", shapes::knot(), {1, 1, 0}, 0},
  };
  shapes::KnotShape cinquefoil;
  cinquefoil.q = 5, cinquefoil.n = 80, cinquefoil.tube = 0.25;
  cases.push_back({"knot_2_5", shapes::knot(cinquefoil), {1, 1, 0}, 0});
  for (int n = 3; n <= 16; ++n) {
    for (const shapes::Move move :
         {shapes::Move{1e-6, 0}, {-1e-6, 0}, {1e-12, 0}, {0, 1}, {0, -1}}) {
      cases.push_back({"moved_prism_" + std::to_string(n) + "_" + std::to_string(move.amount) +
                           "_" + std::to_string(move.ulps),
                       shapes::prism(n, 1, 1, move),
                       {1, 0, 0},
                       0});
    }
  }
  return cases;
}

std::vector<Case> all_cases() {
  std::vector<Case> cases = cad_cases(), more = triangle_cases();
  cases.insert(cases.end(), more.begin(), more.end());
  return cases;
}

void expect_solid(const PolygonMesh& mesh, const Case& expected) {
  const Result<Solid> solid = build_solid(mesh);
  ASSERT_TRUE(solid.ok()) << solid.error().message;
  EXPECT_EQ(solid.value().betti(), expected.betti);
  if (expected.facets != 0) {
    EXPECT_EQ(solid.value().facets, expected.facets);
  }
}

/// No defect at all, not even one that only warns.
void expect_clean(const PolygonMesh& mesh) {
  const ValidationReport report = validate_mesh(mesh);
  EXPECT_TRUE(report.defects.empty())
      << report.summary(Severity::kError) << report.summary(Severity::kWarning);
}

bool all_triangles(const PolygonMesh& mesh) {
  return std::all_of(mesh.faces.begin(), mesh.faces.end(),
                     [](const auto& face) { return face.size() == 3; });
}

TEST(Shapes, AsGenerated_AreValidSolidsWithoutWarnings) {
  for (const Case& shape : all_cases()) {
    SCOPED_TRACE(shape.name);
    expect_solid(shape.mesh, shape);
    expect_clean(shape.mesh);
  }
}

TEST(Shapes, SplitEdges_AddCollinearVerticesOnly) {
  for (const Case& shape : cad_cases()) {
    SCOPED_TRACE(shape.name);
    const PolygonMesh split = shapes::split_edges(shape.mesh, 5);
    EXPECT_GT(split.points.size(), shape.mesh.points.size());
    expect_solid(split, shape);
    expect_clean(split);
  }
}

TEST(Shapes, TriangulatedFacets_AreTheSameSolid) {
  for (const Case& shape : cad_cases()) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(shape.name + " seed " + std::to_string(seed));
      const PolygonMesh split = shapes::split_edges(shape.mesh, seed);
      for (const PolygonMesh* mesh : {&shape.mesh, &split}) {
        const PolygonMesh triangles = shapes::triangulate_facets(*mesh, seed);
        EXPECT_TRUE(all_triangles(triangles));
        EXPECT_EQ(triangles.points, mesh->points);
        expect_solid(triangles, shape);
        expect_clean(triangles);
      }
    }
  }
}

TEST(Shapes, RotatedAndRounded_StayValidSolids) {
  for (Case shape : all_cases()) {
    shape.facets = 0;  // coplanar no more
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(shape.name + " seed " + std::to_string(seed));
      const PolygonMesh rotated = shapes::rotate_rounded(shape.mesh, seed);
      EXPECT_TRUE(all_triangles(rotated));
      expect_solid(rotated, shape);
      expect_solid(shapes::rotate_rounded(shapes::split_edges(shape.mesh, seed), seed), shape);
    }
  }
}

TEST(Shapes, Shuffled_AreTheSameSolid) {
  for (const Case& shape : all_cases()) {
    SCOPED_TRACE(shape.name);
    const PolygonMesh shuffled = shapes::shuffle(shape.mesh, 9);
    EXPECT_NE(shuffled.faces, shape.mesh.faces);
    EXPECT_TRUE(std::is_permutation(shuffled.points.begin(), shuffled.points.end(),
                                    shape.mesh.points.begin(), shape.mesh.points.end()));
    expect_solid(shuffled, shape);
  }
}

TEST(Shapes, Rotation_KeepsLengthsUpToRounding) {
  const PolygonMesh box = shapes::cuboid(1, 2, 3), rotated = shapes::rotate_rounded(box, 4);
  const auto distance = [](const Point3& a, const Point3& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
  };
  for (std::size_t i = 0; i < box.points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_NEAR(distance(rotated.points[i], rotated.points[j]),
                  distance(box.points[i], box.points[j]), 1e-14);
    }
  }
  EXPECT_NE(rotated.points, shapes::rotate_rounded(box, 5).points);
}

TEST(Shapes, EqualSeeds_GiveEqualMeshes) {
  const PolygonMesh plate = shapes::plate(2, 5);
  EXPECT_EQ(shapes::triangulate_facets(plate, 3).faces, shapes::triangulate_facets(plate, 3).faces);
  EXPECT_EQ(shapes::split_edges(plate, 3).points, shapes::split_edges(plate, 3).points);
  EXPECT_EQ(shapes::shuffle(plate, 3).faces, shapes::shuffle(plate, 3).faces);
}

// The cuts that facets with holes are made with must not survive in all triangulations.
TEST(Shapes, TriangulatedPlates_CrossTheCutBetweenHoles) {
  const PolygonMesh plate = shapes::plate(2, 6);
  const auto index_of = [&](const Point3& point) {
    return static_cast<std::uint32_t>(std::find(plate.points.begin(), plate.points.end(), point) -
                                      plate.points.begin());
  };
  const std::uint32_t a = index_of({1.5, 1, 0}), b = index_of({2.5, 1, 0});
  const auto has_cut = [&](const PolygonMesh& mesh) {
    return std::any_of(mesh.faces.begin(), mesh.faces.end(), [&](const auto& face) {
      for (std::size_t i = 0; i < face.size(); ++i) {
        if (face[i] == a && face[(i + 1) % face.size()] == b) return true;
      }
      return false;
    });
  };
  ASSERT_TRUE(has_cut(plate));
  int with = 0, without = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    ++(has_cut(shapes::triangulate_facets(plate, seed)) ? with : without);
  }
  EXPECT_GT(with, 0);
  EXPECT_GT(without, 0);
}

TEST(Shapes, MovedByOneUlp_DiffersInTwoCoordinates) {
  const PolygonMesh plain = shapes::prism(5), moved = shapes::prism(5, 1, 1, {0, 1});
  const double next = std::nextafter(1.0, 2.0);
  EXPECT_EQ(plain.points[5], (Point3{1, 0, 1}));
  EXPECT_EQ(moved.points[5], (Point3{next, 0, next}));
}

TEST(Shapes, SpoonAndChisel_HaveTheCountsOfTheThesis) {
  const auto spoon = build_solid(shapes::spoon());
  ASSERT_TRUE(spoon) << spoon.error().message;
  EXPECT_EQ(spoon.value().point.size(), 44u);
  EXPECT_EQ(spoon.value().triangle.size(), 84u);
  EXPECT_EQ(spoon.value().edge.size(), 126u);
  const SiteCounts sites = count_sites(spoon.value());
  EXPECT_EQ(sites.vertices + sites.edges + sites.faces, 254u);
  EXPECT_EQ(spoon.value().betti(), (std::array<long, 3>{1, 0, 0}));
  for (const double noise : {0.0, 0.01, 0.05}) {
    const auto chisel = build_solid(shapes::chisel(noise, 3));
    ASSERT_TRUE(chisel) << chisel.error().message;
    EXPECT_EQ(chisel.value().point.size(), 318u);
    EXPECT_EQ(chisel.value().triangle.size(), 632u);
    EXPECT_EQ(chisel.value().betti(), (std::array<long, 3>{1, 0, 0}));
  }
  EXPECT_EQ(shapes::chisel(0.01, 1).points, shapes::chisel(0.01, 1).points);
  EXPECT_NE(shapes::chisel(0.01, 1).points, shapes::chisel(0.01, 2).points);
}

TEST(Shapes, PlanarTorus_HasExactlyPlanarFacets) {
  const auto solid = build_solid(shapes::planar_torus(8, 4, 2, 0.75));
  ASSERT_TRUE(solid) << solid.error().message;
  EXPECT_TRUE(solid.value().warnings.empty());
  EXPECT_EQ(solid.value().facets, 32u);
  EXPECT_EQ(solid.value().betti(), (std::array<long, 3>{1, 1, 0}));
}

TEST(Shapes, RegularPolygons_HaveExactSymmetries) {
  const PolygonMesh prism = shapes::prism(8);
  EXPECT_EQ(prism.points[2], (Point3{0, 1, 0}));
  EXPECT_EQ(prism.points[1].x, prism.points[1].y);
  EXPECT_EQ(prism.points[3], (Point3{-prism.points[1].x, prism.points[1].y, 0}));
}

}  // namespace
}  // namespace blum
