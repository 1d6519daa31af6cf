#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>

#include "read_text.hpp"

namespace blum::read {
namespace {

enum class Type : std::uint8_t { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };
enum class Encoding : std::uint8_t { kAscii, kLittle, kBig };

std::size_t size_of(Type t) {
  constexpr std::size_t kSize[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSize[static_cast<int>(t)];
}

std::optional<Type> type_named(std::string_view name) {
  constexpr std::pair<std::string_view, Type> kNames[] = {
      {"char", Type::kInt8},     {"int8", Type::kInt8},     {"uchar", Type::kUint8},
      {"uint8", Type::kUint8},   {"short", Type::kInt16},   {"int16", Type::kInt16},
      {"ushort", Type::kUint16}, {"uint16", Type::kUint16}, {"int", Type::kInt32},
      {"int32", Type::kInt32},   {"uint", Type::kUint32},   {"uint32", Type::kUint32},
      {"float", Type::kFloat},   {"float32", Type::kFloat}, {"double", Type::kDouble},
      {"float64", Type::kDouble}};
  for (const auto& [n, t] : kNames) {
    if (n == name) return t;
  }
  return std::nullopt;
}

struct Property {
  std::string name;
  std::optional<Type> count;  ///< of a list
  Type type = Type::kFloat;
};

struct Element {
  std::string name;
  unsigned long long count = 0;
  std::vector<Property> properties;
};

/// Numbers of the data section, in any encoding, as doubles (all types fit exactly).
class Numbers {
 public:
  Numbers(std::string_view data, Encoding encoding, std::size_t first_line)
      : data_(data), tokens_(data), encoding_(encoding), first_line_(first_line) {}

  [[nodiscard]] std::size_t bytes_left() const {
    return encoding_ == Encoding::kAscii ? tokens_.bytes_left() : data_.size() - at_;
  }
  [[nodiscard]] std::size_t line() const {
    return encoding_ == Encoding::kAscii ? first_line_ + tokens_.line() - 1 : 0;
  }
  /// Bytes that a number of the type takes at the least.
  [[nodiscard]] std::size_t least_size(Type t) const {
    return encoding_ == Encoding::kAscii ? 2 : size_of(t);
  }

  enum class Failure : std::uint8_t { kNone, kEnd, kNotANumber };
  Failure next(Type t, double& x) {
    if (encoding_ == Encoding::kAscii) {
      const std::string_view token = tokens_.next();
      if (token.empty()) return Failure::kEnd;
      const std::optional<double> value = parse_double(token);
      if (!value) return Failure::kNotANumber;
      x = *value;
      return Failure::kNone;
    }
    const std::size_t n = size_of(t);
    if (data_.size() - at_ < n) return Failure::kEnd;
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = encoding_ == Encoding::kLittle ? n - 1 - k : k;
      bits = bits << 8 | static_cast<unsigned char>(data_[at_ + i]);
    }
    at_ += n;
    switch (t) {
      case Type::kInt8:
        x = static_cast<std::int8_t>(bits);
        break;
      case Type::kInt16:
        x = static_cast<std::int16_t>(bits);
        break;
      case Type::kInt32:
        x = static_cast<std::int32_t>(bits);
        break;
      case Type::kUint8:
      case Type::kUint16:
      case Type::kUint32:
        x = static_cast<double>(bits);
        break;
      case Type::kFloat:
        x = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
        break;
      case Type::kDouble:
        x = std::bit_cast<double>(bits);
        break;
    }
    return Failure::kNone;
  }
  [[nodiscard]] bool only_space_left() {
    if (encoding_ == Encoding::kAscii) return tokens_.next().empty();
    return data_.find_first_not_of(" \t\r\n", at_) == std::string_view::npos;
  }

 private:
  std::string_view data_;
  Tokens tokens_;
  Encoding encoding_;
  std::size_t first_line_;
  std::size_t at_ = 0;
};

struct Header {
  Encoding encoding = Encoding::kAscii;
  std::vector<Element> elements;
  std::size_t lines = 0;
  std::string_view data;
};

Result<Header> read_header(std::string_view bytes) {
  Tokens tokens(bytes);
  Header header;
  bool has_format = false;
  const auto bad = [&](const std::string& what) {
    // A keyword cut off by the end of the file is unknown, too.
    const bool ended = tokens.bytes_left() == 0;
    return make_error(ended ? ErrorCode::kTruncatedFile : ErrorCode::kMalformedFile,
                      "line " + std::to_string(tokens.line()) + ": " + what, tokens.line());
  };
  if (tokens.next() != "ply") return bad("no ply keyword");
  for (;;) {
    const std::string_view word = tokens.next();
    if (word.empty()) {
      return make_error(ErrorCode::kTruncatedFile, "the file ends in its header", tokens.line());
    }
    if (word == "end_header") break;
    if (word == "format") {
      const std::string_view name = tokens.next_on_line();
      if (name == "ascii")
        header.encoding = Encoding::kAscii;
      else if (name == "binary_little_endian")
        header.encoding = Encoding::kLittle;
      else if (name == "binary_big_endian")
        header.encoding = Encoding::kBig;
      else
        return bad("unknown format " + shown(name));
      has_format = true;
    } else if (word == "element") {
      Element e;
      e.name = tokens.next_on_line();
      const std::string_view count = tokens.next_on_line();
      const std::optional<long long> n = parse_integer(count);
      if (!n || *n < 0) return bad(shown(count) + " is not a count");
      e.count = static_cast<unsigned long long>(*n);
      header.elements.push_back(std::move(e));
    } else if (word == "property") {
      if (header.elements.empty()) return bad("a property before any element");
      Property p;
      std::string_view type = tokens.next_on_line();
      if (type == "list") {
        const std::string_view count = tokens.next_on_line();
        p.count = type_named(count);
        if (!p.count || *p.count == Type::kFloat || *p.count == Type::kDouble) {
          return bad(shown(count) + " is not the type of a list's length");
        }
        type = tokens.next_on_line();
      }
      const std::optional<Type> t = type_named(type);
      if (!t) return bad("unknown type " + shown(type));
      p.type = *t;
      p.name = tokens.next_on_line();
      header.elements.back().properties.push_back(std::move(p));
    } else if (word != "comment" && word != "obj_info") {
      return bad("unknown keyword " + shown(word));
    }
    tokens.skip_line();
  }
  if (!has_format) return bad("the header names no format");
  tokens.skip_line();
  header.lines = tokens.line();
  header.data = tokens.rest();
  return header;
}

constexpr std::size_t kNoProperty = ~std::size_t{0};

std::size_t find_property(const Element& e, std::string_view name, bool list) {
  for (std::size_t k = 0; k < e.properties.size(); ++k) {
    if (e.properties[k].name == name && e.properties[k].count.has_value() == list) return k;
  }
  return kNoProperty;
}

class Reader {
 public:
  explicit Reader(const Header& header)
      : header_(header), numbers_(header.data, header.encoding, header.lines) {}

