/// The boundary of the solid as the checker sees it: corners, edges and triangles, with the sites
/// that can govern inside (docs/proofs.md, "Candidates"). Built from points and triangles alone.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "blum/kernel/union_find.hpp"
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

/// A site by number: vertices first, then edges, then triangles.
using Site = std::uint32_t;
enum class Kind : std::uint8_t { kVertex, kEdge, kFace };

/// docs/proofs.md, "Which vertices are feet" and "Vertices in a boundary cell".
struct VertexCone {
  bool interior = false;        ///< the polar cone has one
  bool never_foot = false;      ///< of no point of the solid
  bool axis_connected = false;  ///< it is certain that the axis near the vertex is connected
};

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
  std::vector<VertexCone> cone;

  [[nodiscard]] Site vertex_site(std::uint32_t v) const { return v; }
  [[nodiscard]] Site edge_site(std::uint32_t e) const { return vertices() + e; }
  [[nodiscard]] Site face_site(std::uint32_t t) const { return vertices() + edges() + t; }
  [[nodiscard]] Kind kind(Site s) const {
    return s < vertices() ? Kind::kVertex : s < vertices() + edges() ? Kind::kEdge : Kind::kFace;
  }
  [[nodiscard]] std::uint32_t element(Site s) const {
    return kind(s) == Kind::kVertex ? s
                                    : s - (kind(s) == Kind::kEdge ? edge_site(0) : face_site(0));
  }
  [[nodiscard]] std::uint32_t sites() const {
    return face_site(static_cast<std::uint32_t>(triangle.size()));
  }
  /// One to three vertices.
  [[nodiscard]] std::span<const std::uint32_t> corners(Site s) const;
  [[nodiscard]] bool has_corner(Site s, std::uint32_t v) const;
  /// Is there such an edge at v?
  [[nodiscard]] bool has(std::uint32_t v, Bend bend) const;
  /// The triangle on the other side of an edge; its other end.
  [[nodiscard]] std::uint32_t across(std::uint32_t e, std::uint32_t t) const {
    return edge[e].triangle[edge[e].triangle[0] == t ? 1 : 0];
  }
  [[nodiscard]] std::uint32_t other_end(std::uint32_t e, std::uint32_t v) const {
    return edge[e].vertex[edge[e].vertex[0] == v ? 1 : 0];
  }
  /// The edge between two vertices.
  [[nodiscard]] std::optional<std::uint32_t> edge_between(std::uint32_t a, std::uint32_t b) const;

  /// Sites that can govern points of the solid, sorted.
  [[nodiscard]] const std::vector<Site>& candidates() const { return candidates_; }

  /// Normal of a triangle, outwards; difference of two vertices. Not of unit length.
  template <class N>
  [[nodiscard]] const Vec<N>& normal(std::uint32_t t) const {
    return normal_[t].template as<N>();
  }
  template <class N>
  [[nodiscard]] Vec<N> along(std::uint32_t a, std::uint32_t b) const {
    return minus<N>(exactly<N>(point[b]), exactly<N>(point[a]));
  }
  /// x - (vertex v).
  template <class N>
  [[nodiscard]] Vec<N> from(std::uint32_t v, const Point3& x) const {
    return minus<N>(exactly<N>(x), exactly<N>(point[v]));
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
  [[nodiscard]] VertexCone cone_of(std::uint32_t v) const;
  /// The triangles at v, by their place there, joined across edges.
  [[nodiscard]] UnionFind chains(std::uint32_t v, bool across_convex) const;
  [[nodiscard]] std::uint32_t place(std::uint32_t v, std::uint32_t t) const {
    const auto& around = triangles_at[v];
    return static_cast<std::uint32_t>(std::ranges::find(around, t) - around.begin());
  }

  std::string defect_;
  std::vector<Exact> normal_;
  std::vector<std::uint32_t> numbers_;  // 0, 1, ...: corners of vertices
  std::vector<Site> candidates_;
};

/// The triangles, of some, that a segment crosses; nullopt where it meets an edge of the surface,
/// or ends on it.
[[nodiscard]] std::optional<std::vector<std::uint32_t>> triangles_crossed(
    const Shape& shape, const Segment& segment, std::span<const std::uint32_t> triangles);

/// Is x inside the solid? nullopt where axis-parallel rays do not tell, or x is on the surface.
[[nodiscard]] std::optional<bool> is_inside(const Shape& shape, const Point3& x);

}  // namespace blum::verify
