/// Polygon meshes as read: indexed, nothing repaired, nothing assumed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "blum/kernel/point.hpp"
#include "blum/kernel/result.hpp"

namespace blum {

struct PolygonMesh {
  std::vector<Point3> points;
  std::vector<std::vector<std::uint32_t>> faces;  ///< each: >= 3 indices into points
};

/// Reads OFF, OBJ, STL (ASCII, binary) or PLY; the content decides, then the extension.
/// Doubles are taken as the exact numbers they are; STL vertices are merged by exact equality.
/// Errors: every way a file can be absent, unreadable, malformed, truncated or out of range
/// (|x| > 2^200); `element` is the line, vertex or face.
[[nodiscard]] Result<PolygonMesh> read_mesh(const std::filesystem::path& file);

/// Writes OFF with shortest round-trip decimals (reads back bit-identical), by a temporary file
/// and a rename.
[[nodiscard]] std::optional<Error> write_off(const PolygonMesh& mesh,
                                             const std::filesystem::path& file);
/// The content of that file.
[[nodiscard]] std::string off_text(const PolygonMesh& mesh);

}  // namespace blum
