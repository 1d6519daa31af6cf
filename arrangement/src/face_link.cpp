// Parts of a face where all sites meet in one vertex: what the chains of triangles between its
// convex edges, and the cone of points whose foot it is, tell of the axis ("The cone of a vertex"
// in docs/proofs.md).
#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "face_engine.hpp"

namespace blum {
namespace {

/// Number of the chain at the vertex that a site other than it belongs to.
std::uint32_t chain_of(const SiteGeometry& geometry, const Predicates::VertexLink& link,
                       std::uint32_t vertex, SiteId site) {
  const SiteIndex& index = geometry.index();
  const auto t = index.kind(site) == SiteKind::kFace
                     ? index.element(site)
                     : geometry.solid().edge[index.element(site)].triangle[0];
  const auto triangles = geometry.solid().triangles_at(vertex);
  return link.chain[static_cast<std::size_t>(std::ranges::find(triangles, t) - triangles.begin())];
}

/// The extreme ray of the foot cone between whose edges the triangles of a chain lie that does not
/// bound the cone. Requires: the link has rays.
const Predicates::VertexLink::Ray* ray_over(const Solid& solid, const Predicates::VertexLink& link,
                                            std::uint32_t vertex, std::uint32_t chain) {
  const auto triangles = solid.triangles_at(vertex);
  const auto place = [&](std::uint32_t t) {
    return static_cast<std::uint32_t>(std::ranges::find(triangles, t) - triangles.begin());
  };
  const auto bounds = [&](std::uint32_t e) {
    return std::ranges::any_of(link.ray, [e](const auto& r) { return r.edge[0] == e; });
  };
  UnionFind sector;  // of triangles between two edges that bound the cone
  sector.resize(static_cast<std::uint32_t>(triangles.size()));
  for (const auto e : solid.edges_at(vertex))
    if (!bounds(e))
      sector.unite(place(solid.edge[e].triangle[0]), place(solid.edge[e].triangle[1]));
  const auto own = sector.find(
      static_cast<std::uint32_t>(std::ranges::find(link.chain, chain) - link.chain.begin()));
  for (const auto& ray : link.ray)
    if (std::ranges::all_of(ray.edge, [&](std::uint32_t e) {
          return std::ranges::any_of(solid.edge[e].triangle,
                                     [&](auto t) { return sector.find(place(t)) == own; });
        }))
      return &ray;
  return nullptr;
}

/// The last edge at the vertex, from one of the two edges of an extreme ray on, that triangles
/// orthogonal to the ray link: there the gap begins in which a sheet ends.
std::uint32_t beside_gap(EngineContext& context, std::uint32_t vertex,
                         const Predicates::VertexLink::Ray& ray, std::uint32_t edge) {
  const Solid& solid = context.geometry.solid();
  const SiteIndex& index = context.geometry.index();
  std::optional<std::uint32_t> last;
  for (bool found = true; found;) {
    found = false;
    for (const auto t : solid.edge[edge].triangle) {
      if (t == last) continue;
      for (const auto other : solid.triangle[t].edge) {
        const auto& ends = solid.edge[other].vertex;
        const std::array in_plane{index.edge(other)};
        if (found || other == edge || (ends[0] != vertex && ends[1] != vertex) ||
            !context.predicates.rim_common(vertex, ray.edge[0], ray.edge[1], in_plane))
          continue;
        found = true;
        last = t;
        edge = other;
      }
      if (found) break;
    }
  }
  return edge;
}

}  // namespace

std::optional<std::vector<Predicates::VertexLink::Ray>> FaceEngine::ends_on_cone(const Apex& apex,
                                                                                 const Box& box) {
  std::vector<Predicates::VertexLink::Ray> ends;
  if (!apex.is_foot) return ends;
  const Rect& r = problem_.rect;
  for (const auto& ray : context_.vertex_link(apex.vertex)->ray) {
    const auto passes = context_.predicates.passes(apex.vertex, ray, r.axis, r.level,
                                                   point_on(r.axis, r.level, box.u0, box.v0),
                                                   point_on(r.axis, r.level, box.u1, box.v1));
    if (!passes) return std::nullopt;
    if (*passes && ray.ends_axis) ends.push_back(ray);
  }
  return ends;
}

std::vector<FaceEngine::Shown> FaceEngine::shown_on(const Circle& circle, const Apex& apex) {
  const Predicates::VertexLink& link = *context_.vertex_link(apex.vertex);
  std::vector<Shown> shown;
  walk(
      circle, [](const Step&) {},
      [&](const Step& s, bool fresh) {
        if (fresh) shown.emplace_back();
        if (context_.geometry.index().kind(s.label) == SiteKind::kVertex) {
          shown.back().vertex = true;
          return;
        }
        auto& chains = shown.back().chain;
        const auto c = chain_of(context_.geometry, link, apex.vertex, s.label);
        if (std::ranges::find(chains, c) == chains.end()) chains.push_back(c);
      });
  return shown;
}

FaceEngine::Tip FaceEngine::tip_of(const Predicates::VertexLink::Ray& ray,
                                   std::uint32_t run) const {
  const SiteIndex& index = context_.geometry.index();
  const auto& edges = context_.geometry.solid().edge;
  const auto &e = edges[ray.edge[0]].vertex, &f = edges[ray.edge[1]].vertex;
  const auto vertex = e[0] == f[0] || e[0] == f[1] ? e[0] : e[1];
  return {run,
          {index.edge(beside_gap(context_, vertex, ray, ray.edge[0])),
           index.edge(beside_gap(context_, vertex, ray, ray.edge[1]))}};
}

std::optional<std::vector<FaceEngine::Tip>> FaceEngine::tips_of(
    const Apex& apex, std::span<const Predicates::VertexLink::Ray> rays,
    std::span<const std::uint32_t> region, std::span<const Shown> shown) {
  const Predicates::VertexLink& link = *context_.vertex_link(apex.vertex);
  const auto n = static_cast<std::uint32_t>(region.size());
  const auto at_cone = [&](std::uint32_t k) {
    return shown[k].vertex || link.merged[shown[k].chain[0]];
  };
  std::vector<Tip> tips;
  for (const auto& [root, ends] : trees_of(region)) {
    if (ends.size() < 2) continue;
    // The tree lies over the chains of its other regions.
    const auto before =
                   std::ranges::find_if(ends, [&](auto k) { return at_cone((k + n - 1) % n); }),
               over = std::ranges::find_if(ends, [&](auto k) { return !at_cone(k); });
    if (before == ends.end() || over == ends.end()) return std::nullopt;
    const auto* ray = ray_over(context_.geometry.solid(), link, apex.vertex, shown[*over].chain[0]);
    if (ray == nullptr ||
        std::ranges::none_of(rays, [ray](const auto& r) { return r.edge == ray->edge; }))
      return std::nullopt;
    tips.push_back(tip_of(*ray, (*before + n - 1) % n));
  }
  return tips;
}

bool FaceEngine::accept_link(const Apex& apex, const Box& box, std::span<const LocalForm> forms,
                             const Groups& feet, const Circle& circle) {
  const auto& link = context_.vertex_link(apex.vertex);
  if (!link) return false;
  const auto rays = ends_on_cone(apex, box);
  if (!rays) return false;

  // Regions differ if their governors are in different groups of "may share a foot", or in
  // different chains; those beside the cone of the vertex count as one.
  const std::uint32_t merged = link->chains;
  const auto chain = [&](const LocalForm& f) {
    if (f.kind == SiteKind::kVertex) return merged;
    const auto c = chain_of(context_.geometry, *link, apex.vertex, f.site);
    return apex.is_foot && link->merged[c] ? merged : c;
  };
  Groups regions;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> number;
  for (std::size_t i = 0; i < forms.size(); ++i)
    regions.of.push_back(
        number.try_emplace({chain(forms[i]), feet.of[i]}, static_cast<std::uint32_t>(number.size()))
            .first->second);
  regions.count = static_cast<std::uint32_t>(number.size());

  const std::uint32_t ties = ends_of(circle);
  const auto ends = static_cast<std::uint32_t>(rays->size());
  if (ends > ties || ties + ends == 1) return false;  // something is not as thought
  const auto runs = ties == 1 ? std::vector<std::uint32_t>(1) : runs_of(circle, forms, regions);
  if (!runs) return false;
  const std::vector<Shown> shown = shown_on(circle, apex);
  std::vector<std::uint32_t> beside;  // intervals of the region about the cone, if that is one
  for (std::uint32_t k = 0; apex.is_foot && k < shown.size(); ++k)
    if (shown[k].vertex || link->merged[shown[k].chain[0]]) beside.push_back(k);

  std::vector<std::uint32_t> region;  // empty: all different
  std::vector<Tip> tips;
  const std::size_t different = std::set(runs->begin(), runs->end()).size();
  if (ties + ends <= 3) {
    if (ends == 1 && ties == 2) {
      // The interval of the region about the tip, which is that about the cone.
      if (beside.size() > 1)
        std::erase_if(beside,
                      [&](auto k) { return !shown[k].vertex && shown[k].chain.size() < 2; });
      if (beside.size() != 1) return false;
      tips.push_back(tip_of(rays->front(), beside[0]));
    }
  } else if (different + std::max(ends, 1u) == ties + 1) {
    // As many trees as ends inside, or one: not more regions than are seen to be different.
    region = *runs;
    if (ends > 0) {
      auto found = tips_of(apex, *rays, region, shown);
      if (!found) return false;
      tips = std::move(*found);
    }
  } else {
    return false;
  }
  if (!region.empty() && trees_of(region).size() != ties + 1 - different) return false;
  std::size_t most_ends = region.empty() ? ties + ends : 0;
  if (!region.empty())
    for (const auto& [root, own] : trees_of(region)) {
      if (own.size() < 2 && ends == 0) return false;
      most_ends = std::max(most_ends, own.size() + (ends > 0));
    }
  if (most_ends > 3 && context_.part_clusters &&
      range_of(box).radius() > ProductionEngine::kSmallestCluster &&
      (ends > 0 || different != ties || !meet_in_one_point(box, forms, regions, circle)))
    return false;
  context_.counts.rims += ends;
  ++context_.counts.links;
  record(circle, forms, regions, box, region, ends > 0 ? Rims::kTips : Rims::kNone, tips);
  note(PartRecord::Kind::kLink, forms, apex.vertex);
  return true;
}

}  // namespace blum
