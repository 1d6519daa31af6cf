// Runs with planes that cut cells (Theorem E) and without: the same Betti numbers, a pruned tree.

#include <gtest/gtest.h>

#include "medial/axis_tools.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

using test::Scene;

MedialResult axis(const Solid& solid, MedialOptions o, bool cuts) {
  o.cuts = cuts;
  auto r = compute_medial_axis(solid, o);
  if (!r) throw std::runtime_error(r.error().message);
  return std::move(r).value();
}

/// Returns the number of leaves that were cut.
std::size_t compare(const Scene& scene, std::uint64_t seed) {
  SCOPED_TRACE(scene.name);
  const Solid solid = test::solid_of(scene.mesh);
  const MedialOptions o = test::seeded(seed);
  const MedialResult with = axis(solid, o, true), without = axis(solid, o, false);
  for (const MedialResult* r : {&with, &without}) {
    EXPECT_TRUE(r->certified);
    EXPECT_EQ(r->betti, solid.betti());
  }
  EXPECT_EQ(without.leaves_cut, 0u);
  EXPECT_EQ(without.planes_tried, 0u);
  EXPECT_GE(with.planes_tried, with.leaves_cut);
  // A cell is cut or treated as it would be without cuts.
  EXPECT_LE(with.leaves, without.leaves);
  if (with.leaves_cut == 0) {
    EXPECT_EQ(with.leaves, without.leaves);
    EXPECT_EQ(test::difference(with.complex, without.complex), "");
  } else {
    EXPECT_LT(with.leaves, without.leaves);
  }
  return with.leaves_cut;
}

std::vector<Scene> cut_solids() {
  return {{"turned voids", shapes::rotate_rounded(shapes::nested_voids(3), 2)},
          {"turned pocket", shapes::rotate_rounded(shapes::lpocket(), 3)},
          {"turned plate",
           shapes::rotate_rounded(shapes::triangulate_facets(shapes::plate(2, 12), 3), 4)}};
}

TEST(Cuts, AnySolid_HasTheSameBettiNumbersWithAndWithout) {
  compare({"pocket", shapes::lpocket()}, 1);
  compare({"voids", shapes::nested_voids(2)}, 1);
  std::size_t cut = 0;
  for (const Scene& scene : cut_solids()) cut += compare(scene, 1);
  EXPECT_GE(cut, 3u);
}

TEST(Cuts, ResolvedRun_HasTheSamePartsWithAndWithout) {
  const Solid solid = test::solid_of(shapes::rotate_rounded(shapes::lpocket(), 3));
  MedialOptions o = test::seeded(1);
  o.resolve = true;
  const MedialResult with = axis(solid, o, true), without = axis(solid, o, false);
  EXPECT_GT(with.leaves_cut, 0u);
  EXPECT_EQ(with.betti, without.betti);
  EXPECT_EQ(with.parts.sheets, without.parts.sheets);
  EXPECT_EQ(with.parts.seams, without.parts.seams);
  EXPECT_EQ(with.parts.junctions, without.parts.junctions);
  EXPECT_EQ(with.parts.clusters, without.parts.clusters);
}

TEST(Cuts, AnyNumberOfThreads_TriesTheSamePlanes) {
  for (const Scene& scene : cut_solids()) {
    SCOPED_TRACE(scene.name);
    const Solid solid = test::solid_of(scene.mesh);
    MedialOptions o = test::seeded(1);
    const MedialResult one = axis(solid, o, true);
    EXPECT_GT(one.leaves_cut, 0u);
    o.threads = 4;
    const MedialResult four = axis(solid, o, true);
    EXPECT_EQ(one.leaves_cut, four.leaves_cut);
    EXPECT_EQ(one.planes_tried, four.planes_tried);
    EXPECT_EQ(test::difference(one.complex, four.complex), "");
  }
}

TEST(SweepCuts, ManySeedsAndRotations_HaveTheSameBettiNumbersWithAndWithout) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    for (const Scene& scene : test::scenes()) {
      compare(scene, seed);
      compare({"turned " + scene.name, shapes::rotate_rounded(scene.mesh, seed)}, seed);
    }
    for (const Scene& scene : cut_solids()) compare(scene, seed);
    compare({"torus 16x8", shapes::torus(16, 8, 2, 0.75)}, seed);
    compare({"torus 32x16", shapes::torus(32, 16, 2, 0.75)}, seed);
    compare({"knot", shapes::knot()}, seed);
  }
}

}  // namespace
}  // namespace blum
