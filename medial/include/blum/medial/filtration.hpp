/// Pruning: the filtration of K by separation angle (theory section 5), and its replay.
///
/// Units of a collapse. A *sheet* is removed whole, onto what bounds it: cells that other sheets or
/// bare curves have too stay, and all others (its rims, seams and nodes that it alone still has) go
/// with it. Those among them that cost more than the collapse stay as curves and points, if the
/// sheet still collapses onto what is left. An edge without triangles (*bare*: what is left of a
/// seam) is removed with an end that no other edge has. The cost of a collapse is the largest cost
/// over all cells that it removes; the cheapest available one is always done first, and the value
/// of a cell is the running maximum of the costs up to its removal. So one run answers every angle:
/// K_theta, the cells with value >= theta, is homotopy equivalent to K, keeps every cell with cost
/// >= theta, and no unit of cost below theta can be collapsed any more. Ties: the lower cost, then
/// bare edges (by edge) before sheets (by sheet).
///
/// Every collapse is a sequence of elementary ones (a cell and a face that no other cell has), kept
/// as the proof. Source: Sud, Foskey, Manocha 2005 (frontier sheets), with the changes above.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "blum/medial/complex.hpp"
#include "blum/medial/parts.hpp"

namespace blum {

/// One number a cell of a complex, in its order.
struct CellValues {
  std::vector<double> vertex, edge, triangle;
};

/// Removes a triangle with one of its edges, or an edge with one of its vertices.
struct ElementaryCollapse {
  std::uint8_t dimension = 2;  ///< of `cell`: 2 triangle, 1 edge; `face` has one less
  std::uint32_t face = 0, cell = 0;
  friend bool operator==(const ElementaryCollapse&, const ElementaryCollapse&) = default;
};

/// A collapse of one unit: the elementary ones from `begin` to the next step's.
struct CollapseStep {
  double cost = 0;   ///< largest cost of a cell that it removes
  double value = 0;  ///< running maximum
  bool is_sheet = false;
  std::uint32_t unit = 0;  ///< sheet (Parts) or edge
  std::uint32_t begin = 0;
};

struct Filtration {
  std::vector<ElementaryCollapse> collapse;
  std::vector<CollapseStep> step;
  CellValues value;
  /// Value of the cells that are never removed: above every angle in degrees.
  static constexpr double kStays = 360;
};

/// Requires: costs in [0, 180] for all cells (BLUM_CHECK on the numbers of them). A sheet costs
/// what the dearest of its triangles does. O(n log n) but for sheets that fail the final test after
/// they have passed the one by Euler characteristic.
[[nodiscard]] Filtration filter(const CellComplex& complex, const Parts& parts,
                                const CellValues& cost);

/// The same by trying every unit after every step on sets of cells: slow; the twin in tests.
[[nodiscard]] Filtration filter_by_trial(const CellComplex& complex, const Parts& parts,
                                         const CellValues& cost);

/// Which cells of a complex there are.
struct CellMask {
  std::vector<bool> vertex, edge, triangle;
};
[[nodiscard]] CellMask all_cells(const CellComplex& complex);

/// Removes the cells of [first, last) from `cells` after checking that each collapse is elementary:
/// both cells are there, the one is a face of the other, of no other cell and counted once in it
/// (an edge counted twice in a triangle is no free face). Returns what is wrong, if anything; cells
/// up to there are removed then. Uses nothing but the boundary of cells: it is what a checker does.
[[nodiscard]] std::optional<std::string> replay(const CellComplex& complex,
                                                const std::vector<ElementaryCollapse>& collapse,
                                                std::size_t first, std::size_t last,
                                                CellMask& cells);

}  // namespace blum
