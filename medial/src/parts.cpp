// Reads sheets, seams, junctions and clusters from the shapes of the cones' base graphs; labels of
// governors play no part (theory section 4, "To read K").

#include "blum/medial/parts.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "blum/kernel/check.hpp"
#include "parts_cone_shape.hpp"
#include "parts_numbering.hpp"

namespace blum {
namespace {

using detail::BaseGraph;
using detail::SetNumbering;

constexpr std::uint32_t kNone = 0xffffffffu;

bool joins(const ComplexEdge& e, std::uint32_t a, std::uint32_t b) {
  return (e.vertex[0] == a && e.vertex[1] == b) || (e.vertex[0] == b && e.vertex[1] == a);
}

void check_cells(const CellComplex& complex) {
  for (const ComplexEdge& e : complex.edge) {
    BLUM_CHECK(e.vertex[0] < complex.vertex.size() && e.vertex[1] < complex.vertex.size());
  }
  for (const ComplexCone& c : complex.cone) BLUM_CHECK(c.apex < complex.vertex.size());
  for (const ComplexTriangle& t : complex.triangle) {
    BLUM_CHECK(t.cone < complex.cone.size());
    for (const std::uint32_t e : t.edge) BLUM_CHECK(e < complex.edge.size());
    const std::uint32_t apex = complex.cone[t.cone].apex;
    const ComplexEdge& base = complex.edge[t.edge[0]];
    BLUM_CHECK(joins(complex.edge[t.edge[1]], base.vertex[0], apex));
    BLUM_CHECK(joins(complex.edge[t.edge[2]], base.vertex[1], apex));
  }
}

/// Triangles sorted by cone; those of cone c are [begin[c], begin[c + 1]).
struct TrianglesByCone {
  explicit TrianglesByCone(const CellComplex& complex)
      : begin(complex.cone.size() + 1, 0), triangle(complex.triangle.size()) {
    for (const ComplexTriangle& t : complex.triangle) ++begin[t.cone + 1];
    for (std::size_t c = 1; c < begin.size(); ++c) begin[c] += begin[c - 1];
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (std::uint32_t t = 0; t < complex.triangle.size(); ++t) {
      triangle[next[complex.triangle[t].cone]++] = t;
    }
  }
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t c) const {
    return std::span(triangle).subspan(begin[c], begin[c + 1] - begin[c]);
  }
  std::vector<std::uint32_t> begin, triangle;
};

/// A seam goes on through a vertex that is the apex of a kSeam cone, or a node between two leaves.
/// It ends at every other apex and at vertices of the boundary.
std::vector<bool> find_passages(const CellComplex& complex, const std::vector<ConeShape>& shape) {
  std::vector<bool> passage(complex.vertex.size());
  for (std::size_t v = 0; v < complex.vertex.size(); ++v) {
    passage[v] = complex.vertex[v].kind != ComplexVertex::Kind::kBoundary;
  }
  for (std::size_t c = 0; c < complex.cone.size(); ++c) {
    if (shape[c] != ConeShape::kSeam) passage[complex.cone[c].apex] = false;
  }
  return passage;
}

/// Numbers the seams: seam edges that meet, two alone, at a passage belong together.
void number_seams(const CellComplex& complex, const std::vector<bool>& is_seam, Parts& parts) {
  const std::vector<bool> passage = find_passages(complex, parts.cone_shape);
  std::vector<std::array<std::uint32_t, 2>> at(complex.vertex.size(), {kNone, kNone});
  std::vector<std::uint8_t> count(complex.vertex.size(), 0);
  for (std::uint32_t e = 0; e < complex.edge.size(); ++e) {
    if (!is_seam[e]) continue;
    for (const std::uint32_t v : complex.edge[e].vertex) {
      if (count[v] < 2) at[v][count[v]] = e;
      if (count[v] < 3) ++count[v];
    }
  }
  UnionFind sets;
  sets.resize(static_cast<std::uint32_t>(complex.edge.size()));
  for (std::size_t v = 0; v < complex.vertex.size(); ++v) {
    if (passage[v] && count[v] == 2) sets.unite(at[v][0], at[v][1]);
  }
  SetNumbering number(sets);
  parts.edge_seam.assign(complex.edge.size(), Parts::kNoSeam);
  for (std::uint32_t e = 0; e < complex.edge.size(); ++e) {
    if (is_seam[e]) parts.edge_seam[e] = number.of(e);
  }
  parts.seams = number.count();
}

std::vector<bool> first_of_rings(const CellComplex& complex) {
  std::vector<bool> first(complex.cone.size(), false);
  for (const ComplexCone& c : complex.cone)
    if (c.ring != ComplexCone::kNone) first[c.ring] = true;
  return first;
}

/// Seams that end in a ring: spokes to its first apex that three sheets or more have in common.
void find_seams_at_rings(const CellComplex& complex, const std::vector<bool>& ringed,
                         std::vector<bool>& is_seam) {
  if (std::ranges::find(ringed, true) == ringed.end()) return;
  std::vector<std::uint32_t> sheets(complex.edge.size(), 0);
  for (const ComplexTriangle& t : complex.triangle)
    for (const auto e : t.edge) ++sheets[e];
  for (std::uint32_t e = 0; e < complex.edge.size(); ++e)
    if (complex.edge[e].kind == ComplexEdge::Kind::kCone && ringed[complex.edge[e].leaf])
      is_seam[e] = sheets[e] >= 3;
}

bool is_on_ring(const CellComplex& complex, const ComplexEdge& e) {
  return e.kind == ComplexEdge::Kind::kCone && complex.cone[e.leaf].ring != ComplexCone::kNone &&
         complex.vertex[e.vertex[0]].kind == ComplexVertex::Kind::kCone;
}

/// Numbers the sheets: triangles that share an edge outside seams and rings belong together.
void number_sheets(const CellComplex& complex, const std::vector<bool>& is_seam, Parts& parts) {
  UnionFind sets;
  sets.resize(static_cast<std::uint32_t>(complex.triangle.size()));
  std::vector<std::uint32_t> first(complex.edge.size(), kNone);
  for (std::uint32_t t = 0; t < complex.triangle.size(); ++t) {
    for (const std::uint32_t e : complex.triangle[t].edge) {
      if (is_seam[e] || is_on_ring(complex, complex.edge[e])) continue;
      if (first[e] == kNone) {
        first[e] = t;
      } else {
        sets.unite(first[e], t);
      }
    }
  }
  SetNumbering number(sets);
  parts.triangle_sheet.resize(complex.triangle.size());
  for (std::uint32_t t = 0; t < complex.triangle.size(); ++t) {
    parts.triangle_sheet[t] = number.of(t);
  }
  parts.sheets = number.count();
}

}  // namespace

