// .ma and .obj, and the choice of what is drawn as a line.

#include <algorithm>

#include "io_formats.hpp"

namespace blum::detail {

std::vector<std::uint32_t> drawn_edges(const MedialResult& result) {
  const CellComplex& complex = result.complex;
  std::vector<std::uint8_t> triangles(complex.edge.size(), 0);
  for (const ComplexTriangle& t : complex.triangle) {
    for (const std::uint32_t e : t.edge) {
      triangles[e] = static_cast<std::uint8_t>(std::min(triangles[e] + 1, 3));
    }
  }
  std::vector<std::uint32_t> drawn;
  for (std::uint32_t e = 0; e < complex.edge.size(); ++e) {
    const bool seam =
        e < result.parts.edge_seam.size() && result.parts.edge_seam[e] != Parts::kNoSeam;
    if (seam || triangles[e] != 2) drawn.push_back(e);
  }
  return drawn;
}

void put_ma(OutputStream& out, const MedialResult& result) {
  const CellComplex& k = result.complex;
  out << k.vertex.size() << ' ' << k.edge.size() << ' ' << k.triangle.size() << '\n';
  for (const ComplexVertex& v : k.vertex) {
    out << "v " << v.position.x << ' ' << v.position.y << ' ' << v.position.z << ' ' << v.radius
        << '\n';
  }
  for (const ComplexEdge& e : k.edge) out << "e " << e.vertex[0] << ' ' << e.vertex[1] << '\n';
  for (const ComplexTriangle& t : k.triangle) {
    const auto [a, b, c] = corners(k, t);
    out << "f " << a << ' ' << b << ' ' << c << '\n';
  }
}

void put_obj(OutputStream& out, const MedialResult& result) {
  const CellComplex& k = result.complex;
  for (const ComplexVertex& v : k.vertex) {
    out << "v " << v.position.x << ' ' << v.position.y << ' ' << v.position.z << '\n';
  }
  for (const ComplexTriangle& t : k.triangle) {
    const auto [a, b, c] = corners(k, t);
    out << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  }
  for (const std::uint32_t e : drawn_edges(result)) {
    out << "l " << k.edge[e].vertex[0] + 1 << ' ' << k.edge[e].vertex[1] + 1 << '\n';
  }
}

}  // namespace blum::detail
