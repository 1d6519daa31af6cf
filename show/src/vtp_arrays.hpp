/// Looking into arrays of a .vtp file that anybody may have written.
#pragma once

#include <cmath>
#include <span>
#include <string>

#include "blum/show/vtp_file.hpp"

namespace blum::detail {

/// What is wrong with the file; caught by the public functions that read.
struct Malformed {
  std::string message;
};

/// Whether v is one of lo, lo + 1, ... below `end` (lo whole).
[[nodiscard]] inline bool is_whole(double v, double lo, double end) {
  return v >= lo && v < end && v == std::trunc(v);
}

/// Coordinates may be as large as the box of a Voronoi diagram around the largest model; squares of
/// areas of larger ones overflow.
inline void require_coordinates(std::span<const double> values) {
  constexpr double kMost = 0x1p220;
  for (const double v : values) {
    if (!(std::abs(v) <= kMost)) throw Malformed{"a coordinate is not finite or too large"};
  }
}

/// The array, if it is there.
[[nodiscard]] inline const VtpArray* find(const VtpArrays& arrays, const char* name,
                                          int components) {
  const auto found = arrays.find(name);
  if (found == arrays.end()) return nullptr;
  if (found->second.components != components) {
    throw Malformed{std::string("array ") + name + " has another number of components"};
  }
  return &found->second;
}

}  // namespace blum::detail
