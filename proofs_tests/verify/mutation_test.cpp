// What the checker accepts and what it does not: certificates as they are written, and with one
// change that is false by construction.
#include <filesystem>

#include "blum/kernel/mesh.hpp"
#include "mutations.hpp"

namespace blum::test {
namespace {

using Outcome = verify::Answer::Outcome;

/// With leaves small enough for faces of one part, events and interfaces of their own.
std::vector<Certified> small() {
  MedialOptions fine, resolve;
  fine.max_leaf_diameter = 3.5;
  resolve.resolve = true;
  std::vector<Certified> all;
  all.emplace_back("lbracket", shapes::lbracket(), fine);
  all.emplace_back("prism 5", shapes::prism(5), resolve);
  all.emplace_back("voids 2", shapes::nested_voids(2));
  return all;
}

std::vector<Certified> larger() {
  std::vector<Certified> all = small();
  all.emplace_back("lbracket, coarse", shapes::lbracket());
  all.emplace_back("torus 8 x 4", shapes::torus(8, 4, 2, 0.75));
  all.emplace_back("lpocket", shapes::lpocket());
  all.emplace_back("lpocket rotated", shapes::rotate_rounded(shapes::lpocket(), 3));
  all.emplace_back("lbracket rotated", shapes::rotate_rounded(shapes::lbracket(), 7));
  all.emplace_back("plate 2", shapes::plate(2, 6));
  all.emplace_back("prism 5, coarse", shapes::prism(5));
  all.emplace_back("voids 3 rotated", shapes::rotate_rounded(shapes::nested_voids(3), 2));
  return all;
}

TEST(Mutation, OfSmallCertificatesThatAreFalse_Rejected) {
  apply_all(small(), false_mutations(), 1, false);
}

TEST(Mutation, OfSmallCertificatesThatKeepTheMeaning_Accepted) {
  apply_all(small(), true_mutations(), 1, true);
}

/// Whatever the program accepts a leaf for, the checker must know, too.
TEST(VerifyFixtures, CertificatesOfFixtures_AreAccepted) {
  for (const char* name : {"plane_sector", "vertex_governor_square_pyramid", "ray_tripod"}) {
    SCOPED_TRACE(name);
    const auto mesh =
        read_mesh(std::filesystem::path(BLUM_FIXTURES_DIR) / (std::string(name) + ".off"));
    ASSERT_TRUE(mesh.ok());
    const Certified c(name, mesh.value());
    const verify::Answer answer = check(c, c.record);
    EXPECT_EQ(answer.outcome, Outcome::kVerified) << answer.statement;
    EXPECT_EQ(answer.betti, c.betti);
  }
}

TEST(SweepMutation, ThatAreFalse_Rejected) { apply_all(larger(), false_mutations(), 10, false); }

TEST(SweepMutation, ThatKeepTheMeaning_Accepted) { apply_all(larger(), true_mutations(), 5, true); }

TEST(Mutation, TruncatedText_Unreadable) {
  const Certified c("lbracket", shapes::lbracket());
  const std::string text = text_of(c.record);
  Random random(3);
  for (int k = 0; k < 100; ++k) {
    const auto length =
        below(random, text.size() - 1);  // without the last end of line: still whole
    EXPECT_EQ(check(c, text.substr(0, length)).outcome, Outcome::kUnreadable) << length;
  }
  EXPECT_EQ(check(c, text + "\n").outcome, Outcome::kUnreadable);
}

TEST(Mutation, BlanksBetweenTokens_Accepted) {
  const Certified c("lbracket", shapes::lbracket());
  std::string spaced;
  for (const char x : text_of(c.record)) {
    spaced += x;
    if (x == ',' || x == ':' || x == '[') spaced += "  \t";
  }
  const verify::Answer answer = check(c, spaced);
  EXPECT_EQ(answer.outcome, Outcome::kVerified) << answer.statement;
}

TEST(Mutation, CertificateOfAnotherModel_Rejected) {
  const std::vector<Certified> all = small();
  for (const Certified& c : all)
    for (const Certified& other : all) {
      if (&c == &other) continue;
      EXPECT_EQ(check(other, c.record).outcome, Outcome::kFalse);
      // Even if it says that it is of this model: these differ in more than positions.
      auto records = c.record;
      records[0]["header"]["model"] = other.record[0]["header"]["model"];
      EXPECT_NE(check(other, records).outcome, Outcome::kVerified) << c.name << other.name;
    }
}

/// Any value at any place: never a crash, and what is verified is true.
void replace_values(const std::vector<Certified>& certificates, int times) {
  const std::vector<Json> hostile = {Json(nullptr),
                                     Json(-1),
                                     Json(1e300),
                                     Json(-1e300),
                                     Json(0),
                                     Json(4294967296),
                                     Json(18446744073709551615u),
                                     Json("x"),
                                     Json::array(),
                                     Json::object(),
                                     Json(true),
                                     Json(5e-324),
                                     Json(0.1),
                                     Json(3)};
  Random random(5);
  for (const Certified& c : certificates)
    for (int k = 0; k < times; ++k) {
      auto records = c.record;
      Json* place = &records[below(random, records.size())];
      while (place->is_structured() && !place->empty() && below(random, 12) != 0) {
        auto it = place->begin();
        std::advance(it, static_cast<long>(below(random, place->size())));
        place = &*it;
      }
      *place = hostile[below(random, hostile.size())];
      const verify::Answer answer = check(c, records);
      if (answer.outcome == Outcome::kVerified) {
        EXPECT_EQ(answer.betti, c.betti) << c.name;
      }
    }
}

TEST(Mutation, HostileValues_NeverACrashNorAWrongAnswer) { replace_values(small(), 8); }
TEST(SweepMutation, HostileValues_NeverACrashNorAWrongAnswer) { replace_values(larger(), 1000); }

TEST(Mutation, TextThatIsNoCertificate_Unreadable) {
  const Certified c("lbracket", shapes::lbracket());
  for (const char* text : {"", "\n", "null\n", "[]\n", "{}\n", "{\"header\":1}\n",
                           "{\"header\":{}}\n", "{\"header\":{\"format\":\"blum-certificate\"}}\n",
                           "\xff\xfe\n", "{\"header\":1,\"leaf\":2}\n", "{\"leaf\":1e999}\n"})
    EXPECT_EQ(check(c, text).outcome, Outcome::kUnreadable) << text;
  EXPECT_EQ(check(c, std::string(100000, '[')).outcome, Outcome::kUnreadable);
}

TEST(Mutation, UncertifiedResult_FalseWithTheFirstUndecidedLeaf) {
  MedialOptions options;
  options.max_depth = 0;
  const Result<Solid> solid = build_solid(shapes::torus(8, 4, 2, 0.75));
  std::string text;
  const auto result = compute_medial_axis(solid.value(), options, {}, [&](const std::string& line) {
    text += line + "\n";
    return true;
  });
  ASSERT_FALSE(result.value().certified);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const SolidTriangle& t : solid.value().triangle) triangles.push_back(t.vertex);
  std::istringstream in(text);
  const verify::Answer answer = verify::verify({solid.value().point, triangles}, in);
  EXPECT_EQ(answer.outcome, Outcome::kFalse);
  EXPECT_NE(answer.statement.find("leaf 0 is undecided"), std::string::npos) << answer.statement;
}

}  // namespace
}  // namespace blum::test
