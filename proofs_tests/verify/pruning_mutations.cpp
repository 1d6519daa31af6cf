#include "pruning_mutations.hpp"

#include <algorithm>

namespace blum::test {
namespace {

using C = Certified;
using Records = std::vector<Json>;

/// A pair of cells: the record, and its place there.
struct PairRef {
  std::size_t record, at;
};
Json& pair_of(Records& r, const PairRef& p) { return r[p.record]["collapse"]["cells"][p.at]; }

std::vector<PairRef> pairs(const Records& r) {
  std::vector<PairRef> found;
  for (const auto i : all(r, "collapse"))
    for (std::size_t k = 0; k < r[i]["collapse"]["cells"].size(); ++k) found.push_back({i, k});
  return found;
}

PairRef any_pair(const Records& r, Random& random) {
  const auto found = pairs(r);
  return found[below(random, found.size())];
}

Json& any_collapse(Records& r, Random& random) {
  const auto found = all(r, "collapse");
  return r[found[below(random, found.size())]]["collapse"];
}

Json& pruned(Records& r) { return r[r.size() - 2]["pruned"]; }

/// The graphs stated, in the order by which arcs are named.
std::vector<Json*> graphs(Records& r) {
  std::vector<Json*> found;
  for (Json& record : r) {
    if (record.contains("interface")) found.push_back(&record["interface"]["graph"]);
    if (!record.contains("leaf") || !record["leaf"].contains("faces")) continue;
    for (Json& face : record["leaf"]["faces"]) found.push_back(&face["graph"]);
  }
  return found;
}

/// visit(name, at): every name that begins with "arc" or "end" at `at`.
template <class Visit>
void each_arc_name(Records& r, Visit visit) {
  for (const PairRef& p : pairs(r))
    for (Json& name : pair_of(r, p)) {
      const std::size_t at = name[0] == "cone" || name[0] == "apex" ? 2 : 0;
      if (name[at] == "arc" || name[at] == "end") visit(name, at);
    }
}

}  // namespace

const std::vector<Mutation>& false_prunings() {
  static const std::vector<Mutation> list = {
      // What is left is counted: a pair less is seen, if not before because a face is not free.
      {"drop a pair",
       [](const C&, Records& r, Random& random) {
         const PairRef p = any_pair(r, random);
         r[p.record]["collapse"]["cells"].erase(p.at);
         return true;
       }},
      {"drop a collapse",
       [](const C&, Records& r, Random& random) {
         const auto found = all(r, "collapse");
         r.erase(r.begin() + static_cast<long>(found[below(random, found.size())]));
         r.back()["end"]["lines"] = r.size();
         return true;
       }},
      {"a pair twice",
       [](const C&, Records& r, Random& random) {
         const PairRef p = any_pair(r, random);
         const Json copy = pair_of(r, p);
         any_collapse(r, random)["cells"].push_back(copy);
         return true;
       }},
      {"a cell twice in its pair",
       [](const C&, Records& r, Random& random) {
         Json& pair = pair_of(r, any_pair(r, random));
         const auto k = below(random, 2);
         pair[k] = Json(pair[1 - k]);
         return true;
       }},
      {"face and cell exchanged",
       [](const C&, Records& r, Random& random) {
         Json& pair = pair_of(r, any_pair(r, random));
         std::swap(pair[0], pair[1]);
         return true;
       }},
      // A free face has one coface, so another cell has not got it or is gone.
      {"another cell with a face",
       [](const C&, Records& r, Random& random) {
         const auto found = pairs(r);
         const PairRef a = found[below(random, found.size())],
                       b = found[below(random, found.size())];
         if (pair_of(r, a)[1] == pair_of(r, b)[1]) return false;
         pair_of(r, a)[1] = Json(pair_of(r, b)[1]);
         return true;
       }},
      // An arc with its triangle in one leaf, while the triangle over it in the other is still
      // there.
      {"a pair before the one that frees its face",
       [](const C&, Records& r, Random& random) {
         const auto found = pairs(r);
         std::vector<std::array<PairRef, 2>> wrong;
         for (const PairRef& second : found) {
           const Json& arc = pair_of(r, second)[0];
           if (arc[0] != "arc") continue;
           for (const PairRef& first : found) {
             const Json& cell = pair_of(r, first)[1];
             if (cell.size() == 5 && cell[3] == arc[1] && cell[4] == arc[2] &&
                 cell != pair_of(r, second)[1])
               wrong.push_back({first, second});
           }
         }
         if (wrong.empty()) return false;
         const auto [first, second] = wrong[below(random, wrong.size())];
         const Json pair = pair_of(r, second);
         r[second.record]["collapse"]["cells"].erase(second.at);
         Json& cells = r[first.record]["collapse"]["cells"];
         cells.insert(cells.begin() + static_cast<long>(first.at), pair);
         return true;
       }},
      {"the value below the largest cost",
       [](const C&, Records& r, Random& random) {
         Json& c = any_collapse(r, random);
         if (c["value"] == 0) return false;
         c["value"] = 0.5 * c["value"].get<double>();
         return true;
       }},
      {"the value above the largest cost",
       [](const C&, Records& r, Random& random) {
         Json& c = any_collapse(r, random);
         c["value"] = 0x1p-40 + c["value"].get<double>();
         return true;
       }},
      {"a cost above its value",
       [](const C&, Records& r, Random& random) {
         Json& c = any_collapse(r, random);
         c["cost"] = 0x1p-40 + c["value"].get<double>();
         return true;
       }},
      {"a cost that is no angle",
       [](const C&, Records& r, Random& random) {
         any_collapse(r, random)["cost"] = below(random, 2) == 0 ? -1.0 : 181.0;
         return true;
       }},
      {"collapses of different values exchanged",
       [](const C&, Records& r, Random& random) {
         const auto found = all(r, "collapse");
         const auto a = found[below(random, found.size())], b = found[below(random, found.size())];
         if (r[a]["collapse"]["value"] == r[b]["collapse"]["value"]) return false;
         std::swap(r[a], r[b]);
         return true;
       }},
      {"theta below a value",
       [](const C&, Records& r, Random& random) {
         pruned(r)["theta"] = Json(any_collapse(r, random)["value"]);
         return true;
       }},
      {"theta is no angle",
       [](const C&, Records& r, Random&) {
         pruned(r)["theta"] = 180.5;
         return true;
       }},
      {"another Betti number of what is left",
       [](const C&, Records& r, Random& random) {
         Json& b = pruned(r)["betti"][below(random, 3)];
         b = b.get<int>() + 1;
         return true;
       }},
      {"another Euler characteristic of what is left",
       [](const C&, Records& r, Random& random) {
         Json& euler = pruned(r)["euler"];
         euler = euler.get<int>() + (below(random, 2) == 0 ? 1 : -1);
         return true;
       }},
      {"another number of cells left",
       [](const C&, Records& r, Random& random) {
         Json& cells = pruned(r)["cells"];
         auto it = cells.begin();
         std::advance(it, static_cast<long>(below(random, cells.size())));
         *it = it->get<int>() + 1;
         return true;
       }},
      {"nothing is said of what is left",
       [](const C&, Records& r, Random&) {
         r.erase(r.end() - 2);
         r.back()["end"]["lines"] = r.size();
         return true;
       }},
      {"a name of a diagram that there is not",
       [](const C&, Records& r, Random& random) {
         std::size_t n = 0, pick = 0;
         each_arc_name(r, [&](Json&, std::size_t) { ++n; });
         pick = below(random, n);
         each_arc_name(r, [&](Json& name, std::size_t at) {
           if (pick-- == 0) name[at + 1] = 1'000'000;
         });
         return true;
       }},
      // An arc lies in two leaves, so two triangles are over it until one of them goes.
      {"a triangle inside of what stays",
       [](const C&, Records& r, Random& random) {
         const auto found = faces_with_arcs(r);
         const FaceRef f = found[below(random, found.size())];
         const auto leaves = all(r, "leaf");
         const std::size_t leaf =
             static_cast<std::size_t>(std::ranges::find(leaves, f.record) - leaves.begin());
         std::size_t diagram = f.face;  // as graphs() numbers them
         for (const auto i : leaves)
           if (i < f.record && r[i]["leaf"].contains("faces")) diagram += 6;
         const auto n = r[f.record]["leaf"]["faces"][f.face]["graph"]["arcs"].size();
         const Json arc = Json::array({"arc", diagram, below(random, n)});
         for (const PairRef& p : pairs(r))
           for (const Json& name : pair_of(r, p))
             if (name == arc || (name.size() == 5 && name[3] == arc[1] && name[4] == arc[2]))
               return false;
         Json& cells = r[all(r, "collapse").back()]["collapse"]["cells"];
         cells.push_back(Json::array({arc, Json::array({"cone", leaf, "arc", arc[1], arc[2]})}));
         return true;
       }},
      // Collapses came with version 3.
      {"the version before",
       [](const C&, Records& r, Random&) {
         r[0]["header"]["version"] = 2;
         return true;
       }},
  };
  return list;
}

const std::vector<Mutation>& true_prunings() {
  static const std::vector<Mutation> list = {
      {"a collapse in two records",
       [](const C&, Records& r, Random& random) {
         const PairRef p = any_pair(r, random);
         if (p.at == 0) return false;
         Json second = r[p.record];
         Json& a = r[p.record]["collapse"]["cells"];
         Json& b = second["collapse"]["cells"];
         a.erase(a.begin() + static_cast<long>(p.at), a.end());
         b.erase(b.begin(), b.begin() + static_cast<long>(p.at));
         r.insert(r.begin() + static_cast<long>(p.record) + 1, second);
         r.back()["end"]["lines"] = r.size();
         return true;
       }},
      {"arcs in another order, and their names with them",
       [](const C&, Records& r, Random&) {
         const auto all = graphs(r);
         for (Json* graph : all) std::ranges::reverse((*graph)["arcs"].get_ref<Json::array_t&>());
         each_arc_name(r, [&](Json& name, std::size_t at) {
           const auto n = (*all[name[at + 1].get<std::size_t>()])["arcs"].size();
           name[at + 2] = n - 1 - name[at + 2].get<std::size_t>();
         });
         return true;
       }},
      {"arcs the other way, and their ends with them",
       [](const C&, Records& r, Random&) {
         for (Json* graph : graphs(r))
           for (Json& arc : (*graph)["arcs"]) std::swap(arc[0], arc[1]);
         each_arc_name(r, [&](Json& name, std::size_t at) {
           if (name[at] == "end") name[at + 3] = 1 - name[at + 3].get<int>();
         });
         return true;
       }},
      {"an event named by another arc that ends there",
       [](const C&, Records& r, Random&) {
         const auto all = graphs(r);
         bool changed = false;
         each_arc_name(r, [&](Json& name, std::size_t at) {
           if (name[at] != "end") return;
           const Json& arcs = (*all[name[at + 1].get<std::size_t>()])["arcs"];
           const Json& end = arcs[name[at + 2].get<std::size_t>()][name[at + 3].get<std::size_t>()];
           if (end[0] != "event") return;
           for (std::size_t k = 0; k < arcs.size(); ++k)
             for (std::size_t j = 0; j < 2; ++j)
               if (arcs[k][j] == end) {
                 changed |= name[at + 2] != k || name[at + 3] != j;
                 name[at + 2] = k;
                 name[at + 3] = j;
               }
         });
         return changed;
       }},
      // It is a bound, and a larger one holds too.
      {"a larger cost of the last collapse",
       [](const C&, Records& r, Random&) {
         Json& c = r[all(r, "collapse").back()]["collapse"];
         const double between = 0.5 * (c["value"].get<double>() + pruned(r)["theta"].get<double>());
         if (!(between < pruned(r)["theta"])) return false;
         c["cost"] = c["value"] = between;
         return true;
       }},
  };
  return list;
}

}  // namespace blum::test
