#include "mutations.hpp"

#include <algorithm>
#include <map>

namespace blum::test {
namespace {

using Records = std::vector<Json>;

std::optional<std::size_t> any(const Records& r, const char* name, Random& random) {
  const auto found = all(r, name);
  if (found.empty()) return std::nullopt;
  return found[below(random, found.size())];
}

Json* any_face(Records& r, Random& random, std::size_t* record = nullptr) {
  const auto found = faces_with_arcs(r);
  if (found.empty()) return nullptr;
  const FaceRef f = found[below(random, found.size())];
  if (record != nullptr) *record = f.record;
  return &r[f.record]["leaf"]["faces"][f.face];
}

Json& any_arc(Json& face, Random& random) {
  Json& arcs = face["graph"]["arcs"];
  return arcs[below(random, arcs.size())];
}

/// A site on one side of an arc: it governs points beside the arc.
Json governor(Json& face, Random& random) { return any_arc(face, random)[2 + below(random, 2)]; }

/// A face with events, and one of them.
Json* any_event(Records& r, Random& random, std::size_t& event) {
  std::vector<Json*> found;
  for (const FaceRef& f : faces_with_arcs(r)) {
    Json& face = r[f.record]["leaf"]["faces"][f.face];
    if (!face["graph"]["events"].empty()) found.push_back(&face);
  }
  if (found.empty()) return nullptr;
  Json* const face = found[below(random, found.size())];
  event = below(random, (*face)["graph"]["events"].size());
  return face;
}

/// A face whose only part is a star that holds a tie: its direction matters.
Json* star_with_a_tie(Records& r, Random& random) {
  std::vector<Json*> found;
  for (const FaceRef& f : faces_with_arcs(r)) {
    Json& parts = r[f.record]["leaf"]["faces"][f.face]["parts"];
    if (parts.size() == 1 && (parts[0][0] == "star" || parts[0][0] == "feet"))
      found.push_back(&parts[0]);
  }
  return found.empty() ? nullptr : found[below(random, found.size())];
}

bool inside(const Point3& p, const Box3& b) {
  return p.x > b.lo.x && p.x < b.hi.x && p.y > b.lo.y && p.y < b.hi.y && p.z > b.lo.z &&
         p.z < b.hi.z;
}

void count_lines(Records& r) { r.back()["end"]["lines"] = r.size(); }

/// Adds the diagram on a face of a leaf, as that of an interface: true, and of no use.
Json& add_interface(Records& r, Random& random) {
  const auto boxes = boxes_of(r);
  const auto found = faces_with_arcs(r);
  const FaceRef f = found[below(random, found.size())];
  const Box3& b = boxes[f.record];
  const int axis = static_cast<int>(f.face) / 2, u = u_axis(axis), v = v_axis(axis);
  Json j = r[f.record]["leaf"]["faces"][f.face];
  j["rect"] = {axis, f.face % 2 == 0 ? b.lo[axis] : b.hi[axis], b.lo[u], b.hi[u], b.lo[v], b.hi[v]};
  const auto leaves = all(r, "leaf");
  j["leaf"] = std::ranges::find(leaves, f.record) - leaves.begin();
  const auto at = r.insert(r.end() - 3, Json{{"interface", j}});
  count_lines(r);
  return (*at)["interface"];
}

void drop(Json& list, const Json& item) {
  list.erase(std::remove(list.begin(), list.end(), item), list.end());
}

}  // namespace

const std::vector<Mutation>& false_mutations() {
  using C = Certified;
  static const std::vector<Mutation> list = {
      // No record can be spared: leaves tile, every diagram is asked for, counts are compared.
      {"drop a record",
       [](const C&, Records& r, Random& random) {
         r.erase(r.begin() + static_cast<long>(below(random, r.size() - 1)));
         count_lines(r);
         return true;
       }},
      {"a leaf or node twice",
       [](const C&, Records& r, Random& random) {
         const auto i = any(r, below(random, 2) == 0 ? "node" : "leaf", random);
         if (!i) return false;
         r.insert(r.begin() + static_cast<long>(*i), r[*i]);
         count_lines(r);
         return true;
       }},
      {"wrong number of lines",
       [](const C&, Records& r, Random& random) {
         r.back()["end"]["lines"] = r.size() + 1 + below(random, 5);
         return true;
       }},
      {"another format or version",
       [](const C&, Records& r, Random& random) {
         if (below(random, 2) == 0)
           r[0]["header"]["format"] = "blum-certificat";
         else
           r[0]["header"]["version"] = verify::kFormatVersion + 1 + below(random, 9);
         return true;
       }},
      {"of another model",
       [](const C&, Records& r, Random& random) {
         std::string print = r[0]["header"]["model"]["fingerprint"];
         char& c = print[below(random, print.size())];
         c = c == 'a' ? 'b' : 'a';
         r[0]["header"]["model"]["fingerprint"] = print;
         return true;
       }},
      // The solid reaches 1 along an axis of its frame, and the box must hold it.
      {"a box that does not hold the solid",
       [](const C& of, Records& r, Random& random) {
         const auto k = below(random, 3);
         double most = -2;
         for (const Point3& p : of.point) most = std::max(most, p[static_cast<int>(k)]);
         r[0]["header"]["box"]["high"][k] = most;
         return true;
       }},
      // A cut at or beyond the border of its cell: the leaves do not tile.
      {"move a cut out of its cell",
       [](const C&, Records& r, Random& random) {
         const auto boxes = boxes_of(r);
         const auto i = any(r, "node", random);
         if (!i) return false;
         Json& node = r[*i]["node"];
         const int axis = node["axis"];
         const double low = boxes[*i].lo[axis], high = boxes[*i].hi[axis];
         const std::array<double, 4> where = {low, high, low - 0.25, high + 0.25};
         node["cut"] = where[below(random, 4)];
         return true;
       }},
      {"move a cut out of its part",
       [](const C&, Records& r, Random& random) {
         std::vector<Json*> cuts;
         for (const FaceRef& f : faces_with_arcs(r))
           for (Json& p : r[f.record]["leaf"]["faces"][f.face]["parts"])
             if (p[0] == "u" || p[0] == "v") cuts.push_back(&p);
         if (cuts.empty()) return false;
         (*cuts[below(random, cuts.size())])[1] = below(random, 2) == 0 ? 10.0 : -10.0;
         return true;
       }},
      {"drop a part",
       [](const C&, Records& r, Random& random) {
         Json& parts = (*any_face(r, random))["parts"];
         parts.erase(below(random, parts.size()));
         return true;
       }},
      {"a part too many",
       [](const C&, Records& r, Random& random) {
         Json& parts = (*any_face(r, random))["parts"];
         parts.push_back(parts[below(random, parts.size())]);
         return true;
       }},
      {"merge all parts into one outside the solid",  // but arcs run through them
       [](const C&, Records& r, Random& random) {
         (*any_face(r, random))["parts"] = Json::array({Json::array({"outside"})});
         return true;
       }},
      // It governs points beside an arc, so it cannot be missing in all parts.
      {"drop a governor of the parts of a face",
       [](const C&, Records& r, Random& random) {
         Json& face = *any_face(r, random);
         const Json s = governor(face, random);
         for (Json& p : face["parts"])
           if (Json& claim = claim_of(p); claim.size() > 1 && claim[1].is_array())
             drop(claim[1], s);
         return true;
       }},
      // A tie decreases along the direction of its one side only.
      {"turn the directions of a part round",
       [](const C&, Records& r, Random& random) {
         Json* const part = star_with_a_tie(r, random);
         if (part == nullptr) return false;
         for (Json& d : (*part)[2]) {
           if (d.size() == 3) {
             d[1] = -d[1].get<double>();
             d[2] = -d[2].get<double>();
           } else {
             std::swap(d[1][0], d[1][1]);
           }
         }
         return true;
       }},
      {"drop the directions of a part",
       [](const C&, Records& r, Random& random) {
         Json* const part = star_with_a_tie(r, random);
         if (part == nullptr) return false;
         (*part)[2] = Json::array();
         return true;
       }},
      {"a direction of length zero",
       [](const C&, Records& r, Random& random) {
         Json* const part = star_with_a_tie(r, random);
         if (part == nullptr) return false;
         for (Json& d : (*part)[2]) d = Json::array({d[0], 0.0, 0.0});
         return true;
       }},
      // Two sites of an arc meet in two vertices at most, and the cone's must be in all sites.
      {"call a star a cone about a vertex of no site",
       [](const C& of, Records& r, Random& random) {
         Json* const part = star_with_a_tie(r, random);
         if (part == nullptr) return false;
         const auto v = below(random, of.point.size());
         const auto vertices = of.point.size(), edges = of.triangle.size() / 2 * 3;
         for (const Json& s : (*part)[1]) {
           const std::size_t site = s;
           if (site < vertices + edges) continue;
           const auto& t = of.triangle[site - vertices - edges];
           if (std::ranges::find(t, v) != t.end()) continue;
           *part = Json::array({"cone", (*part)[1], v});
           return true;
         }
         return false;
       }},
      {"exclude a nearest site of a leaf",
       [](const C&, Records& r, Random& random) {
         std::size_t record = 0;
         const Json s = governor(*any_face(r, random, &record), random);
         r[record]["leaf"]["excluded"].push_back(s);
         return true;
       }},
      // Every face governs points just inside it.
      {"exclude a face of the solid at the root",
       [](const C& of, Records& r, Random& random) {
         if (!r[1].contains("node")) return false;
         r[1]["node"]["excluded"].push_back(of.point.size() + of.triangle.size() / 2 * 3 +
                                            below(random, of.triangle.size()));
         return true;
       }},
      {"call a leaf that meets the axis outside",
       [](const C&, Records& r, Random& random) {
         std::size_t record = 0;
         (void)any_face(r, random, &record);
         r[record] = Json{{"leaf", {{"theorem", "outside"}}}};
         return true;
       }},
      {"call a leaf conical about a vertex that it does not hold",
       [](const C& of, Records& r, Random& random) {
         const auto boxes = boxes_of(r);
         std::size_t record = 0;
         (void)any_face(r, random, &record);
         const auto v = below(random, of.point.size());
         if (inside(of.point[v], boxes[record])) return false;
         r[record]["leaf"]["theorem"] = "conical";
         r[record]["leaf"]["vertex"] = v;
         return true;
       }},
      {"leave a leaf undecided",
       [](const C&, Records& r, Random& random) {
         r[*any(r, "leaf", random)]["leaf"] = {{"theorem", "undecided"}, {"reason", "depth"}};
         return true;
       }},
      {"an unknown theorem",
       [](const C&, Records& r, Random& random) {
         r[*any(r, "leaf", random)]["leaf"]["theorem"] = "D";
         return true;
       }},
      // The complex then speaks of a leaf that there is not.
      {"enlarge a leaf over its neighbour",
       [](const C&, Records& r, Random& random) {
         const auto leaves = all(r, "leaf");
         if (!r[leaves.back()]["leaf"].contains("faces")) return false;
         const auto& cones = r[r.size() - 3]["complex"]["cones"];
         if (cones.empty() || cones.back()[0] != leaves.size() - 1) return false;
         std::vector<std::size_t> pairs;
         for (const auto i : all(r, "node"))
           if (r[i + 1].contains("leaf") && r[i + 2].contains("leaf")) pairs.push_back(i);
         const auto i = pairs[below(random, pairs.size())];
         const auto keep = below(random, 2);
         r.erase(r.begin() + static_cast<long>(i + 2 - keep));
         r.erase(r.begin() + static_cast<long>(i));
         count_lines(r);
         return true;
       }},
      {"drop a face of a leaf",
       [](const C&, Records& r, Random& random) {
         std::size_t record = 0;
         (void)any_face(r, random, &record);
         r[record]["leaf"]["faces"].erase(below(random, 6));
         return true;
       }},
      {"drop an arc",
       [](const C&, Records& r, Random& random) {
         Json& arcs = (*any_face(r, random))["graph"]["arcs"];
         arcs.erase(below(random, arcs.size()));
         return true;
       }},
      {"an arc twice",
       [](const C&, Records& r, Random& random) {
         Json& face = *any_face(r, random);
         face["graph"]["arcs"].push_back(Json(any_arc(face, random)));
         return true;
       }},
      // Ends on sides are ties, and each is the end of one arc.
      {"move an end of an arc",
       [](const C&, Records& r, Random& random) {
         Json& end = any_arc(*any_face(r, random), random)[below(random, 2)];
         if (end[0] == "side") {
           const auto k = 1 + below(random, 2);
           end[k] = k == 1 ? (end[1].get<int>() + 1) % 4 : end[2].get<int>() + 1;
         } else if (end[0] == "edge") {
           end[1] = end[1] == 0 ? 1 : end[1].get<int>() - 1;
         } else {
           end = Json::array({"side", 0, 1000});
         }
         return true;
       }},
      // Sites excluded from the leaf govern none of its points.
      {"another site beside an arc",
       [](const C&, Records& r, Random& random) {
         std::size_t record = 0;
         Json& face = *any_face(r, random, &record);
         const Json& excluded = r[record]["leaf"]["excluded"];
         const Json& above = r[1].contains("node") ? r[1]["node"]["excluded"] : excluded;
         const Json& from = excluded.empty() ? above : excluded;
         if (from.empty()) return false;
         any_arc(face, random)[2 + below(random, 2)] = from[below(random, from.size())];
         return true;
       }},
      {"the same governor on both sides of an arc",  // an essential tie is between two
       [](const C&, Records& r, Random& random) {
         Json& arc = any_arc(*any_face(r, random), random);
         if (arc[0][0] != "side" || arc[1][0] != "side") return false;  // not beside a rim
         arc[2] = arc[3];
         return true;
       }},
      {"drop an event",
       [](const C&, Records& r, Random& random) {
         std::size_t event = 0;
         Json* const face = any_event(r, random, event);
         if (face == nullptr) return false;
         (*face)["graph"]["events"].erase(event);
         return true;
       }},
      {"move an event",
       [](const C&, Records& r, Random& random) {
         std::size_t event = 0;
         Json* const face = any_event(r, random, event);
         if (face == nullptr) return false;
         Json& e = (*face)["graph"]["events"][event];
         const auto k = 1 + 2 * below(random, 2);
         const double low = e[k], high = e[k + 1];
         const double by = (below(random, 2) == 0 ? 1 : -1) * (high - low);
         e[k] = low + by;
         e[k + 1] = high + by;
         return true;
       }},
      {"merge two events",
       [](const C&, Records& r, Random& random) {
         std::size_t event = 0;
         Json* const face = any_event(r, random, event);
         if (face == nullptr || (*face)["graph"]["events"].size() < 2) return false;
         const auto gone = (event + 1) % (*face)["graph"]["events"].size();
         for (Json& arc : (*face)["graph"]["arcs"])
           for (std::size_t k = 0; k < 2; ++k)
             if (arc[k][0] == "event" && arc[k][1] == gone) arc[k][1] = event;
         return true;
       }},
      {"call an event a rim, or a rim an event",
       [](const C&, Records& r, Random& random) {
         std::size_t event = 0;
         Json* const face = any_event(r, random, event);
         if (face == nullptr) return false;
         Json& e = (*face)["graph"]["events"][event];
         e[0] = e[0] == "rim" ? "event" : "rim";
         return true;
       }},
      {"a box that holds two events",
       [](const C&, Records& r, Random& random) {
         std::size_t event = 0;
         Json* const face = any_event(r, random, event);
         if (face == nullptr) return false;
         Json& events = (*face)["graph"]["events"];
         const Json kind = events[event][0];  // one of another kind may be in the box
         if (std::ranges::count_if(events, [&](const Json& e) { return e[0] == kind; }) < 2)
           return false;
         events[event] = Json::array({kind, -10.0, 10.0, -10.0, 10.0});
         return true;
       }},
      {"an interface of a leaf that it is not on",
       [](const C&, Records& r, Random& random) {
         Json& interface = add_interface(r, random);
         const auto boxes = boxes_of(r);
         const auto leaves = all(r, "leaf");
         const auto leaf = below(random, leaves.size());
         const int axis = interface["rect"][0];
         const Box3& b = boxes[leaves[leaf]];
         if (interface["rect"][1] >= b.lo[axis] && interface["rect"][1] <= b.hi[axis]) return false;
         interface["leaf"] = leaf;
         return true;
       }},
      {"an interface larger than the face of its leaf",
       [](const C&, Records& r, Random& random) {
         const auto k = 2 + below(random, 4);
         Json& x = add_interface(r, random)["rect"][k];
         x = x.get<double>() + (k % 2 == 0 ? -0x1p-20 : 0x1p-20);
         return true;
       }},
      {"drop an arc of an interface",
       [](const C&, Records& r, Random& random) {
         Json& arcs = add_interface(r, random)["graph"]["arcs"];
         arcs.erase(below(random, arcs.size()));
         return true;
       }},
      {"another number of cells",
       [](const C&, Records& r, Random& random) {
         Json& cells = r[r.size() - 3]["complex"]["cells"];
         auto it = cells.begin();
         std::advance(it, static_cast<long>(below(random, cells.size())));
         *it = it->get<int>() + 1 + static_cast<int>(below(random, 3));
         return true;
       }},
      {"another Euler characteristic",
       [](const C&, Records& r, Random& random) {
         Json& euler = r[r.size() - 3]["complex"]["euler"];
         euler = euler.get<int>() + (below(random, 2) == 0 ? 1 : -1);
         return true;
       }},
      {"other cones of a leaf",
       [](const C&, Records& r, Random& random) {
         Json& cones = r[r.size() - 3]["complex"]["cones"];
         const auto k = below(random, cones.size());
         if (below(random, 2) == 0)
           cones.erase(k);
         else
           cones[k][1] = cones[k][1].get<int>() + 1;
         return true;
       }},
      {"another Betti number",
       [](const C&, Records& r, Random& random) {
         Json& b = r[r.size() - 2]["betti"][below(random, 3)];
         b = b == 0 ? 1 : b.get<int>() + (below(random, 2) == 0 ? 1 : -1);
         return true;
       }},
  };
  return list;
}

const std::vector<Mutation>& true_mutations() {
  using C = Certified;
  static const std::vector<Mutation> list = {
      {"reorder excluded sites",
       [](const C&, Records& r, Random& random) {
         for (const char* name : {"node", "leaf"})
           for (const auto i : all(r, name))
             if (r[i][name].contains("excluded"))
               std::ranges::shuffle(r[i][name]["excluded"].get_ref<Json::array_t&>(), random);
         return true;
       }},
      {"reorder sites, arcs and their ends, directions",
       [](const C&, Records& r, Random& random) {
         for (const FaceRef& f : faces_with_arcs(r)) {
           Json& face = r[f.record]["leaf"]["faces"][f.face];
           std::ranges::shuffle(face["graph"]["arcs"].get_ref<Json::array_t&>(), random);
           for (Json& a : face["graph"]["arcs"]) {
             if (below(random, 2) == 0) std::swap(a[0], a[1]);
             if (below(random, 2) == 0) std::swap(a[2], a[3]);
           }
           for (Json& p : face["parts"])
             for (Json& list : claim_of(p))
               if (list.is_array()) std::ranges::shuffle(list.get_ref<Json::array_t&>(), random);
         }
         return true;
       }},
      {"longer directions",
       [](const C&, Records& r, Random& random) {
         Json* const part = star_with_a_tie(r, random);
         if (part == nullptr) return false;
         for (Json& d : (*part)[2])
           if (d.size() == 3) {
             d[1] = 8 * d[1].get<double>();
             d[2] = 8 * d[2].get<double>();
           }
         return true;
       }},
      {"renumber events",
       [](const C&, Records& r, Random& random) {
         std::size_t event = 0;
         Json* const face = any_event(r, random, event);
         if (face == nullptr) return false;
         Json& events = (*face)["graph"]["events"];
         const auto n = events.size();
         std::reverse(events.begin(), events.end());
         for (Json& a : (*face)["graph"]["arcs"])
           for (std::size_t k = 0; k < 2; ++k)
             if (a[k][0] == "event") a[k][1] = n - 1 - a[k][1].get<std::size_t>();
         return true;
       }},
      {"a wider box about the only event",
       [](const C&, Records& r, Random& random) {
         std::size_t event = 0;
         Json* const face = any_event(r, random, event);
         if (face == nullptr || (*face)["graph"]["events"].size() != 1) return false;
         Json& e = (*face)["graph"]["events"][0];
         e = Json::array({e[0], e[1].get<double>() - 0.5, e[2].get<double>() + 0.125,
                          e[3].get<double>() - 1.0, e[4].get<double>() + 7.0});
         return true;
       }},
      {"exclude at the leaves what was excluded at a node",
       [](const C&, Records& r, Random& random) {
         const auto node = any(r, "node", random);
         if (!node) return false;
         const Json excluded = r[*node]["node"]["excluded"];
         r[*node]["node"]["excluded"] = Json::array();
         std::size_t open = 1;  // cells below the node still to come
         for (std::size_t i = *node; open > 0; ++i) {
           --open;
           if (r[i].contains("node")) {
             open += 2;
           } else if (Json& leaf = r[i]["leaf"]; leaf.contains("excluded")) {
             for (const Json& s : excluded) {
               drop(leaf["excluded"], s);
               leaf["excluded"].push_back(s);
             }
           }
         }
         return true;
       }},
      {"a diagram more than is needed",
       [](const C&, Records& r, Random& random) {
         add_interface(r, random);
         return true;
       }},
      {"other options",
       [](const C&, Records& r, Random& random) {
         r[0]["header"]["options"]["seed"] = below(random, 100);
         return true;
       }},
      {"the version before, which had no pruning",
       [](const C&, Records& r, Random&) {
         r[0]["header"]["version"] = 2;
         return true;
       }},
      {"reorder the cones",
       [](const C&, Records& r, Random&) {
         Json& cones = r[r.size() - 3]["complex"]["cones"];
         std::reverse(cones.begin(), cones.end());
         return true;
       }},
  };
  return list;
}

void apply_all(const std::vector<Certified>& certificates, const std::vector<Mutation>& mutations,
               int times, bool meaning_kept) {
  std::map<std::string, int> applied;
  Random random(20);
  for (const Certified& c : certificates) {
    ASSERT_EQ(check(c, c.record).outcome, verify::Answer::Outcome::kVerified) << c.name;
    for (const Mutation& m : mutations)
      for (int k = 0; k < times; ++k) {
        auto records = c.record;
        bool possible = false;
        for (int attempt = 0; attempt < 20 && !possible; ++attempt) {
          records = c.record;
          possible = m.apply(c, records, random);
        }
        if (!possible) continue;
        ++applied[m.name];
        const verify::Answer answer = check(c, records);
        if (meaning_kept)
          EXPECT_EQ(answer.outcome, verify::Answer::Outcome::kVerified)
              << c.name << ", " << m.name << ", " << k << ": " << answer.statement;
        else
          EXPECT_NE(answer.outcome, verify::Answer::Outcome::kVerified)
              << c.name << ", " << m.name << ", " << k;
        if (answer.outcome != verify::Answer::Outcome::kVerified) {
          EXPECT_FALSE(answer.statement.empty()) << m.name;
        }
      }
  }
  int total = 0;
  for (const Mutation& m : mutations) {
    EXPECT_GT(applied[m.name], 0) << m.name << " was never possible";
    total += applied[m.name];
  }
  std::cout << total << " changes of " << mutations.size() << " kinds\n";
}

}  // namespace blum::test
