// Point location against its brute-force twin, on and beside the boundary.
#include "blum/kernel/inside.hpp"

#include <limits>

#include "mesh_test_tools.hpp"

namespace blum {
namespace {

using Where = InsideOracle::Where;
using test::solid_of;

TEST(InsideOracle, Cube_ExactToTheUlp) {
  const InsideOracle oracle(solid_of(test::box_mesh({-1, -1, -1}, {1, 1, 1})));
  const double in = std::nextafter(1.0, 0.0), out = std::nextafter(1.0, 2.0);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      for (const double other : {0.0, 0.3, 0.5}) {
        const auto at = [&](double x) {
          Point3 p{other, other, other};
          p[axis] = sign * x;
          return oracle.locate(p);
        };
        EXPECT_EQ(at(in), Where::kInside);
        EXPECT_EQ(at(1), Where::kBoundary);
        EXPECT_EQ(at(out), Where::kOutside);
      }
    }
  }
  EXPECT_EQ(oracle.locate({1, 1, 1}), Where::kBoundary);
  EXPECT_EQ(oracle.locate({1, 1, 0.5}), Where::kBoundary);
  EXPECT_EQ(oracle.locate({1, 1, out}), Where::kOutside);
  EXPECT_EQ(oracle.locate({1, 1, -out}), Where::kOutside);  // the ray runs along an edge
  EXPECT_EQ(oracle.locate({1, 0, -out}), Where::kOutside);  // the ray runs in a face
  EXPECT_EQ(oracle.locate({5, 5, 5}), Where::kOutside);
}

void expect_agreement(const PolygonMesh& m, unsigned seed, int queries) {
  const Solid s = solid_of(m);
  const InsideOracle oracle(s);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.1, 1.1);
  int count[3] = {0, 0, 0};
  for (int i = 0; i < queries; ++i) {
    Point3 p{unit(random), unit(random), unit(random)};
    // Take coordinates from vertices: rays through vertices and edges, points on the boundary.
    for (int axis = 0; axis < 3; ++axis) {
      if (random() % 2) p[axis] = s.point[random() % s.point.size()][axis];
    }
    if (random() % 4 == 0) p = s.point[random() % s.point.size()];
    if (random() % 4 == 0) {
      const int axis = static_cast<int>(random() % 3);
      p[axis] = std::nextafter(p[axis], random() % 2 ? 2.0 : -2.0);
    }
    const Where w = oracle.locate(p);
    ASSERT_EQ(w, oracle.locate_brute_force(p)) << p.x << " " << p.y << " " << p.z;
    ++count[static_cast<int>(w)];
  }
  EXPECT_GT(count[0], 0);
  EXPECT_GT(count[1], 0);
  EXPECT_GT(count[2], 0);
}

TEST(InsideOracle, DegenerateQueries_AgreeWithBruteForce) {
  expect_agreement(test::box_mesh({-1, -1, -1}, {1, 1, 1}), 1, 3000);
  expect_agreement(test::torus(8, 4, 2, 0.5), 2, 3000);
  expect_agreement(test::torus(24, 12, 2, 0.9), 3, 3000);
  PolygonMesh nested;
  for (int k = 1; k <= 4; ++k) {
    const double r = k;
    const PolygonMesh b = test::box_mesh({-r, -r, -r}, {r, r, r});
    nested = test::merged(std::move(nested), k % 2 == 0 ? b : test::reversed(b));
  }
  expect_agreement(nested, 4, 3000);
}

TEST(InsideOracle, RotatedAxes_GiveTheSameAnswer) {
  // The ray's direction must not matter: the same question about the solid turned.
  const PolygonMesh m = test::torus(10, 6, 2, 0.75);
  const Solid s = solid_of(m);
  const InsideOracle a(s);
  const Solid turned = solid_of(test::mapped(m, [](Point3 p) { return Point3{p.y, p.z, p.x}; }));
  const InsideOracle b(turned);
  std::mt19937 random(5);
  for (int i = 0; i < 3000; ++i) {
    Point3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = s.point[random() % s.point.size()][axis];
    ASSERT_EQ(a.locate(p), b.locate({p.y, p.z, p.x}));
  }
}

TEST(InsideOracle, VoidAndIsland_AreToldApart) {
  PolygonMesh m = test::box_mesh({-4, -4, -4}, {4, 4, 4});
  m = test::merged(m, test::reversed(test::box_mesh({-2, -2, -2}, {2, 2, 2})));
  m = test::merged(m, test::box_mesh({-1, -1, -1}, {1, 1, 1}));
  const InsideOracle oracle(solid_of(m));  // working coordinates: a quarter
  EXPECT_EQ(oracle.locate({0, 0, 0}), Where::kInside);
  EXPECT_EQ(oracle.locate({0, 0, 0.375}), Where::kOutside);
  EXPECT_EQ(oracle.locate({0, 0, 0.75}), Where::kInside);
  EXPECT_EQ(oracle.locate({0, 0, 1.5}), Where::kOutside);
  EXPECT_EQ(oracle.locate({0, 0.5, 0.25}), Where::kBoundary);
}

}  // namespace
}  // namespace blum
