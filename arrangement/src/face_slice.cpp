// Parts of a face whose sites nearly lie in planes and lines through one vertex: the flow to the
// boundary, seen from there, stays in the part's plane and crosses no tie (Theorem S).
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "blum/arrangement/polar_cone.hpp"
#include "blum/kernel/closest_point.hpp"
#include "face_engine.hpp"
#include "fan.hpp"

namespace blum {
namespace {

constexpr double kUp = 1 + 0x1p-40;
constexpr std::size_t kCenters = 6;  // vertices tried: those that most sites have

/// Upper bound of |n . (y - v)| for feet y on the site, n the direction from y to a point with it.
double offset(EngineContext& context, SiteId site, std::uint32_t v) {
  const SiteGeometry& geometry = context.geometry;
  if (geometry.has_corner(site, v)) return 0;
  switch (geometry.index().kind(site)) {
    case SiteKind::kVertex:
      return std::numeric_limits<double>::infinity();
    case SiteKind::kFace:
      return context.height(v, site).magnitude();
    case SiteKind::kEdge:
      break;
  }
  const double plain = length_above(
      cross(geometry.unit(site), difference(geometry.solid().point[v], geometry.base(site))));
  // By its heights over the two planes at the edge, which are precise however small they are.
  const auto& beside = geometry.solid().edge[geometry.index().element(site)].triangle;
  const SiteId a = geometry.index().face(beside[0]), b = geometry.index().face(beside[1]);
  const BallVector turn = cross(geometry.unit(a), geometry.unit(b));
  const double sine = std::sqrt(std::max(0.0, dot(turn, turn).low()));
  if (!(sine > 0)) return plain;
  return std::min(
      plain, (context.height(v, a).magnitude() + context.height(v, b).magnitude()) / sine * kUp);
}

/// Vertices, those first that are corners of most forms; the given number of them.
std::vector<std::uint32_t> common_corners_first(const SiteGeometry& geometry,
                                                std::span<const LocalForm> forms) {
  std::map<std::uint32_t, std::size_t> count;
  for (const LocalForm& f : forms) {
    int n = 0;
    const auto corner = geometry.corners(f.site, n);
    for (int k = 0; k < n; ++k) ++count[corner[k]];
  }
  std::vector<std::uint32_t> vertices;
  for (const auto& [v, times] : count) vertices.push_back(v);
  std::ranges::stable_sort(vertices, [&](auto a, auto b) { return count[a] > count[b]; });
  return vertices;
}

}  // namespace

bool FaceEngine::flow_parts_all(std::uint32_t v, const Box& box, std::span<const LocalForm> forms) {
  const SiteGeometry& geometry = context_.geometry;
  const Rect& r = problem_.rect;
  const Range range = range_of(box);
  const Ball over = Ball(r.level) - Ball(geometry.solid().point[v][r.axis]);
  const double height = std::max(over.low(), -over.high());
  if (!(height > 0)) return false;
  double distance = std::numeric_limits<double>::infinity(), farthest_off = 0;
  std::vector<double> off;
  for (const LocalForm& f : forms) {
    const BallVector d = difference(closest_point(geometry, f.site, range.center), range.center);
    distance = std::min(distance, (length_above(d) + kOnSite + range.radius()) * kUp);
    off.push_back(offset(context_, f.site, v));
    farthest_off = std::max(farthest_off, off.back());
  }
  // The distance falls along the flow.
  if (!((distance + farthest_off) * kUp < height)) return false;
  for (std::size_t i = 0; i < forms.size(); ++i)
    for (std::size_t j = i + 1; j < forms.size(); ++j) {
      if (off[i] == 0 && off[j] == 0) continue;
      if (!may_both_govern(context_, forms[i], forms[j], range)) continue;
      if (!(fans_apart(context_, forms[i], forms[j], range) * height > (off[i] + off[j]) * kUp))
        return false;
    }
  return true;
}

bool FaceEngine::flows_in(SiteId site, std::uint32_t v, std::uint8_t side, const Box& box) const {
  // From x towards v + u, seen from v in the plane: along u - (u_n / h) (x - v), h the height of
  // the plane over v. Across a side, x has one coordinate only.
  const Solid& solid = context_.geometry.solid();
  const Rect& r = problem_.rect;
  const Point3& o = solid.point[v];
  const bool along_u = side == kLowV || side == kHighV;  // the side's direction
  const int across = along_u ? v_ : u_;
  const double at = side == kLowV    ? box.v0
                    : side == kHighV ? box.v1
                    : side == kLowU  ? box.u0
                                     : box.u1;
  const bool low = side == kLowV || side == kLowU;
  const Ball height = Ball(r.level) - Ball(o[r.axis]), offset = Ball(at) - Ball(o[across]);
  const int up = height.sign(), inward = low ? up : -up;
  int n = 0;
  const auto corner = context_.geometry.corners(site, n);
  bool known = n > 1 && (up == 1 || up == -1);
  for (int k = 0; k < n; ++k) {
    if (corner[k] == v) continue;
    const Point3& p = solid.point[corner[k]];
    const Ball w =
        (Ball(p[across]) - Ball(o[across])) * height - (Ball(p[r.axis]) - Ball(o[r.axis])) * offset;
    known &= w.sign() == inward;
  }
  return known;
}

std::optional<std::vector<std::uint32_t>> FaceEngine::regions_in_slice(
    const Circle& circle, std::span<const LocalForm> forms, const Groups& feet, std::uint32_t v,
    const Box& box) {
  // Intervals of different groups are of different regions. Of two intervals of one group, one
  // from which the flow enters the part is joined by it to the other.
  auto group = runs_of(circle, forms, feet);
  if (!group) return std::nullopt;
  const auto all_at_v = [&](std::uint32_t g) {
    for (std::size_t i = 0; i < forms.size(); ++i)
      if (feet.of[i] == g && !context_.geometry.has_corner(forms[i].site, v)) return false;
    return true;
  };
  std::vector<bool> enters;  // runs are in the order of the circle from its last separator on
  const std::size_t n = circle.size();
  std::size_t start = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (separates(circle[i])) start = i;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (start + k) % n;
    if (!separates(circle[i])) continue;
    // One interval between two separators lies inside one side.
    const Step &s = circle[(i + 1) % n], &after = circle[(i + 2) % n];
    enters.push_back(s.kind == Step::Kind::kInterval && separates(after) &&
                     context_.geometry.has_corner(s.label, v) && flows_in(s.label, v, s.side, box));
  }
  std::map<std::uint32_t, std::vector<std::uint32_t>> runs;
  for (std::uint32_t k = 0; k < group->size(); ++k) runs[(*group)[k]].push_back(k);
  for (const auto& [g, own] : runs)
    if (own.size() > 1 && (own.size() > 2 || !all_at_v(g) || !(enters[own[0]] || enters[own[1]])))
      return std::nullopt;
  // A region beside itself, or regions that cross: then something above is not as thought.
  std::size_t parts = 1;
  for (const auto& [root, ends] : trees_of(*group)) {
    if (ends.size() < 2) return std::nullopt;
    parts += ends.size() - 1;
  }
  if (parts != runs.size()) return std::nullopt;
  return group;
}

