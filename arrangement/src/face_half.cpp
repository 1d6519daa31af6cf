// The diagram of half a rectangle from that of the whole, where counting tells how the cut parts it
// (docs/proofs.md, "Halves").
#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "face_engine.hpp"

namespace blum {
namespace {

constexpr auto kNone = Breakpoint::kNone;

/// Where a rectangle lies in one that it is a half of.
struct Half {
  std::uint8_t cut = 0;              ///< its side that is not on the whole's border
  bool high = false;                 ///< the half of greater coordinates
  std::array<std::uint8_t, 2> ends;  ///< the sides that meet the cut, in the order along it
  double at = 0;                     ///< the cut's coordinate
  bool along_u = false;              ///< that coordinate is u

  static std::optional<Half> of(const Rect& half, const Rect& whole) {
    if (half.axis != whole.axis || half.level != whole.level) return std::nullopt;
    const std::array<std::uint8_t, 4> side = {kLowU, kHighU, kLowV, kHighV};
    const std::array<double, 4> own = {half.u0, half.u1, half.v0, half.v1},
                                other = {whole.u0, whole.u1, whole.v0, whole.v1};
    std::optional<Half> found;
    for (std::size_t k = 0; k < 4; ++k) {
      if (own[k] == other[k]) continue;
      if (found) return std::nullopt;
      const bool low = k % 2 == 0, u = k < 2;
      found = Half{side[k], low,
                   u ? std::array<std::uint8_t, 2>{kLowV, kHighV}
                     : std::array<std::uint8_t, 2>{kLowU, kHighU},
                   own[k], u};
      if (low ? !(own[k] > other[k]) : !(own[k] < other[k])) return std::nullopt;
    }
    return found;
  }
};

}  // namespace

/// All that is known of the half before anything is recorded. Nodes are numbered as in the whole,
/// and then by the ties of the cut; regions as in the whole.
class FaceEngine::HalfMap {
 public:
  HalfMap(FaceEngine& engine, const Box& root, const Half& half)
      : engine_(engine), whole_(*engine.problem_.whole), root_(root), half_(half) {}

  [[nodiscard]] bool find() {
    border_ = engine_.border_of(root_);
    if (!border_.loop.empty()) return false;
    for (const FacePiece& p : whole_.piece)
      if (p.boundary_circles != 1) return false;
    return find_regions_of_sides() && find_nodes() && walk_cut() && place_nodes() && find_graph() &&
           find_circles() && find_sides_of_arcs();
  }
  void record();

 private:
  struct Arc {
    std::uint32_t from, to;  ///< local nodes
    const FaceArc* of;       ///< that it is part of
    /// A run on each side, or kNone for the region that it shares with no run.
    std::array<std::uint32_t, 2> run{kNone, kNone};
  };
  /// A node that may stand for a tree through which the cut passes, and the regions around it.
  struct Tree {
    std::uint32_t node;
    std::vector<std::uint32_t> around;
  };
  struct Run {
    std::uint32_t region;
    std::vector<std::uint32_t> elements, traces;
  };

  /// Of side s of the whole, those on the half begin at this number.
  [[nodiscard]] std::size_t first_on(std::uint8_t s) const {
    const auto n = whole_.side[s]->breakpoint.size(), own = root_.side[s].brk.size();
    return half_.high && s != opposite() ? n - own : 0;
  }
  [[nodiscard]] std::uint8_t opposite() const {
    return static_cast<std::uint8_t>((half_.cut + 2) % 4);
  }
  [[nodiscard]] std::uint32_t region_of_trace(std::uint32_t triangle) const {
    for (const FaceTrace& t : whole_.trace)
      if (t.triangle == triangle) return t.region;
    return kNone;
  }
  [[nodiscard]] bool may_govern(SiteId s, std::uint32_t region) const {
    return std::ranges::binary_search(whole_.region[region].labels, s);
  }
  [[nodiscard]] bool in(std::uint32_t node) const { return where_[node] == Where::kIn; }
  /// Does the arc have one end in each half? False too if that is not known of its ends.
  [[nodiscard]] bool joins_halves(const FaceArc& a) const {
    return where_[a.from] != Where::kUnknown && where_[a.to] != Where::kUnknown &&
           where_[a.from] != where_[a.to];
  }
  /// Perhaps by an arc within the tree, of which the whole's diagram does not tell?
  [[nodiscard]] bool may_cross(const Tree& tree, std::uint32_t region, SiteId above) const;
  [[nodiscard]] std::optional<std::uint32_t> region_at_end(std::size_t k) const;
  /// The arc by which a way along the cut leaves the region for one that `above` may govern.
  [[nodiscard]] std::optional<std::uint32_t> arc_crossed(std::uint32_t region, SiteId above,
                                                         bool once_each) const;
  [[nodiscard]] bool find_regions_of_sides();
  [[nodiscard]] bool find_nodes();
  [[nodiscard]] bool walk_cut();
  [[nodiscard]] bool place_nodes();
  [[nodiscard]] bool find_graph();
  [[nodiscard]] bool find_circles();
  [[nodiscard]] bool find_sides_of_arcs();

