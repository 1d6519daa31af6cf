/// Finer meshes of a complex: its edges halved until they are short, the new points on the axis
/// where it can be found. A mesh is a subdivision of the complex: the same space, with other cells.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "blum/kernel/inside.hpp"
#include "blum/medial/complex.hpp"
#include "blum/medial/medial_axis.hpp"
#include "blum/medial/parts.hpp"
#include "blum/placement/leaf_sides.hpp"

namespace blum {

/// The leaf that each cone lies in; cones of one leaf share theirs.
using ConeSides = std::vector<std::shared_ptr<const LeafSides>>;

/// A cell of the complex that a cell of the mesh lies in (in its interior, or is it).
struct CellOrigin {
  std::uint8_t dimension = 0;
  std::uint32_t cell = 0;
};

struct AxisMesh {
  CellComplex complex;  ///< its first vertices are those of the complex
  std::vector<CellOrigin> vertex, edge;
  std::vector<std::uint32_t> triangle;  ///< triangle of the complex
  std::size_t unconverged = 0;          ///< new points that were left where they were
  bool complete = true;                 ///< all edges are as short as was asked for
};

struct MeshOptions {
  double edge_length = 0;                   ///< longest edge, working units; > 0
  std::size_t most_triangles = 4'000'000;   ///< no more halving beyond
  const std::atomic<bool>* stop = nullptr;  ///< nor after this has become true
  int threads = 1;                          ///< the mesh does not depend on it
};

/// Halves edges until they are short. Seams and rims stay curves of the same parts. Points stay in
/// the boxes of the leaves whose triangles they lie on; a point on an edge between two convex
/// boundary points stays on the straight line.
[[nodiscard]] AxisMesh mesh_of(const SiteGeometry& geometry, const InsideOracle& inside,
                               const CellComplex& complex, const Parts& parts,
                               const ConeSides& sides, const MeshOptions& options);

/// `result` with the mesh for its complex: parts, angles and values are those of the cells that
/// the mesh's cells lie in. Where the mesh is finer than the complex, Betti numbers are counted
/// anew (BLUM_CHECK: the same), and collapses, which speak of the complex, are dropped. Requires a
/// mesh of the result's complex.
[[nodiscard]] MedialResult with_mesh(const MedialResult& result, const AxisMesh& mesh);

}  // namespace blum
