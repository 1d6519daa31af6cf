// With `resolve` the parts of the axis are counted: they do not depend on seed, triangulation,
// split edges, numbering, scale, axes or handedness.

#include <gtest/gtest.h>

#include "blum/medial/medial_axis.hpp"
#include "patience.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

using test::permuted;
using test::Scene;
using Counts = std::array<std::uint32_t, 3>;  // sheets, seams, junctions and clusters

Counts counts(const PolygonMesh& mesh, std::uint64_t seed, double max_leaf_diameter = 0) {
  MedialOptions o;
  o.seed = seed;
  o.resolve = true;
  o.max_leaf_diameter = max_leaf_diameter;
  o.time_limit_s = test::patience_s(120);
  const auto r = compute_medial_axis(test::solid_of(mesh), o);
  if (!r || !r.value().certified) {
    ADD_FAILURE() << "not certified";
    return {};
  }
  EXPECT_EQ(r.value().betti, r.value().solid_betti);
  const Parts& p = r.value().parts;
  return {p.sheets, p.seams, p.junctions + p.clusters};
}

struct Box {
  const char* name;
  PolygonMesh mesh;
  Counts expected;
};

std::vector<Box> boxes() {
  return {{"generic box", shapes::cuboid(1, 1.25, 2), {13, 12, 4}},
          {"box with square section", shapes::cuboid(1, 1, 2), {12, 9, 2}},
          {"cube", shapes::cuboid(1, 1, 1), {12, 8, 1}}};
}

TEST(ResolvedBox, AnySeed_HasItsCounts) {
  for (const Box& b : boxes())
    for (std::uint64_t seed = 1; seed <= 5; ++seed)
      EXPECT_EQ(counts(b.mesh, seed), b.expected) << b.name << ", seed " << seed;
}

TEST(ResolvedBox, AnyTriangulationSplitEdgesAndOrder_HasItsCounts) {
  for (const Box& b : boxes())
    for (std::uint64_t k = 1; k <= 5; ++k) {
      SCOPED_TRACE(std::string(b.name) + ", change " + std::to_string(k));
      EXPECT_EQ(counts(shapes::triangulate_facets(b.mesh, k), k), b.expected);
      EXPECT_EQ(counts(shapes::split_edges(b.mesh, k), k), b.expected);
      EXPECT_EQ(counts(shapes::shuffle(b.mesh, k), k), b.expected);
      EXPECT_EQ(
          counts(shapes::shuffle(shapes::triangulate_facets(
                                     shapes::split_edges(shapes::split_edges(b.mesh, k), k + 1), k),
                                 k),
                 k),
          b.expected);
    }
}

TEST(ResolvedBox, ScaledByPowersOfTwo_HasItsCounts) {
  for (const Box& b : boxes())
    for (const int k : {-150, -30, -3, 1, 10, 150})
      EXPECT_EQ(counts(test::scaled(b.mesh, k), 1), b.expected) << b.name << ", 2^" << k;
}

TEST(ResolvedBox, Translated_HasItsCounts) {
  for (const Box& b : boxes())
    for (const Point3& by : {Point3{0.5, -0.5, 3}, Point3{-1e6, 1024, 7}, Point3{0, 0, -0x1p30}})
      EXPECT_EQ(counts(test::translated(b.mesh, by), 2), b.expected) << b.name;
}

