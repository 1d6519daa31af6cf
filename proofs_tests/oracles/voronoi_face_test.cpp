// Voronoi diagrams on rectangles: the production engine against the exact oracle.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "arrangement/coarse_map.hpp"
#include "arrangement/face_scenes.hpp"
#include "blum/arrangement/brute_engine.hpp"
#include "oracles/voronoi_scenes.hpp"

namespace blum {
namespace {

using test::Random;
using test::Scene;

struct Tally {
  int problems = 0, same = 0, both_bad = 0, gives_up = 0, brute_bad = 0, skipped = 0, events = 0;
};

void compare(const Scene& scene, const Rect& r, bool wide, std::size_t most, Tally& tally) {
  const auto near = scene.near(r);
  if (near.size() > most) {
    ++tally.skipped;
    return;
  }
  ++tally.problems;
  const auto all = scene.all_candidates();
  const FaceProblem exact{scene.solid.get(), r, near, {}, true, DiagramKind::kVoronoi};
  FaceProblem fast = exact;
  if (wide) fast.candidates = all;
  ProductionEngine engine = scene.engine();
  const FaceDiagram p = engine.face(fast);
  const FaceDiagram b = brute_face(exact);
  const bool p_ok = p.status == FaceStatus::kDecided, b_ok = b.status == FaceStatus::kDecided;
  if (!p_ok || !b_ok) {
    ++(!p_ok && !b_ok ? tally.both_bad : p_ok ? tally.brute_bad : tally.gives_up);
    if (std::getenv("BLUM_TRACE") != nullptr)
      std::cout << (p_ok ? b.reason : p.reason) << ": " << test::describe(scene, r) << '\n';
    return;
  }
  const std::string difference = test::coarse_map_difference(p, b);
  EXPECT_EQ(difference, "") << test::describe(scene, r);
  if (difference.empty()) ++tally.same;
  for (const FaceNode& n : p.node) tally.events += n.kind == FaceNode::Kind::kEvent;
}

void print(const Tally& t) {
  std::cout << t.problems << " problems, " << t.same << " same, " << t.both_bad << " bad for both, "
            << t.gives_up << " undecided by production alone, " << t.brute_bad
            << " bad for brute alone, " << t.skipped << " skipped, " << t.events << " events\n";
}

Tally run(std::uint64_t seed, int rounds, std::size_t most, bool special,
          const std::vector<Scene>& all = test::voronoi_scenes()) {
  Random random(seed);
  Tally tally;
  for (int round = 0; round < rounds; ++round)
    for (const Scene& scene : all)
      compare(scene,
              special ? test::special_rect(random, scene) : test::voronoi_rect(random, scene),
              random() % 2 == 0, most, tally);
  print(tally);
  return tally;
}

TEST(VoronoiFace, RandomRectangles_GiveTheMapOfTheOracle) {
  const Tally t = run(1, 12, 9, false);
  EXPECT_EQ(t.same, t.problems);
  EXPECT_GT(t.events, 20);
}

TEST(VoronoiFace, SpecialRectangles_GiveTheMapOfTheOracleOrNone) {
  const Tally t = run(2, 20, 9, true);
  EXPECT_LE(t.gives_up, t.problems / 10);  // planes within rounding of a bad position
  EXPECT_GT(t.same, t.problems / 2);
}

TEST(VoronoiFace, RegionsThinnerThanDoubles_GiveTheMapOfTheOracle) {
  const Tally t = run(5, 12, 9, false, test::nearly_flat_voronoi_scenes());
  EXPECT_EQ(t.same, t.problems);
  EXPECT_GT(t.events, 10);
}

TEST(SweepVoronoiFace, ManyRegionsThinnerThanDoubles_GiveTheMapOfTheOracle) {
  const Tally t = run(6, 200, 12, false, test::nearly_flat_voronoi_scenes());
  EXPECT_LE(t.gives_up, t.problems / 50);
}

TEST(SweepVoronoiFace, ManyRandomRectangles_GiveTheMapOfTheOracle) {
  // In this many, some lie within rounding of a bad position; the maps of all others are the same.
  const Tally t = run(3, 200, 14, false);
  EXPECT_GE(t.same, t.problems - t.problems / 50);
}

TEST(SweepVoronoiFace, ManySpecialRectangles_GiveTheMapOfTheOracleOrNone) {
  const Tally t = run(4, 200, 12, true);
  EXPECT_LE(t.gives_up, t.problems / 10);
}

}  // namespace
}  // namespace blum
