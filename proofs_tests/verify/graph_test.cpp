// The graph that a certificate states, against the one that was found: how events are told by boxes.
#include "graph.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "failure.hpp"

namespace blum::test {
namespace {

using verify::FaceMap;
using verify::Graph;

/// Three arcs in one region, each from a tie of side 0 to a rim; the rims nearer than doubles.
struct Rims {
  FaceMap map;
  Graph claimed;
  explicit Rims(const std::array<std::array<double, 4>, 3>& box) {
    map.region.push_back({{7, 8}, 0});
    for (std::uint32_t k = 0; k < 3; ++k)
      map.node.push_back({.kind = FaceMap::Node::Kind::kSide, .change = k});
    for (std::uint32_t k = 0; k < 3; ++k) {
      map.node.push_back({.kind = FaceMap::Node::Kind::kRim, .box = box[k]});
      map.arc.push_back({{k, 3 + k}, {0, 0}});
      claimed.event.push_back({true, box[k]});
      claimed.arc.push_back({{{{Graph::kSide, 0, k}, {Graph::kEvent, k, 0}}}, {7, 8}});
    }
  }
};

constexpr double kX = -0.092220429484204627;
const std::array<double, 2> kOn{kX, kX}, kBelow{std::nextafter(kX, -1), kX},
    kAbove{kX, std::nextafter(kX, 1)};

std::array<double, 4> box(const std::array<double, 2>& u, const std::array<double, 2>& v) {
  return {u[0], u[1], v[0], v[1]};
}

TEST(VerifyGraph, EventAtANumberOfDoublesBetweenTwoBesideIt_IsFound) {
  Rims rims({box(kBelow, kAbove), box(kOn, kOn), box(kAbove, kAbove)});
  EXPECT_NO_THROW(verify::check_graph(rims.map, rims.claimed));
}

TEST(VerifyGraph, EventAtANumberOfDoubles_IsNotOneBesideIt) {
  for (const auto& other : {box(kBelow, kOn), box(kOn, kAbove), box(kAbove, kBelow)}) {
    Rims rims({box(kBelow, kAbove), box(kOn, kOn), box(kAbove, kAbove)});
    rims.claimed.event[1].box = other;
    EXPECT_THROW(verify::check_graph(rims.map, rims.claimed), verify::Failure);
  }
}

TEST(VerifyGraph, ArcsThatChangedTheirEvents_AreRejected) {
  Rims rims({box(kBelow, kAbove), box(kOn, kOn), box(kAbove, kAbove)});
  std::swap(rims.claimed.event[0], rims.claimed.event[1]);
  EXPECT_THROW(verify::check_graph(rims.map, rims.claimed), verify::Failure);
}

}  // namespace
}  // namespace blum::test
