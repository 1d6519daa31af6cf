// Windings of closed walks about two pieces, against planar graphs that are drawn.
#include "blum/subdivision/tube.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "blum/kernel/union_find.hpp"

namespace blum {
namespace {

/// A connected subgraph of a grid. Cells are numbered 1 + x + y * width; 0 is the outside.
struct Drawing {
  struct Arc {
    std::array<std::uint32_t, 2> node;
    std::array<std::uint32_t, 2> cell;  // left and right of the arc from node[0] to node[1]
  };
  int width, height;
  std::vector<Arc> arc;
  UnionFind cells;

  [[nodiscard]] std::uint32_t cell(int x, int y) const {
    if (x < 0 || y < 0 || x >= width || y >= height) return 0;
    return static_cast<std::uint32_t>(1 + x + y * width);
  }
  [[nodiscard]] std::uint32_t node(int x, int y) const {
    return static_cast<std::uint32_t>(x + y * (width + 1));
  }

  Drawing(int w, int h, double keep, std::mt19937& random) : width(w), height(h) {
    std::vector<Arc> all;
    for (int y = 0; y <= h; ++y)
      for (int x = 0; x <= w; ++x) {
        if (x < w) all.push_back({{node(x, y), node(x + 1, y)}, {cell(x, y), cell(x, y - 1)}});
        if (y < h) all.push_back({{node(x, y), node(x, y + 1)}, {cell(x - 1, y), cell(x, y)}});
      }
    std::shuffle(all.begin(), all.end(), random);
    UnionFind connected;
    connected.resize(static_cast<std::uint32_t>((w + 1) * (h + 1)));
    cells.resize(static_cast<std::uint32_t>(1 + w * h));
    for (const Arc& a : all) {
      const bool needed = connected.find(a.node[0]) != connected.find(a.node[1]);
      if (needed || std::uniform_real_distribution<>()(random) < keep) {
        connected.unite(a.node[0], a.node[1]);
        arc.push_back(a);
      } else {
        cells.unite(a.cell[0], a.cell[1]);
      }
    }
    // Directions are chance, and so are the two sides in a SphereArc.
    for (Arc& a : arc)
      if (random() % 2 == 0) {
        std::swap(a.node[0], a.node[1]);
        std::swap(a.cell[0], a.cell[1]);
      }
  }

  [[nodiscard]] std::vector<SphereArc> sphere(std::mt19937& random) {
    std::vector<SphereArc> s;
    for (const Arc& a : arc) {
      s.push_back({a.node, {cells.find(a.cell[0]), cells.find(a.cell[1])}});
      if (random() % 2 == 0) std::swap(s.back().piece[0], s.back().piece[1]);
    }
    return s;
  }

