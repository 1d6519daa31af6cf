/// Triangles that are no wider than the noise of their corners do not survive its removal.
#pragma once

#include <cstddef>

#include "blum/kernel/mesh.hpp"

namespace blum {

/// Drops the triangles of `after` that moving the vertices has made collinear, or has turned over
/// in an axis-parallel plane. The face at the longest side takes the opposite corner in between:
/// the surface stays closed, and its topology what it was. Returns how many were dropped.
/// Slivers that have nobody to go to stay, for the validation to find.
/// Requires: a valid solid `before`; the same faces in both.
std::size_t drop_collapsed_triangles(const PolygonMesh& before, PolygonMesh& after);

}  // namespace blum
