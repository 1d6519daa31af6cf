// Uses every installed module: a cube's medial axis must be certified and contractible.
#include <blum/kernel/shapes.hpp>
#include <blum/kernel/solid.hpp>
#include <blum/medial/medial_axis.hpp>
#include <iostream>

int main() {
  const auto solid = blum::build_solid(blum::shapes::cuboid(1, 2, 3));
  if (!solid) return 2;
  const auto axis = blum::compute_medial_axis(solid.value(), {});
  if (!axis) return 2;
  const auto [b0, b1, b2] = axis.value().betti;
  std::cout << "certified " << axis.value().certified << ", Betti numbers " << b0 << ' ' << b1
            << ' ' << b2 << '\n';
  return axis.value().certified && b0 == 1 && b1 == 0 && b2 == 0 ? 0 : 1;
}
