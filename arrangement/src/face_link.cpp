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

}  // namespace

std::optional<FaceEngine::Section> FaceEngine::section_of(const Apex& apex, const Box& box) {
  Section section;
  if (!apex.is_foot) return section;
  const Rect& r = problem_.rect;
  for (const auto& ray : context_.vertex_link(apex.vertex)->ray) {
    const auto passes = context_.predicates.passes(apex.vertex, ray, r.axis, r.level,
                                                   point_on(r.axis, r.level, box.u0, box.v0),
                                                   point_on(r.axis, r.level, box.u1, box.v1));
    if (!passes) return std::nullopt;
    section.within &= *passes;
    if (*passes && ray.ends_axis) section.end.push_back(ray);
  }
  return section;
}

std::vector<FaceEngine::Shown> FaceEngine::shown_on(const Circle& circle, const Apex& apex) {
  const Predicates::VertexLink& link = *context_.vertex_link(apex.vertex);
  const std::size_t n = circle.size();
  std::size_t start = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (separates(circle[i])) start = i;
  std::vector<Shown> shown;
  bool fresh = true;
  for (std::size_t k = 0; k < n; ++k) {
    const Step& s = circle[(start + k) % n];
    if (separates(s)) {
      fresh = true;
      continue;
    }
    if (fresh) shown.emplace_back();
    fresh = false;
    if (context_.geometry.index().kind(s.label) == SiteKind::kVertex) {
      shown.back().vertex = true;
      continue;
    }
    auto& chains = shown.back().chain;
    const auto c = chain_of(context_.geometry, link, apex.vertex, s.label);
    if (std::ranges::find(chains, c) == chains.end()) chains.push_back(c);
  }
  return shown;
}

FaceEngine::Tip FaceEngine::tip_of(const Predicates::VertexLink::Ray& ray,
                                   std::uint32_t run) const {
  const SiteIndex& index = context_.geometry.index();
  return {run, {index.edge(ray.edge[0]), index.edge(ray.edge[1])}};
}

std::optional<std::vector<FaceEngine::Tip>> FaceEngine::tips_between(const Section& section,
                                                                     const Apex& apex,
                                                                     std::span<const Shown> shown) {
  const Predicates::VertexLink& link = *context_.vertex_link(apex.vertex);
  const Rect& r = problem_.rect;
  const bool forward = r.level > context_.geometry.solid().point[apex.vertex][r.axis];
  std::vector<std::uint32_t> beside;  // the cone: intervals, counter-clockwise
  for (std::uint32_t k = 0; k < shown.size(); ++k) {
    if (shown[k].vertex || shown[k].chain.size() != 1) return std::nullopt;
    if (link.merged[shown[k].chain[0]]) beside.push_back(k);
  }
  std::vector<Tip> tips;
  for (std::size_t k = 0; k < beside.size(); ++k) {
    const auto from = shown[beside[k]].chain[0],
               to = shown[beside[(k + 1) % beside.size()]].chain[0];
    const auto between = [&](const Predicates::VertexLink::Ray& ray) {
      const auto chain = [&](std::uint32_t e) {
        return chain_of(context_.geometry, link, apex.vertex, context_.geometry.index().edge(e));
      };
      const auto a = chain(ray.edge[0]), b = chain(ray.edge[1]);
      return forward ? a == from && b == to : a == to && b == from;
    };
    if (std::ranges::count_if(section.end, between) != 1) return std::nullopt;
    tips.push_back(tip_of(*std::ranges::find_if(section.end, between), beside[k]));
  }
  return tips;
}

bool FaceEngine::accept_link(const Apex& apex, const Box& box, std::span<const LocalForm> forms,
                             const Groups& feet, const Circle& circle) {
  const auto& link = context_.vertex_link(apex.vertex);
  if (!link) return false;
  const auto section = section_of(apex, box);
  if (!section) return false;

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
  const auto ends = static_cast<std::uint32_t>(section->end.size());
  if (ties == 0 ? ends > 0 : ties + ends == 1) return false;  // something is not as thought
  const auto runs = ties == 1 ? std::vector<std::uint32_t>(1) : runs_of(circle, forms, regions);
  if (!runs) return false;
  const std::vector<Shown> shown = shown_on(circle, apex);
  std::vector<std::uint32_t>
      beside;  // intervals whose region is that about the cone, if it is here
  for (std::uint32_t k = 0; apex.is_foot && k < shown.size(); ++k)
    if (shown[k].vertex || link->merged[shown[k].chain[0]]) beside.push_back(k);

  std::vector<std::uint32_t> region;  // empty: all different
  std::vector<Tip> tips;
  const std::size_t different = std::set(runs->begin(), runs->end()).size();
  if (ties + ends <= 3 || different == runs->size()) {
    if (ends > 1) return false;
    if (ends == 1 && ties > 1) {
      // The interval of the region about the tip.
      if (beside.size() > 1)
        std::erase_if(beside,
                      [&](auto k) { return !shown[k].vertex && shown[k].chain.size() < 2; });
      if (beside.size() != 1) return false;
      tips.push_back(tip_of(section->end[0], beside[0]));
    }
  } else {
    // Only intervals beside the cone are of one region: if the cone joins them.
    if (!apex.is_foot || different + beside.size() != runs->size() + 1) return false;
    const bool all_meet_cone = std::ranges::all_of(
        beside, [&](auto k) { return shown[k].vertex || shown[k].chain.size() > 1; });
    if (!(all_meet_cone && ends == 0)) {
      const auto chains = static_cast<std::size_t>(std::ranges::count(link->merged, true));
      if (!section->within || ends != beside.size() || chains != ends) return false;
      auto found = tips_between(*section, apex, shown);
      if (!found) return false;
      tips = std::move(*found);
    }
    region = *runs;
    if (trees_of(region).size() != beside.size()) return false;
  }
  std::size_t most_ends = region.empty() ? ties + ends : 0;
  if (!region.empty())
    for (const auto& [root, own] : trees_of(region)) {
      if (own.size() < 2 && ends == 0) return false;
      most_ends = std::max(most_ends, own.size() + (ends > 0));
    }
  if (most_ends > 3 && context_.part_clusters &&
      range_of(box).radius() > ProductionEngine::kSmallestCluster &&
      (ends > 0 || !region.empty() || !meet_in_one_point(box, forms, regions, circle)))
    return false;
  context_.counts.rims += ends;
  ++context_.counts.links;
  record(circle, forms, regions, box, region, ends > 0 ? Rims::kTips : Rims::kNone, tips);
  note(PartRecord::Kind::kLink, forms, apex.vertex);
  return true;
}

}  // namespace blum
