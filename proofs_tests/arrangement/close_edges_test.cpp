// Reflex edges as near to each other as rounding: what bounds say of their ties and of which is
// farther, against points in quadruple precision.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <optional>

#include "../../arrangement/src/fan.hpp"
#include "../../arrangement/src/local_form.hpp"
#include "face_scenes.hpp"
#include "kernel/turn_by_quaternion.hpp"
#include "small_vectors.hpp"
#include "terrain.hpp"

namespace blum {
namespace {

using test::combined;
using test::dot3;
using test::log_uniform;
using test::Random;
using test::Scene;
using test::uniform;

__extension__ typedef __float128 Quad;
using Vector = test::SmallVector<Quad>;

Vector vector(const Point3& p) { return test::vector_of<Quad>(p); }
Vector between(const Point3& from, const Point3& to) {
  return combined(vector(to), -1, vector(from));
}

/// A reflex edge with its carrier and domain.
struct Edge {
  std::uint32_t id;
  Vector base, along;
  std::array<Vector, 2> to_corner;  ///< of both triangles, from an end

  Edge(const Solid& solid, std::uint32_t e) : id(e) {
    const SolidEdge& edge = solid.edge[e];
    base = vector(solid.point[edge.vertex[0]]);
    along = between(solid.point[edge.vertex[0]], solid.point[edge.vertex[1]]);
    for (std::size_t k = 0; k < 2; ++k)
      for (const auto v : solid.triangle[edge.triangle[k]].vertex)
        if (v != edge.vertex[0] && v != edge.vertex[1])
          to_corner[k] = between(solid.point[edge.vertex[0]], solid.point[v]);
  }
  [[nodiscard]] Quad share(const Vector& x) const {
    return dot3(combined(x, -1, base), along) / dot3(along, along);
  }
  /// From the foot on the line to x.
  [[nodiscard]] Vector from_foot(const Vector& x) const {
    return combined(combined(x, -1, base), -share(x), along);
  }
  [[nodiscard]] Quad square_distance(const Vector& x) const {
    const Vector d = from_foot(x);
    return dot3(d, d);
  }
  [[nodiscard]] bool in_domain(const Vector& x) const {
    const Vector d = from_foot(x);
    const Quad s = share(x);
    return s >= 0 && s <= 1 && dot3(d, to_corner[0]) <= 0 && dot3(d, to_corner[1]) <= 0;
  }
};

/// Furrows side by side, as near to each other and as deep as rounding or less.
Scene random_furrows(Random& random) {
  const auto small = [&](double most) {
    return (random() % 2 == 0 ? 1 : -1) * log_uniform(random, 1e-17, most);
  };
  std::vector<std::vector<double>> y(2);
  double depth = 0, width = log_uniform(random, 1e-16, 0.1);
  for (auto& end : y) {  // they may run apart
    if (random() % 4 == 0) width = log_uniform(random, 1e-16, 0.1);
    depth = std::max(depth, width * log_uniform(random, 1e-3, 30));
    end = {-1, 1};
    for (int k = 0; k < 5; ++k) end.push_back(small(width));
    std::ranges::sort(end);
  }
  depth = std::max(2e-17, std::min(0.1, depth));
  return {"furrows", test::terrain({0, 1}, y, -1, [&](std::size_t i, std::size_t j) {
            return j == 0 || j + 1 == y[i].size() ? 0 : small(depth);
          })};
}

std::vector<Scene> scenes(Random& random) {
  std::vector<Scene> list;
  for (int k = 0; k < 30; ++k) list.push_back(random_furrows(random));
  list.emplace_back("rotated plate", test::turn_by_quaternion(shapes::plate(5, 6), {1, 2, 3, 4}));
  list.emplace_back("rotated plate", test::turn_by_quaternion(shapes::plate(8, 6), {5, 1, -2, 2}));
  return list;
}

/// Two reflex edges, half of the time of nearly the same direction.
std::optional<std::array<Edge, 2>> random_edges(Random& random, const Scene& scene) {
  const Solid& solid = *scene.solid;
  const bool parallel = random() % 2 == 0;
  for (int k = 0; k < 1000; ++k) {
    const auto e = random() % solid.edge.size(), f = random() % solid.edge.size();
    if (e == f || solid.edge[e].kind != EdgeKind::kReflex ||
        solid.edge[f].kind != EdgeKind::kReflex)
      continue;
    const Edge a(solid, static_cast<std::uint32_t>(e)), b(solid, static_cast<std::uint32_t>(f));
    const Quad c = dot3(a.along, b.along);
    const Quad across = 1 - c * c / (dot3(a.along, a.along) * dot3(b.along, b.along));
    if (!parallel || across < 1e-24) return std::array{a, b};
  }
  return std::nullopt;
}

/// A point with its foot on the edge, more often than not near a border of its domain.
Vector point_over(Random& random, const Scene& scene, const Edge& e) {
  const auto& beside = scene.solid->edge[e.id].triangle;
  const BallVector n = scene.geometry->unit(scene.geometry->index().face(beside[0])),
                   m = scene.geometry->unit(scene.geometry->index().face(beside[1]));
  double share = random() % 3 == 0 ? uniform(random, 0, 1) : log_uniform(random, 1e-12, 1);
  if (random() % 2 == 0) share = 1 - share;
  Vector d;
  for (std::size_t k = 0; k < 3; ++k)
    d[k] = -(Quad(share) * n[k].mid + (1 - Quad(share)) * m[k].mid);
  const double place = random() % 2 == 0 ? uniform(random, 0, 1) : log_uniform(random, 1e-6, 1);
  const Vector foot = combined(e.base, random() % 2 == 0 ? place : 1 - place, e.along);
  return combined(foot, scene.extent() * log_uniform(random, 1e-14, 0.1), d);
}

Vector random_vector(Random& random) {
  return {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
}

/// A point where the distances from both carriers are equal, near the given one.
std::optional<Vector> tie_near(Random& random, const Vector& x, const Edge& a, const Edge& b) {
  const Vector way = random_vector(random);
  const auto gap = [&](Quad s) {
    const Vector y = combined(x, s, way);
    return a.square_distance(y) - b.square_distance(y);
  };
  const Quad reach = static_cast<Quad>(std::sqrt(static_cast<double>(a.square_distance(x))));
  Quad lo = 0;
  for (const int sign : {1, -1}) {
    lo = 0;
    for (double step = 1e-14; step < 1; step *= 4) {
      Quad hi = sign * reach * step;
      if ((gap(lo) > 0) == (gap(hi) > 0)) {
        lo = hi;
        continue;
      }
      for (int k = 0; k < 110; ++k) {
        const Quad m = (lo + hi) / 2;
        ((gap(lo) > 0) == (gap(m) > 0) ? lo : hi) = m;
      }
      return combined(x, lo, way);
    }
  }
  return std::nullopt;
}

Range range_about(Random& random, const Vector& x, double size) {
  Point3 lo, hi;
  for (int k = 0; k < 3; ++k) {
    const double share = uniform(random, 0, 1);
    const auto c = static_cast<double>(x[static_cast<std::size_t>(k)]);
    lo[k] = std::nextafter(c - size * share, -1e300);
    hi[k] = std::nextafter(c + size * (1 - share), 1e300);
  }
  return Range::of(lo, hi);
}

LocalForm form_of(const Scene& scene, const Edge& e) {
  LocalForm f;
  f.kind = SiteKind::kEdge;
  f.site = scene.geometry->index().edge(e.id);
  return f;
}

TEST(CloseEdges, GradientsAtTies_AreAsFarApartAsSaid) {
  Random random(61);
  long ties = 0, told = 0, close = 0, tight = 0;
  for (const Scene& scene : scenes(random)) {
    EngineContext context(*scene.geometry, *scene.inside, 1);
    for (int k = 0; k < 500; ++k) {
      const auto pair = random_edges(random, scene);
      if (!pair) continue;
      const auto& [a, b] = *pair;
      const auto x = tie_near(random, point_over(random, scene, a), a, b);
      if (!x || !a.in_domain(*x) || !b.in_domain(*x)) continue;
      const Quad square = a.square_distance(*x);
      const auto distance = std::sqrt(static_cast<double>(square));
      const Vector d = combined(a.from_foot(*x), -1, b.from_foot(*x));
      const auto truth = static_cast<double>(dot3(d, d) / (2 * square));
      const Range range = range_about(random, *x, distance * log_uniform(random, 1e-9, 1));
      const double bound = fans_apart(context, form_of(scene, a), form_of(scene, b), range);
      ++ties;
      ASSERT_LE(bound, truth * (1 + 1e-9)) << scene.name << ' ' << a.id << ' ' << b.id;
      told += bound > 0;
      close += truth < 1e-6 && bound > 0;
      tight += bound > 0.5 * truth;
    }
  }
  std::cout << ties << " ties, told of " << told << ", tightly of " << tight << ", " << close
            << " of gradients closer than 1e-3\n";
  EXPECT_GT(told, 150);
  EXPECT_GT(tight, 80);
  EXPECT_GT(close, 100);
}

TEST(CloseEdges, WhatIsFartherWhereverItGoverns_IsFartherAtItsPoints) {
  Random random(67);
  long told = 0, points = 0, by_domain = 0;
  for (const Scene& scene : scenes(random)) {
    EngineContext context(*scene.geometry, *scene.inside, 1);
    for (int k = 0; k < 1000; ++k) {
      const auto pair = random_edges(random, scene);
      if (!pair) continue;
      const auto& [first, second] = *pair;
      const Vector x = point_over(random, scene, first);
      const bool other = random() % 2 == 0;
      const Edge &a = other ? second : first, &b = other ? first : second;
      const auto distance = std::sqrt(static_cast<double>(a.square_distance(x)));
      const Range range = range_about(random, x, distance * log_uniform(random, 1e-7, 1));
      LocalForm fa, fb;
      if (!local_form(*scene.geometry, scene.geometry->index().edge(a.id), range, fa) ||
          !local_form(*scene.geometry, scene.geometry->index().edge(b.id), range, fb) ||
          !certainly_farther(*scene.geometry, fa, fb, range, &context))
        continue;
      ++told;
      bool nearer_outside = false;
      for (int i = 0; i < 30; ++i) {
        Vector y;
        for (std::size_t c = 0; c < 3; ++c) {
          const int axis = static_cast<int>(c);
          y[c] = range.center[axis] + Quad(range.half[axis]) * uniform(random, -1, 1);
        }
        const bool farther = a.square_distance(y) > b.square_distance(y);
        if (!a.in_domain(y)) {
          nearer_outside |= !farther;
          continue;
        }
        ++points;
        ASSERT_TRUE(farther) << scene.name << ' ' << a.id << ' ' << b.id;
      }
      by_domain += nearer_outside;
    }
  }
  std::cout << told << " told, " << points << " points, " << by_domain
            << " times nearer outside the domain\n";
  EXPECT_GT(told, 1000);
  EXPECT_GT(points, 10'000);
  EXPECT_GT(by_domain, 25);
}

}  // namespace
}  // namespace blum
