#include "graph.hpp"

#include <algorithm>
#include <utility>

#include "blum/kernel/union_find.hpp"
#include "failure.hpp"

namespace blum::verify {
namespace {

using Kind = FaceMap::Node::Kind;
using Box = std::array<double, 4>;

constexpr int kMostTries = 1000;  // to tell events apart that are nearer than doubles

/// A coordinate that is a number of doubles may be given as an interval of that alone.
bool overlap(const Box& a, const Box& b) {
  const auto meet = [&](std::size_t k) {
    return (a[k] < b[k + 1] && b[k] < a[k + 1]) || (a[k] == b[k] && a[k + 1] == b[k + 1]);
  };
  return meet(0) && meet(2);
}

bool holds(const Box& a, const Box& b) {
  return a[0] <= b[0] && a[1] >= b[1] && a[2] <= b[2] && a[3] >= b[3];
}

/// "Clusters": of events in a box that no other claimed one meets, those that arcs join to a tree
/// become one.
void contract(FaceMap& map, const Graph& claimed) {
  const auto count = static_cast<std::uint32_t>(map.node.size());
  std::vector<std::size_t> holder(count, claimed.event.size());  // none
  for (std::uint32_t n = 0; n < count; ++n) {
    const auto meets = [&](const Graph::Event& e) {
      return !e.rim && overlap(e.box, map.node[n].box);
    };
    const auto e = std::ranges::find_if(claimed.event, meets);
    if (map.node[n].kind == Kind::kEvent && std::ranges::count_if(claimed.event, meets) == 1 &&
        holds(e->box, map.node[n].box))
      holder[n] = static_cast<std::size_t>(e - claimed.event.begin());
  }
  UnionFind cluster;
  cluster.resize(count);
  std::erase_if(map.arc, [&](const FaceMap::Arc& a) {
    const auto [p, q] = a.node;
    if (holder[p] == claimed.event.size() || holder[p] != holder[q] ||
        cluster.find(p) == cluster.find(q))
      return false;
    cluster.unite(p, q);
    return true;
  });
  std::vector<std::uint32_t> number(count);
  std::vector<FaceMap::Node> kept;
  for (std::uint32_t n = 0; n < count; ++n)
    if (cluster.find(n) == n) {
      number[n] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(map.node[n]);
    }
  map.node = std::move(kept);
  for (FaceMap::Arc& a : map.arc)
    for (auto& n : a.node) n = number[cluster.find(n)];
}

/// Compares `map` with `claimed`; events are told by kinds and boxes first.
class Matcher {
 public:
  Matcher(FaceMap& map, const Graph& claimed)
      : map_(map), claimed_(claimed), used_(claimed.event.size(), false) {}
  void run();

 private:
  void find_candidates();
  bool match(std::size_t k);
  bool match_arcs();

  FaceMap& map_;
  const Graph& claimed_;
  std::vector<Graph::End> end_;  // of each node
  std::vector<std::uint32_t> event_;
  std::vector<std::vector<std::uint32_t>> candidate_;  // by place in event_
  std::vector<bool> used_;
  int tries_ = kMostTries;
};

void Matcher::find_candidates() {
  std::vector<std::vector<const Box*>> held(claimed_.event.size());  // nodes' boxes
  for (const auto n : event_) {
    const FaceMap::Node& node = map_.node[n];
    candidate_.emplace_back();
    for (std::uint32_t e = 0; e < claimed_.event.size(); ++e) {
      const auto& [rim, own] = claimed_.event[e];
      if (rim != (node.kind == Kind::kRim) || !overlap(own, node.box)) continue;
      const Box& box = node.box;
      const auto alike = std::ranges::count_if(
          claimed_.event, [&own, rim](const auto& x) { return x.rim == rim && x.box == own; });
      require(holds(own, box) &&
                  (std::cmp_less(held[e].size(), alike) ||
                   std::ranges::all_of(held[e], [&](const Box* b) { return overlap(*b, box); })),
              "diagram: a box does not isolate an event of its kind");
      held[e].push_back(&box);
      candidate_.back().push_back(e);
    }
    require(!candidate_.back().empty(), "diagram: an event is missing");
  }
  require(event_.size() <= claimed_.event.size(), "diagram: an event is missing");
  require(event_.size() == claimed_.event.size(), "diagram: an event that there is not");
}

bool Matcher::match(std::size_t k) {
  if (k == event_.size()) return --tries_ >= 0 && match_arcs();
  for (const auto e : candidate_[k]) {
    if (used_[e]) continue;
    used_[e] = true;
    end_[event_[k]] = {Graph::kEvent, e, 0};
    if (match(k + 1)) return true;
    used_[e] = false;
  }
  return false;
}

bool Matcher::match_arcs() {
  std::vector<bool> taken(claimed_.arc.size(), false);
  std::vector<FaceMap::Arc> arcs(claimed_.arc.size());
  for (const FaceMap::Arc& own : map_.arc) {
    const Graph::End p = end_[own.node[0]], q = end_[own.node[1]];
    const auto governs = [&](Site s, int side) {
      return std::ranges::binary_search(map_.region[own.region[side]].labels, s);
    };
    std::size_t k = 0;
    for (; k < taken.size(); ++k) {
      const auto& [ends, site] = claimed_.arc[k];
      if (!taken[k] && (ends == std::array{p, q} || ends == std::array{q, p}) &&
          ((governs(site[0], 0) && governs(site[1], 1)) ||
           (governs(site[0], 1) && governs(site[1], 0))))
        break;
    }
    if (k == taken.size()) return false;
    taken[k] = true;
    arcs[k] = own;
    if (claimed_.arc[k].end[0] != p) std::swap(arcs[k].node[0], arcs[k].node[1]);
  }
  map_.arc = std::move(arcs);
  return true;
}

void Matcher::run() {
  for (const FaceMap::Node& n : map_.node)
    end_.push_back(n.kind == Kind::kSide
                       ? Graph::End{Graph::kSide, static_cast<std::uint32_t>(n.side), n.change}
                       : Graph::End{Graph::kConvexEdge, n.edge, 0});
  std::vector<bool> loop(map_.node.size(), false);
  for (const FaceMap::Arc& a : map_.arc)
    if (a.node[0] == a.node[1]) loop[a.node[0]] = true;
  for (std::uint32_t n = 0; n < map_.node.size(); ++n) {
    if (loop[n])
      end_[n] = {Graph::kLoop, 0, 0};
    else if (map_.node[n].kind == Kind::kEvent || map_.node[n].kind == Kind::kRim)
      event_.push_back(n);
  }
  find_candidates();
  require(map_.arc.size() == claimed_.arc.size(), "diagram: another number of arcs");
  require(match(0), "diagram: an arc is missing, or not between these sites");
}

}  // namespace

void check_graph(FaceMap& map, const Graph& claimed) {
  contract(map, claimed);
  Matcher(map, claimed).run();
}

}  // namespace blum::verify
