// The Hausdorff bound against points of the exact axis, found by bisection, and of the result.

#include <gtest/gtest.h>

#include "placement/placement_tools.hpp"

namespace blum {
namespace {

using test::PlacedRun;

std::vector<test::Scene> scenes() {
  return {{"cube", shapes::cuboid(1, 1, 1)},
          {"cuboid", shapes::cuboid(3, 2, 1)},
          {"lbracket", shapes::lbracket()},
          {"square prism", shapes::prism(4, 1, 3)}};
}

std::vector<test::Scene> slow_scenes() {
  return {{"lpocket", shapes::lpocket()},
          {"octagon", shapes::prism(8, 1, 1)},
          {"voids", shapes::nested_voids(1)},
          {"plate", shapes::plate(2, 6)},
          {"planar torus", shapes::planar_torus(8, 4, 2, 0.75)},
          {"torus", shapes::torus(6, 4, 2, 0.75)},
          {"rotated", shapes::rotate_rounded(shapes::lbracket(), 3)}};
}

/// Sheets of tiny angle are beyond the plain measure: feet there differ by rounding.
bool nearly_coplanar(const Solid& solid, const ComplexTriangle& triangle) {
  const SiteIndex index(solid);
  std::array<Point3, 2> normal;
  for (const std::size_t k : {0u, 1u}) {
    const SiteId s = triangle.governors[k];
    if (index.kind(s) != SiteKind::kFace) return false;
    const auto& v = solid.triangle[index.element(s)].vertex;
    const Point3 n =
        cross(solid.point[v[1]] - solid.point[v[0]], solid.point[v[2]] - solid.point[v[0]]);
    normal[k] = (1 / length(n)) * n;
  }
  return distance_between(normal[0], normal[1]) < 1e-6;
}

/// What is measured, both ways, as parts of the diagonal.
struct Measured {
  double axis_to_result = 0, result_to_axis = 0;
  std::size_t points = 0;
};

Measured measure(const PlacedRun& run, const CellComplex& mesh, std::size_t trials,
                 std::mt19937& random) {
  const InsideOracle inside(run.solid);
  const auto is_inside = [&](const Point3& p) {
    return inside.locate(run.solid.frame.to_working(p)) == InsideOracle::Where::kInside;
  };
  Point3 lo = run.points.front(), hi = lo;
  for (const Point3& p : run.points)
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution(a, b)(random);
  };
  Measured m;
  for (std::size_t k = 0; k < trials; ++k) {
    Point3 p, q;
    for (int i = 0; i < 3; ++i) {
      p[i] = uniform(lo[i], hi[i]);
      q[i] = p[i] + uniform(-0.2, 0.2) * run.diagonal;
    }
    if (!is_inside(p) || !is_inside(q)) continue;
    const auto x = test::axis_point_between(run.solid, run.points, p, q);
    if (!x || !is_inside(*x)) continue;
    ++m.points;
    m.axis_to_result = std::max(m.axis_to_result, test::distance_to_mesh(mesh, *x));
  }
  for (std::size_t k = 0; k < trials / 4; ++k) {
    const auto t = std::uniform_int_distribution<std::size_t>(0, mesh.triangle.size() - 1)(random);
    if (nearly_coplanar(run.solid, mesh.triangle[t])) continue;
    const auto v = corners(mesh, mesh.triangle[t]);
    double a = uniform(0, 1), b = uniform(0, 1);
    if (a + b > 1) a = 1 - a, b = 1 - b;
    const Point3 x = (1 - a - b) * mesh.vertex[v[0]].position + a * mesh.vertex[v[1]].position +
                     b * mesh.vertex[v[2]].position;
    m.result_to_axis =
        std::max(m.result_to_axis, test::plain_distance_to_axis(run.solid, run.points, x));
  }
  return m;
}

/// Of 400 trials a scene: the number of points of the axis that were found.
std::size_t expect_never_exceeded(const std::vector<test::Scene>& list, double epsilon,
                                  std::uint64_t seed) {
  std::mt19937 random(7 + seed);
  std::size_t points = 0;
  for (const auto& scene : list) {
    SCOPED_TRACE(scene.name);
    const PlacedRun run(scene.mesh, epsilon, 0, seed);
    EXPECT_TRUE(run.result.certified);
    EXPECT_TRUE(run.placement->report().reached);
    const double bound = run.result.hausdorff_bound;
    EXPECT_EQ(bound, run.placement->report().bound);
    EXPECT_LE(bound, epsilon * run.diagonal);
    const Measured m = measure(run, run.placement->mesh().complex, 400, random);
    EXPECT_LE(m.axis_to_result, bound);
    EXPECT_LE(m.result_to_axis, bound);
    points += m.points;
  }
  return points;
}

TEST(HausdorffBound, SampledPoints_NeverExceedIt) {
  EXPECT_GT(expect_never_exceeded(scenes(), 0.04, 1), 200u);
}

TEST(SweepHausdorffBound, SampledPoints_NeverExceedIt) {
  for (const std::uint64_t seed : {1, 2}) {
    SCOPED_TRACE(seed);
    EXPECT_GT(expect_never_exceeded(scenes(), 0.01, seed), 200u);
    EXPECT_GT(expect_never_exceeded(slow_scenes(), 0.02, seed), 200u);
  }
}

TEST(HausdorffBound, WithoutEpsilon_IsTheLargestLeaf) {
  std::mt19937 random(8);
  for (const auto& scene : scenes()) {
    SCOPED_TRACE(scene.name);
    const PlacedRun run(scene.mesh, 0);
    auto plain = compute_medial_axis(run.solid, test::seeded(1));
    ASSERT_TRUE(plain);
    EXPECT_NEAR(run.result.hausdorff_bound, plain.value().hausdorff_bound, 1e-8 * run.diagonal);
    EXPECT_LE(measure(run, run.placement->mesh().complex, 60, random).axis_to_result,
              run.result.hausdorff_bound);
  }
}

TEST(HausdorffBound, ResultThatMissesTheAxis_IsNotWithinIt) {
  // The measure itself must be able to fail: the mesh of one solid beside the axis of another.
  std::mt19937 random(9);
  const PlacedRun run(shapes::cuboid(3, 2, 1), 0.02), other(shapes::cuboid(3, 2, 1.3), 0.02);
  const Measured m = measure(run, other.placement->mesh().complex, 300, random);
  EXPECT_GT(m.axis_to_result, run.result.hausdorff_bound);
  EXPECT_GT(m.result_to_axis, run.result.hausdorff_bound);
}

TEST(HausdorffBound, FewerLeavesThanByDiameter) {
  for (const auto& scene : scenes()) {
    SCOPED_TRACE(scene.name);
    const PlacedRun run(scene.mesh, 0.1);
    auto uniform = compute_medial_axis(run.solid, test::seeded(1, 0.1 * run.diagonal));
    ASSERT_TRUE(uniform);
    EXPECT_LT(2 * run.result.leaves, uniform.value().leaves);
  }
}

}  // namespace
}  // namespace blum
