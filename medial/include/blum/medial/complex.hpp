/// The cell complex K of theory section 4: a finite regular-enough 2-complex given by its vertices,
/// edges (with their two ends) and triangles (with their three edges). Parallel edges are legal,
/// so cells are never identified by their vertices.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "blum/kernel/point.hpp"
#include "blum/kernel/site.hpp"

namespace blum {

struct ComplexVertex {
  enum class Kind : std::uint8_t {
    kArcPoint,    ///< an essential tie crosses an edge of the subdivision
    kEvent,       ///< a seam crosses a face of the subdivision
    kRim,         ///< a rim inside the solid crosses a face of the subdivision
    kConvexEdge,  ///< a convex boundary edge crosses a face of the subdivision (radius 0)
    kBoundary,    ///< a boundary vertex where convex edges meet (radius 0)
    kCone,        ///< the apex of a leaf
    kMesh,  ///< on an edge of the certified complex, or in one of its triangles (finer meshes)
  };
  Point3 position;       ///< model units
  double radius = 0;     ///< model units: distance from `position` to ∂O
  bool on_axis = false;  ///< lies on M (or on ∂M, at convex edges), to 1e-9 of the diagonal
  Kind kind = Kind::kCone;
  std::vector<SiteId> governors;
};

struct ComplexEdge {
  enum class Kind : std::uint8_t {
    kArc,         ///< part of an essential arc on a face of the subdivision
    kConvexEdge,  ///< part of a convex boundary edge inside a leaf
    kCone,        ///< joins a vertex on a leaf's boundary to the leaf's apex
  };
  std::array<std::uint32_t, 2> vertex;
  Kind kind = Kind::kArc;
  std::uint32_t leaf = 0;             ///< kCone: index of the cone (ComplexCone)
  std::array<SiteId, 2> governors{};  ///< kArc: one on each side; kCone over an arc point: same
};

/// Cone over one edge (kArc or kConvexEdge) with apex `cone`. edge[0] is the base, edge[1] joins
/// the base's vertex[0] to the apex, edge[2] the base's vertex[1]. In finer meshes a part of such a
/// cone, with any edge for base.
struct ComplexTriangle {
  std::array<std::uint32_t, 3> edge;
  std::uint32_t cone = 0;
  std::array<SiteId, 2> governors{};  ///< those of the base arc
};

/// One cone: the part of K in a leaf that belongs to one component of its graph; with a tube, three
/// of them.
struct ComplexCone {
  std::uint32_t leaf = 0;
  std::uint32_t apex = 0;  ///< vertex index
  /// Theorem B: the apex stands for this boundary vertex (never a junction); kNone otherwise.
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::uint32_t boundary_vertex = kNone;
  /// Theorem T: the apex is on a ring of three, the first of which is that of this cone; kNone for
  /// that one. Cones of the ring have edges of others for bases.
  std::uint32_t ring = kNone;
};

struct CellComplex {
  std::vector<ComplexVertex> vertex;
  std::vector<ComplexEdge> edge;
  std::vector<ComplexTriangle> triangle;
  std::vector<ComplexCone> cone;
};

/// Its vertices: the ends of edge[0] in their order, then the one that edge[1] joins the first to.
[[nodiscard]] std::array<std::uint32_t, 3> corners(const CellComplex& complex,
                                                   const ComplexTriangle& triangle);

/// Betti numbers b0, b1, b2 over Z/2.
[[nodiscard]] std::array<long, 3> betti_numbers(const CellComplex& complex);

}  // namespace blum
