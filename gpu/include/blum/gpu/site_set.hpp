/// What a field is the distance to: points, segments and polygons of any kind, as given.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "blum/kernel/mesh.hpp"
#include "blum/kernel/point.hpp"
#include "blum/kernel/result.hpp"
#include "blum/kernel/site.hpp"
#include "blum/kernel/site_tree.hpp"

namespace blum {

/// Input as it comes: open, non-manifold, intersecting, with duplicates; nothing is assumed.
struct Soup {
  std::vector<Point3> points;                          ///< may hold points that nothing uses
  std::vector<std::uint32_t> isolated;                 ///< points that are sites by themselves
  std::vector<std::array<std::uint32_t, 2>> segments;  ///< ends may coincide
  std::vector<std::vector<std::uint32_t>> polygons;    ///< >= 3 corners each
};

/// All faces of the mesh as polygons; where there are none, all points.
[[nodiscard]] Soup soup_of(PolygonMesh mesh);

inline constexpr SiteId kNoSite{0xffffffffu};

/// The sites of a soup. Ids: points first, in the order of Soup::points, then edges, then polygons.
/// Edges are the segments, in their order, then the sides of the polygons in order of their first
/// appearance; equal pairs of points are one edge.
///
/// **The tie rule.** Sites are closed here: an edge contains its ends, a polygon its sides. Where
/// several sites are nearest the one with the lowest id owns the sample, so a foot on a vertex
/// belongs to the vertex, one on a side to the side, and between equal kinds the earlier wins.
class SiteSet {
 public:
  /// Errors: an index out of range, a coordinate not finite or beyond 2^200 (`element`: the point,
  /// segment or polygon); a polygon with a repeated corner or that meets itself, since it bounds no
  /// definite area (kBadArgument, `element`: the polygon); nothing at all (kNoFaces). Polygons that
  /// are not planar are triangulated by the rule of validate.hpp. Triangles and polygons without
  /// area are their sides.
  [[nodiscard]] static Result<SiteSet> build(const Soup& soup);

  struct Triangle {
    std::array<std::uint32_t, 3> point;
    std::uint32_t polygon;
  };
  /// A side common to two triangles of one polygon: belongs to the polygon, is no edge.
  struct Diagonal {
    std::array<std::uint32_t, 2> point;
    std::uint32_t polygon;
  };

  [[nodiscard]] std::span<const Point3> points() const { return points_; }
  [[nodiscard]] bool is_used(std::uint32_t point) const { return used_[point] != 0; }
  [[nodiscard]] std::span<const std::array<std::uint32_t, 2>> edges() const { return edges_; }
  [[nodiscard]] std::span<const Triangle> triangles() const { return triangles_; }
  [[nodiscard]] std::span<const Triangle> triangles_of(std::uint32_t polygon) const {
    return triangles().subspan(triangle_begin_[polygon],
                               triangle_begin_[polygon + 1] - triangle_begin_[polygon]);
  }
  [[nodiscard]] std::span<const Diagonal> diagonals() const { return diagonals_; }
  [[nodiscard]] std::uint32_t polygons() const { return polygons_; }

  [[nodiscard]] std::uint32_t size() const {
    return static_cast<std::uint32_t>(points_.size() + edges_.size()) + polygons_;
  }
  [[nodiscard]] SiteId vertex(std::uint32_t point) const { return {point}; }
  [[nodiscard]] SiteId edge(std::uint32_t e) const {
    return {static_cast<std::uint32_t>(points_.size()) + e};
  }
  [[nodiscard]] SiteId polygon(std::uint32_t f) const {
    return {static_cast<std::uint32_t>(points_.size() + edges_.size()) + f};
  }
  [[nodiscard]] SiteKind kind(SiteId s) const {
    return s.value < points_.size()                   ? SiteKind::kVertex
           : s.value < points_.size() + edges_.size() ? SiteKind::kEdge
                                                      : SiteKind::kFace;
  }
  /// Index of the point, edge or polygon.
  [[nodiscard]] std::uint32_t element(SiteId s) const {
    const auto points = static_cast<std::uint32_t>(points_.size());
    const auto edges = static_cast<std::uint32_t>(edges_.size());
    return s.value < points           ? s.value
           : s.value < points + edges ? s.value - points
                                      : s.value - points - edges;
  }
  /// Is there such a site? Not with ids too great, nor points that nothing uses.
  [[nodiscard]] bool is_site(SiteId s) const {
    return s.value < size() && (kind(s) != SiteKind::kVertex || is_used(element(s)));
  }
  /// Bounds of the squared distance from q to a closed site, and its foot. A polygon without area
  /// is infinitely far: its sides are sites. Requires |q| <= 2^200 on every axis.
  [[nodiscard]] SquaredDistanceBounds squared_distance(const Point3& q, SiteId s,
                                                       Point3* foot = nullptr) const;
  /// The input's parts as closed sets, numbered: isolated points, segments, polygons.
  [[nodiscard]] std::uint32_t primitives() const {
    return static_cast<std::uint32_t>(piece_begin_.size() - 1);
  }
  /// A primitive as triangles, of which corners may coincide.
  [[nodiscard]] std::span<const std::array<std::uint32_t, 3>> pieces(
      std::uint32_t primitive) const {
    return std::span(pieces_).subspan(piece_begin_[primitive],
                                      piece_begin_[primitive + 1] - piece_begin_[primitive]);
  }
  [[nodiscard]] SquaredDistanceBounds primitive_squared_distance(const Point3& q,
                                                                 std::uint32_t primitive) const;
  /// Of the points that are used.
  [[nodiscard]] const Box3& box() const { return box_; }

 private:
  std::vector<Point3> points_;
  std::vector<std::uint8_t> used_;
  std::vector<std::array<std::uint32_t, 2>> edges_;
  std::vector<Triangle> triangles_;  // by polygon
  std::vector<std::uint32_t> triangle_begin_;
  std::vector<Diagonal> diagonals_;
  std::vector<std::array<std::uint32_t, 3>> pieces_;
  std::vector<std::uint32_t> piece_begin_;
  std::uint32_t polygons_ = 0;
  Box3 box_;
};

}  // namespace blum
