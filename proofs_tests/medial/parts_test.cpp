// read_parts on complexes built by hand: every shape of cone, and the solids whose parts are known.

#include "blum/medial/parts.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "blum/kernel/check.hpp"
#include "medial/parts_builder.hpp"

namespace blum {
namespace {

using fixtures::ConeComplexBuilder;
using fixtures::PlaneGrid;
using Kind = ComplexVertex::Kind;

struct Counts {
  std::uint32_t sheets, seams, junctions, clusters;
  friend bool operator==(const Counts&, const Counts&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Counts& c) {
    return out << c.sheets << '/' << c.seams << '/' << c.junctions << '+' << c.clusters;
  }
};
Counts counts(const Parts& p) { return {p.sheets, p.seams, p.junctions, p.clusters}; }

/// One cone over a graph on `nodes` event nodes, each arc cut in two by a node of degree 2.
Parts parts_of_graph(int nodes, const std::vector<std::array<int, 2>>& arcs,
                     std::uint32_t boundary_vertex = ComplexCone::kNone) {
  ConeComplexBuilder b;
  for (int i = 0; i < nodes; ++i) b.node(Kind::kEvent);
  std::vector<std::uint32_t> pieces;
  for (const auto& [from, to] : arcs) {
    const std::uint32_t middle = b.node();
    pieces.push_back(b.arc(static_cast<std::uint32_t>(from), middle));
    pieces.push_back(b.arc(static_cast<std::uint32_t>(to), middle));
  }
  b.cone(pieces, boundary_vertex);
  return read_parts(b.complex());
}

TEST(ConeShape, Loop_IsADiskOfOneSheet) {
  const Parts p = parts_of_graph(3, {{0, 1}, {1, 2}, {2, 0}});
  EXPECT_EQ(p.cone_shape, std::vector{ConeShape::kLoop});
  EXPECT_EQ(counts(p), (Counts{1, 0, 0, 0}));
}

TEST(ConeShape, LoopOfOneEdge_IsALoop) {
  ConeComplexBuilder b;
  const std::uint32_t v = b.node();
  b.cone({b.arc(v, v)});
  EXPECT_EQ(counts(read_parts(b.complex())), (Counts{1, 0, 0, 0}));
  EXPECT_EQ(read_parts(b.complex()).cone_shape, std::vector{ConeShape::kLoop});
}

TEST(ConeShape, Path_IsAHalfDiskWithoutSeam) {
  const Parts p = parts_of_graph(3, {{0, 1}, {1, 2}});
  EXPECT_EQ(p.cone_shape, std::vector{ConeShape::kPath});
  EXPECT_EQ(counts(p), (Counts{1, 0, 0, 0}));
}

TEST(ConeShape, Theta_IsOneSeamWithAsManySheetsAsArcs) {
  for (std::uint32_t k = 3; k <= 6; ++k) {
    const Parts p = parts_of_graph(2, std::vector<std::array<int, 2>>(k, {0, 1}));
    EXPECT_EQ(p.cone_shape, std::vector{ConeShape::kSeam});
    EXPECT_EQ(counts(p), (Counts{k, 1, 0, 0}));
  }
}

TEST(ConeShape, ParallelArcsWithoutMiddleNodes_AreASeamToo) {
  ConeComplexBuilder b;
  const std::uint32_t p = b.node(Kind::kEvent), q = b.node(Kind::kEvent);
  b.cone({b.arc(p, q), b.arc(q, p), b.arc(p, q)});
  EXPECT_EQ(counts(read_parts(b.complex())), (Counts{3, 1, 0, 0}));
}

TEST(ConeShape, CompleteGraphOnFourNodes_IsAJunction) {
  const Parts p = parts_of_graph(4, {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}});
  EXPECT_EQ(p.cone_shape, std::vector{ConeShape::kJunction});
  EXPECT_EQ(counts(p), (Counts{6, 4, 1, 0}));
}

TEST(ConeShape, OtherGraphs_AreClusters) {
  // Four nodes of degree 3 that are not K4: a square with two opposite sides doubled.
  EXPECT_EQ(counts(parts_of_graph(4, {{0, 1}, {0, 1}, {2, 3}, {2, 3}, {0, 2}, {1, 3}})),
            (Counts{6, 4, 0, 1}));
  // A seam that ends on a rim: a star with three free ends.
  EXPECT_EQ(counts(parts_of_graph(4, {{0, 1}, {0, 2}, {0, 3}})), (Counts{3, 1, 0, 1}));
  // A path with a loop at its end ("lollipop"), and one with a loop at both ends ("dumbbell").
  EXPECT_EQ(counts(parts_of_graph(3, {{0, 1}, {1, 2}, {2, 1}})), (Counts{2, 1, 0, 1}));
  EXPECT_EQ(counts(parts_of_graph(2, {{0, 0}, {0, 1}, {1, 1}})), (Counts{3, 2, 0, 1}));
  // Theta with one more, free, arc.
  EXPECT_EQ(counts(parts_of_graph(3, {{0, 1}, {0, 1}, {0, 1}, {1, 2}})), (Counts{4, 2, 0, 1}));
  // The prism graph and the cube graph.
  EXPECT_EQ(counts(parts_of_graph(
                6, {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}})),
            (Counts{9, 6, 0, 1}));
}

