// Fans and what is cut from them by depth: against ties of a face with a reflex edge that are built
// from a foot on the edge and a direction, in extended precision.
#include "../../arrangement/src/fan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <tuple>

#include "../../arrangement/src/slope.hpp"
#include "blum/kernel/mesh.hpp"
#include "face_scenes.hpp"
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

using Real = long double;
using Vector = test::SmallVector<Real>;

Vector vector(const Point3& p) { return test::vector_of<Real>(p); }
Vector cross3(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector unit(const Vector& a) { return combined({}, 1 / std::sqrt(dot3(a, a)), a); }

Vector inner_normal(const Solid& solid, std::uint32_t triangle) {
  const auto& v = solid.triangle[triangle].vertex;
  const Vector o = vector(solid.point[v[0]]);
  return unit(cross3(combined(vector(solid.point[v[2]]), -1, o),
                     combined(vector(solid.point[v[1]]), -1, o)));
}

struct Tie {
  std::uint32_t edge = 0, face = 0;
  Vector x, at_edge, at_face;  ///< the point, and the gradients of both distances
  Real distance = 0;
};

/// The point that ties with a random reflex edge, in a random direction, and a random face, if its
/// foot on the face's plane lies in the face.
std::optional<Tie> random_tie(Random& random, const Scene& scene) {
  const Solid& solid = *scene.solid;
  Tie r;
  r.edge = static_cast<std::uint32_t>(random() % solid.edge.size());
  r.face = static_cast<std::uint32_t>(random() % solid.triangle.size());
  const SolidEdge& edge = solid.edge[r.edge];
  if (edge.kind != EdgeKind::kReflex) return std::nullopt;
  double share = random() % 3 == 0 ? log_uniform(random, 1e-9, 1) : uniform(random, 0, 1);
  if (random() % 2 == 0) share = 1 - share;
  const Vector first = inner_normal(solid, edge.triangle[0]);
  r.at_edge =
      unit(combined(combined({}, share, first), 1 - share, inner_normal(solid, edge.triangle[1])));
  r.at_face = inner_normal(solid, r.face);
  const Vector p = vector(solid.point[edge.vertex[0]]), q = vector(solid.point[edge.vertex[1]]);
  const Vector foot = combined(p, uniform(random, 0, 1), combined(q, -1, p));
  const auto& corner = solid.triangle[r.face].vertex;
  const Real depth = dot3(r.at_face, combined(foot, -1, vector(solid.point[corner[0]])));
  const Vector apart = combined(r.at_face, -1, r.at_edge);
  r.distance = 2 * depth / dot3(apart, apart);
  if (!(r.distance > 1e-12L * scene.extent() && r.distance < 10 * scene.extent()))
    return std::nullopt;
  r.x = combined(foot, r.distance, r.at_edge);
  const Vector other = combined(r.x, -r.distance, r.at_face);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector a = vector(solid.point[corner[k]]), b = vector(solid.point[corner[(k + 1) % 3]]);
    if (dot3(cross3(combined(b, -1, a), combined(other, -1, a)), r.at_face) > 0)
      return std::nullopt;
  }
  return r;
}

Range range_about(Random& random, const Tie& tie) {
  const double size = static_cast<double>(tie.distance) * log_uniform(random, 1e-10, 1);
  Point3 lo, hi;
  for (int k = 0; k < 3; ++k) {
    const double share = uniform(random, 0, 1);
    const auto c = static_cast<double>(tie.x[static_cast<std::size_t>(k)]);
    lo[k] = c - size * share - 1e-15;
    hi[k] = c + size * (1 - share) + 1e-15;
  }
  return Range::of(lo, hi);
}

/// By how much the direction lies outside the arc, to a small error if the arc is not short.
Real outside(const Fan& fan, const Vector& direction) {
  Vector a{}, b{};
  for (std::size_t k = 0; k < 3; ++k) {
    a[k] = fan.end[0][k].mid;
    b[k] = fan.end[1][k].mid;
  }
  const Vector axis = cross3(a, b);
  const Real length = std::sqrt(dot3(axis, axis));
  if (length < 1e-6L) return 0;
  return -std::min(dot3(cross3(a, direction), axis), dot3(cross3(direction, b), axis)) / length;
}