  FaceEngine& engine_;
  const FaceDiagram& whole_;
  const Box& root_;
  const Half half_;
  Border border_;
  std::map<std::uint32_t, std::uint32_t> region_of_element_;
  std::map<std::uint32_t, std::uint32_t> local_;  // engine's node -> local
  std::vector<std::uint32_t> id_;                 // local node -> engine's, kNone for inner ones
  enum class Where : std::uint8_t { kIn, kOut, kUnknown };
  std::vector<Where> where_;  // of the whole's nodes
  std::vector<Tree> tree_;
  std::vector<std::uint32_t> crossed_;  // arc of the whole -> local node on the cut
  std::vector<Arc> arcs_;
  UnionFind graph_;                                            // over local nodes
  std::vector<Run> runs_;                                      // of all circles
  std::vector<std::uint32_t> circle_;                          // first run of each circle
  std::map<std::uint32_t, std::array<std::uint32_t, 2>> end_;  // local node -> runs beside it
  UnionFind same_;                                             // over runs: parts of one region
};

bool FaceEngine::HalfMap::find_regions_of_sides() {
  for (std::uint8_t s = 0; s < 4; ++s) {
    if (s == half_.cut) continue;
    const auto n = whole_.side[s]->breakpoint.size(), own = root_.side[s].brk.size();
    if (own > n || (s == opposite() && own != n)) return false;
    for (std::size_t k = 0; k < root_.side[s].piece.size(); ++k) {
      const Piece1& p = root_.side[s].piece[k];
      const auto r = whole_.side_region[s][k + first_on(s)];
      if (p.inside != (r != FaceDiagram::kOutside)) return false;
      if (p.inside) region_of_element_[p.element] = r;
    }
  }
  return true;
}

bool FaceEngine::HalfMap::find_nodes() {
  where_.assign(whole_.node.size(), Where::kOut);
  std::vector<std::uint32_t> degree(whole_.node.size(), 0);
  std::vector<std::vector<std::uint32_t>> around(whole_.node.size());
  for (const FaceArc& a : whole_.arc)
    for (const auto n : {a.from, a.to}) {
      ++degree[n];
      for (const auto r : a.region)
        if (std::ranges::find(around[n], r) == around[n].end()) around[n].push_back(r);
    }
  id_.assign(whole_.node.size(), kNone);
  for (std::uint32_t n = 0; n < whole_.node.size(); ++n) {
    const FaceNode& node = whole_.node[n];
    switch (node.kind) {
      case FaceNode::Kind::kSide: {
        if (node.side == half_.cut) break;
        const auto first = first_on(node.side);
        const auto& brk = root_.side[node.side].brk;
        if (node.breakpoint < first || node.breakpoint - first >= brk.size()) break;
        const Break& b = brk[node.breakpoint - first];
        if (b.point.kind != Breakpoint::Kind::kTie) return false;
        where_[n] = Where::kIn;
        id_[n] = b.id;
        local_[b.id] = n;
        break;
      }
      case FaceNode::Kind::kConvexEdge:
        if (std::ranges::any_of(engine_.trace_point_, [&](const TracePoint& p) {
              return p.edge == node.boundary_edge && engine_.in_box(p, root_);
            }))
          where_[n] = Where::kIn;
        break;
      case FaceNode::Kind::kEvent:
      case FaceNode::Kind::kRim: {
        const double lo = half_.along_u ? node.u0 : node.v0, hi = half_.along_u ? node.u1 : node.v1;
        if (lo > half_.at || hi < half_.at) {
          if ((lo > half_.at) == half_.high) where_[n] = Where::kIn;
          break;
        }
        where_[n] = Where::kUnknown;
        if (node.kind == FaceNode::Kind::kRim) {
          if (degree[n] != 1) return false;
          break;
        }
        if (degree[n] == 3 && node.exact) break;
        // It may stand for a tree of several events.
        if (around[n].size() != degree[n]) return false;
        tree_.push_back({n, around[n]});
        break;
      }
    }
  }
  return true;
}

bool FaceEngine::HalfMap::may_cross(const Tree& tree, std::uint32_t region, SiteId above) const {
  if (std::ranges::find(tree.around, region) == tree.around.end()) return false;
  return std::ranges::any_of(tree.around, [&](auto r) {
    return r != region && may_govern(above, r) &&
           std::ranges::none_of(whole_.arc, [&](const FaceArc& a) {
             return (a.from == tree.node || a.to == tree.node) &&
                    (a.region == std::array{r, region} || a.region == std::array{region, r});
           });
  });
}

std::optional<std::uint32_t> FaceEngine::HalfMap::region_at_end(std::size_t k) const {
  const auto& piece = root_.side[half_.ends[k]].piece;
  const Piece1& p = half_.high ? piece.front() : piece.back();
  if (!p.inside) return std::nullopt;
  return region_of_element_.at(p.element);
}

std::optional<std::uint32_t> FaceEngine::HalfMap::arc_crossed(std::uint32_t region, SiteId above,
                                                              bool once_each) const {
  if (std::ranges::any_of(tree_, [&](const Tree& t) { return may_cross(t, region, above); }))
    return std::nullopt;
  std::optional<std::uint32_t> found;
  for (std::uint32_t a = 0; a < whole_.arc.size(); ++a) {
    if (once_each && (crossed_[a] != kNone || !joins_halves(whole_.arc[a]))) continue;
    const auto& r = whole_.arc[a].region;
    if ((r[0] != region || !may_govern(above, r[1])) &&
        (r[1] != region || !may_govern(above, r[0])))
      continue;
    if (found) return std::nullopt;
    found = a;
  }
  return found;
}

/// Which arcs cross the cut, in which order, and the regions between.
bool FaceEngine::HalfMap::walk_cut() {
  const Line& cut = root_.side[half_.cut];
  crossed_.assign(whole_.arc.size(), kNone);
  // An arc crosses the cut an odd number of times if its ends are in both halves, else an even one.
  const auto ties = std::ranges::count_if(
      cut.brk, [](const Break& b) { return b.point.kind == Breakpoint::Kind::kTie; });
  const bool once_each =
      std::ranges::find(where_, Where::kUnknown) == where_.end() &&
      std::ranges::count_if(whole_.arc, [&](const FaceArc& a) { return joins_halves(a); }) == ties;
  std::optional<std::uint32_t> region = region_at_end(0);
  for (std::size_t k = 0; k < cut.piece.size(); ++k) {
    if (k > 0) {
      const Break& b = cut.brk[k - 1];
      if (b.point.kind == Breakpoint::Kind::kBoundary) {
        const auto beside = region_of_trace(b.point.triangle);
        if (beside == kNone || (region && *region != beside)) return false;
        region = region ? std::nullopt : std::optional(beside);
      } else {
        if (!region || !may_govern(b.point.below, *region)) return false;
        const auto arc = arc_crossed(*region, b.point.above, once_each);
        if (!arc || crossed_[*arc] != kNone) return false;
        crossed_[*arc] = local_[b.id] = static_cast<std::uint32_t>(id_.size());
        id_.push_back(b.id);
        const auto& r = whole_.arc[*arc].region;
        region = r[0] == *region ? r[1] : r[0];
      }
    }
    const Piece1& p = cut.piece[k];
    if (p.inside != region.has_value() || (p.inside && !may_govern(p.witness, *region)))
      return false;
    if (p.inside) region_of_element_[p.element] = *region;
  }
  return region == region_at_end(1);
}

/// Of each arc is known whether it crosses the cut, once: so all nodes of its component follow from
/// one.
bool FaceEngine::HalfMap::place_nodes() {
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t a = 0; a < whole_.arc.size(); ++a) {
      const FaceArc& arc = whole_.arc[a];
      for (const auto& [known, other] : {std::pair{arc.from, arc.to}, {arc.to, arc.from}}) {
        if (where_[known] == Where::kUnknown || where_[other] != Where::kUnknown) continue;
        where_[other] =
            (where_[known] == Where::kIn) == (crossed_[a] == kNone) ? Where::kIn : Where::kOut;
        changed = true;
      }
    }
  }
  if (std::ranges::find(where_, Where::kUnknown) != where_.end()) return false;
  for (std::uint32_t a = 0; a < whole_.arc.size(); ++a)
    if (joins_halves(whole_.arc[a]) != (crossed_[a] != kNone)) return false;
  return true;
}