TEST(ConeShape, ApexOnTheBoundary_EndsSeams) {
  EXPECT_EQ(parts_of_graph(4, {{0, 1}, {0, 2}, {0, 3}}, 7).cone_shape,
            std::vector{ConeShape::kBoundaryEnd});
  EXPECT_EQ(counts(parts_of_graph(4, {{0, 1}, {0, 2}, {0, 3}}, 7)), (Counts{3, 1, 0, 0}));
  EXPECT_EQ(parts_of_graph(4, {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}, 7).cone_shape,
            std::vector{ConeShape::kBoundaryEnd});
  EXPECT_EQ(parts_of_graph(3, {{0, 1}, {1, 2}, {2, 0}}, 7).cone_shape,
            std::vector{ConeShape::kBoundaryEnd});
  EXPECT_EQ(parts_of_graph(3, {{0, 1}, {1, 2}}, 7).cone_shape, std::vector{ConeShape::kPath});
}

TEST(ConeShape, TwoComponentsInOneCone_BreakTheContract) {
  EXPECT_THROW(parts_of_graph(4, {{0, 1}, {2, 3}}), BrokenInvariant);
}

TEST(ReadParts, EmptyComplex_HasNoParts) {
  EXPECT_EQ(counts(read_parts(CellComplex{})), (Counts{0, 0, 0, 0}));
}

TEST(ReadParts, ConeEdgeOverTheWrongNode_BreaksTheContract) {
  ConeComplexBuilder b;
  const std::uint32_t p = b.node(), q = b.node();
  b.cone({b.arc(p, q)});
  std::swap(b.complex().triangle[0].edge[1], b.complex().triangle[0].edge[2]);
  EXPECT_THROW((void)read_parts(b.complex()), BrokenInvariant);
}

// The whole cube in one leaf of Theorem C: the graph is the cube's own, its corners boundary nodes.
TEST(ReadParts, CubeInOneLeaf_Has12SheetsAnd8SeamsAndOneCluster) {
  ConeComplexBuilder b;
  for (int i = 0; i < 8; ++i) b.node(Kind::kBoundary);
  std::vector<std::uint32_t> edges;
  for (std::uint32_t i = 0; i < 8; ++i) {
    for (const std::uint32_t bit : {1u, 2u, 4u}) {
      if ((i & bit) == 0) edges.push_back(b.convex_edge(i, i | bit));
    }
  }
  b.cone(edges);
  EXPECT_EQ(counts(read_parts(b.complex())), (Counts{12, 8, 0, 1}));
  EXPECT_EQ(betti_numbers(b.complex()), (std::array<long, 3>{1, 0, 0}));
}

