// betti_numbers on spaces whose homology is known, and against plain elimination over GF(2).

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "blum/kernel/check.hpp"
#include "blum/medial/complex.hpp"
#include "medial/parts_builder.hpp"

namespace blum {
namespace {

using Betti = std::array<long, 3>;
using Index = std::uint32_t;

/// A complex from triangles given by their corners, edges shared by their ends.
CellComplex simplicial(Index vertices, const std::vector<std::array<Index, 3>>& triangles) {
  CellComplex complex;
  complex.vertex.resize(vertices);
  std::map<std::array<Index, 2>, Index> edges;
  const auto edge = [&](Index a, Index b) {
    const auto [place, added] =
        edges.try_emplace({std::min(a, b), std::max(a, b)}, complex.edge.size());
    if (added) complex.edge.push_back({{a, b}, ComplexEdge::Kind::kArc, 0, {}});
    return place->second;
  };
  for (const auto& [a, b, c] : triangles) {
    complex.triangle.push_back({{edge(a, b), edge(b, c), edge(c, a)}, 0, {}});
  }
  return complex;
}

/// The n x m grid of squares, each cut in two, its opposite sides glued: a torus; with `flip` the
/// second gluing reverses, a Klein bottle; without the second gluing (`open`) an annulus or a
/// Moebius strip.
CellComplex square_grid(Index n, Index m, bool flip, bool open) {
  const auto at = [&](Index i, Index j) {
    if (i == n && !open) {
      i = 0;
      j = flip ? (m - j % m) % m : j % m;
    }
    return i * m + j % m;
  };
  std::vector<std::array<Index, 3>> triangles;
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < m; ++j) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return simplicial((n + 1) * m, triangles);
}

CellComplex without_loose_vertices(CellComplex complex) {
  std::vector<Index> index(complex.vertex.size(), 0);
  for (const ComplexEdge& e : complex.edge) {
    for (const Index v : e.vertex) index[v] = 1;
  }
  Index kept = 0;
  for (Index& i : index) i = i != 0 ? kept++ : 0;
  complex.vertex.resize(kept);
  for (ComplexEdge& e : complex.edge) {
    for (Index& v : e.vertex) v = index[v];
  }
  return complex;
}

CellComplex disjoint_union(CellComplex a, const CellComplex& b) {
  const auto vertices = static_cast<Index>(a.vertex.size());
  const auto edges = static_cast<Index>(a.edge.size());
  a.vertex.insert(a.vertex.end(), b.vertex.begin(), b.vertex.end());
  for (ComplexEdge e : b.edge) {
    for (Index& v : e.vertex) v += vertices;
    a.edge.push_back(e);
  }
  for (ComplexTriangle t : b.triangle) {
    for (Index& e : t.edge) e += edges;
    a.triangle.push_back(t);
  }
  return a;
}

CellComplex graph(Index vertices, const std::vector<std::array<Index, 2>>& edges) {
  CellComplex complex;
  complex.vertex.resize(vertices);
  for (const auto& ends : edges) {
    complex.edge.push_back({ends, ComplexEdge::Kind::kArc, 0, {}});
  }
  return complex;
}

CellComplex sphere() { return simplicial(4, {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}); }
CellComplex torus() { return without_loose_vertices(square_grid(4, 5, false, false)); }
CellComplex klein_bottle() { return without_loose_vertices(square_grid(5, 4, true, false)); }
CellComplex annulus() { return square_grid(3, 4, false, true); }
CellComplex moebius() {
  return simplicial(6, {{0, 1, 3}, {1, 3, 4}, {1, 2, 4}, {2, 4, 5}, {2, 5, 3}, {5, 3, 0}});
}

TEST(BettiNumbers, KnownSpaces_HaveTheirHomology) {
  EXPECT_EQ(betti_numbers(CellComplex{}), (Betti{0, 0, 0}));
  EXPECT_EQ(betti_numbers(graph(3, {})), (Betti{3, 0, 0}));
  EXPECT_EQ(betti_numbers(simplicial(3, {{0, 1, 2}})), (Betti{1, 0, 0}));
  EXPECT_EQ(betti_numbers(sphere()), (Betti{1, 0, 1}));
  EXPECT_EQ(betti_numbers(torus()), (Betti{1, 2, 1}));
  EXPECT_EQ(betti_numbers(klein_bottle()), (Betti{1, 2, 1}));  // over Z/2
  EXPECT_EQ(betti_numbers(annulus()), (Betti{1, 1, 0}));
  EXPECT_EQ(betti_numbers(moebius()), (Betti{1, 1, 0}));
}

TEST(BettiNumbers, ProjectivePlane_SeesTheTorsionOverZ2) {
  const CellComplex rp2 = simplicial(6, {{0, 1, 2},
                                         {0, 2, 3},
                                         {0, 3, 4},
                                         {0, 4, 5},
                                         {0, 5, 1},
                                         {1, 2, 4},
                                         {2, 3, 5},
                                         {3, 4, 1},
                                         {4, 5, 2},
                                         {5, 1, 3}});
  EXPECT_EQ(betti_numbers(rp2), (Betti{1, 1, 1}));
}

TEST(BettiNumbers, Graphs_CountIndependentCycles) {
  EXPECT_EQ(betti_numbers(graph(2, {{0, 1}, {0, 1}, {0, 1}})), (Betti{1, 2, 0}));  // theta
  EXPECT_EQ(betti_numbers(graph(2, {{0, 1}, {1, 0}})), (Betti{1, 1, 0}));          // parallel
  EXPECT_EQ(betti_numbers(graph(1, {{0, 0}})), (Betti{1, 1, 0}));                  // loop
  EXPECT_EQ(betti_numbers(graph(4, {{0, 0}, {2, 3}})), (Betti{3, 1, 0}));
}

TEST(BettiNumbers, CellsWithRepeatedFaces_AreLegal) {
  // One vertex and loops: the torus a b a' b' in two triangles with diagonal c.
  CellComplex torus_cw = graph(1, {{0, 0}, {0, 0}, {0, 0}});
  torus_cw.triangle.push_back({{0, 1, 2}, 0, {}});
  torus_cw.triangle.push_back({{0, 1, 2}, 0, {}});
  EXPECT_EQ(betti_numbers(torus_cw), (Betti{1, 2, 1}));
  // A cone on a loop: base edge v v, both cone edges the same.
  CellComplex disk = graph(2, {{0, 0}, {0, 1}});
  disk.triangle.push_back({{0, 1, 1}, 0, {}});
  EXPECT_EQ(betti_numbers(disk), (Betti{1, 0, 0}));
  // The dunce hat: one edge three times.
  CellComplex dunce = graph(1, {{0, 0}});
  dunce.triangle.push_back({{0, 0, 0}, 0, {}});
  EXPECT_EQ(betti_numbers(dunce), (Betti{1, 0, 0}));
  // A sphere of two triangles on the same three edges.
  CellComplex pillow = simplicial(3, {{0, 1, 2}});
  pillow.triangle.push_back(pillow.triangle[0]);
  EXPECT_EQ(betti_numbers(pillow), (Betti{1, 0, 1}));
}

TEST(BettiNumbers, DisjointUnion_AddsUp) {
  const std::vector<CellComplex> parts = {sphere(), torus(), klein_bottle(), moebius(), annulus()};
  CellComplex all;
  Betti sum{};
  for (const CellComplex& part : parts) {
    all = disjoint_union(all, part);
    for (std::size_t i = 0; i < 3; ++i) sum[i] += betti_numbers(part)[i];
  }
  EXPECT_EQ(betti_numbers(all), sum);
}

TEST(BettiNumbers, IndicesOutOfRange_BreakTheContract) {
  EXPECT_THROW((void)betti_numbers(graph(1, {{0, 1}})), BrokenInvariant);
  CellComplex complex = sphere();
  complex.triangle[0].edge[2] = static_cast<Index>(complex.edge.size());
  EXPECT_THROW((void)betti_numbers(complex), BrokenInvariant);
}

TEST(BettiNumbers, TriangleWhoseEdgesDoNotClose_BreaksTheContract) {
  CellComplex complex = graph(4, {{0, 1}, {1, 2}, {2, 3}});
  complex.triangle.push_back({{0, 1, 2}, 0, {}});
  EXPECT_THROW((void)betti_numbers(complex), BrokenInvariant);
}

/// Rank over GF(2) by plain elimination on dense columns.
long rank(std::vector<std::vector<bool>> columns) {
  long rank = 0;
  const std::size_t rows = columns.empty() ? 0 : columns[0].size();
  for (std::size_t row = 0; row < rows; ++row) {
    const auto pivot =
        std::find_if(columns.begin() + rank, columns.end(), [&](const auto& c) { return c[row]; });
    if (pivot == columns.end()) continue;
    std::swap(*pivot, columns[static_cast<std::size_t>(rank)]);
    for (auto c = columns.begin() + rank + 1; c != columns.end(); ++c) {
      if (!(*c)[row]) continue;
      for (std::size_t r = 0; r < rows; ++r) {
        (*c)[r] = (*c)[r] != columns[static_cast<std::size_t>(rank)][r];
      }
    }
    ++rank;
  }
  return rank;
}

Betti betti_by_elimination(const CellComplex& complex) {
  std::vector<std::vector<bool>> d1, d2;
  for (const ComplexEdge& e : complex.edge) {
    auto& column = d1.emplace_back(complex.vertex.size(), false);
    for (const Index v : e.vertex) column[v] = !column[v];
  }
  for (const ComplexTriangle& t : complex.triangle) {
    auto& column = d2.emplace_back(complex.edge.size(), false);
    for (const Index e : t.edge) column[e] = !column[e];
  }
  const long r1 = rank(d1), r2 = rank(d2);
  return {static_cast<long>(complex.vertex.size()) - r1,
          static_cast<long>(complex.edge.size()) - r1 - r2,
          static_cast<long>(complex.triangle.size()) - r2};
}

/// Random vertices, edges (parallel ones and loops among them) and triangles on edges that close.
CellComplex random_complex() {
  const auto vertices = *rc::gen::inRange<Index>(1, 8);
  const auto vertex = rc::gen::inRange<Index>(0, vertices);
  CellComplex complex =
      graph(vertices, *rc::gen::container<std::vector<std::array<Index, 2>>>(
                          rc::gen::map(rc::gen::pair(vertex, vertex), [](const auto& ends) {
                            return std::array<Index, 2>{ends.first, ends.second};
                          })));
  const auto edges = static_cast<Index>(complex.edge.size());
  if (edges == 0) return complex;
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  const auto wanted = *rc::gen::inRange<std::size_t>(0, 30);
  for (int attempt = 0; attempt < 2000 && complex.triangle.size() < wanted; ++attempt) {
    ComplexTriangle t;
    std::vector<bool> odd(vertices, false);
    for (Index& e : t.edge) {
      e = static_cast<Index>(random() % edges);
      for (const Index v : complex.edge[e].vertex) odd[v] = !odd[v];
    }
    if (std::count(odd.begin(), odd.end(), true) == 0) complex.triangle.push_back(t);
  }
  return complex;
}

RC_GTEST_PROP(BettiNumbersProperty, RandomComplex_AgreesWithElimination, ()) {
  const CellComplex complex = random_complex();
  RC_ASSERT(betti_numbers(complex) == betti_by_elimination(complex));
}

RC_GTEST_PROP(BettiNumbersProperty, PlanesInAGridOfLeaves_HaveTheHomologyOfThePlanes, ()) {
  fixtures::PlaneGrid grid;
  for (auto& layers : grid.has) {
    layers = *rc::gen::resize(5, rc::gen::arbitrary<std::vector<bool>>());
    layers.push_back(true);
  }
  RC_ASSERT(betti_numbers(grid.build()) == grid.betti());
}

}  // namespace
}  // namespace blum