std::optional<std::vector<std::vector<std::uint32_t>>> FaceEngine::slice_from(
    std::uint32_t v, const Box& box, std::span<const LocalForm> forms, const Groups& feet,
    const Border& border) {
  if (!flow_parts_all(v, box, forms)) return std::nullopt;
  std::vector<std::vector<std::uint32_t>> regions;
  for (const Circle& circle : border.circle) {
    regions.emplace_back();
    if (ends_of(circle) <= 3) continue;
    auto region = regions_in_slice(circle, forms, feet, v, box);
    if (!region) return std::nullopt;
    const bool cluster = std::ranges::any_of(
        trees_of(*region), [](const auto& tree) { return tree.second.size() > 3; });
    if (cluster && !may_be_cluster(box, forms, feet, circle)) return std::nullopt;
    regions.back() = std::move(*region);
  }
  return regions;
}

bool FaceEngine::accept_slice(const Box& box, std::span<const LocalForm> forms, const Groups& feet,
                              const Border& border) {
  for (const Circle& circle : border.circle)
    if (ends_of(circle) == 1) return false;
  const Rect& r = problem_.rect;
  const Solid& solid = context_.geometry.solid();
  const Range range = range_of(box);
  const auto vertices = common_corners_first(context_.geometry, forms);
  std::optional<std::vector<std::vector<std::uint32_t>>> regions;
  std::size_t center = 0;
  for (; center < std::min(kCenters, vertices.size()); ++center)
    if ((regions = slice_from(vertices[center], box, forms, feet, border))) break;
  if (!regions) return false;
  // No feet merge: no vertex is one.
  for (const auto v : vertices)
    if (may_be_foot(context_, v, forms, range) &&
        meets_polar_cone(solid, v, point_on(r.axis, r.level, box.u0, box.v0),
                         point_on(r.axis, r.level, box.u1, box.v1)))
      return false;
  for (std::size_t c = 0; c < border.circle.size(); ++c)
    record(border.circle[c], forms, feet, box, (*regions)[c]);
  ++context_.counts.slices;
  note(PartRecord::Kind::kSlice, forms, vertices[center]);
  return true;
}

}  // namespace blum
