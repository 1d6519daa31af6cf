// CGAL's arrangements against the production engine and its brute-force twin: the same labelled
// planar maps. What CGAL cannot do, and the disagreements that were found: docs/oracles.md.
#include "cgal_tally.hpp"

namespace blum {
namespace {

using test::CgalTally;
using test::Random;
using test::Scene;

class CgalFace : public ::testing::Test {
 protected:
  void SetUp() override {
    helper = find_cgal_helper();
    if (!helper) GTEST_SKIP() << "no blum-cgal-engine: built without BLUM_CGAL_ORACLES";
  }
  void compare(const Scene& scene, const Rect& r, CgalTally& tally) {
    CgalEngine engine(*scene.solid, *helper, tally.method, tally.limits);
    test::compare_three(scene, r, engine, tally);
  }
  std::optional<std::filesystem::path> helper;
};
using SweepCgalFace = CgalFace;

Rect random_rect(Random& random, const Scene& scene) {
  const double size = std::exp(test::uniform(random, std::log(0.02), std::log(0.8)));
  return test::random_rect(random, scene, size);
}

TEST_F(CgalFace, RandomRectangles_GiveOneMap) {
  CgalTally tally;
  Random random(41);
  for (const Scene& s : test::catalogue(random)) compare(s, random_rect(random, s), tally);
  tally.print("random");
  EXPECT_EQ(tally.different, 0);
  EXPECT_GE(tally.same, 20);
}

}  // namespace
}  // namespace blum
