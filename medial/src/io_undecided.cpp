// Boxes as six quadrilaterals each, as PolyData.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "blum/kernel/vtk_xml.hpp"
#include "io_formats.hpp"

namespace blum::detail {
namespace {

/// Corner c of a box is high on axis k where bit k of c is set.
constexpr std::size_t kCorners = 8;
constexpr std::array<std::array<int, 4>, 6> kQuads{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

/// A cell array: one value a box, repeated for its quadrilaterals.
template <class T, class OfCell>
void put_cell_array(OutputStream& out, std::string_view name, std::span<const UndecidedCell> cells,
                    OfCell of_cell) {
  DataArray<T> array(out, name, kQuads.size() * cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (std::size_t q = 0; q < kQuads.size(); ++q) array.put(of_cell(i));
}

}  // namespace

void put_undecided(OutputStream& out, std::span<const UndecidedCell> cells) {
  const std::size_t quads = kQuads.size() * cells.size();
  out << vtp_head() << "<Piece NumberOfPoints=\"" << kCorners * cells.size()
      << "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" << quads
      << "\">\n<CellData Scalars=\"reason\">\n";
  put_cell_array<std::uint8_t>(out, "reason", cells,
                               [&](std::size_t i) { return cells[i].reason; });
  put_cell_array<std::int32_t>(out, "depth", cells, [&](std::size_t i) { return cells[i].depth; });
  put_cell_array<std::int64_t>(out, "cell", cells, [](std::size_t i) { return i; });
  out << "</CellData>\n<Points>\n";
  {
    DataArray<double> array(out, "Points", kCorners * cells.size(), 3);
    for (const UndecidedCell& cell : cells)
      for (std::size_t c = 0; c < kCorners; ++c)
        for (int k = 0; k < 3; ++k) array.put((c >> k & 1u) != 0 ? cell.box.hi[k] : cell.box.lo[k]);
  }
  out << "</Points>\n<Polys>\n";
  {
    DataArray<std::int64_t> array(out, "connectivity", 4 * quads);
    for (std::size_t i = 0; i < cells.size(); ++i)
      for (const auto& quad : kQuads)
        for (const int c : quad) array.put(kCorners * i + static_cast<std::size_t>(c));
  }
  put_offsets(out, quads, 4);
  out << "</Polys>\n</Piece>\n" << kVtpTail;
}

}  // namespace blum::detail
