/// The common part of validate_mesh and build_solid: report, triangles and shells of a mesh.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "blum/kernel/mesh.hpp"
#include "blum/kernel/solid.hpp"
#include "blum/kernel/validate.hpp"
#include "mesh_topology.hpp"

namespace blum {

struct SurfaceShell {
  std::uint32_t first_triangle = 0;
  std::uint32_t depth = 0;      ///< number of other shells around it
  std::uint32_t component = 0;  ///< of the solid; outer shells in order, voids with their shell
};

struct Surface {
  ValidationReport report;
  std::vector<std::array<std::uint32_t, 3>> triangle;  ///< indices into the mesh's points
  std::vector<std::uint32_t> face_of_triangle;
  EdgeTable face_edges;  ///< of faces with good indices
  // Only when report.valid():
  std::vector<std::uint32_t> shell_of_triangle;
  std::vector<SurfaceShell> shell;  ///< in the order of their first triangles
  std::uint32_t components = 0;
  bool inverted = false;
  std::size_t non_planar_faces = 0;
};

[[nodiscard]] Surface analyse_surface(const PolygonMesh& mesh);

/// build_solid with the analysis of the mesh at hand.
[[nodiscard]] Result<Solid> build_solid(const PolygonMesh& mesh, const Surface& surface);

/// Adds an example and counts; keeps the defects in the order of their kinds.
class DefectCollector {
 public:
  explicit DefectCollector(std::span<const Point3> points) : points_(points) {}
  void add(DefectKind kind, std::vector<std::size_t> elements,
           std::span<const std::uint32_t> at_vertices);
  void mark_as_lower_bound(DefectKind kind);
  [[nodiscard]] bool any_error() const;
  [[nodiscard]] ValidationReport take();

 private:
  Defect& of(DefectKind kind);
  std::span<const Point3> points_;
  std::vector<Defect> defects_;
};

/// Pairs of faces that meet improperly. Requires: triangles not degenerate.
void find_self_intersections(std::span<const Point3> points, const Surface& surface,
                             DefectCollector& defects);

/// Fills the shell fields of `surface`. Requires: a closed oriented embedded surface.
void find_shells(std::span<const Point3> points, Surface& surface, DefectCollector& defects);

}  // namespace blum
