// AxisDistance::is_within against distances that are known otherwise: of convex solids exactly, of
// others by a mesh with a bound of its own.

#include <gtest/gtest.h>

#include "axis_distance.hpp"
#include "placement/placement_tools.hpp"

namespace blum {
namespace {

using test::dot;
using test::LongPoint;
using test::minus;
using test::wide;

/// What is asked about one solid. Working frame.
struct Asker {
  explicit Asker(const Solid& solid)
      : geometry(solid), tree(solid), inside(solid), engine(geometry, inside, 1) {}
  [[nodiscard]] bool is_within(const Point3& p, double most) {
    return AxisDistance(geometry, engine, tree, inside).is_within(p, most);
  }

  SiteGeometry geometry;
  SiteTree tree;
  InsideOracle inside;
  ProductionEngine engine;
};

struct Plane {
  LongPoint normal{};  ///< of length 1, outwards
  long double offset = 0;
};

/// Of the facets, whose triangles are coplanar exactly.
std::vector<Plane> planes_of(const Solid& solid) {
  std::map<std::uint32_t, Plane> of_facet;
  for (const SolidTriangle& t : solid.triangle) {
    std::array<LongPoint, 3> c;
    for (std::size_t k = 0; k < 3; ++k) c[k] = wide(solid.point[t.vertex[static_cast<int>(k)]]);
    const LongPoint u = minus(c[1], c[0]), v = minus(c[2], c[0]);
    LongPoint n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const long double size = std::sqrt(dot(n, n));
    for (auto& x : n) x /= size;
    of_facet[t.facet] = {n, dot(n, c[0])};
  }
  std::vector<Plane> planes;
  for (const auto& [facet, plane] : of_facet) planes.push_back(plane);
  return planes;
}

/// In a convex solid the points nearest to one facet are a convex polytope, all of whose facets but
/// that one are on the axis: planes that bisect two facets.
long double exact_distance(const std::vector<Plane>& planes, const Point3& p) {
  const auto height = [&](const Plane& f) { return f.offset - dot(f.normal, wide(p)); };
  const Plane first =
      *std::min_element(planes.begin(), planes.end(),
                        [&](const Plane& a, const Plane& b) { return height(a) < height(b); });
  long double least = std::numeric_limits<long double>::infinity();
  for (const Plane& f : planes) {
    const LongPoint across = minus(f.normal, first.normal);
    const long double size = std::sqrt(dot(across, across));
    if (size > 0) least = std::min(least, (height(f) - height(first)) / size);
  }
  return least;
}

Point3 point_in(const Box3& box, std::mt19937& random) {
  Point3 p;
  for (int k = 0; k < 3; ++k) p[k] = std::uniform_real_distribution(box.lo[k], box.hi[k])(random);
  return p;
}

TEST(AxisWithin, ConvexSolids_NoDistanceBelowTheExactOneIsClaimed_AndMostAboveItAre) {
  std::mt19937 random(21);
  for (const auto& scene :
       {test::Scene{"cube", shapes::cuboid(1, 1, 1)}, test::Scene{"slab", shapes::cuboid(8, 6, 1)},
        test::Scene{"triangle", shapes::prism(3, 1, 2)},
        test::Scene{"square", shapes::prism(4, 1, 3)}, test::Scene{"disk", shapes::prism(40)}}) {
    SCOPED_TRACE(scene.name);
    const Solid solid = test::solid_of(scene.mesh);
    const std::vector<Plane> planes = planes_of(solid);
    Asker asker(solid);
    std::size_t asked = 0, shown = 0;
    for (int trial = 0; trial < 400; ++trial) {
      const Point3 p = point_in(bounds_of(solid.point), random);
      if (asker.inside.locate(p) != InsideOracle::Where::kInside) {
        EXPECT_FALSE(asker.is_within(p, 0.5));
        continue;
      }
      const auto exact = static_cast<double>(exact_distance(planes, p));
      ++asked;
      for (const double part : {0.01, 0.5, 0.9, 0.999, 1 - 1e-9})
        EXPECT_FALSE(asker.is_within(p, part * exact)) << part;
      shown += asker.is_within(p, 2 * exact) ? 1 : 0;
    }
    EXPECT_GT(asked, 100u);
    EXPECT_GT(20 * shown, 19 * asked);
  }
}

TEST(AxisWithin, OnTheAxis_IsShownForTheLeastDistances) {
  const Solid solid = test::solid_of(shapes::cuboid(8, 6, 1));
  Asker asker(solid);
  std::mt19937 random(22);
  for (int trial = 0; trial < 200; ++trial) {
    const Point3 p{std::uniform_real_distribution(2.0, 6.0)(random),
                   std::uniform_real_distribution(2.0, 4.0)(random), 0.5};
    for (const double most : {1e-9, 1e-6, 1e-3, 0.1})
      EXPECT_TRUE(asker.is_within(solid.frame.to_working(p), most)) << most;
  }
}

TEST(AxisWithin, OtherSolids_WhatIsClaimedIsNearTheMesh) {
  std::mt19937 random(23);
  for (const auto& scene : {test::Scene{"lbracket", shapes::lbracket()},
                            test::Scene{"rotated", shapes::rotate_rounded(shapes::lbracket(), 3)},
                            test::Scene{"voids", shapes::nested_voids(1)},
                            test::Scene{"torus", shapes::torus(6, 4, 2, 0.75)}}) {
    SCOPED_TRACE(scene.name);
    const test::PlacedRun run(scene.mesh, 0.04);
    ASSERT_TRUE(run.placement->report().reached);
    const Frame& frame = run.solid.frame;
    const double bound = run.result.hausdorff_bound;
    Asker asker(run.solid);
    std::size_t far = 0;
    for (int trial = 0; trial < 150; ++trial) {
      const Point3 p = point_in(bounds_of(run.points), random);
      const double way = test::distance_to_mesh(run.placement->mesh().complex, p);
      for (const double most : {0.01, 0.03, 0.1, 0.3}) {
        if (way <= most * run.diagonal + bound) continue;
        ++far;
        EXPECT_FALSE(
            asker.is_within(frame.to_working(p), frame.length_to_working(most * run.diagonal)));
      }
    }
    EXPECT_GT(far, 50u);
  }
}

}  // namespace
}  // namespace blum
