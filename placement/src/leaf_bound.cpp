#include "leaf_bound.hpp"

#include <algorithm>
#include <cmath>

#include "blum/kernel/point_algebra.hpp"

namespace blum {
namespace {

/// Working units: what roundings of positions and distances (numbers of at most 4) can amount to.
constexpr double kRounding = 1e-13;
/// Boxes and triangles are not divided below this part of the target.
constexpr double kFinest = 1.0 / 12;
constexpr std::size_t kMostBoxes = 4'000'000;
constexpr std::size_t kMostAnchors = 1'000;

double radius_about(const Point3& center, const std::array<Point3, 3>& triangle) {
  double r = 0;
  for (const Point3& p : triangle) r = std::max(r, distance_between(center, p));
  return r;
}

/// Distance from x to the triangle, in double: never less than it but for rounding, for the point
/// that is used lies on the triangle.
double distance_to(const std::array<Point3, 3>& triangle, const Point3& x) {
  const auto& [a, b, c] = triangle;
  const Point3 ab = b - a, ac = c - a, ax = x - a;
  const double d00 = inner(ab, ab), d01 = inner(ab, ac), d11 = inner(ac, ac);
  const double d20 = inner(ax, ab), d21 = inner(ax, ac), det = d00 * d11 - d01 * d01;
  // Slivers are measured by their edges, which are at most farther.
  if (det > 1e-12 * d00 * d11) {
    const double s = (d11 * d20 - d01 * d21) / det, t = (d00 * d21 - d01 * d20) / det;
    if (s >= 0 && t >= 0 && s + t <= 1) return length(ax - s * ab - t * ac);
  }
  const auto to_edge = [&](const Point3& p, const Point3& q) {
    const Point3 d = q - p;
    const double square = inner(d, d);
    const double s = square > 0 ? std::clamp(inner(x - p, d) / square, 0.0, 1.0) : 0;
    return length(x - p - s * d);
  };
  return std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
}

/// A point of the leaf that is certainly within a distance of the axis.
struct Anchor {
  Point3 point;
  double distance = 0;
};

/// What the distance from a triangle to the axis may be shown by.
enum class Ways : std::uint8_t { kOwnSides, kAnySides };

/// Largest distance from a triangle of the complex to the axis.
class TriangleBound {
 public:
  /// Distances may go by way of the anchors.
  TriangleBound(BoundTools& tools, const LeafSides& leaf, double target, Ways ways,
                const std::vector<Anchor>& anchors)
      : tools_(tools),
        leaf_(leaf),
        target_(target),
        ways_(ways),
        anchors_(anchors),
        distance_(tools.geometry, tools.engine, tools.tree, tools.inside) {}

  std::optional<double> run(const LeafTriangle& t) {
    std::vector<std::array<Point3, 3>> stack{t.corner};
    double most = 0;
    while (!stack.empty()) {
      if (tools_.stop) return std::nullopt;
      const auto part = stack.back();
      stack.pop_back();
      const Point3 center = (1.0 / 3) * (part[0] + part[1] + part[2]);
      const double reach = radius_about(center, part);
      ++tools_.points;
      if (reach + 2 * kRounding < target_) {
        const double off =
            from_axis(center, t, target_ - reach - 2 * kRounding) + reach + kRounding;
        if (off <= target_) {
          most = std::max(most, off);
          continue;
        }
      }
      if (reach < kFinest * target_) return std::nullopt;
      const Point3 ab = middle(part[0], part[1]), bc = middle(part[1], part[2]),
                   ca = middle(part[2], part[0]);
      stack.push_back({part[0], ab, ca});
      stack.push_back({ab, part[1], bc});
      stack.push_back({ca, bc, part[2]});
      stack.push_back({ab, bc, ca});
    }
    return most;
  }

 private:
  double from_axis(const Point3& p, const LeafTriangle& t, double most) {
    if (ways_ == Ways::kAnySides && distance_.is_within(p, most)) return most;
    double best = std::numeric_limits<double>::infinity();
    if (const auto d = distance_.at_most(p, t.a, t.b)) best = *d;
    for (std::size_t k = 0; k < 3; ++k)
      if (t.on_rim[k]) best = std::min(best, distance_between(p, t.corner[k]));
    for (const Anchor& a : anchors_)
      best = std::min(best, distance_between(p, a.point) + a.distance);
    if (best < most) return best;
    if (const auto d = distance_.exactly_at_most(p, t.a, t.b, leaf_, most))
      return std::min(best, *d);
    // Outside the solid, or where a sheet is too flat: by way of a corner.
    for (const Point3& q : t.corner) {
      const double way = distance_between(p, q);
      if (!(way < best)) continue;
      if (const auto d = distance_.at_most(q, t.a, t.b)) best = std::min(best, way + *d);
    }
    return best;
  }

