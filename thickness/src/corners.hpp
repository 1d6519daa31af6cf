#pragma once

#include <array>
#include <cstdint>

#include "blum/medial/complex.hpp"

namespace blum::detail {

/// The vertices of a triangle: both ends of its base, then the apex.
inline std::array<std::uint32_t, 3> corners(const CellComplex& k, const ComplexTriangle& t) {
  const auto& base = k.edge[t.edge[0]].vertex;
  const auto& spoke = k.edge[t.edge[1]].vertex;
  return {base[0], base[1], spoke[0] == base[0] || spoke[0] == base[1] ? spoke[1] : spoke[0]};
}

}  // namespace blum::detail