TEST(Fan, WhatIsLeftOfIt_HoldsTheGradientsOfAllTies) {
  Random random(31);
  std::vector<Scene> scenes;
  scenes.emplace_back("lbracket", shapes::rotate_rounded(shapes::lbracket(), random()));
  for (const std::uint32_t n : {3u, 4u, 6u}) {
    scenes.emplace_back("plate", shapes::plate(2, n));
    scenes.emplace_back("rotated plate", shapes::rotate_rounded(shapes::plate(2, n), random()));
  }
  // Faces almost orthogonal to the arc of an edge (1e-14): the arc's point nearest to them is not
  // known. A first version cut off the part of the arc that holds the tie.
  auto mesh = read_mesh(BLUM_FIXTURES_DIR "/almost_orthogonal_faces.off");
  ASSERT_TRUE(mesh.ok());
  scenes.emplace_back("almost orthogonal faces", mesh.value());
  constexpr Real kTolerance = 1e-12L;
  long ties = 0, cut = 0, by_fans = 0, by_ends = 0;
  for (Scene& scene : scenes) {
    const SiteGeometry& geometry = *scene.geometry;
    EngineContext context(geometry, *scene.inside, 1);
    for (int k = 0; k < 100'000; ++k) {
      const auto tie = random_tie(random, scene);
      if (!tie) continue;
      const Range range = range_about(random, *tie);
      LocalForm a, b;
      if (!local_form(geometry, geometry.index().face(tie->face), range, a) ||
          !local_form(geometry, geometry.index().edge(tie->edge), range, b))
        continue;
      ++ties;
      const FanPair fans = fans_at_ties(context, a, b, range);
      ASSERT_TRUE(fans.tie) << scene.name;
      cut += !fans.b.face[0] || !fans.b.face[1];
      ASSERT_LE(outside(fans.b, tie->at_edge), kTolerance) << scene.name;
      const FanPair reverse{fans.b, fans.a, true};
      for (int i = 0; i < 4; ++i) {
        BallVector w;
        Vector exact{};
        for (std::size_t c = 0; c < 3; ++c) {
          const double along = static_cast<double>(tie->at_edge[c] - tie->at_face[c]);
          w[c] = Ball((i < 2 ? along : 0) + (i == 0 ? 0.3 : 1) * uniform(random, -1, 1));
          exact[c] = w[c].mid;
        }
        const Real slope = dot3(combined(tie->at_face, -1, tie->at_edge), exact);
        if (gains_by_fans(fans, w)) {
          ++by_fans;
          ASSERT_LT(slope, kTolerance) << scene.name;
        }
        if (gains_by_fans(reverse, w)) {
          ASSERT_GT(slope, -kTolerance) << scene.name;
        }
        // The tie has two feet: what the comparison of ends is for.
        if (gains_by_fan_ends(context, fans, w)) {
          ++by_ends;
          ASSERT_LT(slope, kTolerance) << scene.name;
        }
        if (gains_by_fan_ends(context, reverse, w)) {
          ASSERT_GT(slope, -kTolerance) << scene.name;
        }
      }
    }
  }
  std::cout << ties << " ties, " << cut << " with a fan that is cut, gains " << by_fans
            << " by fans, " << by_ends << " by ends\n";
  EXPECT_GT(ties, 1000);
  EXPECT_GT(cut, 100);
  EXPECT_GT(by_fans, 1000);
  EXPECT_GT(by_ends, 1000);
}

/// A block whose top is a random height field: reflex edges of all directions and widths.
PolygonMesh random_terrain(Random& random) {
  const double steep = log_uniform(random, 0.05, 20);
  const std::vector<double> line{0, 1, 2, 3, 4};
  return test::terrain(line, std::vector(line.size(), line), -1, [&](std::size_t, std::size_t) {
    return steep * (random() % 4 == 0 ? 0 : uniform(random, 0, 1));
  });
}

/// 1 - the largest product of two vectors of the arcs between the given ones, not below the
/// true value: by samples, and by smaller and smaller steps about the best.
Real arcs_apart_by_samples(const std::array<Vector, 2>& a, const std::array<Vector, 2>& b) {
  const auto at = [](const std::array<Vector, 2>& arc, Real t) {
    return unit(combined(combined({}, 1 - t, arc[0]), t, arc[1]));
  };
  const auto apart = [&](Real s, Real t) {
    const Vector d = combined(at(a, s), -1, at(b, t));
    return dot3(d, d) / 2;
  };
  constexpr int kSteps = 24;
  Real best = 2, s0 = 0.5L, t0 = 0.5L;
  for (Real reach = 0.5L; reach > 1e-9L; reach *= 0.15L) {
    const Real s = s0, t = t0;
    for (int i = -kSteps; i <= kSteps; ++i)
      for (int j = -kSteps; j <= kSteps; ++j) {
        const Real si = std::clamp<Real>(s + reach * i / kSteps, 0, 1),
                   tj = std::clamp<Real>(t + reach * j / kSteps, 0, 1);
        if (const Real found = apart(si, tj); found < best) {
          best = found;
          s0 = si;
          t0 = tj;
        }
      }
  }
  return best;
}

