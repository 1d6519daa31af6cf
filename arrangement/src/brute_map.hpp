/// From the cells of a sweep to the map: which elements belong to G, regions and pieces.
#pragma once

#include <cstdint>
#include <vector>

#include "brute_sweep.hpp"

namespace blum::brute {

struct Map {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<char> in_g;                  ///< per element: on an essential tie, inside
  std::vector<std::vector<int>> sections;  ///< per point: the sections of G that end there
  std::vector<std::uint32_t> region;       ///< per element; kNone on G, ∂O and outside
  std::vector<std::uint32_t> piece;        ///< per element; kNone on ∂O and outside
  std::vector<std::vector<int>> labels;    ///< per region: all governors of its points, sorted
  std::vector<std::uint32_t> region_piece;
  std::vector<std::uint32_t> circles;  ///< per piece
};

/// Throws BadPosition if a sheet or a rim lies in the plane or touches it along an arc.
[[nodiscard]] Map make_map(const Setting& setting, const Sweep& sweep);

}  // namespace blum::brute
