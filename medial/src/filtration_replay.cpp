// Replaying a sequence of elementary collapses: boundaries of cells and counting, nothing else.

#include <array>
#include <string>
#include <vector>

#include "blum/kernel/check.hpp"
#include "blum/medial/filtration.hpp"

namespace blum {
namespace {

/// How often each edge (vertex) that is there occurs in a triangle (edge) that is there.
struct Cofaces {
  std::vector<std::uint32_t> edge, vertex;
  Cofaces(const CellComplex& complex, const CellMask& cells)
      : edge(complex.edge.size(), 0), vertex(complex.vertex.size(), 0) {
    for (std::size_t t = 0; t < complex.triangle.size(); ++t)
      if (cells.triangle[t])
        for (const auto e : complex.triangle[t].edge) ++edge[e];
    for (std::size_t e = 0; e < complex.edge.size(); ++e)
      if (cells.edge[e])
        for (const auto v : complex.edge[e].vertex) ++vertex[v];
  }
};

template <std::size_t N>
bool has(const std::array<std::uint32_t, N>& faces, std::uint32_t face) {
  for (const auto f : faces)
    if (f == face) return true;
  return false;
}

}  // namespace

CellMask all_cells(const CellComplex& complex) {
  return {std::vector<bool>(complex.vertex.size(), true),
          std::vector<bool>(complex.edge.size(), true),
          std::vector<bool>(complex.triangle.size(), true)};
}

std::optional<std::string> replay(const CellComplex& complex,
                                  const std::vector<ElementaryCollapse>& collapse,
                                  std::size_t first, std::size_t last, CellMask& cells) {
  BLUM_CHECK(first <= last && last <= collapse.size());
  Cofaces cofaces(complex, cells);
  for (std::size_t k = first; k < last; ++k) {
    const ElementaryCollapse& c = collapse[k];
    const auto wrong = [&](const char* what) {
      return "collapse " + std::to_string(k) + ": " + what;
    };
    if (c.dimension == 2) {
      if (c.cell >= complex.triangle.size() || c.face >= complex.edge.size())
        return wrong("no such cell");
      if (!cells.triangle[c.cell] || !cells.edge[c.face]) return wrong("a cell is gone already");
      if (!has(complex.triangle[c.cell].edge, c.face)) return wrong("not a face of the cell");
      if (cofaces.edge[c.face] != 1) return wrong("the face is not free");
      cells.triangle[c.cell] = cells.edge[c.face] = false;
      for (const auto e : complex.triangle[c.cell].edge) --cofaces.edge[e];
      for (const auto v : complex.edge[c.face].vertex) --cofaces.vertex[v];
    } else if (c.dimension == 1) {
      if (c.cell >= complex.edge.size() || c.face >= complex.vertex.size())
        return wrong("no such cell");
      if (!cells.edge[c.cell] || !cells.vertex[c.face]) return wrong("a cell is gone already");
      if (!has(complex.edge[c.cell].vertex, c.face)) return wrong("not a face of the cell");
      if (cofaces.edge[c.cell] != 0) return wrong("a triangle has the edge");
      if (cofaces.vertex[c.face] != 1) return wrong("the face is not free");
      cells.edge[c.cell] = cells.vertex[c.face] = false;
      for (const auto v : complex.edge[c.cell].vertex) --cofaces.vertex[v];
    } else {
      return wrong("no such dimension");
    }
  }
  return std::nullopt;
}

}  // namespace blum