  Result<PolygonMesh> read() {
    bool has_vertices = false;
    for (const Element& e : header_.elements) {
      if (e.properties.empty()) {
        if (e.count == 0) continue;
        return make_error(ErrorCode::kMalformedFile,
                          "element " + shown(e.name) + " has no properties");
      }
      std::size_t least = 0;
      for (const Property& p : e.properties) least += numbers_.least_size(p.count.value_or(p.type));
      if (e.count > (numbers_.bytes_left() + 1) / least || e.count > 0xFFFFFFFEull) {
        return make_error(ErrorCode::kTruncatedFile,
                          "the header promises " + std::to_string(e.count) + " of " +
                              shown(e.name) + ", more than the file can hold");
      }
      std::optional<Error> error;
      if (e.name == "vertex") {
        has_vertices = true;
        error = read_vertices(e);
      } else if (e.name == "face") {
        error = read_faces(e);
      } else {
        error = read_element(e, [](auto&&...) { return std::nullopt; });
      }
      if (error) return *error;
    }
    // Else the file would be taken for points alone.
    const auto connects = [](const Element& e) {
      return e.count > 0 && (e.name == "tristrips" || e.name == "edge");
    };
    if (mesh_.faces.empty() && std::ranges::any_of(header_.elements, connects)) return no_faces();
    if (!has_vertices) return make_error(ErrorCode::kMalformedFile, "no element 'vertex'");
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      for (const std::uint32_t v : mesh_.faces[f]) {
        if (v < mesh_.points.size()) continue;
        return make_error(ErrorCode::kIndexOutOfRange,
                          at("face", f, 0,
                             "vertex index " + std::to_string(v) + " of " +
                                 std::to_string(mesh_.points.size()) + " vertices"),
                          f);
      }
    }
    if (!numbers_.only_space_left()) {
      if (mesh_.faces.empty()) return no_faces();
      return make_error(ErrorCode::kMalformedFile, "data after the last element");
    }
    return std::move(mesh_);
  }

