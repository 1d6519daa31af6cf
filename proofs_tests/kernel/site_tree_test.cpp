// The tree of triangles against its brute-force twin.
#include "blum/kernel/site_tree.hpp"

#include <limits>

#include "mesh_test_tools.hpp"

namespace blum {
namespace {

using test::solid_of;

TEST(SquaredDistanceToTriangle, KnownPlaces_AreEnclosedTightly) {
  const std::array<Point3, 3> t = {Point3{0, 0, 0}, Point3{1, 0, 0}, Point3{0, 1, 0}};
  const auto check = [&](Point3 q, double expected, Point3 foot) {
    Point3 f;
    const SquaredDistanceBounds b = squared_distance_to_triangle(q, t, &f);
    EXPECT_LE(b.lo, expected);
    EXPECT_GE(b.hi, expected);
    EXPECT_LE(b.hi - b.lo, 1e-13 * (1 + expected));
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(f[axis], foot[axis], 1e-14);
  };
  check({0.25, 0.25, 2}, 4, {0.25, 0.25, 0});
  check({0.25, 0.25, -0.5}, 0.25, {0.25, 0.25, 0});
  check({-3, -4, 0}, 25, {0, 0, 0});
  check({2, -1, 1}, 3, {1, 0, 0});
  check({0.5, -2, 0}, 4, {0.5, 0, 0});
  check({-1, 0.5, 1}, 2, {0, 0.5, 0});
  check({1, 1, 0}, 0.5, {0.5, 0.5, 0});
  check({0.25, 0.25, 0}, 0, {0.25, 0.25, 0});
  check({1, 0, 0}, 0, {1, 0, 0});
}

TEST(SquaredDistanceToTriangle, Slivers_AreEnclosed) {
  // The exact sign against a degenerate-size comparison triangle: a point at distance sqrt(lo),
  // sqrt(hi) straight above q must not be nearer, respectively farther.
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 3000; ++i) {
    const double thin = std::ldexp(1.0, -static_cast<int>(random() % 50));
    const Point3 a{unit(random), unit(random), unit(random)}, b{unit(random), unit(random), 1};
    const double s = unit(random);
    const Point3 c{a.x + s * (b.x - a.x) + thin * unit(random),
                   a.y + s * (b.y - a.y) + thin * unit(random),
                   a.z + s * (b.z - a.z) + thin * unit(random)};
    const Point3 q{unit(random), unit(random), unit(random)};
    const SquaredDistanceBounds d = squared_distance_to_triangle(q, {a, b, c});
    ASSERT_LE(d.lo, d.hi);
    const auto probe = [&](double distance) {
      const double z = q.z + distance;
      const std::array<Point3, 3> flat = {Point3{q.x - 1, q.y - 1, z}, Point3{q.x + 2, q.y - 1, z},
                                          Point3{q.x - 1, q.y + 2, z}};
      return compare_distance_to_triangles(q, {a, b, c}, flat);
    };
    ASSERT_GE(probe(std::sqrt(d.lo) * (1 - 1e-12) - 1e-15), 0) << i;
    ASSERT_LE(probe(std::sqrt(d.hi) * (1 + 1e-12) + 1e-15), 0) << i;
  }
}

TEST(CompareDistanceToTriangles, TieAndOneUlp_AreDecided) {
  const std::array<Point3, 3> s = {Point3{-1, -1, 1}, Point3{1, -1, 1}, Point3{0, 1, 1}};
  const auto t = [](double z) {
    return std::array<Point3, 3>{Point3{-1, -1, z}, Point3{1, -1, z}, Point3{0, 1, z}};
  };
  EXPECT_EQ(compare_distance_to_triangles({0, 0, 0}, s, t(-1)), 0);
  EXPECT_EQ(compare_distance_to_triangles({0, 0, 0}, s, t(std::nextafter(-1, -2))), -1);
  EXPECT_EQ(compare_distance_to_triangles({0, 0, 0}, s, t(std::nextafter(-1, 0))), 1);
  EXPECT_EQ(compare_distance_to_triangles({0, 0, 5e-324}, s, t(-1)), -1);
}

void expect_agreement(const PolygonMesh& m, unsigned seed, int queries) {
  const Solid s = solid_of(m);
  const SiteTree tree(s), brute(s, TreeEngine::kBruteForce);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.5, 1.5);
  std::size_t ties = 0;
  for (int i = 0; i < queries; ++i) {
    Point3 q{unit(random), unit(random), unit(random)};
    if (i % 3 == 1) q = s.point[random() % s.point.size()];
    if (i % 3 == 2) {
      // Halfway between two vertices: ties are likely.
      const Point3 &a = s.point[random() % s.point.size()], &b = s.point[random() % s.point.size()];
      q = {(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
    }
    const std::vector<std::uint32_t> nearest = tree.all_nearest(q);
    ASSERT_EQ(nearest, brute.all_nearest(q));
    ties += nearest.size() > 1;
    std::vector<std::uint32_t> possibly;
    for (const TriangleDistance& t : tree.possibly_nearest(q)) possibly.push_back(t.triangle);
    std::sort(possibly.begin(), possibly.end());
    ASSERT_TRUE(std::includes(possibly.begin(), possibly.end(), nearest.begin(), nearest.end()));
    for (const TriangleDistance& t : brute.possibly_nearest(q)) {
      ASSERT_TRUE(std::binary_search(nearest.begin(), nearest.end(), t.triangle));
      ASSERT_LE(t.squared.lo, t.squared.hi);
    }
    const NearestTriangle n = tree.nearest(q);
    ASSERT_EQ(n.triangle, nearest.front());
    const SquaredDistanceBounds d = tree.squared_distance(q);
    ASSERT_LE(d.lo, n.squared_distance.hi);
    ASSERT_GE(d.hi, n.squared_distance.lo);
    ASSERT_LE(d.lo, d.hi);
    const double dx = n.foot.x - q.x, dy = n.foot.y - q.y, dz = n.foot.z - q.z;
    ASSERT_NEAR(dx * dx + dy * dy + dz * dz, n.squared_distance.hi, 1e-12);
    for (const double r2 : {n.squared_distance.lo, n.squared_distance.hi, 0.25, 1.0, 0.0}) {
      ASSERT_EQ(tree.within(q, r2), brute.within(q, r2));
    }
    const Box3 box = {{q.x - 0.2, q.y, q.z - 0.1}, {q.x, q.y + 0.3, q.z}};
    ASSERT_EQ(tree.boxes_meeting(box), brute.boxes_meeting(box));
  }
  EXPECT_GT(ties, 0u);
}

TEST(SiteTree, Queries_AgreeWithBruteForce) {
  expect_agreement(test::box_mesh({-1, -1, -1}, {1, 1, 1}), 1, 200);
  expect_agreement(test::torus(8, 4, 2, 0.5), 2, 150);
  expect_agreement(test::torus(16, 8, 2, 0.9), 3, 60);
}

TEST(SiteTree, CentreOfACube_IsNearestToAllFaces) {
  const SiteTree tree(solid_of(test::box_mesh({-1, -1, -1}, {1, 1, 1})));
  EXPECT_EQ(tree.all_nearest({0, 0, 0}).size(), 12u);
  EXPECT_EQ(tree.all_nearest({5e-324, 0, 0}).size(), 2u);
  EXPECT_EQ(tree.within({0, 0, 0}, 1).size(), 12u);
  EXPECT_EQ(tree.within({0, 0, 0}, std::nextafter(1, 0)).size(), 0u);
}

}  // namespace
}  // namespace blum
