// Diagrams that rely on "Rivals": against the exact oracle, and against those found without it.
#include <gtest/gtest.h>

#include <iostream>

#include "oracles/degenerate_problems.hpp"
#include "oracles/face_compare.hpp"
#include "oracles/voronoi_scenes.hpp"

namespace blum {
namespace {

using test::Random;
using test::Scene;

struct Counts {
  int problems = 0, same = 0, undecided = 0, oracle = 0;
  std::uint64_t rivals = 0, boxes = 0, plain_boxes = 0;

  void print() const {
    std::cout << problems << " problems, " << same << " same, " << undecided
              << " undecided by one, " << oracle << " asked of the oracle; " << rivals
              << " rivals apart; " << boxes << " boxes, without " << plain_boxes << '\n';
  }
};

/// With the rule, without it, and by the exact oracle where no more than `most` sites are near.
void compare(const Scene& scene, const Rect& rect, std::size_t most, Counts& counts) {
  const auto near = scene.near(rect);
  const bool voronoi = scene.geometry->kind() == DiagramKind::kVoronoi;
  const auto triangles = scene.all_triangles();
  FaceProblem problem{scene.solid.get(), rect, near, triangles};
  if (voronoi) problem = {scene.solid.get(), rect, near, {}, true, DiagramKind::kVoronoi};
  ProductionEngine with = scene.engine(), without = scene.engine();
  without.prefer_plain_reasons();
  const FaceDiagram p = with.face(problem);
  const bool relied_on = with.counts().rivals > 0;
  if (!relied_on) return;
  const FaceDiagram q = without.face(problem);
  ++counts.problems;
  counts.rivals += with.counts().rivals;
  counts.boxes += with.counts().boxes;
  counts.plain_boxes += without.counts().boxes;
  if (p.status == FaceStatus::kDecided && q.status == FaceStatus::kDecided) {
    const std::string difference = test::coarse_map_difference(p, q);
    EXPECT_EQ(difference, "") << test::describe(scene, rect);
    counts.same += difference.empty();
  } else {
    ++counts.undecided;
  }
  if (p.status != FaceStatus::kDecided || near.size() > most || scene.curved(near) > 8) return;
  const FaceDiagram b = brute_face(problem);
  if (b.status != FaceStatus::kDecided) return;
  ++counts.oracle;
  EXPECT_EQ(test::coarse_map_difference(p, b), "") << test::describe(scene, rect);
}

Counts medial(std::uint64_t seed, int rounds, std::size_t most) {
  Random random(seed);
  Counts counts;
  for (int k = 0; k < rounds; ++k) {
    const auto use = [&](const Scene& s, const Rect& r) { compare(s, r, most, counts); };
    for (const Scene& s : test::catalogue(random))
      use(s, test::random_rect(random, s, test::log_uniform(random, 0.02, 0.8)));
    test::degenerate_problems(random, use);
  }
  counts.print();
  return counts;
}

Counts voronoi(std::uint64_t seed, int rounds, std::size_t most) {
  Random random(seed);
  Counts counts;
  for (auto* make : {test::voronoi_scenes, test::nearly_flat_voronoi_scenes})
    for (const Scene& s : make())
      for (int k = 0; k < rounds; ++k)
        compare(s, k % 3 == 2 ? test::special_rect(random, s) : test::voronoi_rect(random, s), most,
                counts);
  counts.print();
  return counts;
}

TEST(RivalsFace, MedialDiagrams_AreThoseWithoutItAndOfTheOracle) {
  const Counts c = medial(1, 1, 14);
  EXPECT_GE(c.oracle, 35);
  EXPECT_GE(c.rivals, 1000u);
  EXPECT_LE(c.undecided, 3);
  EXPECT_LT(c.boxes, c.plain_boxes);
}

TEST(RivalsFace, VoronoiDiagrams_AreThoseWithoutItAndOfTheOracle) {
  const Counts c = voronoi(2, 10, 10);
  EXPECT_GE(c.oracle, 20);
  EXPECT_GE(c.rivals, 2000u);
  EXPECT_LE(c.undecided, 3);
  EXPECT_LT(c.boxes, c.plain_boxes);
}

TEST(SweepRivalsFace, MedialDiagrams_AreThoseWithoutItAndOfTheOracle) {
  const Counts c = medial(3, 20, 20);
  EXPECT_GE(c.oracle, 200);
}

TEST(SweepRivalsFace, VoronoiDiagrams_AreThoseWithoutItAndOfTheOracle) {
  const Counts c = voronoi(4, 80, 11);
  EXPECT_GE(c.oracle, 200);
}

}  // namespace
}  // namespace blum
