// Betti numbers over Z/2 by reducing the boundary matrix with PHAT.
//
// rank d1 and rank d2 are the numbers of columns that stay nonzero, so
//   b0 = V - rank d1,  b1 = E - rank d1 - rank d2,  b2 = F - rank d2.
// Columns are cells by *index*: parallel edges and loops are ordinary cells. Over Z/2 an edge that
// occurs twice in a boundary cancels, as do the two ends of a loop.

#include <algorithm>
#include <cstddef>

#include <phat/algorithms/twist_reduction.h>
#include <phat/boundary_matrix.h>
#include <phat/representations/default_representations.h>

#include "blum/kernel/check.hpp"
#include "blum/medial/complex.hpp"

namespace blum {
namespace {

/// Sorts the rows and drops pairs of equal ones.
void cancel_pairs(phat::column& rows) {
  std::sort(rows.begin(), rows.end());
  std::size_t kept = 0;
  for (const phat::index row : rows) {
    if (kept > 0 && rows[kept - 1] == row) {
      --kept;
    } else {
      rows[kept++] = row;
    }
  }
  rows.resize(kept);
}

/// A boundary has no boundary. An assembly that mixes up edges is caught here instead of giving
/// numbers that mean nothing.
void check_cells(const CellComplex& complex) {
  const std::size_t vertices = complex.vertex.size();
  const std::size_t edges = complex.edge.size();
  for (const ComplexEdge& e : complex.edge) {
    BLUM_CHECK(e.vertex[0] < vertices && e.vertex[1] < vertices);
  }
  phat::column ends;
  for (const ComplexTriangle& t : complex.triangle) {
    ends.clear();
    for (const std::uint32_t e : t.edge) {
      BLUM_CHECK(e < edges);
      ends.push_back(complex.edge[e].vertex[0]);
      ends.push_back(complex.edge[e].vertex[1]);
    }
    cancel_pairs(ends);
    BLUM_CHECK(ends.empty());
  }
}

}  // namespace

std::array<long, 3> betti_numbers(const CellComplex& complex) {
  check_cells(complex);
  const auto vertices = static_cast<phat::index>(complex.vertex.size());
  const auto edges = static_cast<phat::index>(complex.edge.size());
  const auto triangles = static_cast<phat::index>(complex.triangle.size());

  phat::boundary_matrix<phat::sparse_pivot_column> matrix;
  matrix.set_num_cols(vertices + edges + triangles);
  phat::column rows;
  phat::index column = 0;
  for (; column < vertices; ++column) {
    matrix.set_dim(column, 0);
    matrix.set_col(column, rows);
  }
  for (const ComplexEdge& e : complex.edge) {
    rows.assign({e.vertex[0], e.vertex[1]});
    cancel_pairs(rows);
    matrix.set_dim(column, 1);
    matrix.set_col(column++, rows);
  }
  for (const ComplexTriangle& t : complex.triangle) {
    rows.assign({vertices + t.edge[0], vertices + t.edge[1], vertices + t.edge[2]});
    cancel_pairs(rows);
    matrix.set_dim(column, 2);
    matrix.set_col(column++, rows);
  }

  // The twist clears the columns of edges that turn out to be pivots, so an edge column is nonzero
  // afterwards exactly if it is independent of the earlier ones: the ranks can be read off.
  phat::twist_reduction()(matrix);
  long rank1 = 0, rank2 = 0;
  for (phat::index c = vertices; c < vertices + edges; ++c) rank1 += matrix.is_empty(c) ? 0 : 1;
  for (phat::index c = vertices + edges; c < column; ++c) rank2 += matrix.is_empty(c) ? 0 : 1;
  return {vertices - rank1, edges - rank1 - rank2, triangles - rank2};
}

}  // namespace blum
