// Voronoi diagrams with cells that a region passes through (Theorem T), and without.
#include <gtest/gtest.h>

#include "blum/kernel/shapes.hpp"
#include "medial/axis_tools.hpp"
#include "medial/mesh_changes.hpp"

namespace blum {
namespace {

MedialResult diagram(const Solid& solid, std::uint64_t seed, bool tubes,
                     VoronoiSide side = VoronoiSide::kBoth) {
  MedialOptions o;
  o.seed = seed;
  o.tubes = tubes;
  o.side = side;
  o.threads = 2;
  return test::voronoi_of(solid, o);
}

/// Returns the number of leaves with a tube.
std::size_t compare(const PolygonMesh& mesh, std::uint64_t seed, VoronoiSide side) {
  const Solid solid = build_solid(mesh).value();
  const MedialResult with = diagram(solid, seed, true, side),
                     without = diagram(solid, seed, false, side);
  EXPECT_TRUE(with.certified);
  EXPECT_TRUE(without.certified);
  EXPECT_EQ(with.betti, without.betti);
  EXPECT_EQ(without.tubes, 0u);
  EXPECT_LE(with.leaves, without.leaves);
  for (const ConeShape shape : without.parts.cone_shape) EXPECT_NE(shape, ConeShape::kRing);
  // Each ring has two further cones, and is one cluster.
  const auto rings = std::ranges::count(with.parts.cone_shape, ConeShape::kRing);
  EXPECT_EQ(static_cast<std::size_t>(rings), 2 * with.tubes);
  EXPECT_GE(with.parts.clusters, with.tubes);
  return with.tubes;
}

std::size_t compare_all(const std::vector<PolygonMesh>& meshes, std::uint64_t seeds) {
  std::size_t tubes = 0;
  for (std::size_t k = 0; k < meshes.size(); ++k)
    for (std::uint64_t seed = 1; seed <= seeds; ++seed)
      for (const VoronoiSide side :
           {VoronoiSide::kBoth, VoronoiSide::kInside, VoronoiSide::kOutside}) {
        SCOPED_TRACE(testing::Message() << k << " seed " << seed);
        tubes += compare(meshes[k], seed, side);
      }
  return tubes;
}

TEST(Tubes, CellsThatARegionPassesThrough_ChangeNoBettiNumber) {
  EXPECT_GT(compare_all({shapes::planar_torus(8, 4, 2, 0.75), shapes::torus(6, 3, 2, 0.75),
                         shapes::rotate_rounded(shapes::prism(5), 2)},
                        1),
            20u);
}

TEST(SweepTubes, MoreSolids_HaveTheSameBettiNumbers) {
  EXPECT_GT(compare_all({shapes::torus(8, 4, 2, 0.75), shapes::spoon(), shapes::plate(2, 6, 2, 0.5),
                         shapes::rotate_rounded(shapes::nested_voids(1), 3),
                         shapes::rotate_rounded(shapes::cuboid(1, 2, 3), 4)},
                        3),
            200u);
}

}  // namespace
}  // namespace blum
