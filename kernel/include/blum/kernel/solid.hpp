/// A validated polyhedral solid: closed oriented triangle surface with its exact local geometry.
///
/// Orientation: triangles are counter-clockwise seen from outside, voids included (their normals
/// point into the void). Coordinates are in the *working frame*: see Frame.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "blum/kernel/mesh.hpp"
#include "blum/kernel/point.hpp"
#include "blum/kernel/result.hpp"

namespace blum {

/// model = origin + 2^exponent * working. Chosen so that every working coordinate is *exactly* the
/// model's (no rounding) and |working| <= 1. The origin is 0 on an axis where translating would
/// round.
struct Frame {
  Point3 origin;
  int exponent = 0;
  [[nodiscard]] Point3 to_model(const Point3& working) const;
  [[nodiscard]] double length_to_model(double working_length) const;
  /// Exact for the solid's points; others are rounded.
  [[nodiscard]] Point3 to_working(const Point3& model) const;
  [[nodiscard]] double length_to_working(double model_length) const;
};

/// Interior dihedral angle, decided exactly: convex < 180 degrees, flat == 180, reflex > 180.
enum class EdgeKind : std::uint8_t { kConvex, kFlat, kReflex };

struct SolidEdge {
  std::array<std::uint32_t, 2> vertex;  ///< vertex[0] -> vertex[1] is its direction in triangle[0]
  std::array<std::uint32_t, 2> triangle;  ///< the two incident triangles
  EdgeKind kind = EdgeKind::kFlat;
};

struct SolidTriangle {
  std::array<std::uint32_t, 3> vertex;
  std::array<std::uint32_t, 3> edge;  ///< edge[k] joins vertex[k] and vertex[(k+1)%3]
  std::uint32_t facet = 0;            ///< maximal set of triangles joined by flat edges
  std::uint32_t shell = 0;            ///< connected component of the boundary
};

struct Shell {
  int genus = 0;
  bool is_void = false;         ///< normals point inwards: bounds a void
  std::uint32_t component = 0;  ///< component of the solid it bounds
};

struct Solid {
  Frame frame;
  std::vector<Point3> point;
  std::vector<SolidEdge> edge;
  std::vector<SolidTriangle> triangle;
  std::vector<Shell> shell;
  std::uint32_t facets = 0;
  std::uint32_t components = 0;

  /// Incidences in compressed rows: edges (triangles) at vertex v are
  /// vertex_edge[vertex_edge_begin[v] .. vertex_edge_begin[v+1]).
  std::vector<std::uint32_t> vertex_edge, vertex_edge_begin;
  std::vector<std::uint32_t> vertex_triangle, vertex_triangle_begin;

  /// A vertex whose polar cone {x : x.e <= 0 for all incident edge directions e} has no interior
  /// (exact test): its Voronoi region has none either, so it is no site.
  std::vector<bool> vertex_degenerate;

  std::vector<std::string> warnings;  ///< e.g. non-planar polygons triangulated, file turned round

  [[nodiscard]] std::span<const std::uint32_t> edges_at(std::uint32_t v) const {
    return std::span(vertex_edge)
        .subspan(vertex_edge_begin[v], vertex_edge_begin[v + 1] - vertex_edge_begin[v]);
  }
  [[nodiscard]] std::span<const std::uint32_t> triangles_at(std::uint32_t v) const {
    return std::span(vertex_triangle)
        .subspan(vertex_triangle_begin[v], vertex_triangle_begin[v + 1] - vertex_triangle_begin[v]);
  }
  /// The edge that two triangles have in common.
  [[nodiscard]] std::optional<std::uint32_t> common_edge(std::uint32_t a, std::uint32_t b) const;
  /// Betti numbers of the solid (theory section 7): components, sum of genera, voids.
  [[nodiscard]] std::array<long, 3> betti() const;
};

/// Validates `mesh` exactly and builds the solid. An invalid mesh gives ErrorCode::kInvalidSolid
/// with all defects in the message; validate_mesh (validate.hpp) gives them as data.
[[nodiscard]] Result<Solid> build_solid(const PolygonMesh& mesh);

}  // namespace blum
