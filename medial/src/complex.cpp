#include "blum/medial/complex.hpp"

namespace blum {

std::array<std::uint32_t, 3> corners(const CellComplex& complex, const ComplexTriangle& triangle) {
  const auto& base = complex.edge[triangle.edge[0]].vertex;
  const auto& side = complex.edge[triangle.edge[1]].vertex;
  return {base[0], base[1], side[0] == base[0] || side[0] == base[1] ? side[1] : side[0]};
}

}  // namespace blum
