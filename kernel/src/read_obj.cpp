#include <algorithm>
#include <string>

#include "read_text.hpp"

namespace blum::read {

Result<PolygonMesh> obj(std::string_view text) {
  const auto control = std::find_if(text.begin(), text.end(), [](char c) {
    return c >= 0 && c < ' ' && c != '\t' && c != '\n' && c != '\r' && c != '\v' && c != '\f';
  });
  if (control != text.end()) {
    const auto line = static_cast<std::size_t>(1 + std::count(text.begin(), control, '\n'));
    return make_error(ErrorCode::kMalformedFile,
                      "line " + std::to_string(line) + ": not a text file", line);
  }
  PolygonMesh mesh;
  std::vector<std::size_t> line_of_face;
  bool has_curves = false;
  Tokens tokens(text, '#', true);
  for (std::string_view word = tokens.next(); !word.empty(); word = tokens.next()) {
    if (word == "v") {
      Point3 p;
      if (std::optional<Error> error = parse_point(tokens, true, mesh.points.size(), p)) {
        return *error;
      }
      mesh.points.push_back(p);
    } else if (word == "f") {
      const std::size_t f = mesh.faces.size(), line = tokens.line();
      std::vector<std::uint32_t> face;
      for (word = tokens.next_on_line(); !word.empty(); word = tokens.next_on_line()) {
        const std::optional<long long> i = parse_integer(word.substr(0, word.find('/')));
        if (!i) {
          return make_error(ErrorCode::kMalformedFile,
                            at("face", f, line, shown(word) + " is not a vertex index"), f);
        }
        // Indices count from 1, negative ones back from the latest vertex.
        const auto latest = static_cast<long long>(mesh.points.size());
        const long long index = *i > 0 ? *i - 1 : *i < -latest ? -1 : latest + *i;
        if (*i == 0 || index < 0 || index >= 0xFFFFFFFFll) {
          return make_error(ErrorCode::kIndexOutOfRange,
                            at("face", f, line, "no vertex has the index " + shown(word)), f);
        }
        face.push_back(static_cast<std::uint32_t>(index));
      }
      if (face.size() < 3) {
        return make_error(ErrorCode::kMalformedFile,
                          at("face", f, line, "fewer than three vertices"), f);
      }
      mesh.faces.push_back(std::move(face));
      line_of_face.push_back(line);
    } else {
      has_curves |= word == "l" || word == "curv" || word == "surf";
    }
    // Joined lines must not leave half a statement behind, so read on token by token.
    while (!tokens.next_on_line().empty()) {
    }
  }
  // Else the file would be taken for points alone.
  if (mesh.faces.empty() && has_curves) return no_faces();
  // A face may name vertices that come later.
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (const std::uint32_t v : mesh.faces[f]) {
      if (v < mesh.points.size()) continue;
      return make_error(ErrorCode::kIndexOutOfRange,
                        at("face", f, line_of_face[f],
                           "vertex index " + std::to_string(v + 1ull) + " of " +
                               std::to_string(mesh.points.size()) + " vertices"),
                        f);
    }
  }
  return mesh;
}

}  // namespace blum::read