  BoundTools& tools_;
  const LeafSides& leaf_;
  const double target_;
  const Ways ways_;
  const std::vector<Anchor>& anchors_;
  AxisDistance distance_;
};

std::vector<Anchor> anchors_of(BoundTools& tools, const std::vector<LeafTriangle>& triangles) {
  const AxisDistance distance(tools.geometry, tools.engine, tools.tree, tools.inside);
  std::vector<Anchor> anchors;
  for (const LeafTriangle& t : triangles) {
    if (tools.stop || anchors.size() >= kMostAnchors) break;
    for (std::size_t k = 0; k < 3; ++k)
      if (t.on_rim[k])
        anchors.push_back({t.corner[k], 0});
      else if (const auto d = distance.at_most(t.corner[k], t.a, t.b))
        anchors.push_back({t.corner[k], *d});
  }
  return anchors;
}

struct Box {
  Box3 box;
  std::vector<SiteId> candidates;
  std::vector<std::uint32_t> near;  ///< triangles that may be the nearest to a point of it
};

/// Largest distance from the axis in the leaf to the triangles.
std::optional<double> axis_bound(BoundTools& tools, const LeafSides& leaf,
                                 const std::vector<LeafTriangle>& triangles, double target) {
  std::vector<Box> stack(1);
  stack[0].box = leaf.box();
  stack[0].candidates.assign(leaf.candidates().begin(), leaf.candidates().end());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) stack[0].near.push_back(t);
  double most = 0;
  std::vector<double> way;
  for (std::size_t n = 0; !stack.empty(); ++n) {
    if (tools.stop || n > kMostBoxes) return std::nullopt;
    Box part = std::move(stack.back());
    stack.pop_back();
    ++tools.boxes;
    const Point3 center = middle(part.box.lo, part.box.hi);
    const double reach = 0.5 * diameter(part.box) + kRounding;
    double least = std::numeric_limits<double>::infinity();
    way.clear();
    for (const auto t : part.near) {
      way.push_back(distance_to(triangles[t].corner, center));
      least = std::min(least, way.back());
    }
    if (least + reach <= target) {
      most = std::max(most, least + reach);
      continue;
    }
    part.candidates = tools.engine.prune(part.candidates, part.box.lo, part.box.hi);
    if (part.candidates.size() <= 1 ||
        tools.engine.tie_groups(part.candidates, part.box.lo, part.box.hi).size() == 1)
      continue;
    // Outside the solid there is no axis.
    if (tools.inside.locate(center) == InsideOracle::Where::kOutside &&
        tools.tree.squared_distance(center).lo > reach * reach * 1.0001)
      continue;
    if (reach < kFinest * target) return std::nullopt;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < part.near.size(); ++k)
      if (way[k] <= least + 2 * reach) part.near[kept++] = part.near[k];
    part.near.resize(kept);
    int axis = 0;
    for (int k = 1; k < 3; ++k)
      if (part.box.hi[k] - part.box.lo[k] > part.box.hi[axis] - part.box.lo[axis]) axis = k;
    Box high = part;
    part.box.hi[axis] = high.box.lo[axis] = center[axis];
    stack.push_back(std::move(high));
    stack.push_back(std::move(part));
  }
  return most;
}

std::optional<double> bound_from(BoundTools& tools, const LeafSides& leaf,
                                 const std::vector<LeafTriangle>& triangles, double target,
                                 Ways ways, const std::vector<Anchor>& anchors) {
  TriangleBound from_triangles(tools, leaf, target, ways, anchors);
  double most = 0;
  for (const LeafTriangle& t : triangles) {
    const auto bound = from_triangles.run(t);
    if (!bound) return std::nullopt;
    most = std::max(most, *bound);
  }
  const auto bound = axis_bound(tools, leaf, triangles, target);
  if (!bound) return std::nullopt;
  return std::max(most, *bound);
}

}  // namespace

std::optional<double> bound_in_leaf(BoundTools& tools, const LeafSides& leaf,
                                    const std::vector<LeafTriangle>& triangles, double target) {
  const bool well_placed = std::all_of(triangles.begin(), triangles.end(),
                                       [](const LeafTriangle& t) { return t.well_placed; });
  return bound_from(tools, leaf, triangles, target, well_placed ? Ways::kAnySides : Ways::kOwnSides,
                    {});
}

LeafBound least_bound_in_leaf(BoundTools& tools, const LeafSides& leaf,
                              const std::vector<LeafTriangle>& triangles, double target,
                              double diameter) {
  if (!(target < diameter)) return {diameter, diameter <= target};
  if (const auto bound = bound_in_leaf(tools, leaf, triangles, target)) return {*bound, true};
  const std::vector<Anchor> anchors = anchors_of(tools, triangles);
  for (double most = target; most < diameter && !tools.stop; most *= 2)
    if (const auto bound = bound_from(tools, leaf, triangles, most, Ways::kAnySides, anchors))
      return {*bound, false};
  return {diameter, false};
}

}  // namespace blum
