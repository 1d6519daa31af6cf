#include <bit>
#include <cstring>
#include <string>
#include <unordered_map>

#include "read_text.hpp"

namespace blum::read {
namespace {

std::uint32_t little_endian_32(const char* bytes) {
  const auto* b = reinterpret_cast<const unsigned char*>(bytes);
  return b[0] | b[1] << 8 | b[2] << 16 | static_cast<std::uint32_t>(b[3]) << 24;
}

/// STL repeats the coordinates of a vertex in each of its triangles.
class VertexMerger {
 public:
  explicit VertexMerger(PolygonMesh& mesh) : mesh_(mesh) {}
  std::uint32_t index_of(Point3 p) {
    for (int axis = 0; axis < 3; ++axis) p[axis] += 0.0;  // -0 and 0 are one number
    const auto [at, fresh] = index_.try_emplace(p, static_cast<std::uint32_t>(mesh_.points.size()));
    if (fresh) mesh_.points.push_back(p);
    return at->second;
  }

 private:
  struct Hash {
    std::size_t operator()(const Point3& p) const {
      std::uint64_t h = 0;
      for (int axis = 0; axis < 3; ++axis) {
        h = (h ^ std::bit_cast<std::uint64_t>(p[axis])) * 0x9E3779B97F4A7C15ull;
        h ^= h >> 29;
      }
      return h;
    }
  };
  PolygonMesh& mesh_;
  std::unordered_map<Point3, std::uint32_t, Hash> index_;
};

constexpr std::size_t kHeader = 80, kTriangle = 50;

}  // namespace

bool looks_like_binary_stl(std::string_view bytes) {
  return bytes.size() >= kHeader + 4 &&
         bytes.size() == kHeader + 4 +
                             kTriangle * static_cast<unsigned long long>(
                                             little_endian_32(bytes.data() + kHeader));
}

Result<PolygonMesh> stl_binary(std::string_view bytes) {
  if (bytes.size() < kHeader + 4) {
    return make_error(ErrorCode::kTruncatedFile,
                      "the file ends before the triangle count of a binary STL");
  }
  const std::size_t count = little_endian_32(bytes.data() + kHeader);
  const std::size_t there = (bytes.size() - kHeader - 4) / kTriangle;
  if (there < count) {
    return make_error(ErrorCode::kTruncatedFile,
                      "face " + std::to_string(there) + ": the file ends here, of " +
                          std::to_string(count) + " promised triangles",
                      there);
  }
  if (!looks_like_binary_stl(bytes)) {
    return make_error(ErrorCode::kMalformedFile, "data after the last triangle of a binary STL");
  }
  if (count == 0) return no_faces();
  PolygonMesh mesh;
  VertexMerger merger(mesh);
  mesh.faces.reserve(count);
  for (std::size_t f = 0; f < count; ++f) {
    const char* corner = bytes.data() + kHeader + 4 + f * kTriangle + 12;
    std::vector<std::uint32_t> face(3);
    for (int k = 0; k < 3; ++k) {
      Point3 p;
      for (int axis = 0; axis < 3; ++axis, corner += 4) {
        p[axis] = std::bit_cast<float>(little_endian_32(corner));
      }
      if (std::optional<Error> error = check_point(p, 3 * f + k, 0)) return *error;
      face[k] = merger.index_of(p);
    }
    mesh.faces.push_back(std::move(face));
  }
  return mesh;
}

Result<PolygonMesh> stl_ascii(std::string_view text) {
  Tokens tokens(text);
  PolygonMesh mesh;
  VertexMerger merger(mesh);
  std::size_t corners = 0;
  const auto unexpected = [&](std::string_view token, const char* wanted) {
    const std::size_t line = tokens.line();
    if (token.empty()) {
      return make_error(
          ErrorCode::kTruncatedFile,
          "line " + std::to_string(line) + ": the file ends where '" + wanted + "' should follow",
          line);
    }
    return make_error(ErrorCode::kMalformedFile,
                      "line " + std::to_string(line) + ": " + shown(token) + " where '" + wanted +
                          "' should stand",
                      line);
  };
  const auto expect = [&](const char* wanted) -> std::optional<Error> {
    const std::string_view token = tokens.next();
    if (same_word(token, wanted)) return std::nullopt;
    return unexpected(token, wanted);
  };
  for (std::string_view word = tokens.next(); !word.empty(); word = tokens.next()) {
    if (!same_word(word, "solid")) return unexpected(word, "solid");
    tokens.skip_line();  // the name
    for (word = tokens.next(); !same_word(word, "endsolid"); word = tokens.next()) {
      if (!same_word(word, "facet")) return unexpected(word, "endsolid");
      if (auto error = expect("normal")) return *error;
      for (int k = 0; k < 3; ++k) {
        // The normal says nothing that the vertices do not, and is often wrong.
        if (const std::string_view n = tokens.next(); !parse_double(n)) {
          return unexpected(n, "a component of the normal");
        }
      }
      if (auto error = expect("outer")) return *error;
      if (auto error = expect("loop")) return *error;
      std::vector<std::uint32_t> face;
      for (int k = 0; k < 3; ++k) {
        if (auto error = expect("vertex")) return *error;
        Point3 p;
        if (auto error = parse_point(tokens, false, corners++, p)) return *error;
        face.push_back(merger.index_of(p));
      }
      if (auto error = expect("endloop")) return *error;
      if (auto error = expect("endfacet")) return *error;
      mesh.faces.push_back(std::move(face));
    }
    tokens.skip_line();
  }
  if (mesh.faces.empty()) return no_faces();
  return mesh;
}

}  // namespace blum::read
