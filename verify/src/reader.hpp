/// Reads the records of a certificate (docs/certificate.md), one a line. All throw Unreadable where
/// the text is not a certificate, or is cut short.
#pragma once

#include <istream>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "face.hpp"
#include "graph.hpp"

namespace blum::verify {

class Unreadable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

inline constexpr std::size_t kMost = 0xffffffffu, kAnySize = static_cast<std::size_t>(-1);

class Reader {
 public:
  explicit Reader(std::istream& in) : in_(in) {}

  /// The next record's content; its name must be `name`.
  [[nodiscard]] nlohmann::json next(const char* name);
  /// Is the next record called `name`?
  [[nodiscard]] bool at(const char* name);
  /// The text must end here.
  void end();
  [[nodiscard]] std::size_t line() const { return line_; }

 private:
  void fill();
  std::istream& in_;
  nlohmann::json record_;  // null: not read yet
  std::size_t line_ = 0;
};

/// Finite.
[[nodiscard]] double read_number(const nlohmann::json& j);
/// A whole number from 0, less than `limit`.
[[nodiscard]] std::uint32_t read_index(const nlohmann::json& j, std::size_t limit);
/// A list of that length.
[[nodiscard]] const nlohmann::json& read_list(const nlohmann::json& j, std::size_t size = kAnySize);
/// Sorted, no two equal, less than `limit`.
[[nodiscard]] std::vector<Site> read_sites(const nlohmann::json& j, std::uint32_t limit);
[[nodiscard]] std::vector<PartNode> read_parts(const nlohmann::json& j, const Shape& shape);
[[nodiscard]] Graph read_graph(const nlohmann::json& j, const Shape& shape);

}  // namespace blum::verify
