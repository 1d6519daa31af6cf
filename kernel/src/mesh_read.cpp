#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>

#include "blum/kernel/mesh.hpp"
#include "blum/kernel/mesh_or_points.hpp"
#include "read_text.hpp"

namespace blum {
namespace {

bool is_obj_keyword(std::string_view word) {
  for (const std::string_view known : {"v", "vn", "vt", "f", "o", "g", "s", "mtllib", "usemtl"}) {
    if (word == known) return true;
  }
  return false;
}

}  // namespace

Result<PolygonMesh> read::any(std::string_view bytes, std::string_view extension) {
  if (bytes.empty()) return read::make_error(ErrorCode::kEmptyFile, "the file is empty");
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return read::ply(bytes);
  if (read::looks_like_off(bytes)) return read::off(bytes);
  // Before ASCII STL: many binary files begin with "solid" too.
  if (read::looks_like_binary_stl(bytes)) return read::stl_binary(bytes);
  const std::string_view first = read::Tokens(bytes).next();
  if (read::same_word(first, "solid")) {
    const bool text = bytes.find('\0') == std::string_view::npos;
    return text ? read::stl_ascii(bytes) : read::stl_binary(bytes);
  }
  if (is_obj_keyword(read::Tokens(bytes, '#').next())) return read::obj(bytes);
  if (read::same_word(extension, ".off")) return read::off(bytes);
  if (read::same_word(extension, ".obj")) return read::obj(bytes);
  if (read::same_word(extension, ".stl")) return read::stl_binary(bytes);
  if (read::same_word(extension, ".ply")) return read::ply(bytes);
  return read::make_error(ErrorCode::kUnknownFormat,
                          "neither content nor extension is of OFF, OBJ, STL or PLY");
}

Result<PolygonMesh> read_mesh(const std::filesystem::path& file) {
  Result<PolygonMesh> mesh = read_mesh_or_points(file);
  if (!mesh.ok() || !mesh.value().faces.empty()) return mesh;
  Error error = read::no_faces();
  error.file = file.string();
  return error;
}

Result<PolygonMesh> read_mesh_or_points(const std::filesystem::path& file) {
  const auto fail = [&](Error error) {
    error.file = file.string();
    return error;
  };
  std::error_code code;
  const auto status = std::filesystem::status(file, code);
  if (!std::filesystem::exists(status)) {
    if (code && code != std::errc::no_such_file_or_directory &&
        code != std::errc::not_a_directory) {
      return fail(read::make_error(ErrorCode::kFileUnreadable, code.message()));
    }
    return fail(read::make_error(ErrorCode::kFileNotFound, "no such file"));
  }
  if (!std::filesystem::is_regular_file(status)) {
    return fail(read::make_error(ErrorCode::kNotARegularFile, std::filesystem::is_directory(status)
                                                                  ? "a directory, not a file"
                                                                  : "not a regular file"));
  }
  std::ifstream in(file, std::ios::binary);
  if (!in) return fail(read::make_error(ErrorCode::kFileUnreadable, "the file cannot be opened"));
  std::string bytes;
  const auto size = std::filesystem::file_size(file, code);
  if (!code) bytes.reserve(static_cast<std::size_t>(size));
  char buffer[1 << 16];
  while (in.read(buffer, sizeof buffer) || in.gcount() > 0) {
    bytes.append(buffer, static_cast<std::size_t>(in.gcount()));
  }
  if (in.bad()) return fail(read::make_error(ErrorCode::kFileUnreadable, "reading failed"));
  Result<PolygonMesh> mesh = read::any(bytes, file.extension().string());
  if (!mesh.ok()) return fail(mesh.error());
  if (mesh.value().points.empty()) return fail(read::no_faces());
  return mesh;
}

}  // namespace blum
