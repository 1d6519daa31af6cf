#include "certificate_parts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

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
  double low = 0, high = 0;
  for (const Plane& x : vectors) {
    const double angle =
        std::atan2(first[0] * x[1] - first[1] * x[0], first[0] * x[0] + first[1] * x[1]);
    low = std::min(low, angle);
    high = std::max(high, angle);
  }
  const double turn = std::atan2(first[1], first[0]) + 0.5 * (low + high);
  return {std::cos(turn), std::sin(turn), {}};
}

/// For each group by ties one along which it gains on all others, by the gradients.
Directions propose_directions(const SiteGeometry& geometry, Predicates& predicates,
                              const Rect& part, std::span<const SiteId> sites) {
  UnionFind group;
  group.resize(static_cast<std::uint32_t>(sites.size()));
  std::vector<std::vector<Plane>> of;
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    of.push_back(gradients(geometry, part, sites[i]));
    for (std::uint32_t j = 0; j < i; ++j)
      if (predicates.never_essential(sites[i], sites[j])) group.unite(i, j);
  }
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

}  // namespace

std::size_t site_number(const SiteIndex& index, std::span<const std::uint32_t> edge_number,
                        SiteId s) {
  if (index.kind(s) != SiteKind::kEdge) return s.value;
  return index.edge(0).value + edge_number[index.element(s)];
}

nlohmann::json part_claims(const SiteGeometry& geometry, Predicates& predicates,
                           std::span<const std::uint32_t> edge_number, const Rect& rect,
                           std::span<const PartRecord> records) {
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
  std::vector<Rect> open{rect};  // parts still to come
  Json j = Json::array();
  for (const PartRecord& r : records) {
    using Kind = PartRecord::Kind;
    const Rect part = open.back();
    open.pop_back();
    switch (r.kind) {
      case Kind::kCutU:
      case Kind::kCutV: {
        const bool along_u = r.kind == Kind::kCutU;
        j.push_back({along_u ? "u" : "v", r.cut});
        Rect low = part, high = part;
        (along_u ? low.u1 : low.v1) = (along_u ? high.u0 : high.v0) = r.cut;
        open.push_back(high);
        open.push_back(low);
        break;
      }
      case Kind::kOutside:
        j.push_back(Json::array({"outside"}));
        break;
      case Kind::kStar:
      case Kind::kFeet:
        j.push_back(
            {r.kind == Kind::kFeet ? "feet" : "star", sites(r.sites), directions(r.direction)});
        break;
      case Kind::kChords:
      case Kind::kFeetChords: {
        Json between = Json::array(), parted = Json::array();
        for (const auto& [a, b, w] : r.between) between.push_back(directed({site(a), site(b)}, w));
        for (const auto& [a, b, c] : r.parted) parted.push_back({site(a), site(b), site(c)});
        j.push_back(
            {r.kind == Kind::kChords ? "chords" : "feet chords", sites(r.sites), between, parted});
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
        j.push_back({r.kind == Kind::kExact ? "exact" : "slice", sites(r.sites),
                     directions(propose_directions(geometry, predicates, part, r.sites))});
        break;
    }
  }
  return j;
}

}  // namespace blum
