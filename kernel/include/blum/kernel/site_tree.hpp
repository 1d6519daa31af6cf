/// Nearest boundary point and within-distance queries over the triangles of a solid.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "blum/kernel/point.hpp"
#include "blum/kernel/solid.hpp"

namespace blum {

/// A certified enclosure lo <= value <= hi of a squared distance (working units squared).
struct SquaredDistanceBounds {
  double lo = 0, hi = 0;
};

struct TriangleDistance {
  std::uint32_t triangle = 0;
  SquaredDistanceBounds squared;
};

struct NearestTriangle {
  std::uint32_t triangle = 0;  ///< smallest index among the exactly nearest ones
  Point3 foot;                 ///< its point nearest to the query, rounded
  SquaredDistanceBounds squared_distance;
};

enum class TreeEngine : std::uint8_t {
  kTree,        ///< bounding volumes, certified double bounds, exact arithmetic where these overlap
  kBruteForce,  ///< all triangles, exact arithmetic alone: the tree's twin in tests
};

/// Both engines give the same triangles. Cheap to copy; queries are const and safe from many
/// threads. Points: finite, in the working frame, of absolute value <= 2^100.
class SiteTree {
 public:
  /// Requires: at least one triangle.
  explicit SiteTree(const Solid& solid, TreeEngine engine = TreeEngine::kTree);

  /// Of the boundary. The cheapest query: ties need not be decided.
  [[nodiscard]] SquaredDistanceBounds squared_distance(const Point3& q) const;
  [[nodiscard]] NearestTriangle nearest(const Point3& q) const;
  /// All triangles at the least distance, and perhaps others whose enclosures overlap that of it:
  /// no exact arithmetic is used. In an order that depends on the tree.
  [[nodiscard]] std::vector<TriangleDistance> possibly_nearest(const Point3& q) const;
  /// All triangles at exactly the least distance, in increasing order.
  [[nodiscard]] std::vector<std::uint32_t> all_nearest(const Point3& q) const;
  /// All triangles with squared distance <= squared_radius, in increasing order.
  [[nodiscard]] std::vector<std::uint32_t> within(const Point3& q, double squared_radius) const;
  /// All triangles whose bounding boxes meet `box` (both closed), in increasing order.
  [[nodiscard]] std::vector<std::uint32_t> boxes_meeting(const Box3& box) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

/// For one triangle. The width of the enclosure of the distance is about 1e-14 of the distance of
/// q to the farthest vertex, unless the triangle is a sliver (then wider, still certified).
[[nodiscard]] SquaredDistanceBounds squared_distance_to_triangle(
    const Point3& q, const std::array<Point3, 3>& triangle, Point3* foot = nullptr);

/// Exact sign of (squared distance from q to s) - (squared distance from q to t). Requires:
/// neither triangle collinear.
[[nodiscard]] int compare_distance_to_triangles(const Point3& q, const std::array<Point3, 3>& s,
                                                const std::array<Point3, 3>& t);

}  // namespace blum