/// Do the arcs certainly have a common point inside both?
bool cross_each_other(const std::array<Vector, 2>& a, const std::array<Vector, 2>& b) {
  const Vector across_a = cross3(a[0], a[1]), across_b = cross3(b[0], b[1]),
               p = cross3(across_a, across_b);
  const std::array sides{dot3(across_b, a[0]), -dot3(across_b, a[1]), -dot3(across_a, b[0]),
                         dot3(across_a, b[1])};
  const auto positive = [](Real x) { return x > 1e-12L; };
  const auto negative = [](Real x) { return x < -1e-12L; };
  // Half circles: the two points where their planes meet are p and -p.
  return dot3(p, p) > 1e-12L &&
         (std::ranges::all_of(sides, positive) || std::ranges::all_of(sides, negative)) &&
         dot3(p, combined(a[0], 1, a[1])) * dot3(p, combined(b[0], 1, b[1])) > 0;
}

TEST(Fan, ArcsOfTwoEdges_AreAsFarApartAsSaid) {
  Random random(47);
  std::vector<Scene> scenes;
  for (int k = 0; k < 12; ++k)
    scenes.emplace_back("terrain", shapes::rotate_rounded(random_terrain(random), random()));
  scenes.emplace_back("rotated plate", shapes::rotate_rounded(shapes::plate(5, 6), random()));
  scenes.emplace_back("plate", shapes::plate(2, 6));
  // So far away that how far the feet are apart tells nothing.
  const Range far_away = Range::of({1e18, 1e18, 1e18}, {2e18, 2e18, 2e18});
  long pairs = 0, told = 0, tight = 0, wide = 0, inner = 0, crossing = 0;
  for (Scene& scene : scenes) {
    const SiteGeometry& geometry = *scene.geometry;
    const Solid& solid = geometry.solid();
    EngineContext context(geometry, *scene.inside, 1);
    std::vector<std::uint32_t> reflex;
    for (std::uint32_t e = 0; e < solid.edge.size(); ++e)
      if (solid.edge[e].kind == EdgeKind::kReflex) reflex.push_back(e);
    const auto random_pair = [&] {
      const auto e = reflex[random() % reflex.size()], f = reflex[random() % reflex.size()];
      LocalForm a, b;
      a.kind = b.kind = SiteKind::kEdge;
      a.site = geometry.index().edge(e);
      b.site = geometry.index().edge(f);
      const auto arc = [&](std::uint32_t edge) {
        const auto& t = solid.edge[edge].triangle;
        return std::array{inner_normal(solid, t[0]), inner_normal(solid, t[1])};
      };
      const double bound = fans_apart(context, a, b, far_away);
      return std::tuple{arc(e), arc(f), bound};
    };
    for (int k = 0; k < 20'000; ++k) {
      const auto [u, v, bound] = random_pair();
      if (!cross_each_other(u, v)) continue;
      ++crossing;
      ASSERT_LT(bound, 1e-30) << scene.name;
    }
    for (int k = 0; k < 60; ++k) {
      const auto [u, v, bound] = random_pair();
      const Real truth = arcs_apart_by_samples(u, v);
      ASSERT_LE(bound, truth * (1 + 1e-6L) + 1e-30L) << scene.name;
      Real ends = 2;
      for (const Vector& x : u)
        for (const Vector& y : v) ends = std::min(ends, 1 - dot3(x, y));
      ++pairs;
      told += bound > 1e-30;
      tight += truth > 1e-6L && bound > 0.9L * truth;
      wide += bound > 1e-30 && std::min(dot3(u[0], u[1]), dot3(v[0], v[1])) < -0.5L;
      inner += truth > 1e-6L && ends > 1.01L * truth;
    }
  }
  std::cout << pairs << " pairs, " << told << " told, " << tight << " tightly, " << wide
            << " of a wide arc, " << inner << " nearest inside an arc, " << crossing
            << " that cross\n";
  EXPECT_GT(told, pairs / 2);
  EXPECT_GT(tight, pairs / 4);
  EXPECT_GT(wide, 3);
  EXPECT_GT(inner, 80);
  EXPECT_GT(crossing, 1000);
}

}  // namespace
}  // namespace blum
