// Parts that see one vertex only, by the chains of triangles at it and the cone of points whose
// foot it is, against the exact oracle: asked first wherever all sites meet in a vertex.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "oracles/face_compare.hpp"

namespace blum {
namespace {

using test::log_uniform;
using test::Random;
using test::Scene;
using test::Tally;
using test::uniform;

enum class Pit {
  kRandom,    ///< low edges, which bound the cone, and ridges between them
  kIntegers,  ///< corners of a small grid: edges in one plane, equal angles
  kCorner,    ///< three facets, cut into triangles that are coplanar but for rounding
  kRidges,    ///< several ridges between two edges that bound the cone
  kFacet,     ///< a ray of the cone where an edge ties with a facet of two edges or more
};

std::vector<Point3> ring_of_ridges(Random& random) {
  std::vector<Point3> ring;
  const auto full = random() % 3, most = 2 + random() % 2;
  for (std::size_t k = 0; k < 3; ++k) {
    const double from =
        2 * std::numbers::pi / 3 * (static_cast<double>(k) + uniform(random, -0.1, 0.1));
    const auto put = [&](double turn, double z) {
      const double r = uniform(random, 0.8, 1.2);
      ring.push_back({r * std::cos(from + turn), r * std::sin(from + turn), r * z});
    };
    put(0, uniform(random, 0.1, 0.4));
    const std::size_t ridges = k == full ? most : 1 + random() % 2, n = 2 * ridges - 1;
    for (std::size_t i = 0; i < n; ++i)
      put((n == 1 ? 0.95 : 0.25 + 1.4 * static_cast<double>(i) / static_cast<double>(n - 1)) +
              uniform(random, -0.04, 0.04),
          i % 2 == 0 ? uniform(random, 1.2, 3) : uniform(random, 0.7, 1.2));
  }
  return ring;
}

/// Low corners in the plane z = a x + b y, exactly: a facet of two edges or three, and beyond a
/// ridge one more edge, or another facet.
std::vector<Point3> ring_with_facet(Random& random) {
  std::vector<Point3> ring;
  const double a = static_cast<double>(random() % 5) / 8 - 0.25,
               b = static_cast<double>(random() % 5) / 8 - 0.25;
  const auto low = [&](double x, double y) { ring.push_back({x, y, a * x + b * y}); };
  const auto high = [&](double x, double y) {
    ring.push_back({x, y, a * x + b * y + 0.125 * static_cast<double>(2 + random() % 8)});
  };
  low(1, 0);
  if (random() % 3 == 0) low(1, 0.25);
  low(1, 0.5);
  high(0.5, 1);
  if (random() % 2 == 0) high(0, 1);
  low(-0.5, 1);
  if (random() % 2 == 0) low(-0.75, 0.5);
  if (random() % 2 == 0) high(-1, -0.125);
  high(-1, -0.5);
  if (random() % 2 == 0) high(-0.25, -1);
  high(0.25, -1);
  return ring;
}

std::vector<Point3> ring_of(Random& random, Pit kind) {
  const auto n = 5 + random() % 5;
  std::vector<Point3> ring;
  switch (kind) {
    case Pit::kRandom:
      for (std::size_t k = 0; k < n; ++k) {
        const double angle = 2 * std::numbers::pi *
                             (static_cast<double>(k) + uniform(random, -0.4, 0.4)) /
                             static_cast<double>(n);
        const double r = uniform(random, 0.6, 1.3);
        ring.push_back({r * std::cos(angle), r * std::sin(angle),
                        random() % 5 < 2 ? uniform(random, 0.1, 0.4) : uniform(random, 0.6, 2.5)});
      }
      break;
    case Pit::kIntegers: {
      for (int x = -2; x <= 2; ++x)
        for (int y = -2; y <= 2; ++y)
          if (x != 0 || y != 0)
            ring.push_back({x * 0.5, y * 0.5, 0.5 * static_cast<double>(1 + random() % 4)});
      std::ranges::shuffle(ring, random);
      std::set<double> angles;
      std::erase_if(ring, [&](const Point3& p) {
        return angles.size() == n || !angles.insert(std::atan2(p.y, p.x)).second;
      });
      break;
    }
    case Pit::kRidges:
      ring = ring_of_ridges(random);
      break;
    case Pit::kFacet:
      ring = ring_with_facet(random);
      break;
    case Pit::kCorner: {
      std::array<Point3, 3> e;
      for (std::size_t k = 0; k < 3; ++k) {
        const double angle =
            2 * std::numbers::pi / 3 * (static_cast<double>(k) + uniform(random, -0.1, 0.1));
        e[k] = {std::cos(angle), std::sin(angle), uniform(random, 0.4, 1)};
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const Point3 &p = e[k], &q = e[(k + 1) % 3];
        ring.push_back(p);
        for (std::size_t between = k == 0 ? 3 : random() % 2; between > 0; --between) {
          const double a = uniform(random, 0.2, 0.8), b = uniform(random, 0.2, 0.8);
          ring.push_back({a * p.x + b * q.x, a * p.y + b * q.y, a * p.z + b * q.z});
        }
      }
      break;
    }
  }
  std::ranges::sort(ring, {}, [](const Point3& p) { return std::atan2(p.y, p.x); });
  return ring;
}

/// A column whose top is a pit of triangles about the origin: most of the points below it have the
/// origin as foot, or an edge from it.
std::optional<PolygonMesh> pit(Random& random, Pit kind) {
  const std::vector<Point3> ring = ring_of(random, kind);
  const auto n = static_cast<std::uint32_t>(ring.size());
  for (std::uint32_t k = 0; k < n; ++k) {
    const Point3 &p = ring[k], &q = ring[(k + 1) % n];
    if (!(p.x * q.y - p.y * q.x > 0.01)) return std::nullopt;  // not about the origin
  }
  PolygonMesh m;
  m.points.push_back({0, 0, 0});
  m.points.insert(m.points.end(), ring.begin(), ring.end());
  for (const Point3& p : ring) m.points.push_back({p.x, p.y, -4});
  std::vector<std::uint32_t> bottom;
  for (std::uint32_t k = 0; k < n; ++k) {
    const auto next = (k + 1) % n;
    m.faces.push_back({0, 1 + k, 1 + next});
    m.faces.push_back({1 + k, 1 + k + n, 1 + next + n, 1 + next});
    bottom.insert(bottom.begin(), 1 + k + n);
  }
  m.faces.push_back(bottom);
  return m;
}

/// A rectangle about a point next to the cone of points whose foot is the vertex, if there is one.
std::optional<Rect> rect_below(Random& random, const Scene& scene, std::uint32_t vertex,
                               bool any_shape) {
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
  // Next to one ray, or to the cone's inside.
  std::array<double, 3> z{};
  const auto one = random() % (2 * link->ray.size());  // half of the times the inside
  for (std::size_t k = 0; k < link->ray.size(); ++k) {
    if (one < link->ray.size() && one != k) continue;
    const auto a = direction(link->ray[k].edge[0]), b = direction(link->ray[k].edge[1]);
    const std::array c{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                       a[0] * b[1] - a[1] * b[0]};
    const double length = std::hypot(c[0], c[1], c[2]);
    for (std::size_t i = 0; i < 3; ++i) z[i] += c[i] / length * uniform(random, 0.1, 1);
  }
  const double distance = scene.extent() * log_uniform(random, 1e-3, 0.02),
               size = distance * log_uniform(random, 0.1, 4);
  const double length = std::hypot(z[0], z[1], z[2]);
  Point3 c;
  for (int k = 0; k < 3; ++k)
    c[k] = v[k] + z[static_cast<std::size_t>(k)] / length * distance +
           size * uniform(random, -0.3, 0.3);
  Rect r;
  r.axis = static_cast<int>(random() % 3);
  r.level = c[r.axis];
  const int a = u_axis(r.axis), b = v_axis(r.axis);
  const double wide = any_shape ? distance * log_uniform(random, 0.02, 4) : size,
               high = any_shape ? distance * log_uniform(random, 0.02, 4) : size;
  r.u0 = c[a] - wide * uniform(random, 0.3, 1);
  r.u1 = c[a] + wide * uniform(random, 0.3, 1);
  r.v0 = c[b] - high * uniform(random, 0.3, 1);
  r.v1 = c[b] + high * uniform(random, 0.3, 1);
  return r;
}

void run_pits(std::uint64_t seed, int rounds, std::size_t most_candidates, Tally& tally,
              std::initializer_list<Pit> kinds = {Pit::kRandom, Pit::kIntegers, Pit::kCorner},
              bool any_shape = false) {
  Random random(seed);
  for (int round = 0; round < rounds; ++round)
    for (const Pit kind : kinds) {
      const auto mesh = pit(random, kind);
      if (!mesh) continue;
      auto solid = build_solid(*mesh);
      ASSERT_TRUE(solid.ok());
      const Scene scene(kind == Pit::kCorner ? "rotated pit" : "pit", std::move(solid).value());
      for (std::uint32_t v = 0; v < scene.solid->point.size(); ++v) {
        const Point3& p = scene.solid->point[v];
        if (p.x != scene.working(0, 0) || p.y != scene.working(1, 0)) continue;
        for (int k = 0; k < 6; ++k)
          if (const auto r = rect_below(random, scene, v, any_shape);
              r && scene.near(*r).size() <= most_candidates)
            test::compare(scene, *r, false, tally, test::First::kLinks);
      }
    }
  tally.print("pits");
}

TEST(Link, Pits_GiveTheMapOfTheOracle) {
  Tally tally;
  run_pits(1, 8, 14, tally);
  EXPECT_GE(tally.same, 50);
  EXPECT_GE(tally.links, 40);
  EXPECT_GE(tally.rims, 5);
  EXPECT_EQ(tally.different, 0);
}

TEST(Link, PitsWithRidgesAndFacets_GiveTheMapOfTheOracle) {
  Tally tally;
  run_pits(31, 8, 14, tally, {Pit::kRidges, Pit::kFacet}, true);
  EXPECT_GE(tally.same, 20);
  EXPECT_GE(tally.links, 15);
  EXPECT_EQ(tally.different, 0);
}

TEST(SweepLink, PitsWithRidgesAndFacets_GiveTheMapOfTheOracle) {
  Tally tally;
  for (std::uint64_t seed = 32; seed < 42; ++seed)
    run_pits(seed, 10, 22, tally, {Pit::kRidges, Pit::kFacet}, seed % 2 == 0);
  EXPECT_GE(tally.same, 300);
  EXPECT_EQ(tally.different, 0);
}

TEST(SweepLink, Pits_GiveTheMapOfTheOracle) {
  Tally tally;
  for (std::uint64_t seed = 2; seed < 12; ++seed) run_pits(seed, 10, 22, tally);
  EXPECT_GE(tally.same, 800);
  EXPECT_EQ(tally.different, 0);
}

}  // namespace
}  // namespace blum
