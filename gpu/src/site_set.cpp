#include "blum/gpu/site_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include "blum/kernel/triangulate.hpp"

namespace blum {
namespace {

using Pair = std::array<std::uint32_t, 2>;

std::uint64_t key(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

/// Edges by first appearance.
class EdgeNumbers {
 public:
  void add(std::uint32_t a, std::uint32_t b) {
    if (numbers_.emplace(key(a, b), static_cast<std::uint32_t>(edges_.size())).second) {
      edges_.push_back({a, b});
    }
  }
  [[nodiscard]] bool has(std::uint32_t a, std::uint32_t b) const {
    return numbers_.contains(key(a, b));
  }
  [[nodiscard]] std::vector<Pair> take() { return std::move(edges_); }

 private:
  std::unordered_map<std::uint64_t, std::uint32_t> numbers_;
  std::vector<Pair> edges_;
};

std::optional<Error> coordinate_problem(const Soup& soup) {
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double x = soup.points[i][axis];
      if (!std::isfinite(x)) {
        return Error{ErrorCode::kNonFiniteCoordinate, "a coordinate is not finite", {}, i};
      }
      if (std::abs(x) > 0x1p200) {
        return Error{ErrorCode::kCoordinateOutOfRange, "a coordinate is beyond 2^200", {}, i};
      }
    }
  }
  return std::nullopt;
}

std::optional<Error> index_problem(const Soup& soup) {
  const auto bad = [&](std::uint32_t v) { return v >= soup.points.size(); };
  const auto error = [](const char* what, std::size_t i) {
    return Error{ErrorCode::kIndexOutOfRange, std::string(what) + " names no point", {}, i};
  };
  for (std::size_t i = 0; i < soup.isolated.size(); ++i) {
    if (bad(soup.isolated[i])) return error("an isolated site", i);
  }
  for (std::size_t i = 0; i < soup.segments.size(); ++i) {
    if (bad(soup.segments[i][0]) || bad(soup.segments[i][1])) return error("a segment", i);
  }
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
    if (std::ranges::any_of(soup.polygons[i], bad)) return error("a polygon", i);
    if (soup.polygons[i].size() < 3) {
      return Error{ErrorCode::kBadArgument, "a polygon has fewer than three corners", {}, i};
    }
  }
  return std::nullopt;
}

/// Without corners at the place of the one before.
std::vector<std::uint32_t> distinct_corners(std::span<const Point3> points,
                                            const std::vector<std::uint32_t>& polygon) {
  std::vector<std::uint32_t> corners;
  for (const std::uint32_t v : polygon) {
    if (corners.empty() || points[corners.back()] != points[v]) corners.push_back(v);
  }
  while (corners.size() > 1 && points[corners.back()] == points[corners.front()]) {
    corners.pop_back();
  }
  return corners;
}

bool in_one_line(std::span<const Point3> points, const std::vector<std::uint32_t>& corners) {
  std::vector<std::array<std::uint32_t, 3>> ignored;
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const std::array<std::uint32_t, 3> triangle = {corners[0], corners[1], corners[k]};
    if (triangulate_face(points, triangle, ignored) != FaceShape::kDegenerate) return false;
  }
  return true;
}

}  // namespace

Soup soup_of(PolygonMesh mesh) {
  Soup soup;
  if (mesh.faces.empty()) {
    soup.isolated.resize(mesh.points.size());
    std::iota(soup.isolated.begin(), soup.isolated.end(), 0u);
  }
  soup.points = std::move(mesh.points);
  soup.polygons = std::move(mesh.faces);
  return soup;
}

