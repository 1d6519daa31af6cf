// Signs: exact, or explicitly undefined.
#include "blum/gpu/sides.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "blum/kernel/inside.hpp"
#include "blum/kernel/shapes.hpp"
#include "field_tools.hpp"

namespace blum {
namespace {

/// Compares with the oracle's brute-force twin at every sample; returns the number of exact tests.
std::uint64_t expect_exact_sides(const PolygonMesh& mesh, const VoxelGrid& grid, double band) {
  const Solid solid = build_solid(mesh).value();
  const SiteSet sites = test::sites_of(soup_of(mesh));
  FieldOptions options;
  options.band = band;
  const DistanceField field = test::field_of(sites, grid, options);
  const FieldSides sides = sides_of(solid, field, 2);
  EXPECT_EQ(sides.reason, "");
  Solid model = solid;
  for (Point3& p : model.point) p = solid.frame.to_model(p);
  const InsideOracle oracle(model);
  for (std::size_t v = 0; v < grid.voxels(); ++v) {
    const auto where = oracle.locate_brute_force(grid.point(v));
    const FieldSide expected = where == InsideOracle::Where::kInside     ? FieldSide::kInside
                               : where == InsideOracle::Where::kBoundary ? FieldSide::kBoundary
                                                                         : FieldSide::kOutside;
    EXPECT_EQ(sides.side[v], expected) << "voxel " << v;
    const double d = signed_distance(field, sides, v);
    EXPECT_EQ(std::abs(d), expected == FieldSide::kBoundary ? 0 : field.distance[v]);
    EXPECT_EQ(d < 0, expected == FieldSide::kInside);
  }
  EXPECT_EQ(sides_of(solid, field, 1).side, sides.side);
  return sides.exact_tests;
}

TEST(FieldSides, Solids_AreExactAtEverySample) {
  constexpr double kAll = std::numeric_limits<double>::infinity();
  for (const PolygonMesh& mesh : {shapes::lpocket(), shapes::torus(8, 5, 2, 0.7),
                                  shapes::rotate_rounded(shapes::nested_voids(2), 5)}) {
    const SiteSet sites = test::sites_of(soup_of(mesh));
    const VoxelGrid grid = test::grid_around(sites, {24, 13, 11});
    const std::uint64_t tests = expect_exact_sides(mesh, grid, kAll);
    EXPECT_LT(tests, grid.voxels()) << "continuity decides most";
    expect_exact_sides(mesh, grid, 0.2);
  }
}

TEST(FieldSides, SamplesOnTheBoundary_AreKnownAsSuch) {
  // Every other sample of the grid lies on a face, an edge or a corner.
  const VoxelGrid grid{{7, 7, 7}, {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};
  expect_exact_sides(shapes::cuboid(1, 1, 2), grid, std::numeric_limits<double>::infinity());
}

TEST(FieldSides, OpenSurfaces_AreUndefinedWithAReason) {
  PolygonMesh mesh = shapes::cuboid(1, 1, 1);
  mesh.faces.pop_back();
  const SiteSet sites = test::sites_of(soup_of(mesh));
  const DistanceField field = test::field_of(sites, test::grid_around(sites, {5, 5, 5}));
  const FieldSides sides = sides_of(build_solid(mesh), field, 1);
  EXPECT_NE(sides.reason, "");
  for (std::size_t v = 0; v < sides.side.size(); ++v) {
    EXPECT_EQ(sides.side[v], FieldSide::kUndefined);
    EXPECT_TRUE(std::isnan(signed_distance(field, sides, v)));
  }
}

}  // namespace
}  // namespace blum
