#include "leaf_triangles.hpp"

namespace blum {

std::vector<LeafTriangle> leaf_triangles(const Frame& frame, const AxisMesh& mesh,
                                         std::span<const std::uint32_t> which,
                                         const LeafSides& sides) {
  std::vector<LeafTriangle> list;
  for (const auto t : which) {
    const ComplexTriangle& triangle = mesh.complex.triangle[t];
    LeafTriangle l;
    const auto corner = corners(mesh.complex, triangle);
    bool placed = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const ComplexVertex& v = mesh.complex.vertex[corner[k]];
      l.corner[k] = frame.to_working(v.position);
      l.on_rim[k] = v.on_axis && v.radius == 0;
      placed = placed && v.on_axis;
    }
    const auto side = sides.sides_of(triangle.governors);
    l.a = side.front();
    l.b = side.back();
    l.well_placed = placed && side.size() > 1;
    list.push_back(std::move(l));
  }
  return list;
}

}  // namespace blum
