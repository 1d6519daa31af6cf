#include "mesh_checks.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "blum/kernel/info.hpp"
#include "blum/kernel/solid.hpp"
#include "fuzz_target.hpp"
#include "read_text.hpp"

namespace blum::fuzz {
namespace {

constexpr std::size_t kMostValidated = 200;  // corners of faces: validation is slower than reading

bool same(const PolygonMesh& a, const PolygonMesh& b) {
  if (a.points.size() != b.points.size() || a.faces != b.faces) return false;
  for (std::size_t v = 0; v < a.points.size(); ++v)
    for (int k = 0; k < 3; ++k)
      if (std::bit_cast<std::uint64_t>(a.points[v][k]) !=
          std::bit_cast<std::uint64_t>(b.points[v][k]))
        return false;
  return true;
}

/// The lines of an OFF file, from a given one on.
std::string_view lines_from(std::string_view text, int line) {
  for (; line > 0; --line) text.remove_prefix(text.find('\n') + 1);
  return text;
}

std::string as_obj(const PolygonMesh& mesh) {
  const std::string text = off_text(mesh);
  std::string out = "# faces first: indices may point ahead\n";
  for (const auto& face : mesh.faces) {
    out += "f";
    for (const std::uint32_t v : face) out += ' ' + std::to_string(v + 1ull) + "/1/1";
    out += '\n';
  }
  std::string_view points = lines_from(text, 2);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const std::size_t end = points.find('\n') + 1;
    out += "v " + std::string(points.substr(0, end));
    points.remove_prefix(end);
  }
  return out;
}

std::string ply_header(const PolygonMesh& mesh, const char* format) {
  return std::string("ply\nformat ") + format + " 1.0\nelement vertex " +
         std::to_string(mesh.points.size()) +
         "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
         std::to_string(mesh.faces.size()) +
         "\nproperty list uint uint vertex_indices\nend_header\n";
}

std::string as_ascii_ply(const PolygonMesh& mesh) {
  const std::string text = off_text(mesh);
  return ply_header(mesh, "ascii") + std::string(lines_from(text, 2));
}

template <class Unsigned>
void append(std::string& out, Unsigned bits, bool big) {
  constexpr int kBytes = sizeof(Unsigned);
  for (int k = 0; k < kBytes; ++k)
    out += static_cast<char>(bits >> 8 * (big ? kBytes - 1 - k : k) & 0xff);
}

std::string as_binary_ply(const PolygonMesh& mesh, bool big) {
  std::string out = ply_header(mesh, big ? "binary_big_endian" : "binary_little_endian");
  for (const Point3& p : mesh.points)
    for (int k = 0; k < 3; ++k) append(out, std::bit_cast<std::uint64_t>(p[k]), big);
  for (const auto& face : mesh.faces) {
    append(out, static_cast<std::uint32_t>(face.size()), big);
    for (const std::uint32_t v : face) append(out, v, big);
  }
  return out;
}

void expect_same(const PolygonMesh& mesh, const Result<PolygonMesh>& again, const char* format) {
  if (!again) fail(std::string("its ") + format + " is refused: " + again.error().message);
  if (!same(mesh, again.value())) fail(std::string("its ") + format + " reads differently");
}

}  // namespace

void check_read(const Result<PolygonMesh>& read) {
  if (!read) {
    if (read.error().message.empty()) fail("an error without a message");
    return;
  }
  const PolygonMesh& mesh = read.value();
  if (mesh.points.empty() && !mesh.faces.empty()) fail("faces without points");
  for (const Point3& p : mesh.points)
    for (int k = 0; k < 3; ++k)
      if (!(std::abs(p[k]) <= 0x1p200)) fail("a coordinate out of range");
  std::size_t corners = 0;
  for (const auto& face : mesh.faces) {
    corners += face.size();
    if (face.size() < 3) fail("a face of fewer than three vertices");
    for (const std::uint32_t v : face)
      if (v >= mesh.points.size()) fail("an index out of range");
  }
  expect_same(mesh, read::off(off_text(mesh)), "OFF");
  expect_same(mesh, read::obj(as_obj(mesh)), "OBJ");
  expect_same(mesh, read::ply(as_ascii_ply(mesh)), "ASCII PLY");
  expect_same(mesh, read::ply(as_binary_ply(mesh, false)), "little-endian PLY");
  expect_same(mesh, read::ply(as_binary_ply(mesh, true)), "big-endian PLY");
  if (corners > kMostValidated) return;
  const MeshInfo info = mesh_info(mesh);
  const auto solid = build_solid(mesh);
  if (solid.ok() && !info.validation.valid()) fail("an invalid mesh makes a solid");
  if (solid.ok() != info.solid.has_value()) fail("mesh_info and build_solid disagree");
  if (solid.ok() && info.solid->betti != solid.value().betti()) fail("Betti numbers disagree");
}

}  // namespace blum::fuzz