  /// +1 or -1 for arcs that a path of grid cells from one cell to another crosses, from left to
  /// right or back; the path runs first along x, then along y.
  [[nodiscard]] std::vector<int> drawn(int x, int y, int to_x, int to_y) const {
    std::vector<int> sign(arc.size(), 0);
    const auto cross = [&](std::uint32_t from, std::uint32_t to) {
      for (std::size_t k = 0; k < arc.size(); ++k) {
        if (arc[k].cell[0] == from && arc[k].cell[1] == to) ++sign[k];
        if (arc[k].cell[1] == from && arc[k].cell[0] == to) --sign[k];
      }
    };
    for (; x != to_x; x += x < to_x ? 1 : -1) cross(cell(x, y), cell(x + (x < to_x ? 1 : -1), y));
    for (; y != to_y; y += y < to_y ? 1 : -1) cross(cell(x, y), cell(x, y + (y < to_y ? 1 : -1)));
    return sign;
  }
};

/// The closed walks that arcs off a spanning tree close; their signed sums of both counts.
std::vector<std::array<int, 2>> windings(const Drawing& d, const std::vector<int>& first,
                                         const std::vector<int>& second) {
  const std::size_t nodes = static_cast<std::size_t>((d.width + 1) * (d.height + 1));
  std::vector<std::vector<std::size_t>> at(nodes);
  for (std::size_t k = 0; k < d.arc.size(); ++k)
    for (const auto n : d.arc[k].node) at[n].push_back(k);
  std::vector<std::array<int, 2>> potential(nodes);
  std::vector<bool> seen(nodes, false), used(d.arc.size(), false);
  std::vector<std::uint32_t> stack{0};
  seen[0] = true;
  while (!stack.empty()) {
    const auto n = stack.back();
    stack.pop_back();
    for (const auto k : at[n]) {
      const bool along = d.arc[k].node[0] == n;
      const auto m = d.arc[k].node[along ? 1 : 0];
      if (seen[m]) continue;
      seen[m] = used[k] = true;
      const int s = along ? 1 : -1;
      potential[m] = {potential[n][0] + s * first[k], potential[n][1] + s * second[k]};
      stack.push_back(m);
    }
  }
  std::vector<std::array<int, 2>> sum;
  for (std::size_t k = 0; k < d.arc.size(); ++k) {
    if (used[k]) continue;
    const auto [a, b] = d.arc[k].node;
    sum.push_back({potential[a][0] + first[k] - potential[b][0],
                   potential[a][1] + second[k] - potential[b][1]});
  }
  return sum;
}

TEST(TubeCrossings, GraphsDrawnAtRandom_GiveTheWindingsOfTheDrawing) {
  std::mt19937 random(5);
  int told = 0, wound = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const int w = 2 + static_cast<int>(random() % 5), h = 2 + static_cast<int>(random() % 5);
    const double keep = trial % 4 == 0 ? 1 : 0.4 + 0.1 * (trial % 6);
    Drawing d(w, h, keep, random);
    const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    const int x = pick(w), y = pick(h), to_x = pick(w), to_y = pick(h);
    const auto from = d.cells.find(d.cell(x, y)), to = d.cells.find(d.cell(to_x, to_y));
    if (from == to) continue;
    const auto crossing = tube_crossings(d.sphere(random), from, to);
    if (!crossing) {
      ASSERT_LT(keep, 1) << "a graph without cut nodes";
      continue;
    }
    ++told;
    std::vector<int> sign(d.arc.size(), 0);
    for (const Crossing& c : *crossing) sign[c.arc] += c.forward ? 1 : -1;
    int same = 0, opposite = 0;
    for (const auto& [a, b] : windings(d, sign, d.drawn(x, y, to_x, to_y))) {
      wound += b != 0;
      same += a == b;
      opposite += a == -b;
      ASSERT_EQ(std::abs(a), std::abs(b));
    }
    const auto n = static_cast<int>(d.arc.size()) - (w + 1) * (h + 1) + 1;
    ASSERT_TRUE(same == n || opposite == n);
  }
  EXPECT_GT(told, 1000);
  EXPECT_GT(wound, 1000);
}

/// Two triangles with a common node: either may be turned over.
TEST(TubeCrossings, PiecesInBlocksThatOneNodeJoins_AreNotTold) {
  const std::vector<SphereArc> arc{{{0, 1}, {7, 9}}, {{1, 2}, {7, 9}}, {{2, 0}, {7, 9}},
                                   {{0, 3}, {8, 9}}, {{3, 4}, {8, 9}}, {{4, 0}, {8, 9}}};
  EXPECT_FALSE(tube_crossings(arc, 7, 8));
  const auto one = tube_crossings(arc, 7, 9);
  ASSERT_TRUE(one);
  EXPECT_EQ(one->size(), 1u);
}

TEST(TubeCrossings, LoopsAndUnknownSides_AreNotCrossedTwice) {
  // A loop about piece 1, with a bridge to a closed walk of two parallel arcs about piece 3.
  const std::uint32_t u = SphereArc::kUnknown;
  const std::vector<SphereArc> arc{
      {{0, 0}, {1, 2}}, {{0, 5}, {2, 2}}, {{5, 6}, {2, 3}}, {{5, 6}, {3, 2}}, {{5, 6}, {u, u}}};
  EXPECT_TRUE(tube_crossings(arc, 1, 2));
  EXPECT_FALSE(tube_crossings(arc, 1, 3));
  EXPECT_FALSE(tube_crossings(arc, 1, 4));
}

}  // namespace
}  // namespace blum
