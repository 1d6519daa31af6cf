/// Coordinates that are equal up to noise: which value is meant?
#pragma once

#include <cstddef>
#include <vector>

namespace blum {

/// A few values, more than `reach` apart, one of them within `reach` of every given coordinate.
class Levels {
 public:
  /// Greedy: the value that has the most coordinates within reach absorbs them, and so on with what
  /// is left below and above. Ties: the shortest decimal, the most frequent, the smallest absolute
  /// value, the positive one. The order of `coordinates` has no influence.
  Levels(std::vector<double> coordinates, double reach);

  /// Requires: one of the coordinates.
  [[nodiscard]] double level_of(double coordinate) const;

 private:
  struct Value {
    double at = 0;
    std::size_t times = 0;
    double level = 0;
  };
  struct Range {
    std::size_t begin = 0, end = 0;
  };
  /// Gives one level to the part of [begin, end) that it returns.
  Range choose_level(std::size_t begin, std::size_t end, double reach);

  std::vector<Value> value_;  // increasing
};

}  // namespace blum
