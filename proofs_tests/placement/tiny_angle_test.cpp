// The lemma for sheets of tiny angle (docs/proofs.md, "Distance from the axis"), where the axis is
// known: below the ridge of a double pyramid whose two upper faces are coplanar up to rounding, it
// is the plane that bisects them if the ridge is convex, and nothing if it is flat or reflex.

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>

#include "axis_distance.hpp"
#include "placement/placement_tools.hpp"

namespace blum {
namespace {

constexpr unsigned kBits = 1024;
using LongVector = std::array<mpf_class, 3>;

LongVector long_vector(const Point3& p) {
  return {mpf_class(p.x, kBits), mpf_class(p.y, kBits), mpf_class(p.z, kBits)};
}
LongVector minus(const LongVector& a, const LongVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
mpf_class inner(const LongVector& a, const LongVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
LongVector unit_normal(const Solid& solid, std::uint32_t t) {
  const auto& v = solid.triangle[t].vertex;
  const LongVector a = long_vector(solid.point[v[0]]), u = minus(long_vector(solid.point[v[1]]), a),
                   w = minus(long_vector(solid.point[v[2]]), a);
  LongVector n{u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]};
  mpf_class size(sqrt(mpf_class(inner(n, n), kBits)), kBits);
  for (mpf_class& x : n) x /= size;
  return n;
}

/// Vertices 0, 1: the ridge; 2, 3: beside it; 4: below. The ridge is `lift` above the others.
PolygonMesh double_pyramid(double lift) {
  return {{{0, -1, lift}, {0, 1, lift}, {-1, 0, 0}, {1, 0, 0}, {0, 0, -1}},
          {{0, 1, 2}, {1, 0, 3}, {0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}}};
}

struct Fold {
  Solid solid;
  std::array<std::uint32_t, 2> face{};  ///< at the ridge, beside vertices 2 and 3
  std::uint32_t ridge = 0;              ///< the edge
  /// A point by vertices 0 to 4, weights of sum 1. Working frame.
  [[nodiscard]] Point3 at(const std::array<double, 5>& weight) const {
    Point3 p{0, 0, 0};
    for (std::size_t i = 0; i < 5; ++i) p = p + weight[i] * solid.point[i];
    return p;
  }
  /// Distance from the plane that bisects the two faces; exact but for 1e-100 or so.
  [[nodiscard]] mpf_class distance_from_bisector(const Point3& p) const {
    const LongVector n = minus(unit_normal(solid, face[0]), unit_normal(solid, face[1]));
    const mpf_class size(sqrt(mpf_class(inner(n, n), kBits)), kBits);
    return abs(inner(n, minus(long_vector(p), long_vector(solid.point[0]))) / size);
  }
};

Fold fold_of(const PolygonMesh& mesh) {
  Fold fold{test::solid_of(mesh)};
  const auto has = [&](std::uint32_t t, std::uint32_t v) {
    const auto& corner = fold.solid.triangle[t].vertex;
    return std::find(corner.begin(), corner.end(), v) != corner.end();
  };
  for (std::uint32_t t = 0; t < fold.solid.triangle.size(); ++t)
    if (has(t, 0) && has(t, 1)) fold.face[has(t, 2) ? 0 : 1] = t;
  for (std::uint32_t e = 0; e < fold.solid.edge.size(); ++e) {
    const auto& v = fold.solid.edge[e].vertex;
    if (std::max(v[0], v[1]) == 1) fold.ridge = e;
  }
  return fold;
}

struct Tally {
  std::size_t near = 0, nothing = 0;
  std::size_t within = 0;  ///< by feet alone
};

/// Points in the part of the solid where nothing but the two faces and the ridge is near, and what
/// is claimed of them with the ridge on neither side, on one and on the other.
void look(const Fold& fold, std::mt19937& random, Tally& tally) {
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution(a, b)(random);
  };
  const bool is_convex = fold.solid.edge[fold.ridge].kind == EdgeKind::kConvex;
  const AxisReview review = [&](const AssembledAxis& axis) {
    const SiteTree tree(fold.solid);
    const SiteIndex& index = axis.geometry.index();
    const SiteId left = index.face(fold.face[0]), right = index.face(fold.face[1]),
                 ridge = index.edge(fold.ridge);
    const AxisDistance distance(axis.geometry, axis.engines.production(0), tree,
                                axis.engines.inside());
    for (int trial = 0; trial < 12; ++trial) {
      const double along = uniform(-0.9, 0.9), wide = 1 - std::abs(along);
      const double depth = uniform(0.02, 0.2) * wide;
      double aside = uniform(-0.04, 0.04) * wide;
      if (trial % 3 == 0) aside = std::ldexp(aside, -40);
      if (trial % 3 == 1) aside = 0;
      // Weights of (aside, along, -depth) where nothing is moved.
      const double rest = 1 - depth - std::abs(aside);
      const Point3 p = fold.at({(rest - along) / 2, (rest + along) / 2, std::max(-aside, 0.0),
                                std::max(aside, 0.0), depth});
      const double most = 0.03 * wide * length(fold.solid.point[2] - fold.solid.point[3]) / 2;
      const bool within = distance.is_within(p, most);
      EXPECT_TRUE(!within || (is_convex && fold.distance_from_bisector(p) <= most));
      tally.within += within ? 1 : 0;
      for (const Leaf& leaf : axis.subdivision.leaf) {
        if (!contains(leaf.box, p)) continue;
        const LeafSides sides(axis.geometry, leaf);
        for (const auto& [a, b] : {std::pair(SiteGroup{left}, SiteGroup{right}),
                                   std::pair(SiteGroup{right}, SiteGroup{left}),
                                   std::pair(SiteGroup{left, ridge}, SiteGroup{right}),
                                   std::pair(SiteGroup{left}, SiteGroup{ridge, right})}) {
          const auto d = distance.exactly_at_most(p, a, b, sides, most);
          ++(d ? tally.near : tally.nothing);
          if (!d) continue;
          EXPECT_TRUE(is_convex) << "there is no axis";
          EXPECT_LE(fold.distance_from_bisector(p), *d);
        }
      }
    }
    return ReviewVerdict{};
  };
  ASSERT_TRUE(compute_medial_axis(fold.solid, test::seeded(1), {}, {}, review));
}

/// Ridges lifted by powers of two, and as rounding leaves them where the solid is turned.
void folds(int from, int to, int turned, std::mt19937& random, Tally& convex, Tally& others) {
  const auto one = [&](const PolygonMesh& mesh) {
    const Fold fold = fold_of(mesh);
    look(fold, random, fold.solid.edge[fold.ridge].kind == EdgeKind::kConvex ? convex : others);
  };
  for (int power = from; power <= to; power += 4)
    for (const double sign : {1.0, -1.0}) {
      one(double_pyramid(sign * std::ldexp(1.0, -power)));
      one(shapes::rotate_rounded(double_pyramid(sign * std::ldexp(1.0, -power)), power));
    }
  for (int seed = 1; seed <= turned; ++seed)
    one(shapes::rotate_rounded(double_pyramid(0), static_cast<std::uint64_t>(seed)));
}

TEST(TinyAngle, WhatIsSaidToBeNear_IsWithinTheDistanceOfTheExactBisector) {
  std::mt19937 random(11);
  Tally convex, others;
  folds(20, 100, 12, random, convex, others);
  EXPECT_GT(convex.near, convex.nothing / 4);
  EXPECT_GT(convex.near, 300u);
  EXPECT_EQ(others.near, 0u);
  EXPECT_EQ(others.within, 0u);
  EXPECT_GT(convex.within, 0u);
  EXPECT_GT(others.nothing, 500u);
  std::printf("convex: %zu near, %zu nothing; flat and reflex: %zu nothing\n", convex.near,
              convex.nothing, others.nothing);
}

/// Between two faces a narrow floor, lower than both: every point below has one foot.
TEST(TinyAngle, BetweenFacesWithAFloorOfATroughBetweenThem_NothingIsSaid) {
  std::mt19937 random(12);
  for (const double wide : {0x1p-30, 0x1p-20, 0x1p-10})
    for (const double deep : {0x1p-60, 0x1p-40, 0x1p-20}) {
      const PolygonMesh mesh = {{{-wide, -1, -deep},
                                 {-wide, 1, -deep},
                                 {wide, 1, -deep},
                                 {wide, -1, -deep},
                                 {-1, 0, 0},
                                 {1, 0, 0},
                                 {0, 0, -1}},
                                {{0, 3, 2, 1},
                                 {0, 1, 4},
                                 {2, 3, 5},
                                 {0, 4, 6},
                                 {4, 1, 6},
                                 {1, 2, 6},
                                 {2, 5, 6},
                                 {5, 3, 6},
                                 {3, 0, 6}}};
      const Solid solid = test::solid_of(mesh);
      const auto face_with = [&](std::uint32_t v) {
        std::uint32_t found = 0;
        for (std::uint32_t t = 0; t < solid.triangle.size(); ++t) {
          const auto& corner = solid.triangle[t].vertex;
          const auto has = [&](std::uint32_t u) {
            return std::find(corner.begin(), corner.end(), u) != corner.end();
          };
          if (has(v) && !has(6)) found = t;
        }
        return found;
      };
      const AxisReview review = [&](const AssembledAxis& axis) {
        const SiteTree tree(solid);
        const SiteGroup left{axis.geometry.index().face(face_with(4))},
            right{axis.geometry.index().face(face_with(5))};
        const AxisDistance distance(axis.geometry, axis.engines.production(0), tree,
                                    axis.engines.inside());
        for (int trial = 0; trial < 20; ++trial) {
          const double along = std::uniform_real_distribution(-0.3, 0.3)(random),
                       depth = std::uniform_real_distribution(0.05, 0.15)(random);
          const Point3 p = solid.frame.to_working({0, along, -depth});
          for (const Leaf& leaf : axis.subdivision.leaf)
            if (contains(leaf.box, p)) {
              const LeafSides sides(axis.geometry, leaf);
              EXPECT_FALSE(distance.exactly_at_most(p, left, right, sides, 0.01));
              EXPECT_FALSE(distance.exactly_at_most(p, right, left, sides, 0.01));
            }
        }
        return ReviewVerdict{};
      };
      ASSERT_TRUE(compute_medial_axis(solid, test::seeded(1), {}, {}, review));
    }
}

}  // namespace
}  // namespace blum
