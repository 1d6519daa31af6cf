// Theorem S (parts of a face seen from a vertex) against the exact oracle: tried first everywhere,
// in all scenes, and on slivers in rows.
#include <gtest/gtest.h>

#include <cmath>

#include "kernel/turn_by_quaternion.hpp"
#include "oracles/face_compare.hpp"

namespace blum {
namespace {

using test::compare;
using test::log_uniform;
using test::Random;
using test::Scene;
using test::Tally;
using test::uniform;

/// A rectangle of any size about a point beside an edge.
Rect rect_beside(Random& random, const Scene& scene, std::uint32_t e, double most_off,
                 double least_size = 1e-3) {
  const Solid& solid = *scene.solid;
  const Point3 &p = solid.point[solid.edge[e].vertex[0]], &q = solid.point[solid.edge[e].vertex[1]];
  const double t = random() % 3 == 0 ? log_uniform(random, 1e-6, 1) : uniform(random, 0, 1);
  const double off = scene.extent() * log_uniform(random, 1e-9, most_off);
  const double size = off * log_uniform(random, least_size, 3);
  Point3 c;
  for (int k = 0; k < 3; ++k) c[k] = p[k] + t * (q[k] - p[k]) + off * uniform(random, -1, 1);
  Rect r;
  r.axis = static_cast<int>(random() % 3);
  const int u = u_axis(r.axis), v = v_axis(r.axis);
  r.level = c[r.axis];
  r.u0 = c[u] - size * uniform(random, 0.3, 1);
  r.u1 = c[u] + size * uniform(random, 0.3, 1);
  r.v0 = c[v] - size * uniform(random, 0.3, 1);
  r.v1 = c[v] + size * uniform(random, 0.3, 1);
  return r;
}

/// The same for an edge that is no diagonal of a flat facet.
Rect rect_at_edge(Random& random, const Scene& scene, double most_off = 0.05) {
  const Solid& solid = *scene.solid;
  std::uint32_t e = 0;
  do {
    e = static_cast<std::uint32_t>(random() % solid.edge.size());
  } while (solid.edge[e].kind == EdgeKind::kFlat);
  return rect_beside(random, scene, e, most_off);
}

void run_catalogue(std::uint64_t seed, int rounds, Tally& tally) {
  Random random(seed);
  for (int round = 0; round < rounds; ++round)
    for (const Scene& scene : test::catalogue(random)) {
      compare(scene, test::special_rect(random, scene), false, tally, test::First::kSlices);
      compare(scene, rect_at_edge(random, scene), false, tally, test::First::kSlices);
    }
  tally.print("slices of all scenes");
}

/// Facets with holes, turned and rounded: slivers 1e-16 wide in rows.
void run_rows(std::uint64_t seed, int rectangles, std::size_t candidates, Tally& tally) {
  Random random(seed);
  for (const auto& q : {std::array{5, 1, -2, 2}, std::array{1, 2, 3, 4}})
    for (const int holes : {2, 3}) {
      const Scene scene("rotated plate", test::turn_by_quaternion(shapes::plate(holes, 6), q));
      for (int k = 0; k < rectangles; ++k) {
        const Rect r = rect_at_edge(random, scene, 1e-3);
        const auto near = scene.near(r);
        if (near.size() > 1 && near.size() <= candidates && scene.curved(near) <= 4)
          compare(scene, r, false, tally, test::First::kSlices);
      }
    }
  tally.print("slices of rows of slivers");
}

/// Facets with holes where slivers fold back: beside reflex edges whose faces are all but opposite.
void run_slits(std::uint64_t seed, int rectangles, std::size_t candidates, Tally& tally) {
  tally.oracle_may_give_up = true;
  Random random(seed);
  for (const auto& q : {std::array{5, 1, -2, 2}, std::array{1, 2, 3, 4}})
    for (const int holes : {5, 6, 7, 8}) {
      const Scene scene("rotated plate", test::turn_by_quaternion(shapes::plate(holes, 6), q));
      const Solid& solid = *scene.solid;
      std::vector<std::uint32_t> slits;
      for (std::uint32_t e = 0; e < solid.edge.size(); ++e) {
        const auto& t = solid.edge[e].triangle;
        const auto normal = [&](std::uint32_t k) {
          return scene.geometry->unit(scene.geometry->index().face(t[k]));
        };
        if (solid.edge[e].kind == EdgeKind::kReflex && dot(normal(0), normal(1)).mid < -0.8)
          slits.push_back(e);
      }
      for (int k = 0; k < rectangles && !slits.empty(); ++k) {
        const Rect r = rect_beside(random, scene, slits[random() % slits.size()], 1e-7, 0.5);
        const auto near = scene.near(r);
        if (near.size() > 1 && near.size() <= candidates && scene.curved(near) <= 4)
          compare(scene, r, false, tally, test::First::kSlices);
      }
    }
  tally.print("slices of slits");
}

TEST(Slice, AllScenes_NeverContradictTheOracle) {
  Tally tally;
  run_catalogue(1, 1, tally);
  EXPECT_GE(tally.same, 30);
  EXPECT_GE(tally.slices, 10);
  EXPECT_EQ(tally.different, 0);
}

TEST(SweepSlice, AllScenes_NeverContradictTheOracle) {
  Tally tally;
  run_catalogue(2, 30, tally);
  EXPECT_GE(tally.same, 1000);
  EXPECT_EQ(tally.different, 0);
}

TEST(Slice, RowsOfSlivers_NeverContradictTheOracle) {
  Tally tally;
  run_rows(3, 24, 7, tally);
  EXPECT_GE(tally.same, 20);
  EXPECT_GE(tally.slices, 10);
  EXPECT_EQ(tally.different, 0);
}

TEST(SweepSlice, RowsOfSlivers_NeverContradictTheOracle) {
  Tally tally;
  for (std::uint64_t seed = 4; seed < 12; ++seed) run_rows(seed, 40, 12, tally);
  EXPECT_GE(tally.same, 400);
  EXPECT_EQ(tally.different, 0);
}

TEST(Slice, Slits_NeverContradictTheOracle) {
  Tally tally;
  run_slits(21, 16, 10, tally);
  EXPECT_GE(tally.same, 15);
  EXPECT_GE(tally.slices, 10);
  EXPECT_EQ(tally.different, 0);
}

TEST(SweepSlice, Slits_NeverContradictTheOracle) {
  Tally tally;
  for (std::uint64_t seed = 22; seed < 30; ++seed) run_slits(seed, 40, 12, tally);
  EXPECT_GE(tally.same, 300);
  EXPECT_EQ(tally.different, 0);
}

}  // namespace
}  // namespace blum
