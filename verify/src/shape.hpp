/// The boundary of the solid as the checker sees it: corners, edges and triangles, with the sites
/// that can govern inside (docs/proofs.md, "Candidates"). Built from points and triangles alone.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "number.hpp"

namespace blum::verify {

enum class Bend : std::int8_t { kConvex = -1, kFlat = 0, kReflex = 1 };

struct Edge {
  std::array<std::uint32_t, 2> vertex;    ///< in its direction in triangle[0]
  std::array<std::uint32_t, 2> triangle;  ///< counter-clockwise from outside
  Bend bend = Bend::kFlat;
};

struct Triangle {
  std::array<std::uint32_t, 3> vertex;
  std::array<std::uint32_t, 3> edge;  ///< edge[k] joins vertex[k] and vertex[k + 1]
};

/// Up to three vertices.
struct Corners {
  std::array<std::uint32_t, 3> vertex{};
  std::uint32_t count = 0;
  [[nodiscard]] const std::uint32_t* begin() const { return vertex.data(); }
  [[nodiscard]] const std::uint32_t* end() const { return vertex.data() + count; }
  [[nodiscard]] bool has(std::uint32_t v) const {
    for (const auto x : *this)
      if (x == v) return true;
    return false;
  }
};

/// A site by number: vertices first, then edges, then triangles.
using Site = std::uint32_t;
enum class Kind : std::uint8_t { kVertex, kEdge, kFace };

/// Immutable. Requires of the input: a closed, consistently oriented, embedded, vertex-manifold
/// triangle surface without degenerate triangles; what of this is combinatorial is checked.
class Shape {
 public:
  Shape(std::span<const Point3> points, std::span<const std::array<std::uint32_t, 3>> triangles);

  /// Why the surface is none; empty if it is.
  [[nodiscard]] const std::string& defect() const { return defect_; }

  std::vector<Point3> point;
  std::vector<Edge> edge;
  std::vector<Triangle> triangle;
  std::vector<std::vector<std::uint32_t>> edges_at, triangles_at;  // by vertex

  [[nodiscard]] Site vertex_site(std::uint32_t v) const { return v; }
  [[nodiscard]] Site edge_site(std::uint32_t e) const { return vertices() + e; }
  [[nodiscard]] Site face_site(std::uint32_t t) const { return vertices() + edges() + t; }
  [[nodiscard]] Kind kind(Site s) const {
    return s < vertices() ? Kind::kVertex : s < vertices() + edges() ? Kind::kEdge : Kind::kFace;
  }
  [[nodiscard]] std::uint32_t element(Site s) const {
    return s < vertices()             ? s
           : s < vertices() + edges() ? s - vertices()
                                      : s - vertices() - edges();
  }
  [[nodiscard]] std::uint32_t sites() const {
    return vertices() + edges() + static_cast<std::uint32_t>(triangle.size());
  }
  [[nodiscard]] Corners corners(Site s) const;
  /// The triangle on the other side of an edge; the end of an edge at the other end.
  [[nodiscard]] std::uint32_t across(std::uint32_t e, std::uint32_t t) const {
    return edge[e].triangle[edge[e].triangle[0] == t ? 1 : 0];
  }
  [[nodiscard]] std::uint32_t other_end(std::uint32_t e, std::uint32_t v) const {
    return edge[e].vertex[edge[e].vertex[0] == v ? 1 : 0];
  }
  /// The edge between two vertices; nullopt if there is none.
  [[nodiscard]] std::int64_t edge_between(std::uint32_t a, std::uint32_t b) const;

  /// Sites that can govern points of the solid, sorted.
  [[nodiscard]] const std::vector<Site>& candidates() const { return candidates_; }

  /// Normal of a triangle, outwards; direction of an edge. Not of unit length.
  template <class N>
  [[nodiscard]] Vec<N> normal(std::uint32_t t) const {
    if constexpr (std::is_same_v<N, Ball>) return normal_[t];
    const auto& v = triangle[t].vertex;
    const Vec<N> a = exactly<N>(point[v[0]]);
    return outer<N>(minus<N>(exactly<N>(point[v[1]]), a), minus<N>(exactly<N>(point[v[2]]), a));
  }
  template <class N>
  [[nodiscard]] Vec<N> along(std::uint32_t a, std::uint32_t b) const {
    return minus<N>(exactly<N>(point[b]), exactly<N>(point[a]));
  }
  /// Sign of normal . (x - a): negative on the solid's side.
  [[nodiscard]] int side_of_plane(std::uint32_t t, const Point3& x) const;

  /// Betti numbers of the solid (theory section 7): outer shells, sum of genera, voids. Requires
  /// shells that do not meet.
  [[nodiscard]] std::array<long, 3> betti() const;

 private:
  [[nodiscard]] std::uint32_t vertices() const { return static_cast<std::uint32_t>(point.size()); }
  [[nodiscard]] std::uint32_t edges() const { return static_cast<std::uint32_t>(edge.size()); }
  void find_edges();
  void check_manifold();
  void find_candidates();
  [[nodiscard]] bool polar_cone_has_interior(std::uint32_t v) const;

  std::string defect_;
  std::vector<Vec<Ball>> normal_;  // the exact ones rounded: those of slivers lose digits in double
  std::vector<Site> candidates_;
};

}  // namespace blum::verify
