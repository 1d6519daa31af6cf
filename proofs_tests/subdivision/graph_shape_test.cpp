// graph_shape on every shape and on near misses, however its arcs are subdivided and numbered.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "blum/subdivision/graph_shape.hpp"

namespace blum {
namespace {

using Index = std::uint32_t;

struct Graph {
  Index nodes = 0;
  std::vector<std::array<Index, 2>> arcs;
};

Graph parallel(Index k) {
  Graph g{2, {}};
  for (Index i = 0; i < k; ++i) g.arcs.push_back({0, 1});
  return g;
}

Graph complete(Index n) {
  Graph g{n, {}};
  for (Index i = 0; i < n; ++i)
    for (Index j = i + 1; j < n; ++j) g.arcs.push_back({i, j});
  return g;
}

Graph cycle(Index n) {
  Graph g{n, {}};
  for (Index i = 0; i < n; ++i) g.arcs.push_back({i, (i + 1) % n});
  return g;
}

Graph path(Index arcs) {
  Graph g{arcs + 1, {}};
  for (Index i = 0; i < arcs; ++i) g.arcs.push_back({i, i + 1});
  return g;
}

Graph star(Index rays) {
  Graph g{rays + 1, {}};
  for (Index i = 1; i <= rays; ++i) g.arcs.push_back({0, i});
  return g;
}

Graph with(Graph g, std::vector<std::array<Index, 2>> more) {
  for (const auto& a : more) {
    g.nodes = std::max({g.nodes, a[0] + 1, a[1] + 1});
    g.arcs.push_back(a);
  }
  return g;
}

/// Puts new nodes on random arcs, renumbers the nodes, shuffles and reverses the arcs.
Graph disguised(Graph g, unsigned seed, int new_nodes) {
  std::mt19937 random(seed);
  for (int k = 0; k < new_nodes && !g.arcs.empty(); ++k) {
    auto& a = g.arcs[random() % g.arcs.size()];
    const std::array<Index, 2> rest{g.nodes, a[1]};
    a[1] = g.nodes++;
    g.arcs.push_back(rest);
  }
  std::vector<Index> name(g.nodes);
  std::iota(name.begin(), name.end(), 0u);
  std::shuffle(name.begin(), name.end(), random);
  for (auto& a : g.arcs) {
    for (auto& n : a) n = name[n];
    if (random() % 2 != 0) std::swap(a[0], a[1]);
  }
  std::shuffle(g.arcs.begin(), g.arcs.end(), random);
  return g;
}

GraphShape shape(const Graph& g) { return graph_shape(g.nodes, g.arcs); }

struct Case {
  const char* name;
  Graph graph;
  GraphShape expected;
};

std::vector<Case> cases() {
  const Graph k4 = complete(4);
  return {
      {"one arc from a node to itself", {1, {{0, 0}}}, GraphShape::kLoop},
      {"two parallel arcs", parallel(2), GraphShape::kLoop},
      {"cycle", cycle(7), GraphShape::kLoop},
      {"one arc", path(1), GraphShape::kPath},
      {"path", path(5), GraphShape::kPath},
      {"three parallel arcs", parallel(3), GraphShape::kSeam},
      {"four parallel arcs", parallel(4), GraphShape::kSeam},
      {"nine parallel arcs", parallel(9), GraphShape::kSeam},
      {"K4 less one arc", {4, {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}}}, GraphShape::kSeam},
      {"K4", k4, GraphShape::kJunction},
      {"star of three rays", star(3), GraphShape::kOther},
      {"star of four rays", star(4), GraphShape::kOther},
      {"cycle with a pendant edge", with(cycle(3), {{0, 3}}), GraphShape::kRimEnd},
      {"cycle with two pendant edges at a node", with(cycle(3), {{0, 3}, {0, 4}}),
       GraphShape::kOther},
      {"seam with a pendant edge", with(parallel(3), {{0, 2}}), GraphShape::kOther},
      {"seam with a pendant edge on an arc", with(parallel(2), {{0, 2}, {2, 1}, {2, 3}}),
       GraphShape::kOther},
      {"seam with a loop at a node", with(parallel(3), {{1, 1}}), GraphShape::kOther},
      {"two loops at a node", {1, {{0, 0}, {0, 0}}}, GraphShape::kOther},
      {"three loops at a node", {1, {{0, 0}, {0, 0}, {0, 0}}}, GraphShape::kOther},
      {"loop on a stalk", {2, {{0, 0}, {0, 1}}}, GraphShape::kRimEnd},
      {"spectacles", {2, {{0, 0}, {0, 1}, {1, 1}}}, GraphShape::kOther},
      {"two double arcs in a row", {3, {{0, 1}, {0, 1}, {1, 2}, {1, 2}}}, GraphShape::kOther},
      {"four nodes, two pairs joined twice",
       {4, {{0, 1}, {0, 1}, {2, 3}, {2, 3}, {0, 2}, {1, 3}}},
       GraphShape::kOther},
      {"K4 with a double arc", with(k4, {{0, 1}}), GraphShape::kOther},
      {"K4 with two disjoint double arcs", with(k4, {{0, 1}, {2, 3}}), GraphShape::kOther},
      {"K4 with a loop", with(k4, {{2, 2}}), GraphShape::kOther},
      {"K4 with a pendant edge", with(k4, {{2, 4}}), GraphShape::kOther},
      {"K5", complete(5), GraphShape::kOther},
      {"K3,3",
       {6, {{0, 3}, {0, 4}, {0, 5}, {1, 3}, {1, 4}, {1, 5}, {2, 3}, {2, 4}, {2, 5}}},
       GraphShape::kOther},
      {"wheel of four spokes", with(cycle(4), {{0, 4}, {1, 4}, {2, 4}, {3, 4}}),
       GraphShape::kOther},
      {"triangular prism",
       {6, {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}},
       GraphShape::kOther},
  };
}

TEST(GraphShape, OneNodeWithoutArcs_IsPoint) { EXPECT_EQ(graph_shape(1, {}), GraphShape::kPoint); }

TEST(GraphShape, KnownGraph_HasItsShape) {
  for (const Case& c : cases()) EXPECT_EQ(shape(c.graph), c.expected) << c.name;
}

TEST(GraphShape, NodesOfDegreeTwoAndNumbering_DoNotMatter) {
  for (const Case& c : cases())
    for (unsigned seed = 0; seed < 50; ++seed)
      EXPECT_EQ(shape(disguised(c.graph, seed, static_cast<int>(seed % 11))), c.expected)
          << c.name << ", seed " << seed;
}

TEST(GraphShape, SubdividedJunctionLessAnyPart_IsNoJunction) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Graph k4 = disguised(complete(4), seed, 0);
    for (std::size_t k = 0; k < k4.arcs.size(); ++k) {
      Graph less = k4;
      less.arcs.erase(less.arcs.begin() + static_cast<std::ptrdiff_t>(k));
      EXPECT_EQ(shape(disguised(less, seed, 5)), GraphShape::kSeam);
    }
  }
}

RC_GTEST_PROP(GraphShape, PendantEdge_TurnsLoopIntoRimEndAndOthersIntoOther, ()) {
  const auto all = cases();
  const Case& c = all[*rc::gen::inRange<std::size_t>(0, all.size())];
  // An edge at the end of a path or of a tail only makes it longer.
  RC_PRE(c.expected != GraphShape::kPath && c.expected != GraphShape::kRimEnd);
  Graph g = disguised(c.graph, *rc::gen::arbitrary<unsigned>(), *rc::gen::inRange(0, 6));
  const auto at = *rc::gen::inRange<Index>(0, g.nodes);
  g = with(g, {{at, g.nodes}});
  RC_ASSERT(shape(g) ==
            (c.expected == GraphShape::kLoop ? GraphShape::kRimEnd : GraphShape::kOther));
}

}  // namespace
}  // namespace blum
