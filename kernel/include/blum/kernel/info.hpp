/// What `blum info` prints about a mesh, valid or not.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "blum/kernel/mesh.hpp"
#include "blum/kernel/point.hpp"
#include "blum/kernel/validate.hpp"

namespace blum {

struct MeshInfo {
  // Of the mesh as read; always there.
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t polygon_faces = 0;     ///< faces with more than three vertices
  std::size_t edges = 0;             ///< distinct vertex pairs in faces
  std::size_t triangles = 0;         ///< after triangulation (faces that allow it)
  std::optional<Box3> bounding_box;  ///< of the finite vertices, model units; none without them
  std::size_t short_edges = 0;       ///< shorter than 1e-6 of the bounding box's diagonal
  double shortest_edge_over_diagonal = 0;
  ValidationReport validation;

  /// Only of a valid solid.
  struct SolidInfo {
    std::size_t triangle_edges = 0;  ///< edges of the triangulated surface
    std::size_t components = 0;
    std::size_t shells = 0;
    std::size_t voids = 0;
    std::size_t facets = 0;
    std::vector<int> genus_per_shell;
    std::array<long, 3> betti{};
    double min_dihedral_deg = 0, max_dihedral_deg = 0;  ///< interior, over the mesh's edges
    std::size_t coplanar_pairs = 0;                     ///< adjacent faces, exactly coplanar
    std::size_t nearly_coplanar_pairs = 0;  ///< within 1e-4 degrees of flat, exact ones included
    std::size_t convex_edges = 0, reflex_edges = 0;  ///< exact
    std::size_t degenerate_vertices = 0;             ///< see Solid::vertex_degenerate
    double volume = 0;                               ///< model units, rounded
    int frame_exponent = 0;
    Point3 frame_origin;
  };
  std::optional<SolidInfo> solid;
  std::vector<std::string> warnings;
};

/// Never fails: what is wrong with the mesh is in `validation`.
[[nodiscard]] MeshInfo mesh_info(const PolygonMesh& mesh);

}  // namespace blum
