#include <charconv>
#include <fstream>
#include <string>
#include <system_error>

#include "blum/kernel/mesh.hpp"

#include <unistd.h>

namespace blum {
namespace {

template <class Number>
void append(std::string& out, Number x) {
  char buffer[32];
  out.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, x).ptr);
}

}  // namespace

std::string off_text(const PolygonMesh& mesh) {
  std::string out = "OFF\n";
  append(out, mesh.points.size());
  out += ' ';
  append(out, mesh.faces.size());
  out += " 0\n";
  for (const Point3& p : mesh.points) {
    for (int axis = 0; axis < 3; ++axis) {
      append(out, p[axis]);
      out += axis < 2 ? ' ' : '\n';
    }
  }
  for (const auto& face : mesh.faces) {
    append(out, face.size());
    for (const std::uint32_t v : face) {
      out += ' ';
      append(out, v);
    }
    out += '\n';
  }
  return out;
}

std::optional<Error> write_off(const PolygonMesh& mesh, const std::filesystem::path& file) {
  const auto fail = [&](const std::string& what) {
    return Error{ErrorCode::kOutputNotWritten, what, file.string(), std::nullopt};
  };
  std::error_code code;
  if (std::filesystem::is_directory(file, code)) return fail("a directory is in the way");
  // Beside the target, so that the rename stays on one file system and is atomic.
  std::filesystem::path temporary = file;
  temporary += ".tmp" + std::to_string(::getpid());
  {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    if (!out) return fail("the file cannot be created");
    const std::string text = off_text(mesh);
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    out.close();
    if (!out) {
      std::filesystem::remove(temporary, code);
      return fail("writing failed");
    }
  }
  std::filesystem::rename(temporary, file, code);
  if (code) {
    const std::string what = code.message();
    std::filesystem::remove(temporary, code);
    return fail("the finished file cannot be renamed: " + what);
  }
  return std::nullopt;
}

}  // namespace blum
