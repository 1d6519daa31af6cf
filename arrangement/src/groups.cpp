#include "groups.hpp"

#include <algorithm>

namespace blum {
namespace {

/// Connected components of a symmetric relation on the forms.
template <class Related>
Groups components(std::span<const LocalForm> forms, Related&& related) {
  constexpr auto kUnset = 0xffffffffu;
  const auto n = static_cast<std::uint32_t>(forms.size());
  Groups g;
  g.of.assign(n, kUnset);
  std::vector<std::uint32_t> stack;
  for (std::uint32_t root = 0; root < n; ++root) {
    if (g.of[root] != kUnset) continue;
    stack.assign(1, root);
    g.of[root] = g.count;
    while (!stack.empty()) {
      const auto i = stack.back();
      stack.pop_back();
      for (std::uint32_t j = 0; j < n; ++j) {
        if (g.of[j] != kUnset || !related(forms[i].site, forms[j].site)) continue;
        g.of[j] = g.count;
        stack.push_back(j);
      }
    }
    ++g.count;
  }
  return g;
}

bool are_cliques(EngineContext& context, std::span<const LocalForm> forms, const Groups& g) {
  for (std::size_t i = 0; i < forms.size(); ++i)
    for (std::size_t j = i + 1; j < forms.size(); ++j)
      if (g.of[i] == g.of[j] && !context.never_essential(forms[i].site, forms[j].site))
        return false;
  return true;
}

bool among(std::span<const LocalForm> forms, SiteId s) {
  return std::any_of(forms.begin(), forms.end(), [s](const LocalForm& f) { return f.site == s; });
}

}  // namespace

Groups Groups::by_ties(EngineContext& context, std::span<const LocalForm> forms) {
  Groups g = components(forms, [&](SiteId a, SiteId b) { return context.never_essential(a, b); });
  g.cliques = are_cliques(context, forms, g);
  return g;
}

Groups Groups::by_feet(EngineContext& context, std::span<const LocalForm> forms,
                       const Range& range) {
  if (context.voronoi()) return by_ties(context, forms);  // every site is a region of its own
  Groups g = components(
      forms, [&](SiteId a, SiteId b) { return may_share_foot(context, a, b, forms, range); });
  g.cliques = are_cliques(context, forms, g);
  return g;
}

std::uint32_t Groups::find(std::span<const LocalForm> forms, SiteId s) const {
  for (std::uint32_t i = 0; i < forms.size(); ++i)
    if (forms[i].site == s) return of[i];
  return count;
}

std::vector<SiteId> Groups::members(std::span<const LocalForm> forms, std::uint32_t group) const {
  std::vector<SiteId> sites;
  for (std::size_t i = 0; i < forms.size(); ++i)
    if (of[i] == group) sites.push_back(forms[i].site);
  return sites;
}

CommonCorners common_corners(const SiteGeometry& geometry, SiteId a, SiteId b) {
  int na = 0, nb = 0;
  const auto ca = geometry.corners(a, na), cb = geometry.corners(b, nb);
  CommonCorners common;
  for (int i = 0; i < na; ++i)
    for (int j = 0; j < nb; ++j)
      if (ca[i] == cb[j]) common.vertex[common.count++] = ca[i];
  return common;
}

bool may_be_foot(EngineContext& context, std::uint32_t vertex, std::span<const LocalForm> forms,
                 const Range& range) {
  if (context.foot_cone(vertex) == Predicates::FootCone::kNone) return false;
  const Solid& solid = context.geometry.solid();
  // A site that is not among the forms governs nothing in the range.
  if (!solid.vertex_degenerate[vertex])
    return among(forms, context.geometry.index().vertex(vertex));
  return !outside_polar_cone(context.geometry, vertex, range);
}

bool may_share_foot(EngineContext& context, SiteId a, SiteId b, std::span<const LocalForm> forms,
                    const Range& range) {
  const SiteGeometry& geometry = context.geometry;
  const CommonCorners common = common_corners(geometry, a, b);
  if (context.voronoi()) return common.count > 0;
  for (int k = 0; k < common.count; ++k)
    if (may_be_foot(context, common.vertex[k], forms, range)) return true;
  return common.count >= 2 && may_hold_foot(context, common.vertex[0], common.vertex[1], forms);
}

bool may_hold_foot(EngineContext& context, std::uint32_t v, std::uint32_t p,
                   std::span<const LocalForm> forms) {
  const Solid& solid = context.geometry.solid();
  for (const auto e : solid.edges_at(v)) {
    const auto& ends = solid.edge[e].vertex;
    if (ends[0] != p && ends[1] != p) continue;
    switch (solid.edge[e].kind) {
      case EdgeKind::kConvex:
        return false;
      case EdgeKind::kFlat:
        return true;
      case EdgeKind::kReflex:
        return among(forms, context.geometry.index().edge(e));
    }
  }
  return true;
}

}  // namespace blum