Parts read_parts(const CellComplex& complex) {
  check_cells(complex);
  Parts parts;
  parts.cone_shape.reserve(complex.cone.size());
  std::vector<bool> is_seam(complex.edge.size(), false);
  const TrianglesByCone triangles(complex);
  BaseGraph graph(complex);
  const std::vector<bool> ringed = first_of_rings(complex);
  for (std::size_t c = 0; c < complex.cone.size(); ++c) {
    if (ringed[c] || complex.cone[c].ring != ComplexCone::kNone) {
      parts.cone_shape.push_back(ringed[c] ? ConeShape::kCluster : ConeShape::kRing);
      parts.clusters += ringed[c] ? 1 : 0;
      continue;
    }
    graph.read(triangles.of(c));
    const bool at_boundary = complex.cone[c].boundary_vertex != ComplexCone::kNone;
    parts.cone_shape.push_back(graph.shape(at_boundary));
    parts.junctions += parts.cone_shape.back() == ConeShape::kJunction ? 1 : 0;
    parts.clusters += parts.cone_shape.back() == ConeShape::kCluster ? 1 : 0;
    for (const std::uint32_t t : triangles.of(c)) {
      const ComplexTriangle& triangle = complex.triangle[t];
      const auto& base = complex.edge[triangle.edge[0]].vertex;
      for (std::size_t end = 0; end < 2; ++end) {
        if (graph.degree(base[end]) >= 3) is_seam[triangle.edge[1 + end]] = true;
      }
    }
  }
  find_seams_at_rings(complex, ringed, is_seam);
  number_seams(complex, is_seam, parts);
  number_sheets(complex, is_seam, parts);
  return parts;
}

}  // namespace blum