TEST(ResolvedBox, AxesPermutedAndMirrored_HasItsCounts) {
  for (const Box& b : boxes()) {
    std::array<int, 3> order{0, 1, 2};
    do {
      for (int m = 0; m < 8; ++m)
        EXPECT_EQ(counts(permuted(b.mesh, order, {(m & 1) != 0, (m & 2) != 0, (m & 4) != 0}), 3),
                  b.expected)
            << b.name << ", axes " << order[0] << order[1] << order[2] << ", mirror " << m;
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

/// Counts under several seeds and leaf diameters must be one and the same.
void expect_one_answer(const PolygonMesh& mesh, std::initializer_list<double> diameters = {0, 0.2},
                       std::uint64_t seeds = 5) {
  std::map<Counts, std::string> seen;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed)
    for (const double d : diameters)
      seen[counts(mesh, seed, d)] +=
          " (seed " + std::to_string(seed) + ", diameter " + std::to_string(d).substr(0, 3) + ")";
  std::ostringstream all;
  for (const auto& [c, where] : seen)
    all << "\n  " << c[0] << '/' << c[1] << '/' << c[2] << ":" << where;
  EXPECT_EQ(seen.size(), 1u) << all.str();
}

TEST(ResolvedSolid, LBracket_HasOneAnswer) { expect_one_answer(shapes::lbracket()); }
TEST(ResolvedSolid, Prism3_HasOneAnswer) { expect_one_answer(shapes::prism(3)); }
TEST(ResolvedSolid, Prism4_HasOneAnswer) { expect_one_answer(shapes::prism(4), {0}); }
TEST(ResolvedSolid, Prism5_HasOneAnswer) { expect_one_answer(shapes::prism(5)); }
TEST(ResolvedSolid, Prism6_HasOneAnswer) { expect_one_answer(shapes::prism(6)); }
TEST(ResolvedSolid, Prism7_HasOneAnswer) { expect_one_answer(shapes::prism(7), {0}); }
TEST(ResolvedSolid, Prism8_HasOneAnswer) { expect_one_answer(shapes::prism(8), {0}); }
TEST(ResolvedSolid, Prism12_HasOneAnswer) { expect_one_answer(shapes::prism(12), {0}); }
TEST(ResolvedSolid, LPocket_HasOneAnswer) { expect_one_answer(shapes::lpocket(), {0, 0.5}); }
TEST(ResolvedSolid, PlateWithOneHole_HasOneAnswer) { expect_one_answer(shapes::plate(1, 6)); }
TEST(ResolvedSolid, NestedVoid_HasOneAnswer) { expect_one_answer(shapes::nested_voids(1), {0, 1}); }
TEST(ResolvedSolid, SaddleRoof_HasOneAnswer) { expect_one_answer(test::saddle_roof(), {0, 0.5}); }
// Seams end at rims inside the solid: GraphShape::kRimEnd.
TEST(ResolvedSolid, StarVoid_HasOneAnswer) { expect_one_answer(test::star_void(3), {0, 4}); }

TEST(SweepResolvedSolid, FineLeavesAndManySeeds_HaveOneAnswer) {
  for (int n = 3; n <= 16; ++n) {
    SCOPED_TRACE(n);
    expect_one_answer(shapes::prism(n), {0, 0.2, 0.1}, 8);
  }
  for (const PolygonMesh& mesh : {shapes::lbracket(), shapes::plate(1, 6), shapes::plate(2, 6)})
    expect_one_answer(mesh, {0, 0.2}, 10);
}

TEST(ResolvedSolid, RotatedBox_HasTheSheetsOfABoxAndThoseOfItsAlmostFlatEdges) {
  // A facet's diagonal is convex, flat or reflex by rounding; if convex, it adds sheets.
  for (std::uint64_t k = 1; k <= 5; ++k) {
    const PolygonMesh mesh = test::rotated(shapes::cuboid(1, 1.25, 2), k);
    std::size_t convex = 0;
    for (const SolidEdge& e : test::solid_of(mesh).edge) convex += e.kind == EdgeKind::kConvex;
    const Counts c = counts(mesh, k);
    if (convex == 12) EXPECT_EQ(c, (Counts{13, 12, 4}));
    EXPECT_GE(c[0], 13 + (convex - 12));
  }
}

TEST(ResolvedSolid, LBracketTransformed_KeepsItsCounts) {
  const PolygonMesh mesh = shapes::lbracket();
  const Counts expected = counts(mesh, 1);
  for (std::uint64_t k = 1; k <= 3; ++k) {
    EXPECT_EQ(counts(shapes::triangulate_facets(mesh, k), k), expected);
    EXPECT_EQ(counts(shapes::shuffle(shapes::split_edges(mesh, k), k), k), expected);
    EXPECT_EQ(counts(test::scaled(mesh, static_cast<int>(k) * 20 - 50), k), expected);
  }
  std::array<int, 3> order{0, 1, 2};
  do {
    EXPECT_EQ(counts(permuted(mesh, order), 1), expected);
    EXPECT_EQ(counts(permuted(mesh, order, {true, false, false}), 1), expected);
  } while (std::next_permutation(order.begin(), order.end()));
}

}  // namespace
}  // namespace blum
