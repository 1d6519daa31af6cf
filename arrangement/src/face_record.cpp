// What an accepted part adds to the diagram: labels of its regions, and arcs between its ends.
#include <algorithm>
#include <map>

#include "blum/kernel/check.hpp"
#include "face_engine.hpp"

namespace blum {

FaceEngine::Sequence FaceEngine::label_circle(const Circle& circle,
                                              std::span<const LocalForm> forms,
                                              const Groups& feet) {
  Sequence r;
  std::vector<SiteId> labels;
  const auto at_separator = [&](const Step& s) {
    const auto node = s.kind == Step::Kind::kTie ? s.id : convex_node(s.id);
    const auto& g = nodes_[node].node.governors;
    r.end.push_back({node, g.front(), g.back()});
  };
  walk(circle, at_separator, [&](const Step& s, bool fresh) {
    const auto element = s.kind == Step::Kind::kInterval ? s.id : trace_element(s.id);
    if (fresh) {
      r.run.push_back({element, s.label});
      // Feet are continuous in a region, so its governors share feet, one with the next.
      labels.clear();
      const auto group = feet.find(forms, s.label);
      for (std::size_t i = 0; i < forms.size(); ++i)
        if (feet.of[i] == group) labels.push_back(forms[i].site);
      label_element(element, labels);
    }
    region_.unite(r.run.back().element, element);
    component_.unite(r.run.front().element, element);
  });
  for (const Sequence::End& e : r.end) nodes_[e.node].element = r.run.front().element;
  return r;
}

std::optional<std::vector<std::uint32_t>> FaceEngine::runs_of(const Circle& circle,
                                                              std::span<const LocalForm> forms,
                                                              const Groups& groups) {
  std::vector<std::uint32_t> run;
  std::size_t separators = 0;
  bool apart = true;  // separators lie between groups
  walk(
      circle, [&](const Step&) { ++separators; },
      [&](const Step& s, bool fresh) {
        const auto g = groups.find(forms, s.label);
        BLUM_CHECK(g < groups.count);
        if (fresh) run.push_back(g);
        apart = apart && g == run.back();
      });
  if (!apart) return std::nullopt;
  if (separators > 0 && (separators != run.size() || run.size() < 2)) return std::nullopt;
  return run;
}

FaceEngine::Trees FaceEngine::trees_of(std::span<const std::uint32_t> region) {
  // The border of a region goes from the end after one of its intervals to the end before its next.
  const auto n = static_cast<std::uint32_t>(region.size());
  UnionFind tree;
  tree.resize(n);
  for (std::uint32_t k = 0; k < n; ++k) {
    std::uint32_t next = (k + 1) % n;
    while (region[next] != region[k]) next = (next + 1) % n;
    tree.unite((k + 1) % n, next);
  }
  Trees ends;
  for (std::uint32_t k = 0; k < n; ++k) ends[tree.find(k)].push_back(k);
  return ends;
}

void FaceEngine::record(const Circle& circle, std::span<const LocalForm> forms, const Groups& feet,
                        const Box& box, std::span<const std::uint32_t> region, Rims rims,
                        std::span<const Tip> tips) {
  const Sequence s = label_circle(circle, forms, feet);
  const auto n = static_cast<std::uint32_t>(s.end.size());
  if (n == 0) return;
  std::vector<std::uint32_t> region_of(region.begin(), region.end());
  if (region.empty())
    for (std::uint32_t k = 0; k < n; ++k) region_of.push_back(k);
  BLUM_CHECK(region_of.size() == n && s.run.size() == n);
  for (std::uint32_t k = 0; k < n; ++k)
    for (std::uint32_t j = 0; j < k; ++j)
      if (region_of[j] == region_of[k]) region_.unite(s.run[j].element, s.run[k].element);
  const auto beside = [&](std::uint32_t k) {
    return std::array{s.run[(k + n - 1) % n].element, s.run[k].element};
  };
  const auto inner_node = [&](FaceNode::Kind kind) {
    const auto node = new_node(kind, box);
    nodes_[node].element = s.run.front().element;
    return node;
  };
  for (const auto& [root, ends] : trees_of(region_of)) {
    BLUM_CHECK(rims != Rims::kNone || ends.size() >= 2);
    if (ends.size() == 2 && rims == Rims::kNone) {
      const auto &from = s.end[ends[0]], &to = s.end[ends[1]];
      add_arc(from.node, to.node, from.below, from.above, beside(ends[0]));
      continue;
    }
    const bool tip = rims == Rims::kTips && ends.size() > 1, rim = rims != Rims::kNone && !tip;
    const auto center = inner_node(rim ? FaceNode::Kind::kRim : FaceNode::Kind::kEvent);
    for (const auto k : ends)
      add_arc(center, s.end[k].node, s.end[k].below, s.end[k].above, beside(k));
    // A tree with three ends has one branching point, a true event. More: a cluster.
    FaceNode& node = nodes_[center].node;
    node.exact = rim || ends.size() + tip == 3;
    context_.counts.clusters += !node.exact;
    if (rim)
      for (const LocalForm& f : forms) node.governors.push_back(f.site);
    for (const auto k : ends) {
      node.governors.push_back(s.end[k].below);
      node.governors.push_back(s.end[k].above);
    }
    std::sort(node.governors.begin(), node.governors.end());
    node.governors.erase(std::unique(node.governors.begin(), node.governors.end()),
                         node.governors.end());
    if (!tip) continue;
    const auto own = std::ranges::find_if(
        tips, [&](const Tip& t) { return std::ranges::find(ends, (t.run + 1) % n) != ends.end(); });
    BLUM_CHECK(own != tips.end());
    const auto end = inner_node(FaceNode::Kind::kRim);
    for (const LocalForm& f : forms) nodes_[end].node.governors.push_back(f.site);
    std::ranges::sort(nodes_[end].node.governors);
    const auto around = s.run[own->run].element;
    add_arc(center, end, own->sites[0], own->sites[1], {around, around});
  }
}

void FaceEngine::note(PartRecord::Kind kind, std::span<const LocalForm> forms, std::uint32_t vertex,
                      std::array<std::uint32_t, 2> edge) {
  if (context_.parts == nullptr) return;
  PartRecord r;
  r.kind = kind;
  for (const LocalForm& f : forms) r.sites.push_back(f.site);
  r.vertex = vertex;
  r.edge = edge;
  r.plain = context_.plain;
  context_.parts->push_back(std::move(r));
}

void FaceEngine::note(PartRecord::Kind kind, std::span<const LocalForm> forms, const Groups& groups,
                      const Directions& directions) {
  if (context_.parts == nullptr) return;
  note(kind, forms);
  for (std::uint32_t g = 0; g < directions.size(); ++g)
    // All sites: who knows that a vertex between some of them is no foot has several groups.
    if (directions[g])
      for (const SiteId s : groups.members(forms, g))
        context_.parts->back().direction.emplace_back(s, in_plane(*directions[g]));
}

PlaneDirection FaceEngine::in_plane(const Direction& d) const {
  PlaneDirection w{d.w[u_].mid, d.w[v_].mid, {}};
  if (d.line) w.line = {d.line->from, d.line->to};
  return w;
}

}  // namespace blum