// The cube in nine leaves: a Theorem B cone at each corner, the rest a truncated middle.
TEST(ReadParts, CubeWithConicalCorners_Has12SheetsAnd8SeamsAndOneCluster) {
  ConeComplexBuilder b;
  std::vector<std::uint32_t> middle;
  std::array<std::array<std::uint32_t, 3>, 8> end{};
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    const std::uint32_t event = b.node(Kind::kEvent);
    std::vector<std::uint32_t> star;
    for (auto& e : end[corner]) {
      e = b.node(Kind::kConvexEdge);
      star.push_back(b.arc(event, e));
    }
    b.cone(star, corner);
    middle.insert(middle.end(), star.begin(), star.end());
  }
  for (std::uint32_t i = 0; i < 8; ++i) {
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const std::uint32_t j = i | (1u << axis);
      if (j != i) middle.push_back(b.convex_edge(end[i][axis], end[j][axis]));
    }
  }
  b.cone(middle);
  const Parts p = read_parts(b.complex());
  EXPECT_EQ(counts(p), (Counts{12, 8, 0, 1}));
  EXPECT_EQ(std::count(p.cone_shape.begin(), p.cone_shape.end(), ConeShape::kBoundaryEnd), 8);
  EXPECT_EQ(betti_numbers(b.complex()), (std::array<long, 3>{1, 0, 0}));
}

// A box with three different sides, cut by two planes into four leaves of Theorem C, each with one
// junction and two corners. Q(i, j): i the half along x, j the half along y.
TEST(ReadParts, GenericBoxInFourLeaves_Has13SheetsAnd12SeamsAnd4Junctions) {
  ConeComplexBuilder b;
  const std::uint32_t centre = b.node();  // the middle sheet crosses the line of the two cuts
  struct Section {  // half of a cut: an event, the convex edges above and below it, three arcs
    std::array<std::uint32_t, 2> edge_node;
    std::array<std::uint32_t, 3> arc;
  };
  const auto section = [&] {
    const std::uint32_t event = b.node(Kind::kEvent);
    Section s{};
    s.edge_node = {b.node(Kind::kConvexEdge), b.node(Kind::kConvexEdge)};
    s.arc = {b.arc(event, s.edge_node[0]), b.arc(event, s.edge_node[1]), b.arc(event, centre)};
    return s;
  };
  const std::array<Section, 2> x_cut = {section(), section()};  // by half along y
  const std::array<Section, 2> y_cut = {section(), section()};  // by half along x
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      std::vector<std::uint32_t> base;
      std::array<std::uint32_t, 2> corner{};
      for (std::size_t k = 0; k < 2; ++k) {
        corner[k] = b.node(Kind::kBoundary);
        base.push_back(b.convex_edge(corner[k], x_cut[j].edge_node[k]));
        base.push_back(b.convex_edge(corner[k], y_cut[i].edge_node[k]));
      }
      base.push_back(b.convex_edge(corner[0], corner[1]));
      base.insert(base.end(), x_cut[j].arc.begin(), x_cut[j].arc.end());
      base.insert(base.end(), y_cut[i].arc.begin(), y_cut[i].arc.end());
      b.cone(base);
    }
  }
  const Parts p = read_parts(b.complex());
  EXPECT_EQ(counts(p), (Counts{13, 12, 4, 0}));
  EXPECT_EQ(betti_numbers(b.complex()), (std::array<long, 3>{1, 0, 0}));
}

// A corner of a convex solid in a Theorem C leaf: the seam starts in the corner itself.
TEST(ReadParts, SeamFromACorner_EndsThere) {
  ConeComplexBuilder b;
  const std::uint32_t corner = b.node(Kind::kBoundary), event = b.node(Kind::kEvent);
  std::vector<std::uint32_t> base, opposite;
  for (int i = 0; i < 3; ++i) {
    const std::uint32_t node = b.node(Kind::kConvexEdge);
    base.push_back(b.convex_edge(corner, node));
    base.push_back(b.arc(node, event));
    opposite.push_back(base.back());
  }
  b.cone(base);
  EXPECT_EQ(counts(read_parts(b.complex())), (Counts{3, 1, 0, 0}));
  // The leaf on the other side carries the seam on, to a second corner.
  const std::uint32_t corner2 = b.node(Kind::kBoundary);
  for (int i = 0; i < 3; ++i) {
    opposite.push_back(b.convex_edge(b.complex().edge[opposite[i]].vertex[0], corner2));
  }
  b.cone(opposite);
  EXPECT_EQ(counts(read_parts(b.complex())), (Counts{3, 1, 0, 0}));
}

