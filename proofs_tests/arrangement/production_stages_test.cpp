// Which stage of the predicates decides: the exact one is rare on input in general position.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "face_scenes.hpp"

namespace blum {
namespace {

using test::Random;
using test::Scene;

struct Outcome {
  StageCounts stages;
  int faces = 0, decided = 0, with_ties = 0;
  void print(const char* what) const {
    const double total = static_cast<double>(stages.filter + stages.extended + stages.exact);
    std::cout << what << ": " << faces << " faces, " << decided << " decided, " << with_ties
              << " with ties; " << total << " decisions: filter "
              << 100 * double(stages.filter) / total << " %, extended "
              << 100 * double(stages.extended) / total << " %, exact "
              << 100 * double(stages.exact) / total << " %\n";
  }
  void expect_rare_exact_stage() const {
    EXPECT_LT(stages.exact * 100, stages.filter + stages.extended + stages.exact);
  }
};

void ask(const Scene& scene, Random& random, int faces, Outcome& out) {
  ProductionEngine engine = scene.engine();
  const auto triangles = scene.all_triangles();
  for (int k = 0; k < faces; ++k) {
    const Rect r = test::random_rect(random, scene, test::uniform(random, 0.05, 0.8));
    const auto sites = scene.near(r);
    const FaceDiagram d = engine.face({scene.solid.get(), r, sites, triangles});
    ++out.faces;
    out.decided += d.status == FaceStatus::kDecided;
    out.with_ties += !d.arc.empty();
  }
  out.stages += engine.predicates().stages();
}

TEST(ProductionStages, SolidsInGeneralPosition_DecideExactlyBelowOnePercent) {
  Random random(1);
  Outcome out;
  for (int k = 0; k < 40; ++k) {
    const auto solid = build_solid(test::star(random, k % 2));
    if (solid.ok()) ask(Scene("star", solid.value()), random, 10, out);
  }
  out.print("stars");
  EXPECT_GE(out.decided, 200);
  EXPECT_EQ(out.decided, out.faces);
  EXPECT_GE(out.with_ties, 100);
  out.expect_rare_exact_stage();
}

TEST(ProductionStages, CadSolids_DecideExactlyBelowOnePercent) {
  Random random(2);
  Outcome out;
  for (const Scene& scene : test::catalogue(random))
    if (scene.name.rfind("rotated", 0) != 0) ask(scene, random, 8, out);
  out.print("CAD solids");
  EXPECT_GE(out.decided, 200);
  EXPECT_EQ(out.decided, out.faces);
  out.expect_rare_exact_stage();
}

TEST(ProductionStages, RoundedSolids_AreReported) {
  Random random(3);
  Outcome out;
  for (const Scene& scene : test::catalogue(random))
    if (scene.name.rfind("rotated", 0) == 0) ask(scene, random, 20, out);
  out.print("rounded solids");
  EXPECT_GE(out.decided * 100, out.faces * 90);
}

TEST(ProductionStages, SpecialRectangles_ReachEveryStage) {
  Random random(4);
  StageCounts stages;
  for (const Scene& scene : test::catalogue(random)) {
    ProductionEngine engine = scene.engine();
    const auto triangles = scene.all_triangles();
    for (int k = 0; k < 5; ++k) {
      const Rect r = test::special_rect(random, scene);
      const auto sites = scene.near(r);
      if (std::getenv("BLUM_TRACE") != nullptr) std::cout << test::describe(scene, r) << std::endl;
      (void)engine.face({scene.solid.get(), r, sites, triangles});
    }
    stages += engine.predicates().stages();
  }
  EXPECT_GT(stages.filter, 0u);
  EXPECT_GT(stages.extended, 0u);
  EXPECT_GT(stages.exact, 0u);
}

}  // namespace
}  // namespace blum
