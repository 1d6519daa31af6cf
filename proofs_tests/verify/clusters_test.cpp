// Events that a certificate states as one (docs/proofs.md, "Clusters"): the checker takes a tree of
// events for one, and nothing else.
#include <filesystem>

#include "blum/kernel/mesh.hpp"
#include "certificates.hpp"

namespace blum::test {
namespace {

using Outcome = verify::Answer::Outcome;
using Records = std::vector<Json>;

/// An arc between two events of a face.
struct Pair {
  FaceRef face;
  std::size_t arc, a, b;
};

std::vector<Pair> pairs(const Records& r) {
  std::vector<Pair> found;
  for (const FaceRef& f : faces_with_arcs(r)) {
    const Json& graph = r[f.record]["leaf"]["faces"][f.face]["graph"];
    for (std::size_t k = 0; k < graph["arcs"].size(); ++k) {
      const Json &p = graph["arcs"][k][0], &q = graph["arcs"][k][1];
      const auto event = [&](const Json& end) {
        return end[0] == "event" && graph["events"][end[1].get<std::size_t>()][0] == "event";
      };
      if (event(p) && event(q) && p != q) found.push_back({f, k, p[1], q[1]});
    }
  }
  return found;
}

Json& graph_of(Records& r, const Pair& p) {
  return r[p.face.record]["leaf"]["faces"][p.face.face]["graph"];
}

/// The smallest box about both; does it meet no other event's?
bool widen(Json& events, std::size_t a, std::size_t b) {
  Json& box = events[a];
  for (const int k : {1, 3}) {
    box[k] = std::min(box[k].get<double>(), events[b][k].get<double>());
    box[k + 1] = std::max(box[k + 1].get<double>(), events[b][k + 1].get<double>());
  }
  for (std::size_t e = 0; e < events.size(); ++e)
    if (e != a && e != b && events[e][1] < box[2] && box[1] < events[e][2] &&
        events[e][3] < box[4] && box[3] < events[e][4])
      return false;
  return true;
}

/// Without event b; its ends are ends at a.
void merge(Json& graph, std::size_t a, std::size_t b) {
  graph["events"].erase(b);
  for (Json& arc : graph["arcs"])
    for (const int k : {0, 1})
      if (arc[k][0] == "event") {
        const std::size_t e = arc[k][1] == b ? a : arc[k][1].get<std::size_t>();
        arc[k][1] = e > b ? e - 1 : e;
      }
}

/// The counts of the complex with a vertex and an edge less on a face between two leaves.
void count_less(Records& r) {
  Json& cells = r[all(r, "complex")[0]]["complex"]["cells"];
  for (const auto& [name, by] : {std::pair{"events", 1}, {"arcs", 1}, {"spokes", 2}})
    cells[name] = cells[name].get<int>() - by;
}

TEST(VerifyClusters, TwoEventsThatAnArcJoins_MayBeStatedAsOne) {
  int verified = 0;
  for (const Certified& c :
       {Certified("lpocket rotated", shapes::rotate_rounded(shapes::lpocket(), 3)),
        Certified("plate 2", shapes::plate(2, 6)),
        Certified("voids 3 rotated", shapes::rotate_rounded(shapes::nested_voids(3), 2))}) {
    int tried = 0;
    for (const Pair& p : pairs(c.record)) {
      Records r = c.record;
      Json& graph = graph_of(r, p);
      if (!widen(graph["events"], p.a, p.b) || ++tried > 2) continue;
      const auto spoil = [&](const char* what, auto&& change) {
        Records bad = r;
        change(graph_of(bad, p));
        const verify::Answer answer = check(c, bad);
        EXPECT_EQ(answer.outcome, Outcome::kFalse) << c.name << ": " << what;
        EXPECT_TRUE(answer.statement.starts_with("diagram: ")) << what << ": " << answer.statement;
        EXPECT_EQ(answer.line, p.face.record + 1) << what;
      };
      // One box for both, and two events in it.
      spoil("both", [](const Json&) {});
      spoil("the arc between them, too", [&](Json& g) { merge(g, p.a, p.b); });
      const auto without = [&](Json& g, std::size_t arc) {
        g["arcs"].erase(arc);
        merge(g, p.a, p.b);
      };
      spoil("another arc less", [&](Json& g) {
        without(g, p.arc);
        g["arcs"].erase(g["arcs"].size() - 1);
      });
      spoil("a box that holds one of them only", [&](Json& g) {
        g["events"][p.a] =
            c.record[p.face.record]["leaf"]["faces"][p.face.face]["graph"]["events"][p.a];
        without(g, p.arc);
      });
      spoil("a rim", [&](Json& g) {
        g["events"][p.a][0] = "rim";
        without(g, p.arc);
      });
      without(graph, p.arc);
      // Of a diagram that the complex does not use nothing is counted.
      verify::Answer answer = check(c, r);
      if (answer.outcome != Outcome::kVerified) {
        EXPECT_TRUE(answer.statement.starts_with("the complex has another number of events: "))
            << c.name << answer.statement;
        count_less(r);
        answer = check(c, r);
        verified += answer.outcome == Outcome::kVerified;
      }
      EXPECT_EQ(answer.outcome, Outcome::kVerified) << c.name << ": " << answer.statement;
      EXPECT_EQ(answer.betti, c.betti) << c.name;
    }
  }
  EXPECT_GE(verified, 2);
}

TEST(VerifyClusters, TwoEventsThatNoArcJoins_AreTwo) {
  int tried = 0;
  for (const Certified& c :
       {Certified("plate 2", shapes::plate(2, 6)),
        Certified("voids 3 rotated", shapes::rotate_rounded(shapes::nested_voids(3), 2))})
    for (const FaceRef& f : faces_with_arcs(c.record)) {
      Records r = c.record;
      Json& graph = r[f.record]["leaf"]["faces"][f.face]["graph"];
      bool joined = graph["events"].size() != 2;
      for (const Json& arc : graph["arcs"]) joined |= arc[0][0] == "event" && arc[1][0] == "event";
      if (joined || tried == 4) continue;
      ++tried;
      widen(graph["events"], 0, 1);
      merge(graph, 0, 1);
      const verify::Answer answer = check(c, r);
      EXPECT_EQ(answer.outcome, Outcome::kFalse) << c.name;
      EXPECT_TRUE(answer.statement.starts_with("diagram: ")) << c.name << answer.statement;
    }
  EXPECT_GT(tried, 2);
}

/// The program shows four sheets about a vertex as one event; by exact algebra they are two.
TEST(SweepVerifyFixtures, ClusterThatExactAlgebraParts_Verified) {
  const PolygonMesh split = shapes::split_edges(shapes::plate(4, 6), 2);
  const Certified c("plate 4", shapes::rotate_rounded(shapes::triangulate_facets(split, 3), 1));
  const verify::Answer answer = check(c, c.record);
  EXPECT_EQ(answer.outcome, Outcome::kVerified) << answer.statement;
}

}  // namespace
}  // namespace blum::test
