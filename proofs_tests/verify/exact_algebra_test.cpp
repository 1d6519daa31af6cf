// Diagrams that the checker finds by exact algebra: it takes nothing that is false about them.
#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "cell.hpp"
#include "certificates.hpp"

namespace blum::test {
namespace {

using Outcome = verify::Answer::Outcome;
using Records = std::vector<Json>;

/// With collinear vertices on its edges, triangulated and turned: the hardest.
Certified variant(const std::string& name, const PolygonMesh& mesh, std::uint64_t s,
                  std::uint64_t r) {
  const PolygonMesh split = shapes::split_edges(mesh, (r + s) % 3 + 1);
  return {name + " " + std::to_string(s) + " " + std::to_string(r),
          shapes::rotate_rounded(shapes::triangulate_facets(split, s), r)};
}

const std::vector<Certified>& variants() {
  static std::vector<Certified> all;
  if (!all.empty()) return all;
  all.push_back(variant("lpocket", shapes::lpocket(), 1, 1));
  all.push_back(variant("lpocket", shapes::lpocket(), 3, 1));
  return all;
}

/// A part that the certificate calls exact, on a face of a leaf.
struct ExactPart {
  std::size_t record, face, part;
  Rect rect;
};

std::vector<ExactPart> exact_parts(const Records& r) {
  std::vector<ExactPart> found;
  const std::vector<Box3> boxes = boxes_of(r);
  for (const auto i : all(r, "leaf")) {
    if (!r[i]["leaf"].contains("faces")) continue;
    for (std::size_t f = 0; f < 6; ++f) {
      std::vector<Rect> open{verify::face_of(boxes[i], f)};
      const Json& parts = r[i]["leaf"]["faces"][f]["parts"];
      for (std::size_t p = 0; p < parts.size(); ++p) {
        const Rect rect = open.back();
        open.pop_back();
        const bool along_u = parts[p][0] == "u";
        if (along_u || parts[p][0] == "v") {
          Rect low = rect, high = rect;
          (along_u ? low.u1 : low.v1) = (along_u ? high.u0 : high.v0) = parts[p][1];
          open.push_back(high);
          open.push_back(low);
        } else if (parts[p][0] == "exact") {
          found.push_back({i, f, p, rect});
        }
      }
    }
  }
  return found;
}

Json& face_of(Records& r, const ExactPart& p) { return r[p.record]["leaf"]["faces"][p.face]; }

/// Without any proposal: all of them by exact algebra.
Records without_proposals(Records r) {
  for (const ExactPart& p : exact_parts(r)) {
    Json& claim = face_of(r, p)["parts"][p.part][1];
    claim = {"star", claim[1], Json::array()};
  }
  return r;
}

TEST(VerifyExactAlgebra, VariantsWithSplitEdges_Verified) {
  for (const Certified& c : variants()) {
    const verify::Answer answer = check(c, c.record), again = check(c, without_proposals(c.record));
    EXPECT_EQ(answer.outcome, Outcome::kVerified) << c.name << answer.statement;
    EXPECT_EQ(answer.betti, c.betti) << c.name;
    EXPECT_GT(answer.exact_parts, 0u) << c.name;
    EXPECT_EQ(again.outcome, Outcome::kVerified) << c.name << again.statement;
    EXPECT_GE(again.exact_parts, answer.exact_parts) << c.name;
  }
}

void drop_event(Json& graph, std::size_t event) {
  graph["events"].erase(event);
  for (Json& a : graph["arcs"])
    for (int k : {0, 1})
      if (a[k][0] == "event" && a[k][1].get<std::size_t>() > event)
        a[k][1] = a[k][1].get<std::size_t>() - 1;
}

bool ends_at(const Json& arc, std::size_t event) {
  const Json end = {"event", event};
  return arc[0] == end || arc[1] == end;
}

/// Some change of a graph about one of its events, which is in an exact part; false: there is no
/// such change.
struct Change {
  std::string name, reason;
  std::function<bool(Json& graph, std::size_t event)> apply;
};

const std::vector<Change>& changes() {
  static const std::vector<Change> list = {
      {"drop the event and its arcs", "diagram: an event is missing",
       [](Json& graph, std::size_t e) {
         auto& arcs = graph["arcs"].get_ref<Json::array_t&>();
         std::erase_if(arcs, [&](const Json& a) { return ends_at(a, e); });
         drop_event(graph, e);
         return true;
       }},
      {"merge it with another event", "diagram: an event is missing",
       [](Json& graph, std::size_t e) {
         if (graph["events"].size() < 2) return false;
         const std::size_t other = e == 0 ? 1 : 0;
         for (Json& a : graph["arcs"])
           for (int k : {0, 1})
             if (a[k] == Json{"event", e}) a[k][1] = other;
         drop_event(graph, e);
         return true;
       }},
      {"an event twice", "diagram: a",
       [](Json& graph, std::size_t e) {
         graph["events"].push_back(graph["events"][e]);
         return true;
       }},
      {"move its box", "diagram: a",
       [](Json& graph, std::size_t e) {
         Json& box = graph["events"][e];
         const double width = box[2].get<double>() - box[1].get<double>();
         for (int k : {1, 2}) box[k] = box[k].get<double>() + 2 * width;
         return true;
       }},
      {"another kind", "diagram: a",
       [](Json& graph, std::size_t e) {
         Json& kind = graph["events"][e][0];
         kind = kind == "rim" ? "event" : "rim";
         return true;
       }},
      {"drop an arc", "diagram: another number of arcs",
       [](Json& graph, std::size_t e) {
         auto& arcs = graph["arcs"].get_ref<Json::array_t&>();
         arcs.erase(std::ranges::find_if(arcs, [&](const Json& a) { return ends_at(a, e); }));
         return true;
       }},
      {"the same governor on both sides of an arc", "diagram: an arc is missing",
       [](Json& graph, std::size_t e) {
         if (graph["events"][e][0] == "rim") return false;  // it may be
         for (Json& a : graph["arcs"])
           if (ends_at(a, e)) a[3] = a[2];
         return true;
       }},
      {"a pair of sites with a vertex that governs nothing", "diagram: an arc is missing",
       [](Json& graph, std::size_t e) {
         for (Json& a : graph["arcs"])
           if (ends_at(a, e)) a[2] = 0;
         return true;
       }},
      {"an arc to another end", "diagram: an arc is missing",
       [](Json& graph, std::size_t e) {
         for (Json& a : graph["arcs"])
           for (int k : {0, 1})
             if (ends_at(a, e) && a[k][0] == "side") {
               a[k][2] = a[k][2].get<std::size_t>() + 1;
               return true;
             }
         return false;
       }},
  };
  return list;
}

TEST(VerifyExactAlgebra, ChangedDiagrams_RejectedForTheRightReason) {
  std::map<std::string, int> applied;
  for (const Certified& c : variants()) {
    const Records whole = without_proposals(c.record);
    int events = 0;
    for (const ExactPart& p : exact_parts(whole)) {
      Records copy = whole;
      const Json& listed = face_of(copy, p)["graph"]["events"];
      std::size_t e = 0;
      const auto here = [&](const Json& x) {
        return x[1] >= p.rect.u0 && x[2] <= p.rect.u1 && x[3] >= p.rect.v0 && x[4] <= p.rect.v1;
      };
      while (e < listed.size() && !here(listed[e])) ++e;
      if (e == listed.size() || ++events > 1) continue;
      for (const Change& change : changes()) {
        Records r = whole;
        if (!change.apply(face_of(r, p)["graph"], e)) continue;
        ++applied[change.name];
        const verify::Answer answer = check(c, r);
        EXPECT_EQ(answer.outcome, Outcome::kFalse) << c.name << ": " << change.name;
        EXPECT_TRUE(answer.statement.starts_with(change.reason))
            << c.name << ": " << change.name << ": " << answer.statement;
        EXPECT_EQ(answer.line, p.record + 1) << c.name << ": " << change.name;
      }
    }
    EXPECT_GT(events, 0) << c.name;
  }
  for (const Change& change : changes()) EXPECT_GT(applied[change.name], 0) << change.name;
}

// Governors are found here at points of the part, from the mesh alone.
TEST(VerifyExactAlgebra, AGovernorThatIsNotListed_Noticed) {
  std::size_t dropped = 0;
  for (const Certified& c : variants()) {
    const verify::Shape shape(c.point, c.triangle);
    const verify::Sites sites(shape);
    const Records whole = without_proposals(c.record);
    std::size_t parts = 0;
    for (const ExactPart& p : exact_parts(whole)) {
      std::set<verify::Site> governs;
      for (int k = 0; k < 25; ++k) {
        const Rect& q = p.rect;
        const double u = q.u0 + (k % 5 + 0.5) / 5 * (q.u1 - q.u0),
                     v = q.v0 + (k / 5 + 0.5) / 5 * (q.v1 - q.v0);
        const Point3 x = point_on(q.axis, q.level, u, v);
        if (verify::is_inside(shape, x) != true) continue;
        const auto found = sites.governors(x, shape.candidates());
        if (found.size() == 1) governs.insert(found[0]);
      }
      if (governs.size() < 2 || ++parts > 1) continue;
      for (const auto s : governs) {
        Records r = whole;
        auto& listed = face_of(r, p)["parts"][p.part][1][1].get_ref<Json::array_t&>();
        ASSERT_EQ(std::erase(listed, Json(s)), 1u) << c.name;
        const verify::Answer answer = check(c, r);
        EXPECT_EQ(answer.outcome, Outcome::kFalse) << c.name << " without " << s;
        EXPECT_NE(answer.statement.find("is missing"), std::string::npos) << answer.statement;
        EXPECT_EQ(answer.line, p.record + 1) << answer.statement;
        ++dropped;
      }
    }
  }
  EXPECT_GT(dropped, 3u);
}

}  // namespace
}  // namespace blum::test
