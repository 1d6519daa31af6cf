#include <charconv>
#include <span>
#include <string>

#include "blum/kernel/mesh.hpp"
#include "blum/kernel/output_files.hpp"

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
  const detail::OutputFile output{file,
                                  [&mesh](detail::OutputStream& out) { out << off_text(mesh); }};
  return detail::write_files(std::span(&output, 1));
}

}  // namespace blum
