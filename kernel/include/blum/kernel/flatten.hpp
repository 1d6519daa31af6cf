/// Puts facets that are coplanar only up to noise exactly into one plane. The one function of Blum
/// that changes a solid; nothing calls it unless the user asks.
#pragma once

#include <cstddef>

#include "blum/kernel/mesh.hpp"
#include "blum/kernel/result.hpp"
#include "blum/kernel/solid.hpp"

namespace blum {

struct FlattenReport {
  /// Of the triangulated surface.
  struct Edges {
    std::size_t flat = 0;  ///< exactly
    /// Not exactly flat, but the far vertex of each of the two triangles lies within the tolerance
    /// of the other's plane (rounded arithmetic).
    std::size_t nearly_flat = 0;
  };
  double tolerance = 0;  ///< as asked for: of the bounding box's diagonal
  std::size_t vertices_moved = 0;
  double largest_displacement = 0;  ///< model units
  std::size_t slivers_dropped = 0;
  Edges before, after;
};

struct Flattened {
  PolygonMesh mesh;  ///< vertices keep their indices
  Solid solid;       ///< build_solid of that mesh
  FlattenReport report;
};

/// Moves vertices, none by more than `tolerance` times the bounding box's diagonal, so that nearly
/// axis-parallel facets become exactly so, and that upright edges, nearly parallel to an axis,
/// become exactly so too (walls between parallel edges are exact planes). Parallel facets at nearly
/// one height get one height, adjacent or not: one of theirs, the one that most vertices are near
/// to, on ties the one with the shortest decimal, then the most frequent, then the smallest
/// absolute value, then the positive one. Triangles no wider than the noise collapse and are
/// dropped.
///
/// Facets in other directions stay as noisy as they are, because a plane in general direction
/// contains hardly any point with double coordinates; `after.nearly_flat` counts them. A
/// general plane that was exact and lost a vertex to such a move can become noisy.
///
/// Tolerance 0 changes nothing. Flattening twice gives what flattening once gives, unless details
/// of the solid are about as small as the tolerance. The order of vertices and faces has no
/// influence on where a vertex goes.
///
/// Errors: kBadArgument for a tolerance outside [0, 1]; those of build_solid for an invalid mesh;
/// kInvalidSolid, with all defects and their places, if the changed mesh bounds no solid or one of
/// other Betti numbers (a wall thinner than the tolerance collapses).
[[nodiscard]] Result<Flattened> flatten_facets(const PolygonMesh& mesh, double tolerance);

}  // namespace blum
