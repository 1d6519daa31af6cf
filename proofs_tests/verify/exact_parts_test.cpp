// Parts of faces that the program decided by exact algebra: the checker shows them as stars, or by
// exact algebra on a problem of its own, and takes nothing that is false about them.
#include <filesystem>

#include "blum/kernel/mesh.hpp"
#include "certificates.hpp"

namespace blum::test {
namespace {

using Outcome = verify::Answer::Outcome;

Certified fixture(const std::string& name, std::uint64_t seed) {
  const auto mesh = read_mesh(std::filesystem::path(BLUM_FIXTURES_DIR) / (name + ".off"));
  EXPECT_TRUE(mesh.ok()) << name;
  MedialOptions options;
  options.seed = seed;
  return {name, mesh.value(), options};
}

/// Calls visit(record, part) for each exact part of the records, in order.
template <class F>
void for_exact_parts(std::vector<Json>& records, F&& visit) {
  const auto of_face = [&](Json& face) {
    for (Json& part : face["parts"])
      if (part[0] == "exact") visit(part);
  };
  for (Json& record : records) {
    if (record.contains("leaf") && record["leaf"].contains("faces"))
      for (Json& face : record["leaf"]["faces"]) of_face(face);
    if (record.contains("interface")) of_face(record["interface"]);
  }
}

std::size_t count_exact_parts(std::vector<Json> records) {
  std::size_t n = 0;
  for_exact_parts(records, [&](const Json&) { ++n; });
  return n;
}

const std::vector<Certified>& with_exact_parts() {
  static std::vector<Certified> all;
  if (!all.empty()) return all;
  all.emplace_back("lpocket", shapes::lpocket(1, 2, 1e-9));
  all.emplace_back("lpocket rotated", shapes::rotate_rounded(shapes::lpocket(1, 2, 1e-9), 1));
  all.emplace_back("lbracket rotated", shapes::rotate_rounded(shapes::lbracket(4, 3, 1e-9, 2), 2));
  all.push_back(fixture("needle_two_events", 414));
  all.push_back(fixture("wall_by_feet", 413));
  return all;
}

TEST(VerifyExactParts, BesideWallsAndInNeedles_AreShown) {
  for (const Certified& c : with_exact_parts()) {
    EXPECT_GT(count_exact_parts(c.record), 0u) << c.name;
    const verify::Answer answer = check(c, c.record);
    EXPECT_EQ(answer.outcome, Outcome::kVerified) << c.name << answer.statement;
    EXPECT_EQ(answer.betti, c.betti);
  }
}

// Bounds of this checker alone: the sites of a needle, and an edge beside a face in its plane but
// for rounding.
TEST(VerifyFixtures, NeedleAndThinWall_Verified) {
  for (const Certified& c : {fixture("needle", 71), fixture("wall_rotated", 519)}) {
    const verify::Answer answer = check(c, c.record);
    EXPECT_EQ(answer.outcome, Outcome::kVerified) << c.name << answer.statement;
  }
}

// A part that a hole cuts into a piece of the solid and a piece outside, where sites are near that
// govern nothing inside; and two edges in line but for rounding, with a polar cone as thin.
TEST(VerifyFixtures, PartCutByAHoleAndThinPolarCone_Verified) {
  for (const Certified& c : {fixture("part_cut_by_hole", 655), fixture("thin_polar_cone", 152)}) {
    const verify::Answer answer = check(c, c.record);
    EXPECT_EQ(answer.outcome, Outcome::kVerified) << c.name << answer.statement;
  }
}

// A face where events are nearly one: the candidates of the cell's parent part them otherwise.
TEST(VerifyFixtures, FaceDecidedWithTheCellsOwnCandidates_Verified) {
  const Certified c = fixture("dragknob", 1);
  const verify::Answer answer = check(c, c.record);
  EXPECT_EQ(answer.outcome, Outcome::kVerified) << answer.statement;
}

/// Solids with split edges, turned: nearly straight edges, and vertices that are hardly feet.
PolygonMesh variant(const PolygonMesh& mesh, int s, int r) {
  const auto split = shapes::split_edges(mesh, static_cast<std::uint64_t>((r + s) % 3 + 1));
  return shapes::rotate_rounded(shapes::triangulate_facets(split, static_cast<std::uint64_t>(s)),
                                static_cast<std::uint64_t>(r));
}

// Exact parts with several events: the cuts proposed between them must not meet an edge of a
// symmetric solid, nor have two ties between two neighbouring doubles.
TEST(VerifyFixtures, CutsBetweenEventsOfExactParts_Verified) {
  for (const Certified& c : {fixture("needle_two_events", 1),
                             Certified("voids 2", variant(shapes::nested_voids(2), 4, 4))}) {
    EXPECT_GT(count_exact_parts(c.record), 0u) << c.name;
    const verify::Answer answer = check(c, c.record);
    EXPECT_EQ(answer.outcome, Outcome::kVerified) << c.name << answer.statement;
  }
}

// Two rims and an event in one box; edges that a degenerate vertex joins in the program alone.
TEST(SweepVerifyFixtures, SeveralEventsInABoxAndGroupsOfEdges_Verified) {
  for (const Certified& c : {Certified("plate 4", variant(shapes::plate(4, 6), 2, 1)),
                             Certified("voids 3", variant(shapes::nested_voids(3), 5, 2))}) {
    const verify::Answer answer = check(c, c.record);
    EXPECT_EQ(answer.outcome, Outcome::kVerified) << c.name << answer.statement;
  }
}

// No site covers the centre of a box for certain, and corners are far.
TEST(VerifyFixtures, Needle_Verified) {
  const Certified c = fixture("needle_of_2e8", 377);
  const verify::Answer answer = check(c, c.record);
  EXPECT_EQ(answer.outcome, Outcome::kVerified) << answer.statement;
}

// An edge beside a face in its plane but for rounding: they do not tie, as the gap is wider than
// their depth allows.
TEST(SweepVerifyFixtures, EdgesBesideFacesInTheirPlanes_Verified) {
  for (const Certified& c : {fixture("wall_by_depth", 337), fixture("sliver_by_depth", 62)}) {
    const verify::Answer answer = check(c, c.record);
    EXPECT_EQ(answer.outcome, Outcome::kVerified) << c.name << answer.statement;
  }
}

/// With the change of its nth exact part.
template <class F>
verify::Answer changed(const Certified& c, std::size_t n, F&& change) {
  std::vector<Json> records = c.record;
  for_exact_parts(records, [&](Json& part) {
    if (n-- == 0) change(part);
  });
  return check(c, records);
}

TEST(VerifyExactParts, WithoutTheSitesThatShow_Rejected) {
  for (const Certified& c : with_exact_parts())
    EXPECT_NE(changed(c, 0, [](Json& part) { part[1][1] = Json::array(); }).outcome,
              Outcome::kVerified)
        << c.name;
}

// What is proposed may be wrong: then exact algebra decides, and the answer says so.
TEST(VerifyExactParts, WithDirectionsTurnedRound_ByExactAlgebra) {
  for (const Certified& c : with_exact_parts()) {
    const std::size_t before = check(c, c.record).exact_parts;
    std::vector<Json> records = c.record;
    for_exact_parts(records, [&](Json& part) {
      for (Json& d : part[1][2]) {
        d[1] = -d[1].get<double>();
        d[2] = -d[2].get<double>();
      }
    });
    const verify::Answer answer = check(c, records);
    EXPECT_EQ(answer.outcome, Outcome::kVerified) << c.name << answer.statement;
    EXPECT_GT(answer.exact_parts, before) << c.name;
  }
}

// As versions 2 and 3 had them: a list of sites, with directions or without.
TEST(VerifyExactParts, OfOlderVersions_Verified) {
  const Certified c("lpocket", shapes::lpocket(1, 2, 1e-9));
  for (const bool with_directions : {true, false}) {
    std::vector<Json> records = c.record;
    records[0]["header"]["version"] = 3;
    for_exact_parts(records, [&](Json& part) {
      part = with_directions ? Json{"exact", part[1][1], part[1][2]} : Json{"exact", part[1][1]};
    });
    const verify::Answer answer = check(c, records);
    EXPECT_EQ(answer.outcome, Outcome::kVerified) << answer.statement;
    EXPECT_EQ(answer.exact_parts > 0, !with_directions);
  }
}

TEST(VerifyExactParts, OfOneDiagramWithoutAny_NoneCounted) {
  const Certified c("lbracket", shapes::lbracket());
  EXPECT_EQ(check(c, c.record).exact_parts, 0u);
}

}  // namespace
}  // namespace blum::test
