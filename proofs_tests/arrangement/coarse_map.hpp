/// Compares face diagrams of two engines as labelled planar maps, where one of them may show a
/// cluster of events as one node and may label regions with supersets.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "blum/arrangement/face_diagram.hpp"

namespace blum::test {

/// The map without its nodes of degree 2.
class CoarseMap {
 public:
  using Pair = std::array<std::uint32_t, 2>;

  explicit CoarseMap(const FaceDiagram& d)
      : d_(d), arcs_of_(d.node.size()), parent_(d.node.size()) {
    std::iota(parent_.begin(), parent_.end(), 0u);
    for (std::uint32_t a = 0; a < d.arc.size(); ++a) {
      arcs_of_[d.arc[a].from].push_back(a);
      arcs_of_[d.arc[a].to].push_back(a);
      parent_[find(d.arc[a].from)] = find(d.arc[a].to);
    }
  }
  [[nodiscard]] std::uint32_t find(std::uint32_t n) const {
    while (parent_[n] != n) n = parent_[n];
    return n;
  }
  [[nodiscard]] std::size_t degree(std::uint32_t n) const { return arcs_of_[n].size(); }
  [[nodiscard]] bool suppressed(std::uint32_t n) const {
    return inner(n) && degree(n) == 2 && arcs_of_[n][0] != arcs_of_[n][1];
  }
  [[nodiscard]] bool inner(std::uint32_t n) const {
    return d_.node[n].kind == FaceNode::Kind::kEvent || d_.node[n].kind == FaceNode::Kind::kRim;
  }
  /// A rim: an inner node of degree 1.
  [[nodiscard]] bool rim(std::uint32_t n) const { return inner(n) && degree(n) == 1; }
  [[nodiscard]] bool event(std::uint32_t n) const { return inner(n) && degree(n) >= 3; }

  /// A name that both engines share: side and breakpoint, or boundary edge. Empty for inner nodes.
  [[nodiscard]] std::vector<std::uint32_t> name(std::uint32_t n) const {
    const FaceNode& node = d_.node[n];
    if (node.kind == FaceNode::Kind::kSide) return {0, node.side, node.breakpoint};
    if (node.kind == FaceNode::Kind::kConvexEdge) return {1, node.boundary_edge};
    return {};
  }

  /// Pairs of regions of the arcs after suppression (one for each chain).
  [[nodiscard]] std::multiset<Pair> chains(const std::vector<std::uint32_t>& region_name) const {
    std::vector<std::uint32_t> chain(d_.arc.size());
    std::iota(chain.begin(), chain.end(), 0u);
    const auto root = [&](std::uint32_t a) {
      while (chain[a] != a) a = chain[a];
      return a;
    };
    for (std::uint32_t n = 0; n < d_.node.size(); ++n)
      if (suppressed(n)) chain[root(arcs_of_[n][0])] = root(arcs_of_[n][1]);
    std::multiset<Pair> out;
    for (std::uint32_t a = 0; a < d_.arc.size(); ++a) {
      if (chain[a] != a) continue;
      Pair p{region_name[d_.arc[a].region[0]], region_name[d_.arc[a].region[1]]};
      std::sort(p.begin(), p.end());
      out.insert(p);
    }
    return out;
  }
  /// Regions around an inner node, once each.
  [[nodiscard]] std::set<std::uint32_t> around(
      std::uint32_t n, const std::vector<std::uint32_t>& region_name) const {
    std::set<std::uint32_t> out;
    for (const auto a : arcs_of_[n])
      for (const auto r : d_.arc[a].region) out.insert(region_name[r]);
    return out;
  }

