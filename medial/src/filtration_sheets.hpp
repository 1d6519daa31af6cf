/// What is left of a complex while it is pruned: whose private cells are whose, and the collapse of
/// one sheet.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "blum/medial/filtration.hpp"

namespace blum::detail {

inline constexpr std::uint32_t kNone = 0xffffffffu;

/// Rows of numbers, compressed.
class Rows {
 public:
  Rows() = default;
  /// `visit(put)` calls put(row, value) for all entries, in the same order both times.
  template <class Visit>
  Rows(std::size_t rows, Visit visit) : begin_(rows + 1, 0) {
    visit([&](std::uint32_t row, std::uint32_t) { ++begin_[row + 1]; });
    for (std::size_t r = 1; r <= rows; ++r) begin_[r] += begin_[r - 1];
    value_.resize(begin_[rows]);
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    visit([&](std::uint32_t row, std::uint32_t value) { value_[next[row]++] = value; });
  }
  [[nodiscard]] std::span<const std::uint32_t> operator[](std::uint32_t row) const {
    return std::span(value_).subspan(begin_[row], begin_[row + 1] - begin_[row]);
  }

 private:
  std::vector<std::uint32_t> begin_, value_;
};

/// The triangles at each edge; an edge counted twice in a triangle has it twice.
[[nodiscard]] Rows triangles_at_edges(const CellComplex& complex);
[[nodiscard]] Rows triangles_of_sheets(const CellComplex& complex, const Parts& parts);

/// An edge or vertex is *private* to a sheet if all triangles around it are of that sheet and, for
/// vertices, no bare edge is there. What is private stays so until the sheet goes.
class PruneState {
 public:
  PruneState(const CellComplex& complex, const Parts& parts, const CellValues& cost);

  /// The least cost >= at_least at which the sheet passes the test by Euler characteristic.
  [[nodiscard]] std::optional<double> cheapest(std::uint32_t sheet, double at_least);

  /// Collapses the sheet, private cells of at most this cost included. Nothing is changed if it
  /// does not collapse.
  [[nodiscard]] std::optional<std::vector<ElementaryCollapse>> try_sheet(std::uint32_t sheet,
                                                                         double cost);

  /// The bare edge whose end v is, where v has no other; else kNone.
  [[nodiscard]] std::uint32_t only_bare_edge(std::uint32_t v) const;
  /// Requires: only_bare_edge(v) == e.
  void remove_bare_edge(std::uint32_t v, std::uint32_t e);

  /// Sheets that have got new private cells, and vertices that have lost an edge or got a bare one.
  [[nodiscard]] const std::vector<std::uint32_t>& touched_sheets() const { return sheets_; }
  [[nodiscard]] const std::vector<std::uint32_t>& touched_vertices() const { return vertices_; }
  void clear_touched();

 private:
  static constexpr std::uint32_t kShared = 0xfffffffeu, kBare = 0xfffffffdu;
  struct Sheet {
    double cost = 0;
    long euler = 0;                                     // of its triangles and private cells
    long free = 0;                                      // private edges with one triangle
    std::vector<std::uint32_t> dear_edge, dear_vertex;  // private, of a higher cost than the sheet
    bool touched = false;
  };

  [[nodiscard]] std::uint32_t owner_of(std::uint32_t edge) const;
  void count_edge_at(std::uint32_t vertex, std::uint32_t owner);
  void discount_edge_at(std::uint32_t vertex, std::uint32_t owner);
  void claim_edge(std::uint32_t edge, std::uint32_t sheet);
  void claim_vertex(std::uint32_t vertex, std::uint32_t sheet);
  void touch(std::uint32_t sheet);
  /// Stamps what is kept at this cost; returns its Euler characteristic and number of free edges.
  std::pair<long, long> keep_above(const Sheet& sheet, std::uint32_t id, double cost);
  [[nodiscard]] bool removable_edge(std::uint32_t e, std::uint32_t sheet) const {
    return owner_[e] == sheet && edge_stamp_[e] != stamp_;
  }
  [[nodiscard]] bool removable_vertex(std::uint32_t v, std::uint32_t sheet) const {
    return vertex_owner_[v] == sheet && vertex_stamp_[v] != stamp_;
  }
  void drop_triangle(std::uint32_t t, int sign);
  void drop_edge(std::uint32_t e, int sign);
  void collapse_triangles(std::uint32_t sheet, std::vector<ElementaryCollapse>& done);
  void collapse_graph(std::uint32_t sheet, std::vector<ElementaryCollapse>& done);
  void undo(const std::vector<ElementaryCollapse>& done);
  void hand_over(std::uint32_t sheet, const std::vector<ElementaryCollapse>& done);

  const CellComplex& complex_;
  const CellValues& cost_;
  const std::vector<std::uint32_t>& sheet_of_;
  Rows at_edge_, of_sheet_;
  std::vector<Sheet> sheet_;
  std::vector<bool> gone_, edge_gone_;       // gone_: triangles
  std::vector<std::uint32_t> degree_;        // triangles at an edge
  std::vector<std::uint32_t> owner_;         // of an edge: a sheet, kShared, kBare; kNone: gone
  std::vector<std::uint32_t> edges_;         // edge ends at a vertex
  std::vector<std::uint32_t> edge_xor_;      // of their edges: with one edge, that edge
  std::vector<std::uint32_t> vertex_owner_;  // a sheet: private; kNone: not private, or gone
  /// Owners of the edges at vertices that are not private at first, with their numbers.
  std::vector<std::uint32_t> list_of_;
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> list_;
  std::vector<std::uint32_t> edge_stamp_, vertex_stamp_;
  std::uint32_t stamp_ = 0;
  std::vector<std::uint32_t> sheets_, vertices_, stack_;
};

}  // namespace blum::detail
