#include "certificate_parts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "blum/arrangement/polar_cone.hpp"
#include "blum/kernel/angular_span.hpp"
#include "blum/kernel/closest_point.hpp"
#include "blum/kernel/union_find.hpp"

namespace blum {
namespace {

using Json = nlohmann::json;
using Directions = std::vector<std::pair<SiteId, PlaneDirection>>;
using Plane = std::array<double, 2>;

/// The list with the direction added: two numbers, or two vertices.
Json directed(Json list, const PlaneDirection& w) {
  if (w.line) {
    list.push_back(*w.line);
  } else {
    list.push_back(w.u);
    list.push_back(w.v);
  }
  return list;
}

/// How the distance to a site grows in the plane of the part where it governs: of an edge the ends
/// of its fan (docs/proofs.md, "Fans"), of a vertex at the centre.
std::vector<Plane> gradients(const SiteGeometry& geometry, const Rect& part, SiteId site) {
  const SiteIndex& index = geometry.index();
  const int u = u_axis(part.axis), v = v_axis(part.axis);
  const auto inwards = [&](std::uint32_t triangle) {
    const BallVector& n = geometry.unit(index.face(triangle));
    return Plane{-n[u].mid, -n[v].mid};
  };
  const auto i = index.element(site);
  switch (index.kind(site)) {
    case SiteKind::kFace:
      return {inwards(i)};
    case SiteKind::kEdge: {
      const auto& side = geometry.solid().edge[i].triangle;
      return {inwards(side[0]), inwards(side[1])};
    }
    case SiteKind::kVertex:
      break;
  }
  const Point3 x =
      point_on(part.axis, part.level, 0.5 * (part.u0 + part.u1), 0.5 * (part.v0 + part.v1));
  const Point3& y = geometry.solid().point[i];
  const double d = std::hypot(x.x - y.x, x.y - y.y, x.z - y.z);
  return {{(x[u] - y[u]) / d, (x[v] - y[v]) / d}};
}

/// The middle of the directions of some vectors that span less than pi.
PlaneDirection middle_of(std::span<const Plane> vectors) {
  const Plane& first = vectors.front();
  const auto [low, high] = angular_span(vectors);
  const double turn = std::atan2(first[1], first[0]) + 0.5 * (low + high);
  return {std::cos(turn), std::sin(turn), {}};
}

/// May the two share a foot, as far as their corners and the other sites tell?
bool touch(const SiteGeometry& geometry, std::span<const SiteId> sites, SiteId a, SiteId b) {
  const auto listed = [&](SiteId s) { return std::ranges::find(sites, s) != sites.end(); };
  const Solid& solid = geometry.solid();
  int na = 0, nb = 0;
  const auto ca = geometry.corners(a, na), cb = geometry.corners(b, nb);
  const auto of_both = [&](std::uint32_t v) {
    return std::find(ca.begin(), ca.begin() + na, v) != ca.begin() + na &&
           std::find(cb.begin(), cb.begin() + nb, v) != cb.begin() + nb;
  };
  for (int k = 0; k < na; ++k) {
    if (!of_both(ca[k])) continue;
    if (listed(geometry.index().vertex(ca[k]))) return true;
    for (const auto e : solid.edges_at(ca[k]))
      if (of_both(solid.edge[e].vertex[0]) && of_both(solid.edge[e].vertex[1]) &&
          (solid.edge[e].kind == EdgeKind::kFlat || listed(geometry.index().edge(e))))
        return true;
  }
  return false;
}

/// By ties, unless two of a group tie essentially: then by feet (true).
std::pair<UnionFind, bool> groups_of(const SiteGeometry& geometry, Predicates& predicates,
                                     std::span<const SiteId> sites) {
  const auto n = static_cast<std::uint32_t>(sites.size());
  const auto components = [&](auto&& related) {
    UnionFind group;
    group.resize(n);
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t j = 0; j < i; ++j)
        if (related(sites[i], sites[j])) group.unite(i, j);
    return group;
  };
  const auto never = [&](SiteId a, SiteId b) { return predicates.never_essential(a, b); };
  UnionFind ties = components(never);
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < i; ++j)
      if (ties.find(i) == ties.find(j) && !never(sites[i], sites[j]))
        return {components([&](SiteId a, SiteId b) { return touch(geometry, sites, a, b); }), true};
  return {ties, false};
}

/// For each group one along which it gains on all others, by the gradients.
Directions propose_directions(const SiteGeometry& geometry, const Rect& part,
                              std::span<const SiteId> sites, UnionFind& group) {
  std::vector<std::vector<Plane>> of;
  for (const SiteId s : sites) of.push_back(gradients(geometry, part, s));
  std::map<std::uint32_t, std::vector<Plane>> gains;  // by group, on each site of the others
  for (std::uint32_t i = 0; i < sites.size(); ++i)
    for (std::uint32_t j = 0; j < sites.size(); ++j)
      for (const Plane& a : of[i])
        for (const Plane& b : of[j])
          if (group.find(i) != group.find(j))
            gains[group.find(i)].push_back({b[0] - a[0], b[1] - a[1]});
  Directions directions;
  for (const auto& [g, vectors] : gains)
    if (const PlaneDirection w = middle_of(vectors); std::isfinite(w.u) && std::isfinite(w.v))
      directions.emplace_back(sites[g], w);
  return directions;
}

std::array<Rect, 2> cut(const Rect& part, bool along_u, double at) {
  std::array<Rect, 2> half{part, part};
  (along_u ? half[0].u1 : half[0].v1) = (along_u ? half[1].u0 : half[1].v0) = at;
  return half;
}