bool FaceEngine::HalfMap::find_graph() {
  graph_.resize(static_cast<std::uint32_t>(id_.size()));
  for (std::uint32_t a = 0; a < whole_.arc.size(); ++a) {
    const FaceArc& arc = whole_.arc[a];
    if (arc.region[0] == FaceArc::kUnknown || arc.region[1] == FaceArc::kUnknown) return false;
    const auto end = [&](std::uint32_t n) { return in(n) ? n : crossed_[a]; };
    if (!in(arc.from) && !in(arc.to)) continue;
    arcs_.push_back({end(arc.from), end(arc.to), &arc});
    graph_.unite(arcs_.back().from, arcs_.back().to);
  }
  return true;
}

bool FaceEngine::HalfMap::find_circles() {
  std::map<std::uint32_t, std::uint32_t> convex;
  for (std::uint32_t n = 0; n < whole_.node.size(); ++n)
    if (whole_.node[n].kind == FaceNode::Kind::kConvexEdge)
      convex[whole_.node[n].boundary_edge] = n;
  std::map<std::uint32_t, std::size_t> circle_of;  // by tree
  for (std::size_t c = 0; c < border_.circle.size(); ++c) {
    const auto first = static_cast<std::uint32_t>(runs_.size());
    circle_.push_back(first);
    std::vector<std::uint32_t> ends;
    bool known = true;
    engine_.walk(
        border_.circle[c],
        [&](const Step& s) {
          if (s.kind == Step::Kind::kTie) {
            const auto it = local_.find(s.id);
            known = known && it != local_.end();
            ends.push_back(known ? it->second : 0);
          } else {
            const auto it = convex.find(s.id);
            known = known && it != convex.end() && in(it->second);
            ends.push_back(known ? it->second : 0);
          }
        },
        [&](const Step& s, bool fresh) {
          const bool interval = s.kind == Step::Kind::kInterval;
          const auto r = interval ? region_of_element_.at(s.id) : region_of_trace(s.id);
          if (fresh) runs_.push_back({r, {}, {}});
          known = known && r != kNone && r == runs_.back().region;
          (interval ? runs_.back().elements : runs_.back().traces).push_back(s.id);
        });
    const auto n = static_cast<std::uint32_t>(ends.size());
    if (!known || runs_.size() - first != std::max(n, 1u)) return false;
    same_.resize(static_cast<std::uint32_t>(runs_.size()));
    std::map<std::uint32_t, std::vector<std::uint32_t>> of_tree;
    for (std::uint32_t k = 0; k < n; ++k) {
      of_tree[graph_.find(ends[k])].push_back(k);
      if (!end_.try_emplace(ends[k], std::array{first + (k + n - 1) % n, first + k}).second)
        return false;
    }
    // Along the border of a region: from an end of a tree to its next one on the circle.
    for (const auto& [tree, on] : of_tree) {
      if (!circle_of.try_emplace(tree, c).second) return false;
      for (std::size_t i = 0; i < on.size(); ++i)
        same_.unite(first + on[i], first + (on[(i + 1) % on.size()] + n - 1) % n);
    }
    std::size_t classes = 0;
    for (std::uint32_t k = first; k < runs_.size(); ++k) {
      classes += same_.find(k) == k;
      if (runs_[k].region != runs_[same_.find(k)].region) return false;
    }
    if (classes != 1 + n - of_tree.size()) return false;  // trees that cross
  }
  return true;
}

