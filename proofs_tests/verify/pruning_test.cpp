// Collapses in certificates: replayed as they are written, and refused with one change that makes
// them false.
#include "pruning_mutations.hpp"

namespace blum::test {
namespace {

using Outcome = verify::Answer::Outcome;

std::vector<Certified> small() {
  std::vector<Certified> all;
  all.emplace_back("lbracket", shapes::lbracket(), MedialOptions{}, 95);
  all.emplace_back("prism 5", shapes::prism(5), MedialOptions{}, 95);
  all.emplace_back("voids 2", shapes::nested_voids(2), MedialOptions{}, 100);
  return all;
}

Certified torus() { return {"torus 8 x 4", shapes::torus(8, 4, 2, 0.75), MedialOptions{}, 180}; }

std::vector<Certified> larger() {
  MedialOptions resolve;
  resolve.resolve = true;
  std::vector<Certified> all = small();
  all.emplace_back("prism 5, fine", shapes::prism(5), resolve, 120);
  all.push_back(torus());
  for (const double theta : {30, 95, 180}) {
    all.emplace_back("lpocket rotated", shapes::rotate_rounded(shapes::lpocket(), 3),
                     MedialOptions{}, theta);
    all.emplace_back("plate 2 rotated", shapes::rotate_rounded(shapes::plate(2, 6), 4),
                     MedialOptions{}, theta);
  }
  return all;
}

TEST(Pruning, OfSmallCertificatesThatIsFalse_Rejected) {
  apply_all(small(), false_prunings(), 1, false);
}

TEST(Pruning, OfSmallCertificatesThatKeepsTheMeaning_Accepted) {
  std::vector<Certified> all = small();
  all.push_back(torus());  // with events that go
  apply_all(all, true_prunings(), 1, true);
}

TEST(SweepPruning, ThatIsFalse_Rejected) { apply_all(larger(), false_prunings(), 3, false); }
TEST(SweepPruning, ThatKeepsTheMeaning_Accepted) { apply_all(larger(), true_prunings(), 3, true); }

/// The rest of a certificate is checked as without.
TEST(SweepPruning, CertificatesWithAFalseRecordElsewhere_Rejected) {
  for (const Certified& c : small())
    for (const std::size_t i : all(c.record, "leaf")) {
      auto records = c.record;
      records.erase(records.begin() + static_cast<long>(i));
      EXPECT_NE(check(c, records).outcome, Outcome::kVerified) << c.name << i;
    }
}

TEST(Pruning, EveryTheta_VerifiedWithTheBettiNumbersOfTheSolid) {
  for (const PolygonMesh& mesh : {shapes::lbracket(), shapes::prism(6)})
    for (const double theta : {0, 89, 91, 180}) {
      const Certified c("", mesh, MedialOptions{}, theta);
      const verify::Answer answer = check(c, c.record);
      EXPECT_EQ(answer.outcome, Outcome::kVerified) << theta << ": " << answer.statement;
      EXPECT_EQ(answer.theta_deg, theta);
      EXPECT_EQ(answer.betti, c.betti);
      EXPECT_EQ(answer.collapses > 0, !all(c.record, "collapse").empty());
    }
}

/// All sheets of the rest are between two faces; of 90 degrees, those that go.
TEST(Pruning, SheetsBetweenFaces_AnglesAreCompared) {
  const Certified c("", shapes::lbracket(), MedialOptions{}, 95);
  const verify::Answer answer = check(c, c.record);
  EXPECT_GT(answer.pieces, 0u);
  EXPECT_EQ(answer.angles, answer.pieces);
}

/// The same collapses, said to be cheap: they keep the homotopy type, but sheets of 90 degrees have
/// no place among what goes below 60.
TEST(Pruning, SheetsOfALargerAngleThanTheirCost_Rejected) {
  for (const PolygonMesh& mesh : {shapes::lbracket(), shapes::cuboid(1, 2, 3)}) {
    Certified c("", mesh, MedialOptions{}, 95);
    for (const std::size_t i : all(c.record, "collapse"))
      c.record[i]["collapse"]["cost"] = c.record[i]["collapse"]["value"] = 50;
    c.record[c.record.size() - 2]["pruned"]["theta"] = 60;
    const verify::Answer answer = check(c, c.record);
    EXPECT_EQ(answer.outcome, Outcome::kFalse);
    EXPECT_EQ(answer.statement,
              "pruning: the angle of a sheet between two faces is above the cost of its collapse");
  }
}

TEST(Pruning, NoTheta_NoCollapses) {
  const Certified c("", shapes::lbracket());
  EXPECT_TRUE(all(c.record, "pruned").empty());
  const verify::Answer answer = check(c, c.record);
  EXPECT_EQ(answer.outcome, Outcome::kVerified);
  EXPECT_FALSE(answer.theta_deg.has_value());
}

TEST(Pruning, ThetaWithoutAngles_BadArgument) {
  AngleOptions angles;
  angles.certified_theta_deg = 60;
  const auto result =
      compute_medial_axis(build_solid(shapes::lbracket()).value(), {}, angles, {}, {});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kBadArgument);
}

}  // namespace
}  // namespace blum::test
