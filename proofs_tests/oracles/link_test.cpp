// Parts that see one vertex only, by the chains of triangles at it and the cone of points whose
// foot it is, against the exact oracle: asked first wherever all sites meet in a vertex.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "kernel/turn_by_quaternion.hpp"
#include "oracles/face_compare.hpp"

namespace blum {
namespace {

using test::log_uniform;
using test::Random;
using test::Scene;
using test::Tally;
using test::uniform;

enum class Pit {
  kRandom,    ///< any heights
  kIntegers,  ///< corners of a small grid: edges in one plane, equal angles
  kFlat,      ///< all corners in one plane but for rounding
};

/// A column whose top is a pit of triangles about the origin: most of the points below it have the
/// origin as foot, or an edge from it.
std::optional<PolygonMesh> pit(Random& random, Pit kind) {
  const auto n = static_cast<std::uint32_t>(3 + random() % 6);
  std::vector<Point3> ring;
  if (kind == Pit::kIntegers) {
    std::vector<Point3> grid;
    for (int x = -2; x <= 2; ++x)
      for (int y = -2; y <= 2; ++y)
        if (x != 0 || y != 0)
          grid.push_back({x * 0.5, y * 0.5, 0.25 * static_cast<double>(random() % 5)});
    std::ranges::shuffle(grid, random);
    std::set<double> angles;
    for (const Point3& p : grid)
      if (ring.size() < n && angles.insert(std::atan2(p.y, p.x)).second) ring.push_back(p);
  } else {
    const double a = uniform(random, -0.4, 0.4), b = uniform(random, -0.4, 0.4);
    for (std::uint32_t k = 0; k < n; ++k) {
      const double angle =
          2 * std::numbers::pi * (k + uniform(random, -0.45, 0.45)) / static_cast<double>(n);
      const double r = uniform(random, 0.7, 1.2), x = r * std::cos(angle), y = r * std::sin(angle);
      const double z = kind == Pit::kFlat ? a * x + b * y : uniform(random, 0, 1.5);
      ring.push_back({x, y, z});
    }
  }
  std::ranges::sort(ring, {}, [](const Point3& p) { return std::atan2(p.y, p.x); });
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point3 &p = ring[k], &q = ring[(k + 1) % ring.size()];
    if (!(p.x * q.y - p.y * q.x > 0.02)) return std::nullopt;  // not about the origin
  }
  PolygonMesh m;
  m.points.push_back({0, 0, 0});
  m.points.insert(m.points.end(), ring.begin(), ring.end());
  for (const Point3& p : ring) m.points.push_back({p.x, p.y, -4});
  std::vector<std::uint32_t> bottom;
  for (std::uint32_t k = 0; k < ring.size(); ++k) {
    const auto next = (k + 1) % static_cast<std::uint32_t>(ring.size());
    const auto below = static_cast<std::uint32_t>(ring.size());
    m.faces.push_back({0, 1 + k, 1 + next});
    m.faces.push_back({1 + k, 1 + k + below, 1 + next + below, 1 + next});
    bottom.insert(bottom.begin(), 1 + k + below);
  }
  m.faces.push_back(bottom);
  return m;
}

/// A rectangle about a point next to the cone of points whose foot is the vertex, if there is one.
std::optional<Rect> rect_below(Random& random, const Scene& scene, std::uint32_t vertex) {
  Predicates predicates(*scene.geometry);
  const auto link = predicates.vertex_link(vertex);
  if (!link || link->ray.empty()) return std::nullopt;
  const Solid& solid = *scene.solid;
  const Point3& v = solid.point[vertex];
  const auto direction = [&](std::uint32_t e) {
    const auto& ends = solid.edge[e].vertex;
    const Point3& p = solid.point[ends[0] == vertex ? ends[1] : ends[0]];
    return std::array{p.x - v.x, p.y - v.y, p.z - v.z};
  };
  std::array<double, 3> z{};
  // One ray, or a mean of all.
  const auto one = random() % (link->ray.size() + 1);
  for (std::size_t k = 0; k < link->ray.size(); ++k) {
    if (one < link->ray.size() && one != k) continue;
    const auto a = direction(link->ray[k].edge[0]), b = direction(link->ray[k].edge[1]);
    const std::array c{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                       a[0] * b[1] - a[1] * b[0]};
    const double length = std::hypot(c[0], c[1], c[2]);
    for (std::size_t i = 0; i < 3; ++i) z[i] += c[i] / length * uniform(random, 0.1, 1);
  }
  const double distance = scene.extent() * log_uniform(random, 1e-4, 0.03),
               size = distance * log_uniform(random, 1e-3, 1);
  const double length = std::hypot(z[0], z[1], z[2]);
  Point3 c;
  for (int k = 0; k < 3; ++k)
    c[k] = v[k] + z[static_cast<std::size_t>(k)] / length * distance +
           size * uniform(random, -0.5, 0.5);
  Rect r;
  r.axis = static_cast<int>(random() % 3);
  r.level = c[r.axis];
  const int a = u_axis(r.axis), b = v_axis(r.axis);
  r.u0 = c[a] - size * uniform(random, 0.3, 1);
  r.u1 = c[a] + size * uniform(random, 0.3, 1);
  r.v0 = c[b] - size * uniform(random, 0.3, 1);
  r.v1 = c[b] + size * uniform(random, 0.3, 1);
  return r;
}

void run_pits(std::uint64_t seed, int rounds, Tally& tally) {
  Random random(seed);
  for (int round = 0; round < rounds; ++round)
    for (const Pit kind : {Pit::kRandom, Pit::kIntegers, Pit::kFlat}) {
      const auto mesh = pit(random, kind);
      if (!mesh) continue;
      auto solid = build_solid(*mesh);
      ASSERT_TRUE(solid.ok());
      const Scene scene(kind == Pit::kFlat ? "rotated pit" : "pit", std::move(solid).value());
      for (std::uint32_t v = 0; v < scene.solid->point.size(); ++v) {
        const Point3& p = scene.solid->point[v];
        if (p.x != scene.working(0, 0) || p.y != scene.working(1, 0)) continue;
        for (int k = 0; k < 3; ++k)
          if (const auto r = rect_below(random, scene, v))
            test::compare(scene, *r, false, tally, test::First::kLinks);
      }
    }
  tally.print("pits");
}

void run_turned_plates(std::uint64_t seed, int rectangles, Tally& tally) {
  Random random(seed);
  for (const auto& q : {std::array{5, 1, -2, 2}, std::array{1, 2, 3, 4}})
    for (const int holes : {1, 3}) {
      const Scene scene("rotated plate", test::turn_by_quaternion(shapes::plate(holes, 8), q));
      for (int k = 0; k < rectangles; ++k) {
        const auto v = static_cast<std::uint32_t>(random() % scene.solid->point.size());
        const auto r = rect_below(random, scene, v);
        if (!r) continue;
        const auto near = scene.near(*r);
        if (near.size() <= 12 && scene.curved(near) <= 5)
          test::compare(scene, *r, false, tally, test::First::kLinks);
      }
    }
  tally.print("vertices of turned plates");
}

TEST(Link, Pits_GiveTheMapOfTheOracle) {
  Tally tally;
  run_pits(1, 12, tally);
  EXPECT_GE(tally.same, 60);
  EXPECT_GE(tally.links, 40);
  EXPECT_GE(tally.rims, 5);
  EXPECT_EQ(tally.different, 0);
}

TEST(SweepLink, Pits_GiveTheMapOfTheOracle) {
  Tally tally;
  for (std::uint64_t seed = 2; seed < 12; ++seed) run_pits(seed, 40, tally);
  EXPECT_GE(tally.same, 2000);
  EXPECT_EQ(tally.different, 0);
}

TEST(Link, VerticesOfTurnedPlates_NeverContradictTheOracle) {
  Tally tally;
  run_turned_plates(1, 20, tally);
  EXPECT_GE(tally.links, 5);
  EXPECT_EQ(tally.different, 0);
}

TEST(SweepLink, VerticesOfTurnedPlates_NeverContradictTheOracle) {
  Tally tally;
  for (std::uint64_t seed = 2; seed < 8; ++seed) run_turned_plates(seed, 60, tally);
  EXPECT_GE(tally.links, 100);
  EXPECT_EQ(tally.different, 0);
}

}  // namespace
}  // namespace blum