/// Between the boxes of some events, where they are farthest apart: along u, and at what number.
/// nullopt: nowhere, or too near each other.
std::optional<std::pair<bool, double>> between(std::vector<const FaceNode*> event) {
  std::optional<std::pair<bool, double>> best;
  // A cut through a narrower gap may have several ties between neighbouring doubles.
  double widest = 0x1p-40;
  for (const bool along_u : {true, false}) {
    const auto low = [&](const FaceNode* n) { return along_u ? n->u0 : n->v0; };
    const auto high = [&](const FaceNode* n) { return along_u ? n->u1 : n->v1; };
    std::ranges::sort(event, {}, low);
    for (std::size_t k = 1; k < event.size(); ++k) {
      double end = high(event[0]);
      for (std::size_t i = 1; i < k; ++i) end = std::max(end, high(event[i]));
      // Not in the middle: edges and ties of symmetric solids are there.
      const double gap = low(event[k]) - end, at = end + 0.46 * gap;
      if (!(gap > widest) || !(at > end && at < low(event[k]))) continue;
      widest = gap;
      best = {along_u, at};
    }
  }
  return best;
}

}  // namespace

std::size_t site_number(const SiteIndex& index, std::span<const std::uint32_t> edge_number,
                        SiteId s) {
  if (index.kind(s) != SiteKind::kEdge) return s.value;
  return index.edge(0).value + edge_number[index.element(s)];
}

nlohmann::json part_claims(const SiteGeometry& geometry, Predicates& predicates,
                           std::span<const std::uint32_t> edge_number,
                           std::span<const PartRecord> records, FaceDiagram& face) {
  const auto site = [&](SiteId s) { return site_number(geometry.index(), edge_number, s); };
  const auto sites = [&](std::span<const SiteId> list) {
    Json numbers = Json::array();
    for (const SiteId s : list) numbers.push_back(site(s));
    return numbers;
  };
  const auto directions = [&](const Directions& list) {
    Json all = Json::array();
    for (const auto& [s, w] : list) all.push_back(directed(Json::array({site(s)}), w));
    return all;
  };
  Json j = Json::array();
  // What exact algebra decided holds one event in the end, whose box is the part, unless events are
  // too near each other to be parted.
  const auto propose = [&](const auto& self, const Rect& part, const PartRecord& r) -> void {
    std::vector<FaceNode*> event;
    for (FaceNode& n : face.node)
      if ((n.kind == FaceNode::Kind::kEvent || n.kind == FaceNode::Kind::kRim) && n.u0 >= part.u0 &&
          n.u1 <= part.u1 && n.v0 >= part.v0 && n.v1 <= part.v1)
        event.push_back(&n);
    if (event.size() > 1)
      if (const auto gap = between({event.begin(), event.end()})) {
        j.push_back({gap->first ? "u" : "v", gap->second});
        for (const Rect& half : cut(part, gap->first, gap->second)) self(self, half, r);
        return;
      }
    if (event.size() == 1) {
      event[0]->u0 = part.u0;
      event[0]->u1 = part.u1;
      event[0]->v0 = part.v0;
      event[0]->v1 = part.v1;
    }
    // Vertices that are feet of no point of the part would tie the edges there into one group.
    std::vector<SiteId> kept;
    for (const SiteId s : r.sites)
      if (geometry.index().kind(s) != SiteKind::kVertex ||
          meets_polar_cone(geometry.solid(), geometry.index().element(s),
                           point_on(part.axis, part.level, part.u0, part.v0),
                           point_on(part.axis, part.level, part.u1, part.v1)))
        kept.push_back(s);
    auto [group, by_feet] = groups_of(geometry, predicates, kept);
    Json star = {by_feet ? "feet" : "star", sites(kept),
                 directions(propose_directions(geometry, part, kept, group))};
    j.push_back(Json::array({"exact", std::move(star)}));
  };
  // What the checker may not show by reasons of its own it may decide otherwise.
  const auto claim = [&](const PartRecord& r, Json part) {
    j.push_back(r.plain ? std::move(part) : Json::array({"exact", std::move(part)}));
  };
  std::vector<Rect> open{face.rect};  // parts still to come
  for (const PartRecord& r : records) {
    using Kind = PartRecord::Kind;
    const Rect part = open.back();
    open.pop_back();
    switch (r.kind) {
      case Kind::kCutU:
      case Kind::kCutV: {
        const bool along_u = r.kind == Kind::kCutU;
        j.push_back({along_u ? "u" : "v", r.cut});
        const auto half = cut(part, along_u, r.cut);
        open.push_back(half[1]);
        open.push_back(half[0]);
        break;
      }
      case Kind::kOutside:
        j.push_back(Json::array({"outside"}));
        break;
      case Kind::kStar:
      case Kind::kFeet:
        claim(r,
              {r.kind == Kind::kFeet ? "feet" : "star", sites(r.sites), directions(r.direction)});
        break;
      case Kind::kChords:
      case Kind::kFeetChords: {
        Json between_groups = Json::array(), parted = Json::array();
        for (const auto& [a, b, w] : r.between)
          between_groups.push_back(directed(Json::array({site(a), site(b)}), w));
        for (const auto& [a, b, c] : r.parted)
          parted.push_back(Json::array({site(a), site(b), site(c)}));
        claim(r, {r.kind == Kind::kChords ? "chords" : "feet chords", sites(r.sites),
                  between_groups, parted});
        break;
      }
      case Kind::kCone:
        j.push_back({"cone", sites(r.sites), r.vertex});
        break;
      case Kind::kRim:
        j.push_back(
            {"rim", sites(r.sites), r.vertex, edge_number[r.edge[0]], edge_number[r.edge[1]]});
        break;
      case Kind::kExact:
      case Kind::kSlice:
      case Kind::kLink:
        propose(propose, part, r);
        break;
    }
  }
  return j;
}

}  // namespace blum
