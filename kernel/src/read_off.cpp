#include <string>

#include "read_text.hpp"

namespace blum::read {
namespace {

/// The prefix of an OFF keyword ("" of OFF, "ST", "C", "N", "4", "n" of the variants).
std::optional<std::string_view> off_prefix(std::string_view keyword) {
  if (keyword.size() < 3 || keyword.substr(keyword.size() - 3) != "OFF") return std::nullopt;
  std::string_view prefix = keyword.substr(0, keyword.size() - 3), rest = prefix;
  for (const std::string_view part : {"ST", "C", "N", "4", "n"}) {
    if (rest.substr(0, part.size()) == part) rest.remove_prefix(part.size());
  }
  return rest.empty() ? std::optional(prefix) : std::nullopt;
}

Error truncated(const char* element, std::size_t index, std::size_t line) {
  return make_error(ErrorCode::kTruncatedFile, at(element, index, line, "the file ends here"),
                    index);
}

}  // namespace

bool looks_like_off(std::string_view text) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  return off_prefix(Tokens(text, '#').next()).has_value();
}

Result<PolygonMesh> off(std::string_view text) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  Tokens tokens(text, '#');
  const std::optional<std::string_view> prefix = off_prefix(tokens.next());
  if (!prefix) {
    return make_error(ErrorCode::kMalformedFile, "line 1: no OFF keyword", tokens.line());
  }
  if (prefix->find_first_of("4n") != std::string_view::npos) {
    return make_error(ErrorCode::kMalformedFile, "line 1: only three-dimensional OFF is read", 1);
  }
  long long counts[2] = {0, 0};
  for (long long& count : counts) {
    const std::string_view token = tokens.next();
    if (same_word(token, "BINARY")) {
      return make_error(ErrorCode::kMalformedFile, "line 1: binary OFF is not read", 1);
    }
    if (token.empty()) {
      return make_error(ErrorCode::kTruncatedFile, "the file ends before its counts",
                        tokens.line());
    }
    const std::optional<long long> n = parse_integer(token);
    if (!n || *n < 0) {
      return make_error(ErrorCode::kMalformedFile,
                        "line " + std::to_string(tokens.line()) + ": " + shown(token) +
                            " is not a count of vertices or faces",
                        tokens.line());
    }
    count = *n;
  }
  tokens.skip_line();  // the count of edges, often wrong or missing
  const auto vertices = static_cast<unsigned long long>(counts[0]);
  const auto faces = static_cast<unsigned long long>(counts[1]);
  // The shortest vertex is "0 0 0\n", the shortest (bad) face "0\n": believe no count that the rest
  // of the file has no room for.
  const unsigned long long room = tokens.bytes_left() + 1;
  if (vertices > room / 6 || faces > room / 2 || vertices * 6 + faces * 2 > room) {
    return make_error(ErrorCode::kTruncatedFile,
                      "the header promises " + std::to_string(vertices) + " vertices and " +
                          std::to_string(faces) + " faces, more than the file can hold",
                      tokens.line());
  }

  PolygonMesh mesh;
  mesh.points.reserve(vertices);
  mesh.faces.reserve(faces);
  for (std::size_t v = 0; v < vertices; ++v) {
    Point3 p;
    if (std::optional<Error> error = parse_point(tokens, false, v, p)) return *error;
    mesh.points.push_back(p);
    if (!prefix->empty()) {
      tokens.skip_line();  // normals, colours, texture coordinates
    } else if (const std::string_view extra = tokens.next_on_line(); !extra.empty()) {
      return make_error(ErrorCode::kMalformedFile,
                        at("vertex", v, tokens.line(), shown(extra) + " after the coordinates"), v);
    }
  }
  for (std::size_t f = 0; f < faces; ++f) {
    const std::string_view token = tokens.next();
    if (token.empty()) return truncated("face", f, tokens.line());
    const std::optional<long long> n = parse_integer(token);
    if (!n || *n < 3) {
      return make_error(
          ErrorCode::kMalformedFile,
          at("face", f, tokens.line(), shown(token) + " is not a number of vertices >= 3"), f);
    }
    if (static_cast<unsigned long long>(*n) > tokens.bytes_left() / 2) {
      return make_error(
          ErrorCode::kTruncatedFile,
          at("face", f, tokens.line(), "more vertices than the rest of the file can hold"), f);
    }
    std::vector<std::uint32_t> face;
    face.reserve(static_cast<std::size_t>(*n));
    for (long long k = 0; k < *n; ++k) {
      const std::string_view word = tokens.next();
      if (word.empty()) return truncated("face", f, tokens.line());
      const std::optional<long long> i = parse_integer(word);
      if (!i) {
        return make_error(ErrorCode::kMalformedFile,
                          at("face", f, tokens.line(), shown(word) + " is not a vertex index"), f);
      }
      if (*i < 0 || static_cast<unsigned long long>(*i) >= vertices) {
        return make_error(
            ErrorCode::kIndexOutOfRange,
            at("face", f, tokens.line(),
               "vertex index " + shown(word) + " of " + std::to_string(vertices) + " vertices"),
            f);
      }
      face.push_back(static_cast<std::uint32_t>(*i));
    }
    mesh.faces.push_back(std::move(face));
    tokens.skip_line();  // the face's colour
  }
  if (const std::string_view extra = tokens.next(); !extra.empty()) {
    return make_error(
        ErrorCode::kMalformedFile,
        "line " + std::to_string(tokens.line()) + ": " + shown(extra) + " after the last face",
        tokens.line());
  }
  return mesh;
}

}  // namespace blum::read
