// The arcs of a diagram found again in one whose nodes and arcs come in another order.
#include "match_arcs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace blum {
namespace {

using Kind = FaceNode::Kind;

FaceNode side(int s, std::uint32_t k) {
  FaceNode n;
  n.kind = Kind::kSide;
  n.side = static_cast<std::uint8_t>(s);
  n.breakpoint = k;
  return n;
}
FaceNode inner(Kind kind, std::uint32_t edge = 0) {
  FaceNode n;
  n.kind = kind;
  n.boundary_edge = edge;
  return n;
}

FaceDiagram graph(std::vector<FaceNode> nodes,
                  const std::vector<std::array<std::uint32_t, 2>>& arcs) {
  FaceDiagram d;
  d.node = std::move(nodes);
  for (const auto& [from, to] : arcs) {
    d.arc.emplace_back();
    d.arc.back().from = from;
    d.arc.back().to = to;
  }
  return d;
}

/// Two events joined by two arcs and one arc to a side each; a rim; a convex edge; closed arcs.
FaceDiagram rich() {
  return graph({side(0, 0), inner(Kind::kEvent), inner(Kind::kEvent), side(2, 1), side(1, 0),
                inner(Kind::kRim), inner(Kind::kConvexEdge, 7), side(3, 0), inner(Kind::kEvent),
                inner(Kind::kEvent)},
               {{0, 1}, {1, 2}, {2, 1}, {3, 2}, {4, 5}, {6, 7}, {8, 8}, {9, 9}});
}

struct Shuffled {
  FaceDiagram diagram;
  std::vector<std::uint32_t> node;  // where each is
};
Shuffled shuffled(const FaceDiagram& of, std::mt19937_64& random) {
  Shuffled s;
  s.node.resize(of.node.size());
  std::iota(s.node.begin(), s.node.end(), 0u);
  std::ranges::shuffle(s.node, random);
  s.diagram.node.resize(of.node.size());
  for (std::size_t n = 0; n < of.node.size(); ++n) s.diagram.node[s.node[n]] = of.node[n];
  s.diagram.arc = of.arc;
  for (FaceArc& a : s.diagram.arc) {
    a.from = s.node[a.from];
    a.to = s.node[a.to];
    if (random() % 2 == 0) std::swap(a.from, a.to);
  }
  std::ranges::shuffle(s.diagram.arc, random);
  return s;
}

TEST(MatchArcs, TheSameDiagram_EachArcItself) {
  const auto match = match_arcs(rich(), rich());
  ASSERT_TRUE(match.has_value());
  for (std::uint32_t k = 0; k < match->size(); ++k) EXPECT_EQ((*match)[k], (ArcMatch{k, false}));
}

TEST(MatchArcs, AnotherOrder_AMapOfGraphsThatFixesWhatOthersShare) {
  std::mt19937_64 random(1);
  const FaceDiagram a = rich();
  for (int trial = 0; trial < 200; ++trial) {
    const auto [b, node] = shuffled(a, random);
    const auto match = match_arcs(a, b);
    ASSERT_TRUE(match.has_value());
    std::vector<std::uint32_t> image(a.node.size(), 1000);
    std::vector<bool> taken(b.arc.size(), false);
    const auto bind = [&](std::uint32_t n, std::uint32_t m) {
      EXPECT_TRUE(image[n] == 1000 || image[n] == m);
      image[n] = m;
    };
    for (std::size_t k = 0; k < a.arc.size(); ++k) {
      const auto [j, reversed] = (*match)[k];
      ASSERT_LT(j, b.arc.size());
      EXPECT_FALSE(taken[j]);
      taken[j] = true;
      bind(a.arc[k].from, reversed ? b.arc[j].to : b.arc[j].from);
      bind(a.arc[k].to, reversed ? b.arc[j].from : b.arc[j].to);
    }
    for (const std::uint32_t n : {0u, 3u, 4u, 6u, 7u}) EXPECT_EQ(image[n], node[n]);
    // Events are told apart by the sides that their arcs come from.
    for (const std::uint32_t n : {1u, 2u, 5u}) EXPECT_EQ(image[n], node[n]);
  }
}

TEST(MatchArcs, OtherGraphs_None) {
  const FaceDiagram a = rich();
  FaceDiagram other = a;
  other.node[0].breakpoint = 1;
  EXPECT_FALSE(match_arcs(a, other));
  other = a;
  other.arc.pop_back();
  EXPECT_FALSE(match_arcs(a, other));
  other = a;
  other.node[5].kind = Kind::kEvent;
  EXPECT_FALSE(match_arcs(a, other));
  other = a;
  std::swap(other.arc[0].to, other.arc[4].to);
  EXPECT_FALSE(match_arcs(a, other));
  other = a;
  other.node[6].boundary_edge = 8;
  EXPECT_FALSE(match_arcs(a, other));
  // One end more at one event, one less at the other.
  const auto y = [](std::uint32_t third) {
    return graph({side(0, 0), side(0, 1), side(1, 0), inner(Kind::kEvent), inner(Kind::kEvent)},
                 {{0, 3}, {1, third}, {2, 4}, {3, 4}});
  };
  EXPECT_TRUE(match_arcs(y(3), y(3)));
  EXPECT_FALSE(match_arcs(y(3), y(4)));
}

}  // namespace
}  // namespace blum
