/// What the mesh readers share: tokens of a text, numbers, errors that say where.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "blum/kernel/mesh.hpp"
#include "blum/kernel/result.hpp"

namespace blum::read {

/// read_mesh adds the file to what the readers return.
[[nodiscard]] Error make_error(ErrorCode code, std::string message,
                               std::optional<std::size_t> element = std::nullopt);
/// "face 3 (line 17): " + what.
[[nodiscard]] std::string at(const char* element, std::size_t index, std::size_t line,
                             const std::string& what);
/// A token as it may stand in a message: shortened, unprintable bytes replaced.
[[nodiscard]] std::string shown(std::string_view token);

/// Tokens between white space, with the line (from 1) they stand in; comments run from `comment`
/// ('\0': none) to the end of the line. A backslash before a line end joins lines if so asked.
class Tokens {
 public:
  explicit Tokens(std::string_view text, char comment = '\0', bool join_lines = false)
      : text_(text), comment_(comment), join_lines_(join_lines) {}
  [[nodiscard]] std::string_view next();          ///< empty at the end of the text
  [[nodiscard]] std::string_view next_on_line();  ///< empty at the end of the line
  void skip_line();
  [[nodiscard]] std::size_t line() const { return line_; }  ///< of the token read last
  [[nodiscard]] std::size_t bytes_left() const { return text_.size() - at_; }
  [[nodiscard]] std::string_view rest() const { return text_.substr(at_); }

 private:
  void skip_space(bool over_lines);
  [[nodiscard]] std::string_view take();

  std::string_view text_;
  char comment_;
  bool join_lines_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

/// The nearest double, ties to even; a leading '+' is accepted, and inf and nan, so that the range
/// check can name them. A number too large for a double gives infinity.
[[nodiscard]] std::optional<double> parse_double(std::string_view token);
[[nodiscard]] std::optional<long long> parse_integer(std::string_view token);

/// Reads three coordinates. `line_bound`: they must stand on the present line.
[[nodiscard]] std::optional<Error> parse_point(Tokens& tokens, bool line_bound, std::size_t vertex,
                                               Point3& p);
/// Is the vertex finite and within range? `line` 0: the format has no lines.
[[nodiscard]] std::optional<Error> check_point(const Point3& p, std::size_t vertex,
                                               std::size_t line);

/// ASCII case-insensitive.
[[nodiscard]] bool same_word(std::string_view a, std::string_view b);

[[nodiscard]] Error no_faces();

/// OFF, OBJ and PLY may have points alone.
[[nodiscard]] Result<PolygonMesh> off(std::string_view text);
[[nodiscard]] Result<PolygonMesh> obj(std::string_view text);
[[nodiscard]] Result<PolygonMesh> stl_ascii(std::string_view text);
[[nodiscard]] Result<PolygonMesh> stl_binary(std::string_view bytes);
[[nodiscard]] Result<PolygonMesh> ply(std::string_view bytes);

/// Of any of these formats: the content decides, the extension (".off") only where it does not.
[[nodiscard]] Result<PolygonMesh> any(std::string_view bytes, std::string_view extension);

[[nodiscard]] bool looks_like_off(std::string_view text);  ///< COFF, NOFF, STOFF, ... included
/// Has the bytes the exact length that a binary STL's triangle count asks for?
[[nodiscard]] bool looks_like_binary_stl(std::string_view bytes);

}  // namespace blum::read
