// The production engine against the exact oracle: the same labelled planar map, up to clusters.
#include <gtest/gtest.h>

#include "oracles/face_compare.hpp"

namespace blum {
namespace {

using test::compare;
using test::Random;
using test::Scene;
using test::Tally;

void run_random(std::uint64_t seed, int rounds, Tally& tally) {
  Random random(seed);
  for (int round = 0; round < rounds; ++round)
    for (const Scene& scene : test::catalogue(random)) {
      const double size = std::exp(test::uniform(random, std::log(0.02), std::log(0.8)));
      compare(scene, test::random_rect(random, scene, size), random() % 2 == 0, tally);
    }
}

TEST(ProductionFace, RandomRectangles_GiveTheMapOfTheOracle) {
  Tally tally;
  run_random(1, 2, tally);
  tally.print("random");
  EXPECT_GE(tally.same, 60);
  EXPECT_EQ(tally.production_gives_up + tally.both_bad + tally.brute_bad_only, 0);
  EXPECT_LE(tally.rounded_gives_up, 2);
}

TEST(SweepProductionFace, RandomRectangles_GiveTheMapOfTheOracle) {
  Tally tally;
  run_random(2, 40, tally);
  tally.print("random");
  EXPECT_GE(tally.same, 1000);
  EXPECT_EQ(tally.production_gives_up + tally.both_bad + tally.brute_bad_only, 0);
  // Rims and flat edges that rounding has split in several almost equal features.
  EXPECT_LE(tally.rounded_gives_up * 20, tally.rounded);
}

void run_special(std::uint64_t seed, int rounds, Tally& tally) {
  Random random(seed);
  for (int round = 0; round < rounds; ++round)
    for (const Scene& scene : test::catalogue(random))
      compare(scene, test::special_rect(random, scene), random() % 2 == 0, tally);
}

TEST(ProductionFace, SpecialRectangles_NeverContradictTheOracle) {
  Tally tally;
  run_special(11, 1, tally);
  tally.print("special");
  EXPECT_GE(tally.problems, 20);
  EXPECT_EQ(tally.different, 0);
}

TEST(SweepProductionFace, SpecialRectangles_NeverContradictTheOracle) {
  Tally tally;
  run_special(12, 20, tally);
  tally.print("special");
  EXPECT_GE(tally.problems, 300);
  EXPECT_EQ(tally.different, 0);
}

/// Square sections: four walls at one event, and beside it two events very near to each other.
TEST(ProductionFace, SquareAndNearlySquareSections_GiveTheMapOfTheOracle) {
  Tally tally;
  Random random(21);
  for (const double e : {0.0, 0x1p-51, -0x1p-51, 0x1p-48, 1e-12, -1e-12, 1e-6, -1e-6}) {
    const Scene s("square section", shapes::cuboid(5, 2, 2 + e));
    for (int k = 0; k < 3; ++k) {
      const auto near_one = [&](double lo, double hi) { return test::uniform(random, lo, hi); };
      compare(s,
              s.rect(0, near_one(1.2, 3.8), near_one(0.2, 0.9), near_one(1.1, 1.8),
                     near_one(0.2, 0.9), near_one(1.1, 1.8)),
              k == 0, tally);
    }
  }
  tally.print("square sections");
  EXPECT_EQ(tally.same, tally.problems);
  EXPECT_GE(tally.events, 24);
}

/// Regular prisms: n walls tie on the axis; with the coordinates rounded and with a moved corner
/// they nearly do.
void prism_axes(int rounds, Tally& tally) {
  Random random(22);
  for (int round = 0; round < rounds; ++round)
    for (int n = 3; n <= 8; ++n)
      for (const shapes::Move move : {shapes::Move{0, 0}, {0, 1}, {0, -1}, {1e-12, 0}, {1e-6, 0}}) {
        const Scene s("prism " + std::to_string(n), test::moved(shapes::prism(n, 1, 4, move)));
        const double h = test::uniform(random, 0.02, 0.3);
        const auto side = [&](int sign) { return 5 + sign * h * test::uniform(random, 0.3, 1); };
        compare(
            s, s.rect(2, 5 + test::uniform(random, 1.3, 2.7), side(-1), side(1), side(-1), side(1)),
            round % 2 == 0, tally);
      }
  tally.print("prism axes");
}

TEST(ProductionFace, PrismAxes_GiveTheMapOfTheOracle) {
  Tally tally;
  prism_axes(1, tally);
  EXPECT_EQ(tally.same, tally.problems);
  EXPECT_GE(tally.clusters, 20);
}

TEST(SweepProductionFace, PrismAxes_GiveTheMapOfTheOracle) {
  Tally tally;
  prism_axes(10, tally);
  EXPECT_EQ(tally.same, tally.problems);
}

/// Planes beside the axis of a prism or a pyramid, along it: many sheets side by side, and beside
/// them those of the base.
void planes_beside_axes(std::uint64_t seed, int rounds, Tally& tally) {
  Random random(seed);
  const double moves[] = {0, 1e-15, 1e-12, 1e-6, 1e-2};
  for (int round = 0; round < rounds; ++round) {
    const int n = 5 + static_cast<int>(random() % 12);
    const double by = moves[random() % 5], height = test::uniform(random, 0.5, 5);
    const bool flat = random() % 2 == 0;
    const Scene s(flat ? "prism" : "pyramid",
                  flat ? test::moved(shapes::prism(n, 1, height, {by, 0}))
                       : test::pyramid(random, n, height, by));
    const double beside = std::exp(test::uniform(random, std::log(1e-9), std::log(0.3))),
                 half = beside * std::exp(test::uniform(random, -1, 5)),
                 at = test::uniform(random, -1, 1);
    const double low = 5 + height * test::uniform(random, 0.05, 0.6),
                 high = low + height * test::uniform(random, 0.05, 0.5);
    compare(s,
            random() % 2 == 0 ? s.rect(0, 5 + beside, 5 + half * (at - 1), 5 + half * (at + 1), low,
                                       std::min(high, 5 + 0.98 * height))
                              : s.rect(1, 5 - beside, low, std::min(high, 5 + 0.98 * height),
                                       5 + half * (at - 1), 5 + half * (at + 1)),
            random() % 2 == 0, tally);
  }
  tally.print("planes beside axes");
}

TEST(ProductionFace, PlanesBesideAxes_GiveTheMapOfTheOracle) {
  Tally tally;
  planes_beside_axes(41, 16, tally);
  EXPECT_GE(tally.same, 8);
  EXPECT_LE(tally.production_gives_up, 1);
  EXPECT_EQ(tally.same + tally.production_gives_up, tally.problems);
}

TEST(SweepProductionFace, PlanesBesideAxes_GiveTheMapOfTheOracle) {
  Tally tally;
  planes_beside_axes(42, 500, tally);
  EXPECT_LE(50 * tally.production_gives_up, tally.problems);
  EXPECT_EQ(tally.same + tally.production_gives_up, tally.problems);
}

/// Exactly regular: squares and octagons with short coordinates.
TEST(ProductionFace, ExactSeamsOfEightWalls_GiveTheMapOfTheOracle) {
  Tally tally;
  Random random(23);
  PolygonMesh m;  // walls at distance 5 from the axis: normals (+-1,0), (+-3/5,4/5), ...
  const double c[8][2] = {{5, -2.5}, {5, 2.5},   {1, 5.5},   {-1, 5.5},
                          {-5, 2.5}, {-5, -2.5}, {-1, -5.5}, {1, -5.5}};
  for (const double z : {0.0, 20.0})
    for (const auto& p : c) m.points.push_back({p[0], p[1], z});
  m.faces = {{7, 6, 5, 4, 3, 2, 1, 0}, {8, 9, 10, 11, 12, 13, 14, 15}};
  for (std::uint32_t k = 0; k < 8; ++k) m.faces.push_back({k, (k + 1) % 8, (k + 1) % 8 + 8, k + 8});
  const Scene s("octagon", test::moved(m));
  for (int k = 0; k < 6; ++k) {
    const auto r = [&](double sign) { return 5 + sign * test::uniform(random, 0.1, 2); };
    compare(s, s.rect(2, 5 + test::uniform(random, 6, 14), r(-1), r(1), r(-1), r(1)), false, tally);
  }
  tally.print("octagon");
  EXPECT_EQ(tally.same, tally.problems);
}

/// Corners of the rectangle on a tie: bad for both; beside it decided by both.
TEST(ProductionFace, CornersOnATieAndBeside_AreLikeTheOracle) {
  Tally exact, beside;
  const Scene s("cuboid", shapes::cuboid(4, 3, 2));
  for (const double e : {0.0, 0x1p-50, -0x1p-50, 1e-12, -1e-12}) {
    Tally& tally = e == 0 ? exact : beside;
    compare(s, s.rect(2, 0.75, 0.25 + e, 1.5, 0.25, 1.25), false, tally);
    compare(s, s.rect(2, 0.75, -1, 0.5 + e, -1, 0.5), false, tally);
    compare(s, s.rect(0, 2.125, 0.5 + e, 2.5625, 0.5, 1.75), false, tally);
  }
  EXPECT_EQ(exact.both_bad, 3);
  EXPECT_EQ(beside.same, 12);
}

/// Mid-planes: a sheet in the plane is never decided, 1e-12 beside it is. One ulp beside,
/// production may give up: bounds over a box are taken in doubles only.
TEST(ProductionFace, MidPlanesAndBeside_AreLikeTheOracle) {
  Tally exact, ulp, beside;
  const Scene s("cuboid", shapes::cuboid(4, 3, 2));
  for (const double e : {0.0, 0x1p-51, -0x1p-51, 1e-12, -1e-12}) {
    Tally& tally = e == 0 ? exact : std::abs(e) < 1e-15 ? ulp : beside;
    compare(s, s.rect(2, 1 + e, 0.5, 3.6875, 0.4375, 2.625), false, tally);
    compare(s, s.rect(2, 1 + e, 1.5, 2.5, 1.25, 1.75), false, tally);
  }
  EXPECT_EQ(exact.both_bad, 2);
  EXPECT_EQ(ulp.different, 0);
  EXPECT_EQ(beside.same, 4);
}

/// Rims inside the solid, exact and rotated.
void rims(std::uint64_t seed, int rounds, Tally& tally) {
  Random random(seed);
  for (int round = 0; round < rounds; ++round) {
    std::vector<Scene> scenes;
    scenes.emplace_back("lpocket", shapes::lpocket());
    scenes.emplace_back("triangulated lpocket",
                        shapes::triangulate_facets(shapes::lpocket(), random()));
    scenes.emplace_back("split lpocket", shapes::split_edges(shapes::lpocket(), random()));
    scenes.emplace_back("rotated lpocket", shapes::rotate_rounded(shapes::lpocket(), random()));
    for (const Scene& s : scenes)
      for (int k = 0; k < 3; ++k) {
        const auto rim = test::random_rim_point(random, s);
        if (!rim) continue;
        const double h = s.extent() * test::uniform(random, 0.005, 0.06);
        const bool rotated = s.name.rfind("rotated", 0) == 0;
        const int axis = rotated ? static_cast<int>(random() % 3) : 2;
        const int u = u_axis(axis), v = v_axis(axis);
        const auto r = [&] { return h * test::uniform(random, 0.1, 1); };
        compare(s,
                {axis, (*rim)[axis], (*rim)[u] - r(), (*rim)[u] + r(), (*rim)[v] - r(),
                 (*rim)[v] + r()},
                random() % 2 == 0, tally);
      }
  }
  tally.print("rims");
}

TEST(ProductionFace, RimsInsideTheSolid_GiveTheMapOfTheOracle) {
  Tally tally;
  rims(31, 3, tally);
  EXPECT_GE(tally.rims, 8);
}

TEST(SweepProductionFace, RimsInsideTheSolid_GiveTheMapOfTheOracle) {
  Tally tally;
  rims(32, 12, tally);
  EXPECT_GE(tally.rims, 40);
  EXPECT_EQ(tally.production_gives_up + tally.brute_bad_only + tally.both_bad, 0);
}

/// A seam that runs along the plane at distance e: the third site never governs, but nearly does
/// along a whole line.
void seam_along_the_plane(std::initializer_list<double> distances, Tally& tally) {
  const Scene s("plate", shapes::plate(1, 6));
  for (const double e : distances)
    for (const int sign : {-1, 1})
      compare(s, {0, 0.125 + sign * e, 0.34, 0.87, -0.015, 0.39}, false, tally);
  tally.print("seam along the plane");
}

TEST(ProductionFace, SeamAlongThePlane_GivesTheMapOfTheOracle) {
  Tally tally;
  seam_along_the_plane({1e-2, 1e-3, 1e-4}, tally);
  EXPECT_EQ(tally.same, 6);
}

TEST(SweepProductionFace, SeamAlongThePlaneNearer_GivesTheMapOfTheOracle) {
  Tally tally;
  seam_along_the_plane({1e-5, 1e-6}, tally);
  EXPECT_EQ(tally.same, 4);
}

TEST(ProductionFace, SeamAlongThePlaneVeryNear_IsDecidedOrGivenUpInTime) {
  Tally tally;
  seam_along_the_plane({1e-8, 1e-12}, tally);
  EXPECT_EQ(tally.different, 0);
  EXPECT_LT(tally.production_s, 10);
}

}  // namespace
}  // namespace blum
