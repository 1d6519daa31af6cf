#include "face_engine.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "blum/kernel/angular_span.hpp"

namespace blum {
namespace {

/// How far a point within a strip may be from its tip (working units), or its direction from that
/// of its edge: any positive number would do.
constexpr double kAside = 0x1p-44;

/// A direction w (in the plane) with g . w < 0 for all given vectors, if they span less than pi.
std::optional<std::array<double, 2>> opposite(std::span<const std::array<double, 2>> g) {
  const auto& first = g.front();
  const auto [lo, hi] = angular_span(g);
  if (!(hi - lo < 3.1415)) return std::nullopt;
  const double turn = 0.5 * (lo + hi), c = std::cos(turn), s = std::sin(turn);
  const double length = std::hypot(first[0], first[1]);
  if (!(length > 0)) return std::nullopt;
  return std::array{-(c * first[0] - s * first[1]) / length,
                    -(s * first[0] + c * first[1]) / length};
}

}  // namespace

// Theorem D': directions along which every site of a group gains on its rivals.

bool FaceEngine::gain_along(std::span<const GainPair> pairs, std::span<const LocalForm> forms,
                            const Range& range, const Direction& direction) {
  return std::all_of(pairs.begin(), pairs.end(), [&](const GainPair& p) {
    const LocalForm &a = forms[p.i], &b = forms[p.j];
    if (gains(p.slope, range, direction.w)) return true;
    return !may_share_foot(context_, a.site, b.site, forms, range) &&
           gains_by_feet(context_, p.slope, a.site, b.site, direction, forms, range);
  });
}

std::optional<Direction> FaceEngine::along_strip(std::span<const GainPair> pairs,
                                                 std::span<const LocalForm> forms,
                                                 const Range& range) const {
  const SiteGeometry& geometry = context_.geometry;
  const SiteIndex& index = geometry.index();
  const LocalForm& own = forms[pairs.front().i];
  if (own.kind != SiteKind::kEdge) return std::nullopt;
  const SolidEdge& edge = geometry.solid().edge[index.element(own.site)];
  const Point3 &p = geometry.solid().point[edge.vertex[0]],
               &q = geometry.solid().point[edge.vertex[1]];
  const Rect& r = problem_.rect;
  std::vector<Direction> tried;
  if (p[r.axis] == q[r.axis]) {
    for (const auto& [from, to] : {std::pair{p, q}, std::pair{q, p}}) {
      Direction d;
      double size = 0;
      for (const int k : {u_, v_}) size = std::max(size, std::abs(to[k] - from[k]));
      for (const int k : {u_, v_}) d.w[k] = Ball(to[k]) - Ball(from[k]) + Ball(0.0, kAside * size);
      tried.push_back(d);
    }
  } else {
    const Ball s = divide(Ball(r.level) - Ball(p[r.axis]), Ball(q[r.axis]) - Ball(p[r.axis]));
    Direction d;
    bool apart = false;
    for (const int k : {u_, v_}) {
      // A little beside the crossing.
      const Ball at = Ball(p[k]) + s * (Ball(q[k]) - Ball(p[k])) + Ball(0.0, kAside);
      d.w[k] = at - Ball(range.center[k]) + Ball(0.0, range.half[k]);
      const Ball gap = at - Ball(range.center[k]);
      apart |= gap.low() > range.half[k] || gap.high() < -range.half[k];
    }
    if (!apart) return std::nullopt;
    tried.push_back(d);
  }
  for (const Direction& d : tried)
    if (std::ranges::all_of(pairs, [&](const GainPair& g) {
          const LocalForm& other = forms[g.j];
          return forms[g.i].site == own.site &&
                 (other.site == index.face(edge.triangle[0]) ||
                  other.site == index.face(edge.triangle[1]) || gains(g.slope, range, d.w));
        }))
      return d;
  return std::nullopt;
}

std::optional<Direction> FaceEngine::direction(std::span<const GainPair> pairs,
                                               std::span<const LocalForm> forms,
                                               const Range& range) {
  const Solid& solid = context_.geometry.solid();
  const auto along =
      [&](std::span<const std::array<double, 2>> against) -> std::optional<Direction> {
    const auto w2 = opposite(against);
    if (!w2) return std::nullopt;
    Direction d;
    d.w[u_] = Ball((*w2)[0]);
    d.w[v_] = Ball((*w2)[1]);
    if (!gain_along(pairs, forms, range, d)) return std::nullopt;
    return d;
  };
  std::vector<std::array<double, 2>> against;
  for (const GainPair& p : pairs)
    against.push_back({p.slope.gradient[u_].mid, p.slope.gradient[v_].mid});
  if (const auto d = along(against)) return d;

  // By all directions of their feet, where edges are so near that gradients vary too much.
  against.clear();
  bool known = true;
  for (const GainPair& p : pairs) {
    const auto& [f, g, tie] = p.slope.fans;
    if (p.slope.constant) against.push_back({p.slope.gradient[u_].mid, p.slope.gradient[v_].mid});
    known &= p.slope.constant || (f.count > 0 && g.count > 0);
    for (int i = 0; i < f.count; ++i)
      for (int j = 0; j < g.count; ++j)
        against.push_back(
            {f.end[i][u_].mid - g.end[j][u_].mid, f.end[i][v_].mid - g.end[j][v_].mid});
  }
  if (known)
    if (const auto d = along(against)) return d;

  if (context_.voronoi())
    if (const auto d = along_strip(pairs, forms, range)) return d;

  // Sites that meet in a vertex: by their corners as seen from there.
  against.clear();
  bool meet = false;
  for (const GainPair& p : pairs) {
    const SiteId a = forms[p.i].site, b = forms[p.j].site;
    const CommonCorners common = common_corners(context_.geometry, a, b);
    if (common.count != 1) {
      against.push_back({p.slope.gradient[u_].mid, p.slope.gradient[v_].mid});
      continue;
    }
    meet = true;
    const Point3& o = solid.point[common.vertex[0]];
    for (const auto& [site, sign] : {std::pair{a, -1.0}, std::pair{b, 1.0}}) {
      int n = 0;
      const auto corner = context_.geometry.corners(site, n);
      for (int k = 0; k < n; ++k)
        if (corner[k] != common.vertex[0])
          against.push_back({sign * (solid.point[corner[k]][u_] - o[u_]),
                             sign * (solid.point[corner[k]][v_] - o[v_])});
    }
  }
  if (!meet || context_.voronoi()) return std::nullopt;
  if (const auto d = along(against)) return d;

  // By the planes through their common convex edges, or through one and an edge of one of them.
  for (const GainPair& p : pairs) {
    const CommonCorners common =
        common_corners(context_.geometry, forms[p.i].site, forms[p.j].site);
    std::vector<std::uint32_t> tip;
    if (common.count == 2) tip.push_back(common.vertex[1]);
    if (common.count == 1)
      for (const SiteId s : {forms[p.i].site, forms[p.j].site}) {
        int n = 0;
        const auto corner = context_.geometry.corners(s, n);
        for (int k = 0; k < n; ++k)
          if (corner[k] != common.vertex[0]) tip.push_back(corner[k]);
      }
    for (const auto t : tip) {
      const Direction d = left_normal(solid, problem_.rect.axis, common.vertex[0], t);
      if (gain_along(pairs, forms, range, d)) return d;
      if (gain_along(pairs, forms, range, d.reversed())) return d.reversed();
    }
  }
  return std::nullopt;
}

bool FaceEngine::directions_exist(std::span<const LocalForm> forms, const Groups& groups,
                                  Rivals& rivals, Directions& found) {
  const Range& range = rivals.range();
  std::vector<std::vector<GainPair>> of_group(groups.count);
  for (auto& pairs : of_group) pairs.reserve(forms.size());
  for (std::uint32_t i = 0; i < forms.size(); ++i)
    for (std::uint32_t j = i + 1; j < forms.size(); ++j) {
      if (groups.of[i] == groups.of[j] || !rivals.meet(i, j)) continue;
      of_group[groups.of[i]].push_back({i, j, pair_slope(context_, forms[i], forms[j], range)});
      of_group[groups.of[j]].push_back({j, i, pair_slope(context_, forms[j], forms[i], range)});
    }
  found.assign(groups.count, std::nullopt);
  for (std::uint32_t g = 0; g < groups.count; ++g)
    if (!of_group[g].empty() && !(found[g] = direction(of_group[g], forms, range))) return false;
  return true;
}

}  // namespace blum