Result<SiteSet> SiteSet::build(const Soup& soup) {
  if (soup.isolated.empty() && soup.segments.empty() && soup.polygons.empty()) {
    return Error{ErrorCode::kNoFaces, "there is no site", {}, {}};
  }
  if (auto problem = coordinate_problem(soup)) return *problem;
  if (auto problem = index_problem(soup)) return *problem;
  SiteSet set;
  set.points_ = soup.points;
  set.used_.assign(soup.points.size(), 0);
  set.polygons_ = static_cast<std::uint32_t>(soup.polygons.size());
  if (std::uint64_t{set.points_.size()} + soup.segments.size() + 2 * soup.polygons.size() >
      kNoSite.value / 4) {
    return Error{ErrorCode::kBadArgument, "more sites than ids", {}, {}};
  }
  const auto end_primitive = [&] {
    set.piece_begin_.push_back(static_cast<std::uint32_t>(set.pieces_.size()));
  };
  end_primitive();
  for (const std::uint32_t v : soup.isolated) {
    set.used_[v] = 1;
    set.pieces_.push_back({v, v, v});
    end_primitive();
  }

  EdgeNumbers edges;
  const auto add_edge = [&](std::uint32_t a, std::uint32_t b) {
    set.used_[a] = set.used_[b] = 1;
    if (set.points_[a] != set.points_[b]) edges.add(a, b);
  };
  for (const Pair& segment : soup.segments) {
    add_edge(segment[0], segment[1]);
    set.pieces_.push_back({segment[0], segment[1], segment[1]});
    end_primitive();
  }
  std::vector<std::array<std::uint32_t, 3>> pieces;
  std::vector<Pair> inner;
  for (std::uint32_t f = 0; f < set.polygons_; ++f) {
    set.triangle_begin_.push_back(static_cast<std::uint32_t>(set.triangles_.size()));
    const std::vector<std::uint32_t>& polygon = soup.polygons[f];
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      add_edge(polygon[k], polygon[(k + 1) % polygon.size()]);
    }
    const std::vector<std::uint32_t> corners = distinct_corners(set.points_, polygon);
    if (corners.size() < 3 || in_one_line(set.points_, corners)) {
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const std::uint32_t next = polygon[(k + 1) % polygon.size()];
        set.pieces_.push_back({polygon[k], next, next});
      }
      end_primitive();
      continue;
    }
    pieces.clear();
    const FaceShape shape = triangulate_face(set.points_, corners, pieces);
    if (shape == FaceShape::kDegenerate || shape == FaceShape::kNonSimple) {
      return Error{ErrorCode::kBadArgument,
                   "a polygon meets itself or names a corner twice: it bounds no definite area",
                   {},
                   f};
    }
    for (const auto& piece : pieces) set.triangles_.push_back({piece, f});
    set.pieces_.insert(set.pieces_.end(), pieces.begin(), pieces.end());
    end_primitive();
    if (pieces.size() == 1) continue;
    // A diagonal is what two pieces share.
    inner.clear();
    for (const auto& piece : pieces) {
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t a = piece[k], b = piece[(k + 1) % 3];
        inner.push_back({std::min(a, b), std::max(a, b)});
      }
    }
    std::ranges::sort(inner);
    for (std::size_t k = 0; k + 1 < inner.size(); ++k) {
      if (inner[k] == inner[k + 1]) set.diagonals_.push_back({inner[k], f});
    }
  }
  set.triangle_begin_.push_back(static_cast<std::uint32_t>(set.triangles_.size()));
  set.edges_ = edges.take();

  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  set.box_ = {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (std::size_t i = 0; i < set.points_.size(); ++i) {
    if (set.used_[i] == 0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      set.box_.lo[axis] = std::min(set.box_.lo[axis], set.points_[i][axis]);
      set.box_.hi[axis] = std::max(set.box_.hi[axis], set.points_[i][axis]);
    }
  }
  return set;
}

SquaredDistanceBounds SiteSet::primitive_squared_distance(const Point3& q,
                                                          std::uint32_t primitive) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  SquaredDistanceBounds best{kInfinity, kInfinity};
  for (const auto& v : pieces(primitive)) {
    const SquaredDistanceBounds d =
        squared_distance_to_triangle(q, {points_[v[0]], points_[v[1]], points_[v[2]]});
    best = {std::min(best.lo, d.lo), std::min(best.hi, d.hi)};
  }
  return best;
}

SquaredDistanceBounds SiteSet::squared_distance(const Point3& q, SiteId s, Point3* foot) const {
  const std::uint32_t i = element(s);
  if (kind(s) == SiteKind::kVertex) {
    return squared_distance_to_triangle(q, {points_[i], points_[i], points_[i]}, foot);
  }
  if (kind(s) == SiteKind::kEdge) {
    const auto [a, b] = edges_[i];
    return squared_distance_to_triangle(q, {points_[a], points_[b], points_[b]}, foot);
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  SquaredDistanceBounds best{kInfinity, kInfinity};
  for (const Triangle& t : triangles_of(i)) {
    const auto& v = t.point;
    Point3 y;
    const SquaredDistanceBounds d =
        squared_distance_to_triangle(q, {points_[v[0]], points_[v[1]], points_[v[2]]}, &y);
    if (d.hi < best.hi && foot != nullptr) *foot = y;
    best = {std::min(best.lo, d.lo), std::min(best.hi, d.hi)};
  }
  return best;
}

}  // namespace blum