bool FaceEngine::HalfMap::find_sides_of_arcs() {
  std::vector<std::uint32_t> degree(id_.size(), 0);
  for (const Arc& a : arcs_) {
    ++degree[a.from];
    ++degree[a.to];
  }
  for (const auto& [node, runs] : end_)
    if (degree[node] != 1) return false;
  std::map<std::uint32_t, std::vector<std::uint32_t>> parts;  // region -> a run of each part
  for (std::uint32_t k = 0; k < runs_.size(); ++k)
    if (same_.find(k) == k) parts[runs_[k].region].push_back(k);
  for (Arc& a : arcs_) {
    const auto& r = a.of->region;
    const auto end = end_.contains(a.from) ? end_.find(a.from) : end_.find(a.to);
    if (end != end_.end()) {
      a.run = end->second;
      const std::array on = {runs_[a.run[0]].region, runs_[a.run[1]].region};
      if (on != r && on != std::array{r[1], r[0]}) return false;
      continue;
    }
    for (const std::size_t k : {0u, 1u}) {
      const auto it = parts.find(r[k]);
      if (it == parts.end()) continue;  // the region lies wholly within the half
      if (it->second.size() > 1) return false;
      a.run[k] = it->second.front();
    }
  }
  return true;
}

void FaceEngine::HalfMap::record() {
  std::vector<LocalForm> forms;
  prune(engine_.context_.geometry, root_.candidates, engine_.range_of(root_), forms,
        &engine_.context_);
  const auto label = [&](std::uint32_t element, std::uint32_t region) {
    std::vector<SiteId> labels;
    for (const LocalForm& f : forms)
      if (may_govern(f.site, region)) labels.push_back(f.site);
    engine_.label_element(element, labels);
  };
  std::vector<std::uint32_t> element;  // of each run
  for (const Run& run : runs_) {
    std::vector<std::uint32_t> all = run.elements;
    for (const auto t : run.traces) all.push_back(engine_.trace_element(t));
    for (const auto e : all) engine_.region_.unite(all.front(), e);
    label(all.front(), run.region);
    element.push_back(all.front());
  }
  for (std::size_t c = 0; c < circle_.size(); ++c) {
    const auto end = c + 1 < circle_.size() ? circle_[c + 1] : runs_.size();
    for (std::size_t k = circle_[c]; k < end; ++k) {
      engine_.component_.unite(element[circle_[c]], element[k]);
      const Run& run = runs_[k];
      for (const auto e : run.elements) engine_.component_.unite(element[k], e);
      for (const auto t : run.traces)
        engine_.component_.unite(element[k], engine_.trace_element(t));
      engine_.region_.unite(element[k], element[same_.find(static_cast<std::uint32_t>(k))]);
    }
  }
  std::map<std::uint32_t, std::uint32_t> within;  // region -> element
  const auto node_of = [&](std::uint32_t n) {
    if (id_[n] != kNone) return id_[n];
    const FaceNode& node = whole_.node[n];
    if (node.kind == FaceNode::Kind::kConvexEdge)
      return id_[n] = engine_.convex_node(node.boundary_edge);
    id_[n] = engine_.new_node(node.kind, root_);
    FaceNode& own = engine_.nodes_[id_[n]].node;
    own = node;
    own.u0 = std::max(node.u0, root_.u0);
    own.u1 = std::min(node.u1, root_.u1);
    own.v0 = std::max(node.v0, root_.v0);
    own.v1 = std::min(node.v1, root_.v1);
    return id_[n];
  };
  for (const Arc& a : arcs_) {
    std::array<std::uint32_t, 2> beside{};
    for (const std::size_t k : {0u, 1u}) {
      if (a.run[k] != kNone) {
        beside[k] = element[a.run[k]];
        continue;
      }
      const auto [it, fresh] = within.try_emplace(a.of->region[k], 0u);
      if (fresh) {
        it->second = engine_.new_element();
        label(it->second, it->first);
      }
      beside[k] = it->second;
    }
    engine_.component_.unite(beside[0], beside[1]);
    for (const auto n : {a.from, a.to}) engine_.nodes_[node_of(n)].element = beside[0];
    engine_.add_arc(node_of(a.from), node_of(a.to), a.of->left, a.of->right, beside);
  }
}

bool FaceEngine::take_half(const Box& root) {
  const auto half = Half::of(problem_.rect, problem_.whole->rect);
  if (!half) return false;
  HalfMap map(*this, root, *half);
  if (!map.find()) return false;
  map.record();
  ++context_.counts.halves;
  return true;
}

}  // namespace blum
