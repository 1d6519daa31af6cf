// How many sites a cell may have when it is tested changes the leaves, and no Betti number.
#include <gtest/gtest.h>

#include "blum/kernel/shapes.hpp"
#include "medial/axis_tools.hpp"

namespace blum {
namespace {

/// Returns how many leaves less there are if all cells are tested.
template <class Compute>
long compare(const PolygonMesh& mesh, Compute compute) {
  const Solid solid = build_solid(mesh).value();
  MedialOptions o;
  o.threads = 2;
  const MedialResult usual = compute(solid, o);
  EXPECT_TRUE(usual.certified);
  long less = 0;
  for (const std::size_t most : {32u, 0u}) {
    o.max_candidates = most;
    const MedialResult r = compute(solid, o);
    EXPECT_TRUE(r.certified) << most;
    EXPECT_EQ(r.betti, usual.betti) << most;
    if (most > 0) EXPECT_GT(r.leaves, usual.leaves);
    less = static_cast<long>(usual.leaves) - static_cast<long>(r.leaves);
  }
  return less;
}

TEST(CellSites, AnyNumber_GivesTheSameBettiNumbers) {
  for (const PolygonMesh& mesh : {shapes::torus(16, 8, 2, 0.75), shapes::plate(2, 16)})
    EXPECT_GT(
        compare(mesh, [](const Solid& s,
                         const MedialOptions& o) { return compute_medial_axis(s, o).value(); }),
        0);
  EXPECT_GE(compare(shapes::planar_torus(8, 4, 2, 0.75), test::voronoi_of), 0);
}

}  // namespace
}  // namespace blum