 private:
  /// Calls use(item, property, values) for each property of each item.
  template <class Use>
  std::optional<Error> read_element(const Element& e, Use&& use) {
    std::vector<double> values;
    for (std::size_t i = 0; i < e.count; ++i) {
      for (std::size_t k = 0; k < e.properties.size(); ++k) {
        const Property& p = e.properties[k];
        double length = 1;
        if (p.count) {
          if (auto error = read_number(e, i, *p.count, length)) return error;
          if (!(length >= 0) || length != std::floor(length)) {
            return make_error(ErrorCode::kMalformedFile,
                              at(e.name.c_str(), i, numbers_.line(), "not the length of a list"),
                              i);
          }
          if (length * static_cast<double>(numbers_.least_size(p.type)) >
              static_cast<double>(numbers_.bytes_left()) + 1) {
            return make_error(
                ErrorCode::kTruncatedFile,
                at(e.name.c_str(), i, numbers_.line(), "a list longer than the rest of the file"),
                i);
          }
        }
        values.resize(static_cast<std::size_t>(length));
        for (double& x : values) {
          if (auto error = read_number(e, i, p.type, x)) return error;
        }
        if (std::optional<Error> error = use(i, k, values)) return error;
      }
    }
    return std::nullopt;
  }

  std::optional<Error> read_number(const Element& e, std::size_t item, Type t, double& x) {
    switch (numbers_.next(t, x)) {
      case Numbers::Failure::kNone:
        return std::nullopt;
      case Numbers::Failure::kEnd:
        return make_error(ErrorCode::kTruncatedFile,
                          at(e.name.c_str(), item, numbers_.line(), "the file ends here"), item);
      case Numbers::Failure::kNotANumber:
        break;
    }
    return make_error(ErrorCode::kMalformedFile,
                      at(e.name.c_str(), item, numbers_.line(), "not a number"), item);
  }

  std::optional<Error> read_vertices(const Element& e) {
    const std::array<std::size_t, 3> axis = {
        find_property(e, "x", false), find_property(e, "y", false), find_property(e, "z", false)};
    if (std::find(axis.begin(), axis.end(), kNoProperty) != axis.end()) {
      return make_error(ErrorCode::kMalformedFile, "element 'vertex' lacks x, y or z");
    }
    if (!mesh_.points.empty()) {
      return make_error(ErrorCode::kMalformedFile, "a second element 'vertex'");
    }
    Point3 p;
    mesh_.points.reserve(e.count);
    return read_element(e,
                        [&, last = e.properties.size() - 1](
                            std::size_t v, std::size_t k,
                            const std::vector<double>& values) -> std::optional<Error> {
                          for (int a = 0; a < 3; ++a) {
                            if (axis[a] == k) p[a] = values[0];
                          }
                          if (k != last) return std::nullopt;
                          if (auto error = check_point(p, v, numbers_.line())) return error;
                          mesh_.points.push_back(p);
                          return std::nullopt;
                        });
  }

  std::optional<Error> read_faces(const Element& e) {
    std::size_t list = find_property(e, "vertex_indices", true);
    if (list == kNoProperty) list = find_property(e, "vertex_index", true);
    if (list == kNoProperty) {
      return make_error(ErrorCode::kMalformedFile, "element 'face' lacks the list vertex_indices");
    }
    mesh_.faces.reserve(e.count);
    return read_element(
        e,
        [&](std::size_t f, std::size_t k,
            const std::vector<double>& values) -> std::optional<Error> {
          if (k != list) return std::nullopt;
          if (values.size() < 3) {
            return make_error(ErrorCode::kMalformedFile,
                              at("face", f, numbers_.line(), "fewer than three vertices"), f);
          }
          std::vector<std::uint32_t> face;
          face.reserve(values.size());
          for (const double x : values) {
            if (x != std::floor(x)) {
              return make_error(ErrorCode::kMalformedFile,
                                at("face", f, numbers_.line(), "a vertex index is no integer"), f);
            }
            if (!(x >= 0 && x < 4294967295.0)) {
              return make_error(ErrorCode::kIndexOutOfRange,
                                at("face", f, numbers_.line(), "a vertex index is out of range"),
                                f);
            }
            face.push_back(static_cast<std::uint32_t>(x));
          }
          mesh_.faces.push_back(std::move(face));
          return std::nullopt;
        });
  }

  const Header& header_;
  Numbers numbers_;
  PolygonMesh mesh_;
};

}  // namespace

Result<PolygonMesh> ply(std::string_view bytes) {
  const Result<Header> header = read_header(bytes);
  if (!header.ok()) return header.error();
  return Reader(header.value()).read();
}

}  // namespace blum::read
