// Boundary vertices near which the axis falls apart, in cells with other sites: one vertex of the
// complex for each tree there (docs/proofs.md, "Vertices in a boundary cell").

#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "blum/kernel/mesh.hpp"
#include "blum/medial/medial_axis.hpp"
#include "kernel/turn_by_quaternion.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

/// How many boundary vertices of the complex lie where another one does.
std::size_t repeated(const CellComplex& complex) {
  std::map<std::array<double, 3>, std::size_t> at;
  for (const ComplexVertex& v : complex.vertex)
    if (v.kind == ComplexVertex::Kind::kBoundary) ++at[{v.position.x, v.position.y, v.position.z}];
  std::size_t n = 0;
  for (const auto& [x, count] : at) n += count - 1;
  return n;
}

TEST(SplitVertices, StarVoids_HaveTheBettiNumbersOfTheSolidSplitOrNot) {
  std::size_t split = 0;
  for (const int points : {3, 4, 5})
    for (const double height : {1.0, 4.0, 8.0}) {
      const Solid solid = test::solid_of(test::star_void(points, height));
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        MedialOptions options;
        options.seed = seed;
        const auto axis = compute_medial_axis(solid, options);
        options.split_vertices = false;
        const auto unsplit = compute_medial_axis(solid, options);
        ASSERT_TRUE(axis);
        ASSERT_TRUE(unsplit);
        for (const MedialResult* r : {&axis.value(), &unsplit.value()}) {
          EXPECT_TRUE(r->certified) << points << " " << height << " seed " << seed;
          EXPECT_EQ(r->betti, solid.betti()) << points << " " << height << " seed " << seed;
        }
        split += repeated(axis.value().complex);
        EXPECT_EQ(repeated(unsplit.value().complex), 0u);
      }
    }
  EXPECT_GT(split, 0u);
}

// A facet with holes whose rim, turned and rounded, has corners exactly in line beside slivers: a
// plane sector of points outside the solid has such a corner as foot. (One cell undecided once.)
TEST(SplitVertices, TurnedPlate_IsCertified) {
  const Solid solid = test::solid_of(test::turn_by_quaternion(shapes::plate(3, 6), {5, 1, -2, 2}));
  MedialOptions options;
  const auto axis = compute_medial_axis(solid, options);
  ASSERT_TRUE(axis);
  EXPECT_TRUE(axis.value().certified);
  EXPECT_EQ(axis.value().betti, solid.betti());
}

}  // namespace
}  // namespace blum
