/// Files that may hold points alone.
#pragma once

#include <filesystem>

#include "blum/kernel/mesh.hpp"
#include "blum/kernel/result.hpp"

namespace blum {

/// As read_mesh, but OFF, OBJ and PLY files without faces are read as clouds of points: `faces` is
/// empty then. Errors: as read_mesh; kNoFaces where there are no points either.
[[nodiscard]] Result<PolygonMesh> read_mesh_or_points(const std::filesystem::path& file);

}  // namespace blum