// A closed seam (three sheets around a circle) has no end: a ring of leaves, each with a theta.
TEST(ReadParts, ClosedSeam_IsOneSeam) {
  for (const std::size_t leaves : {2u, 3u, 7u}) {
    ConeComplexBuilder b;
    struct Cut {
      std::array<std::uint32_t, 3> arc, end;
    };
    std::vector<Cut> cut(leaves);
    for (Cut& c : cut) {
      const std::uint32_t event = b.node(Kind::kEvent);
      for (int i = 0; i < 3; ++i) {
        c.end[i] = b.node();
        c.arc[i] = b.arc(event, c.end[i]);
      }
    }
    for (std::size_t i = 0; i < leaves; ++i) {
      const Cut& here = cut[i];
      const Cut& next = cut[(i + 1) % leaves];
      std::vector<std::uint32_t> base;
      for (int s = 0; s < 3; ++s) {
        base.push_back(here.arc[s]);
        base.push_back(next.arc[s]);
        base.push_back(b.arc(here.end[s], next.end[s]));
      }
      b.cone(base);
    }
    EXPECT_EQ(counts(read_parts(b.complex())), (Counts{3, 1, 0, 0}));
    EXPECT_EQ(betti_numbers(b.complex()), (std::array<long, 3>{1, 1, 0}));
  }
}

TEST(ReadParts, SameSheetOnTwoSidesOfASeam_IsOneSheet) {
  // A loop around a lollipop's stick: two of the three arcs at the node are the same arc.
  ConeComplexBuilder b;
  const std::uint32_t n = b.node(Kind::kEvent), free_end = b.node(Kind::kRim);
  b.cone({b.arc(n, n), b.arc(n, free_end)});
  EXPECT_EQ(counts(read_parts(b.complex())), (Counts{2, 1, 0, 1}));
}

TEST(ReadParts, SeamEdges_AreThoseOverNodesOfDegreeThree) {
  ConeComplexBuilder b;
  const std::uint32_t p = b.node(Kind::kEvent), q = b.node(Kind::kEvent);
  b.cone({b.arc(p, q), b.arc(p, q), b.arc(p, q)});
  const Parts parts = read_parts(b.complex());
  EXPECT_EQ(parts.edge_seam,
            (std::vector<std::uint32_t>{Parts::kNoSeam, Parts::kNoSeam, Parts::kNoSeam, 0, 0}));
}

PlaneGrid random_grid() {
  PlaneGrid grid;
  for (auto& layers : grid.has) {
    layers = *rc::gen::resize(5, rc::gen::nonEmpty(rc::gen::arbitrary<std::vector<bool>>()));
  }
  return grid;
}

RC_GTEST_PROP(ReadPartsProperty, PlanesInAGridOfLeaves_HaveThePartsOfThePlanes, ()) {
  const PlaneGrid grid = random_grid();
  const Parts p = read_parts(grid.build());
  RC_ASSERT(static_cast<long>(p.sheets) == grid.sheets());
  RC_ASSERT(static_cast<long>(p.seams) == grid.seams());
  RC_ASSERT(static_cast<long>(p.clusters) == grid.clusters());
  RC_ASSERT(p.junctions == 0u);
}

/// The same complex with its triangles and the ends of its arcs in another order.
CellComplex shuffled(CellComplex complex, std::uint32_t seed) {
  std::mt19937 random(seed);
  for (ComplexTriangle& t : complex.triangle) {
    ComplexEdge& base = complex.edge[t.edge[0]];
    if (base.vertex[0] != base.vertex[1] && random() % 2 == 0) {
      std::swap(base.vertex[0], base.vertex[1]);
      for (ComplexTriangle& other : complex.triangle) {
        if (other.edge[0] == t.edge[0]) std::swap(other.edge[1], other.edge[2]);
      }
    }
  }
  std::shuffle(complex.triangle.begin(), complex.triangle.end(), random);
  return complex;
}

RC_GTEST_PROP(ReadPartsProperty, OrderOfCells_DoesNotMatter, ()) {
  const CellComplex complex = random_grid().build();
  const Parts a = read_parts(complex);
  const Parts b = read_parts(shuffled(complex, *rc::gen::arbitrary<std::uint32_t>()));
  RC_ASSERT(counts(a) == counts(b));
  RC_ASSERT(a.cone_shape == b.cone_shape);
  RC_ASSERT(a.edge_seam == b.edge_seam);
}

}  // namespace
}  // namespace blum
