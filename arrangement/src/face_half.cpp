#include "face_half.hpp"

namespace blum {

std::optional<Half> Half::of(const Rect& half, const Rect& whole) {
  if (half.axis != whole.axis || half.level != whole.level) return std::nullopt;
  const std::array<std::uint8_t, 4> side = {kLowU, kHighU, kLowV, kHighV};
  const std::array<double, 4> own = {half.u0, half.u1, half.v0, half.v1},
                              other = {whole.u0, whole.u1, whole.v0, whole.v1};
  std::optional<Half> found;
  for (std::size_t k = 0; k < 4; ++k) {
    if (own[k] == other[k]) continue;
    if (found) return std::nullopt;
    const bool low = k % 2 == 0, u = k < 2;
    found = Half{
        side[k], low,
        u ? std::array<std::uint8_t, 2>{kLowV, kHighV} : std::array<std::uint8_t, 2>{kLowU, kHighU},
        own[k], u};
    if (low ? !(own[k] > other[k]) : !(own[k] < other[k])) return std::nullopt;
  }
  return found;
}

bool FaceEngine::HalfMap::find_regions_of_sides() {
  for (std::uint8_t s = 0; s < 4; ++s) {
    if (s == half_.cut) continue;
    const auto n = whole_.side[s]->breakpoint.size(), own = root_.side[s].brk.size();
    if (own > n || (s == opposite() && own != n)) return false;
    for (std::size_t k = 0; k < root_.side[s].piece.size(); ++k) {
      const Piece1& p = root_.side[s].piece[k];
      const auto r = whole_.side_region[s][k + first_on(s)];
      if (p.inside != (r != FaceDiagram::kOutside)) return false;
      if (!p.inside) continue;
      region_of_element_[p.element] = r;
      witness_[p.element] = p.witness;
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
    if (!p.inside) continue;
    region_of_element_[p.element] = *region;
    witness_[p.element] = p.witness;
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

}  // namespace blum
