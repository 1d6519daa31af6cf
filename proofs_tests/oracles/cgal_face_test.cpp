// CGAL's arrangements against the production engine and its brute-force twin: the same labelled
// planar maps. What CGAL cannot do, and the disagreements that were found: docs/oracles.md.
#include "cgal_tally.hpp"
#include "degenerate_problems.hpp"

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
class SweepCgalFace : public CgalFace {};

Rect random_rect(Random& random, const Scene& scene) {
  const double size = std::exp(test::uniform(random, std::log(0.02), std::log(0.8)));
  return test::random_rect(random, scene, size);
}

TEST_F(CgalFace, RandomRectangles_GiveOneMap) {
  CgalTally tally;
  Random random(41);
  int k = 0;
  for (const Scene& s : test::catalogue(random))
    if (k++ % 3 == 0) compare(s, random_rect(random, s), tally);
  tally.print("random");
  EXPECT_EQ(tally.different, 0);
  EXPECT_GE(tally.same, 9);
}

TEST_F(CgalFace, DegenerateRectangles_GiveOneMap) {
  CgalTally tally;
  Random random(42);
  int k = 0;
  test::degenerate_problems(random, [&](const Scene& s, const Rect& r) {
    if (k++ % 7 == 0) compare(s, r, tally);
  });
  test::corners_and_mid_planes([&](const Scene& s, const Rect& r) {
    if (k++ % 5 == 0) compare(s, r, tally);
  });
  tally.print("degenerate");
  EXPECT_EQ(tally.different, 0);
  EXPECT_GE(tally.same, 8);
}

TEST_F(CgalFace, EnvelopesOfSmallIntegers_GiveOneMap) {
  CgalTally tally;
  tally.method = CgalMethod::kEnvelope;
  Random random(45);
  test::small_integer_problems(random,
                               [&](const Scene& s, const Rect& r) { compare(s, r, tally); });
  tally.print("small integers");
  EXPECT_EQ(tally.different, 0);
  EXPECT_GE(tally.same + tally.bad, 3);
}

/// Arr_conic_traits_2 has known faults (docs/oracles.md): it may give up, it must not be wrong.
TEST_F(CgalFace, ConicsOfSmallIntegers_AreRightOrGivenUp) {
  CgalTally tally;
  tally.method = CgalMethod::kConic;
  tally.limits.cpu_s = 2;
  Random random(46);
  test::small_integer_problems(random,
                               [&](const Scene& s, const Rect& r) { compare(s, r, tally); });
  tally.print("small integers");
  EXPECT_EQ(tally.different, 0);
}

TEST_F(SweepCgalFace, EnvelopesAndConicsOfSmallIntegers_GiveOneMap) {
  for (const CgalMethod method : {CgalMethod::kEnvelope, CgalMethod::kConic}) {
    CgalTally tally;
    tally.method = method;
    Random random(47);
    while (tally.problems < 100)
      test::small_integer_problems(random,
                                   [&](const Scene& s, const Rect& r) { compare(s, r, tally); });
    tally.print("small integers");
    EXPECT_EQ(tally.different, 0);
  }
}

TEST_F(SweepCgalFace, ThousandRandomRectangles_GiveOneMap) {
  CgalTally tally;
  Random random(43);
  while (tally.problems < 1000)
    for (const Scene& s : test::catalogue(random)) compare(s, random_rect(random, s), tally);
  tally.print("random");
  EXPECT_EQ(tally.different, 0);
}

TEST_F(SweepCgalFace, ThousandDegenerateRectangles_GiveOneMap) {
  CgalTally tally;
  Random random(44);
  while (tally.problems < 1000)
    test::degenerate_problems(random, [&](const Scene& s, const Rect& r) { compare(s, r, tally); });
  tally.print("degenerate");
  EXPECT_EQ(tally.different, 0);
}

}  // namespace
}  // namespace blum