 private:
  const FaceDiagram& d_;
  std::vector<std::vector<std::uint32_t>> arcs_of_;
  std::vector<std::uint32_t> parent_;
};

/// How much larger production's labels are.
struct LabelSizes {
  std::size_t production = 0, brute = 0;
};

/// What is wrong with one decided diagram by itself; empty if nothing.
inline std::string diagram_defect(const FaceDiagram& d) {
  std::ostringstream out;
  for (std::size_t s = 0; s < 4; ++s) {
    if (!d.side[s]) return "no side";
    if (d.side_region[s].size() != d.side[s]->interval.size() ||
        d.side[s]->interval.size() != d.side[s]->breakpoint.size() + 1)
      return "intervals of a side";
    for (std::size_t k = 0; k < d.side_region[s].size(); ++k) {
      const auto r = d.side_region[s][k];
      const auto& i = d.side[s]->interval[k];
      if ((r != FaceDiagram::kOutside) != i.inside) return "inside of an interval";
      if (!i.inside) continue;
      if (r >= d.region.size()) return "index of a region";
      const auto& l = d.region[r].labels;
      if (!std::binary_search(l.begin(), l.end(), i.witness)) return "witness is no label";
    }
  }
  std::vector<std::size_t> degree(d.node.size());
  std::set<std::vector<std::uint32_t>> names;
  std::size_t ties = 0, side_nodes = 0;
  for (std::size_t s = 0; s < 4; ++s)
    for (const Breakpoint& b : d.side[s]->breakpoint) ties += b.kind == Breakpoint::Kind::kTie;
  for (const FaceArc& a : d.arc) {
    if (a.from >= d.node.size() || a.to >= d.node.size()) return "end of an arc";
    ++degree[a.from];
    ++degree[a.to];
    for (const auto r : a.region) {
      if (r >= d.region.size()) return "region of an arc";
      if (d.region[r].piece != d.node[a.from].piece || d.region[r].piece != d.node[a.to].piece)
        return "piece of an arc's end";
    }
    const auto has = [&](std::size_t side, SiteId s) {
      const auto& l = d.region[a.region[side]].labels;
      return std::binary_search(l.begin(), l.end(), s);
    };
    if (!(has(0, a.left) && has(1, a.right)) && !(has(1, a.left) && has(0, a.right)))
      return "an arc's governors are no labels of its regions";
  }
  CoarseMap map(d);
  for (std::uint32_t n = 0; n < d.node.size(); ++n) {
    const FaceNode& node = d.node[n];
    if (node.piece >= d.piece.size()) return "piece of a node";
    if (!(node.u0 <= node.u1 && node.v0 <= node.v1)) return "box of a node";
    if (!std::is_sorted(node.governors.begin(), node.governors.end())) return "order of governors";
    if (!map.inner(n)) {
      if (degree[n] != 1) return "degree of a border node";
      if (!names.insert(map.name(n)).second) return "a border node twice";
    }
    side_nodes += node.kind == FaceNode::Kind::kSide;
  }
  if (ties != side_nodes) return "number of side nodes";
  for (const FaceRegion& r : d.region) {
    if (r.piece >= d.piece.size()) return "piece of a region";
    if (r.labels.empty() || !std::is_sorted(r.labels.begin(), r.labels.end())) return "labels";
  }
  for (const FaceTrace& t : d.trace)
    if (t.region >= d.region.size()) return "region of a trace";
  return {};
}

/// Empty if `production` shows the same map as the exact `brute`, else what differs. Both decided.
inline std::string coarse_map_difference(const FaceDiagram& p, const FaceDiagram& b,
                                         LabelSizes* sizes = nullptr) {
  std::ostringstream out;
  if (auto d = diagram_defect(p); !d.empty()) return "production alone: " + d;
  if (auto d = diagram_defect(b); !d.empty()) return "brute alone: " + d;
  constexpr auto kNone = 0xffffffffu;
  // Sides, and the region of production for each of brute.
  std::vector<std::uint32_t> to_p(b.region.size(), kNone), to_b(p.region.size(), kNone);
  const auto match = [&](std::uint32_t rp, std::uint32_t rb) {
    if (to_p[rb] == kNone && to_b[rp] == kNone) {
      to_p[rb] = rp;
      to_b[rp] = rb;
    }
    return to_p[rb] == rp && to_b[rp] == rb;
  };
  for (std::size_t s = 0; s < 4; ++s) {
    const SegmentDiagram &sp = *p.side[s], &sb = *b.side[s];
    if (sp.breakpoint.size() != sb.breakpoint.size()) {
      out << "side " << s << ": " << sp.breakpoint.size() << " breakpoints, not "
          << sb.breakpoint.size();
      return out.str();
    }
    for (std::size_t k = 0; k < sp.breakpoint.size(); ++k) {
      const Breakpoint &x = sp.breakpoint[k], &y = sb.breakpoint[k];
      if (x.kind != y.kind || (x.kind == Breakpoint::Kind::kBoundary && x.triangle != y.triangle))
        return "kind or triangle of a breakpoint";
      if (x.lo > y.hi || y.lo > x.hi) return "place of a breakpoint";
    }
    for (std::size_t k = 0; k < sp.interval.size(); ++k) {
      if (sp.interval[k].inside != sb.interval[k].inside) return "inside of an interval";
      if (sp.interval[k].inside && !match(p.side_region[s][k], b.side_region[s][k]))
        return "regions of the sides";
    }
  }
  if (p.region.size() != b.region.size()) {
    out << p.region.size() << " regions, not " << b.region.size();
    return out.str();
  }
  std::map<std::uint32_t, std::uint32_t> trace_p, trace_b;
  for (const FaceTrace& t : p.trace) trace_p[t.triangle] = t.region;
  for (const FaceTrace& t : b.trace) trace_b[t.triangle] = t.region;
  if (trace_p.size() != p.trace.size() || trace_b.size() != b.trace.size()) return "a trace twice";
  if (trace_p.size() != trace_b.size()) return "number of traces";
  for (const auto& [t, r] : trace_b) {
    const auto it = trace_p.find(t);
    if (it == trace_p.end()) return "a trace is missing";
    if (!match(it->second, r)) return "region of a trace";
  }
  std::multiset<std::uint32_t> point_p, point_b;
  for (const auto& t : p.trace_point) point_p.insert(t.boundary_edge);
  for (const auto& t : b.trace_point) point_b.insert(t.boundary_edge);
  if (point_p != point_b) return "trace points";
  // Regions that touch neither a side nor the boundary: by labels, any consistent choice.
  const auto subset = [&](std::uint32_t rp, std::uint32_t rb) {
    const auto &x = p.region[rp].labels, &y = b.region[rb].labels;
    return std::includes(x.begin(), x.end(), y.begin(), y.end());
  };
  std::vector<std::uint32_t> free_p, free_b;
  for (std::uint32_t r = 0; r < p.region.size(); ++r) {
    if (to_b[r] == kNone) free_p.push_back(r);
    if (to_p[r] == kNone) free_b.push_back(r);
  }
  do {
    bool fits = true;
    for (std::size_t k = 0; k < free_b.size() && fits; ++k) fits = subset(free_p[k], free_b[k]);
    if (!fits) continue;
    for (std::size_t k = 0; k < free_b.size(); ++k) match(free_p[k], free_b[k]);
    break;
  } while (free_b.size() < 6 && std::next_permutation(free_p.begin(), free_p.end()));
  std::map<std::uint32_t, std::uint32_t> piece_to_p, piece_to_b;
  for (std::uint32_t r = 0; r < b.region.size(); ++r) {
    if (to_p[r] == kNone) return "a region without a partner";
    if (!subset(to_p[r], r)) {
      out << "labels of a region: production";
      for (const SiteId s : p.region[to_p[r]].labels) out << ' ' << s.value;
      out << ", brute";
      for (const SiteId s : b.region[r].labels) out << ' ' << s.value;
      return out.str();
    }
    if (sizes != nullptr) {
      sizes->production += p.region[to_p[r]].labels.size();
      sizes->brute += b.region[r].labels.size();
    }
    const auto x = p.region[to_p[r]].piece, y = b.region[r].piece;
    if (piece_to_p.try_emplace(y, x).first->second != x ||
        piece_to_b.try_emplace(x, y).first->second != y)
      return "piece of a region";
    if (p.piece[x].boundary_circles != b.piece[y].boundary_circles) {
      out << p.piece[x].boundary_circles << " circles, not " << b.piece[y].boundary_circles;
      return out.str();
    }
  }
  if (p.piece.size() != b.piece.size()) return "number of pieces";

  // Graphs: every component by its terminals (sides, convex edges, rims).
  const CoarseMap mp(p), mb(b);
  std::vector<std::uint32_t> rims_p, rims_b;
  for (std::uint32_t n = 0; n < p.node.size(); ++n)
    if (mp.rim(n)) rims_p.push_back(n);
  for (std::uint32_t n = 0; n < b.node.size(); ++n)
    if (mb.rim(n)) rims_b.push_back(n);
  if (rims_p.size() != rims_b.size()) {
    out << rims_p.size() << " rims, not " << rims_b.size();
    return out.str();
  }
  const auto meet = [](const FaceNode& x, const FaceNode& y) {
    return x.u0 <= y.u1 && y.u0 <= x.u1 && x.v0 <= y.v1 && y.v0 <= x.v1;
  };
  // Rims that production knows in one box only have one name.
  const auto same_box = [](const FaceNode& x, const FaceNode& y) {
    return x.u0 == y.u0 && x.u1 == y.u1 && x.v0 == y.v0 && x.v1 == y.v1;
  };
  std::map<std::uint32_t, std::uint32_t> rim_name_p, rim_name_b;
  for (std::uint32_t k = 0; k < rims_b.size(); ++k) {
    const auto n = std::ranges::find_if(rims_p, [&](auto i) {
      return !rim_name_p.contains(i) && meet(p.node[i], b.node[rims_b[k]]);
    });
    if (n == rims_p.end()) return "place of a rim";
    std::uint32_t name = k;
    for (const auto& [other, known] : rim_name_p)
      if (same_box(p.node[other], p.node[*n])) name = known;
    rim_name_p[*n] = rim_name_b[rims_b[k]] = name;
  }
  struct Component {
    std::set<std::vector<std::uint32_t>> terminal;
    long euler = 0;
    auto operator<=>(const Component&) const = default;
  };
  const auto components = [](const FaceDiagram& d, const CoarseMap& m, const auto& rim_name) {
    std::map<std::uint32_t, Component> part;
    for (std::uint32_t n = 0; n < d.node.size(); ++n) {
      Component& c = part[m.find(n)];
      ++c.euler;
      if (!m.inner(n)) c.terminal.insert(m.name(n));
      if (const auto it = rim_name.find(n); it != rim_name.end())
        c.terminal.insert({2, it->second});
    }
    for (const FaceArc& a : d.arc) --part[m.find(a.from)].euler;
    std::multiset<Component> all;
    for (const auto& [root, c] : part) all.insert(c);
    return all;
  };
  const auto cp = components(p, mp, rim_name_p), cb = components(b, mb, rim_name_b);
  if (cp != cb) {
    out << "components of G: production";
    for (const auto& c : cp) out << ' ' << c.terminal.size() << '/' << c.euler;
    out << ", brute";
    for (const auto& c : cb) out << ' ' << c.terminal.size() << '/' << c.euler;
    return out.str();
  }
  // Adjacencies, named by brute's regions.
  std::vector<std::uint32_t> own(b.region.size());
  std::iota(own.begin(), own.end(), 0u);
  const auto chains_p = mp.chains(to_b), chains_b = mb.chains(own);
  if (!std::includes(chains_b.begin(), chains_b.end(), chains_p.begin(), chains_p.end()))
    return "regions beside the arcs";
  // Events: each of brute's lies in one of production's; one that claims to be exact holds one.
  bool clusters = false;
  std::multiset<std::set<std::uint32_t>> around_p, around_b;
  for (std::uint32_t n = 0; n < p.node.size(); ++n) {
    if (!mp.event(n)) continue;
    clusters |= !p.node[n].exact;
    around_p.insert(mp.around(n, to_b));
  }
  for (std::uint32_t n = 0; n < b.node.size(); ++n) {
    if (!mb.event(n)) continue;
    around_b.insert(mb.around(n, own));
    bool found = false;
    for (std::uint32_t k = 0; k < p.node.size() && !found; ++k) {
      if (!mp.event(k) || !meet(p.node[k], b.node[n])) continue;
      const auto x = mp.around(k, to_b), y = mb.around(n, own);
      found = std::includes(x.begin(), x.end(), y.begin(), y.end());
    }
    if (!found) return "an event is in no event of production";
  }
  if (!clusters && (chains_p != chains_b || around_p != around_b))
    return "no cluster, yet arcs or events differ";
  return {};
}

/// The part of a diagram that must not depend on numbering, seed, scale or candidates: a canonical
/// text of the coarse map. Regions are named by their first appearance along the sides and traces;
/// `trace_name` and `edge_name` name boundary triangles and edges.
template <class TraceName, class EdgeName>
std::string coarse_signature(const FaceDiagram& d, TraceName&& trace_name, EdgeName&& edge_name) {
  std::ostringstream out;
  out << "status " << static_cast<int>(d.status) << '\n';
  if (d.status != FaceStatus::kDecided) return out.str();
  constexpr auto kNone = 0xffffffffu;
  std::vector<std::uint32_t> name(d.region.size(), kNone);
  std::uint32_t next = 0;
  const auto named = [&](std::uint32_t r) {
    if (r == FaceDiagram::kOutside) return kNone;
    if (name[r] == kNone) name[r] = next++;
    return name[r];
  };
  for (std::size_t s = 0; s < 4; ++s) {
    out << "side";
    for (const auto r : d.side_region[s]) out << ' ' << static_cast<int>(named(r));
    out << '\n';
  }
  std::vector<std::pair<std::string, std::uint32_t>> trace;
  for (const FaceTrace& t : d.trace) trace.emplace_back(trace_name(t.triangle), t.region);
  std::sort(trace.begin(), trace.end());
  for (const auto& [t, r] : trace) out << "trace " << t << ' ' << named(r) << '\n';
  const std::size_t outer = next;
  for (std::uint32_t r = 0; r < name.size(); ++r) named(r);
  std::set<std::string> points;
  for (const FaceTracePoint& t : d.trace_point) points.insert(edge_name(t.boundary_edge));
  for (const auto& t : points) out << "point " << t << '\n';
  out << "regions " << name.size() << " outer " << outer << '\n';
  std::multiset<std::string> pieces;
  for (std::uint32_t k = 0; k < d.piece.size(); ++k) {
    std::set<std::uint32_t> in;
    for (std::uint32_t r = 0; r < name.size(); ++r)
      if (d.region[r].piece == k && name[r] < outer) in.insert(name[r]);
    std::ostringstream line;
    line << "piece " << d.piece[k].boundary_circles << ':';
    for (const auto r : in) line << ' ' << r;
    pieces.insert(line.str());
  }
  for (const auto& l : pieces) out << l << '\n';
  const CoarseMap map(d);
  std::map<std::uint32_t, std::set<std::string>> terminal;
  std::map<std::uint32_t, long> euler;
  std::map<std::uint32_t, int> rims;
  for (std::uint32_t n = 0; n < d.node.size(); ++n) {
    ++euler[map.find(n)];
    const FaceNode& node = d.node[n];
    if (node.kind == FaceNode::Kind::kSide)
      terminal[map.find(n)].insert("s" + std::to_string(node.side) + "." +
                                   std::to_string(node.breakpoint));
    if (node.kind == FaceNode::Kind::kConvexEdge)
      terminal[map.find(n)].insert("e" + edge_name(node.boundary_edge));
    rims[map.find(n)] += map.rim(n) ? 1 : 0;
  }
  for (const FaceArc& a : d.arc) --euler[map.find(a.from)];
  std::multiset<std::string> parts;
  for (const auto& [root, e] : euler) {
    std::string line = "component " + std::to_string(e) + " rims " + std::to_string(rims[root]);
    for (const auto& t : terminal[root]) line += " " + t;
    parts.insert(line);
  }
  for (const auto& l : parts) out << l << '\n';
  return out.str();
}

}  // namespace blum::test
