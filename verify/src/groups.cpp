#include "groups.hpp"

#include <algorithm>

#include "gains.hpp"

namespace blum::verify {
namespace {

template <class Related>
Groups components(const Sites& sites, std::span<const Site> list, const Box3& box,
                  Related&& related) {
  constexpr auto kUnset = 0xffffffffu;
  Groups g;
  g.of.assign(list.size(), kUnset);
  std::vector<std::size_t> stack;
  for (std::size_t root = 0; root < list.size(); ++root) {
    if (g.of[root] != kUnset) continue;
    stack.assign(1, root);
    g.of[root] = g.count;
    while (!stack.empty()) {
      const auto i = stack.back();
      stack.pop_back();
      for (std::size_t j = 0; j < list.size(); ++j) {
        if (g.of[j] != kUnset || !related(list[i], list[j])) continue;
        g.of[j] = g.count;
        stack.push_back(j);
      }
    }
    ++g.count;
  }
  g.cliques = true;
  for (std::size_t i = 0; i < list.size() && g.cliques; ++i)
    for (std::size_t j = 0; j < i && g.cliques; ++j)
      g.cliques = g.of[i] != g.of[j] || sites.never_essential(list[i], list[j]) ||
                  never_tie_from_vertex(sites.shape(), box, list[i], list[j]);
  return g;
}

}  // namespace

std::uint32_t Groups::find(std::span<const Site> sites, Site s) const {
  const auto it = std::ranges::find(sites, s);
  return it == sites.end() ? count : of[static_cast<std::size_t>(it - sites.begin())];
}

Groups groups_by_ties(const Sites& sites, std::span<const Site> list, const Box3& box) {
  return components(sites, list, box, [&](Site a, Site b) { return sites.never_essential(a, b); });
}

Groups groups_by_feet(const Sites& sites, std::span<const Site> list, const SharedFeet& feet) {
  return components(sites, list, feet.box(), [&](Site a, Site b) { return feet.shared(a, b); });
}

std::vector<std::uint32_t> common_corners(const Shape& shape, Site a, Site b) {
  std::vector<std::uint32_t> common;
  for (const auto v : shape.corners(a))
    if (shape.corners(b).has(v)) common.push_back(v);
  return common;
}

bool SharedFeet::listed(Site s) const { return std::ranges::find(sites_, s) != sites_.end(); }

bool SharedFeet::vertex(std::uint32_t v) const {
  const Sites& sites = exclusion_.sites();
  const Shape& shape = sites.shape();
  if (sites.cone(v).foot == VertexCone::Foot::kNever) return false;
  if (std::ranges::binary_search(shape.candidates(), shape.vertex_site(v)))
    return listed(shape.vertex_site(v)) &&
           !exclusion_.outside_polar_cone(shape.vertex_site(v), box_);
  return polar_cone_meets(shape, v, box_);
}

bool SharedFeet::edge(std::uint32_t v, std::uint32_t p) const {
  const Shape& shape = exclusion_.sites().shape();
  const auto e = shape.edge_between(v, p);
  if (e < 0) return true;
  const auto i = static_cast<std::uint32_t>(e);
  switch (shape.edge[i].bend) {
    case Bend::kConvex:
      return false;  // no ball inside touches it
    case Bend::kFlat:
      return true;
    case Bend::kReflex:
      break;
  }
  return listed(shape.edge_site(i));
}

bool SharedFeet::shared(Site a, Site b) const {
  const auto common = common_corners(exclusion_.sites().shape(), a, b);
  if (std::ranges::any_of(common, [&](std::uint32_t v) { return vertex(v); })) return true;
  return common.size() >= 2 && edge(common[0], common[1]);
}

}  // namespace blum::verify
