// Dividing leaves with a look ahead, within a budget, and what becomes of it when that ends.

#include <gtest/gtest.h>

#include "blum/subdivision/refine.hpp"
#include "placement/placement_tools.hpp"

namespace blum {
namespace {

using test::PlacedRun;

/// A subdivision, and the leaves that meet the axis.
struct Coarse {
  explicit Coarse(const PolygonMesh& mesh, int threads = 1)
      : solid(test::solid_of(mesh)), geometry(solid) {
    options.threads = threads;
    watch.emplace(options);
    engines.emplace(geometry, options, *watch);
    subdivision = subdivide(geometry, options, *engines).value();
    for (std::uint32_t l = 0; l < subdivision.leaf.size(); ++l)
      if (subdivision.leaf[l].has_axis) with_axis.push_back(l);
  }
  Refined refined(const Refinement& refinement) {
    return refine(geometry, options, *engines, subdivision, refinement).value();
  }

  Solid solid;
  SiteGeometry geometry;
  SubdivisionOptions options;
  std::optional<RunWatch> watch;
  std::optional<EngineSet> engines;
  Subdivision subdivision;
  std::vector<std::uint32_t> with_axis;
};

using Boxes = std::vector<std::array<double, 6>>;

Boxes boxes_of(const Subdivision& subdivision) {
  Boxes boxes;
  for (const Leaf& l : subdivision.leaf)
    boxes.push_back({l.box.lo.x, l.box.lo.y, l.box.lo.z, l.box.hi.x, l.box.hi.y, l.box.hi.z});
  return boxes;
}

TEST(Refine, PartsThatAreNotFineEnough_AreDividedUntilTheyAre) {
  Coarse coarse(shapes::lbracket());
  const double most = 0.2;
  const auto small = [&](const Leaf& part, int) { return diameter(part.box) <= most; };
  const Refined refined = coarse.refined({coarse.with_axis, 0.9, small});
  EXPECT_EQ(refined.divided, coarse.with_axis.size());
  double largest = 0;
  for (const Leaf& l : refined.subdivision.leaf)
    if (l.has_axis) largest = std::max(largest, diameter(l.box));
  EXPECT_LE(largest, most);
  EXPECT_GT(largest, most / 3);  // halved one by one, not all to the smallest
}

TEST(Refine, SameForAnyNumberOfThreads) {
  std::vector<Boxes> found;
  for (const int threads : {1, 3}) {
    Coarse coarse(shapes::lbracket(), threads);
    const auto small = [](const Leaf& part, int) { return diameter(part.box) <= 0.15; };
    found.push_back(boxes_of(coarse.refined({coarse.with_axis, 0.55, small}).subdivision));
  }
  EXPECT_EQ(found[0], found[1]);
}

TEST(Refine, PastTheDeadline_NothingIsDivided) {
  Coarse coarse(shapes::lbracket());
  Refinement refinement{coarse.with_axis};
  refinement.deadline = std::chrono::steady_clock::now() - std::chrono::seconds(1);
  const Refined refined = coarse.refined(refinement);
  EXPECT_EQ(refined.divided, 0u);
  EXPECT_EQ(boxes_of(refined.subdivision), boxes_of(coarse.subdivision));
}

TEST(Refine, LeafThatCannotBeFinished_StaysAsItWas) {
  Coarse coarse(shapes::lbracket());
  // A leaf is divided without end, so that its cells run out of depth; the others are not.
  const Box3 stubborn = coarse.subdivision.leaf[coarse.with_axis.front()].box;
  const auto fine = [&](const Leaf& part, int) {
    return !contains(stubborn, middle(part.box.lo, part.box.hi));
  };
  coarse.options.max_cells = coarse.subdivision.node.size() + 400;
  const std::vector<std::uint32_t> two{coarse.with_axis.back(), coarse.with_axis.front()};
  const Refined refined = coarse.refined({two, 0.55, fine});
  EXPECT_EQ(refined.divided, 1u);
  std::size_t same = 0;
  for (const Leaf& l : refined.subdivision.leaf) {
    EXPECT_NE(l.theorem, LeafTheorem::kUndecided);
    same += l.box.lo == stubborn.lo && l.box.hi == stubborn.hi ? 1 : 0;
  }
  EXPECT_EQ(same, 1u);
}

TEST(Refine, ReviewThatGoesBack_LeavesTheAxisOfTheReviewBefore) {
  const Solid solid = test::solid_of(shapes::lbracket());
  std::vector<std::size_t> leaves;
  std::size_t triangles = 0;
  const AxisReview review = [&](const AssembledAxis& axis) {
    ReviewVerdict verdict;
    leaves.push_back(axis.subdivision.leaf.size());
    verdict.hausdorff_bound = 1;
    if (leaves.size() == 1) {
      triangles = axis.complex.triangle.size();
      for (std::uint32_t l = 0; l < axis.subdivision.leaf.size(); ++l)
        if (axis.subdivision.leaf[l].has_axis) verdict.divide.push_back(l);
    }
    verdict.go_back = leaves.size() == 2;
    return verdict;
  };
  const auto axis = compute_medial_axis(solid, test::seeded(1), {}, {}, review);
  ASSERT_TRUE(axis);
  ASSERT_EQ(leaves.size(), 2u);
  EXPECT_GT(leaves[1], leaves[0]);
  EXPECT_EQ(axis.value().leaves, leaves[0]);
  EXPECT_EQ(axis.value().complex.triangle.size(), triangles);
  EXPECT_TRUE(axis.value().certified);
}

TEST(HausdorffBound, WhereEpsilonIsNotReached_IsLessThanTheLargestLeafAndHolds) {
  std::mt19937 random(10);
  for (const auto& scene : {test::Scene{"cuboid", shapes::cuboid(3, 2, 1)},
                            test::Scene{"lbracket", shapes::lbracket()}}) {
    SCOPED_TRACE(scene.name);
    const Solid solid = test::solid_of(scene.mesh);
    const std::vector<Point3> points = test::model_points(solid);
    const double diagonal = test::extent(points);
    const double epsilon = 0.02 * diagonal;
    AxisPlacement placement(solid, {epsilon, 0});
    double largest = 0;
    const AxisReview never_divide = [&, look = placement.review()](const AssembledAxis& axis) {
      ReviewVerdict verdict = look(axis);
      EXPECT_FALSE(verdict.divide.empty());
      verdict.divide.clear();
      for (const Leaf& l : axis.subdivision.leaf)
        if (l.has_axis) largest = std::max(largest, solid.frame.length_to_model(diameter(l.box)));
      return verdict;
    };
    const auto axis = compute_medial_axis(solid, test::seeded(1), {}, {}, never_divide);
    ASSERT_TRUE(axis);
    const double bound = axis.value().hausdorff_bound;
    ASSERT_EQ(placement.report().round.size(), 1u);
    EXPECT_GT(placement.report().round.back().failed, 0u);
    EXPECT_FALSE(placement.report().reached);
    EXPECT_GT(bound, epsilon);
    EXPECT_LT(bound, 0.8 * largest);
    const InsideOracle inside(solid);
    const Box3 box = bounds_of(points);
    std::size_t found = 0;
    for (int trial = 0; trial < 300; ++trial) {
      Point3 p, q;
      for (int k = 0; k < 3; ++k) {
        p[k] = std::uniform_real_distribution(box.lo[k], box.hi[k])(random);
        q[k] = p[k] + std::uniform_real_distribution(-0.2, 0.2)(random) * diagonal;
      }
      const auto is_inside = [&](const Point3& x) {
        return inside.locate(solid.frame.to_working(x)) == InsideOracle::Where::kInside;
      };
      if (!is_inside(p) || !is_inside(q)) continue;
      const auto x = test::axis_point_between(solid, points, p, q);
      if (!x) continue;
      ++found;
      EXPECT_LE(test::distance_to_mesh(placement.mesh().complex, *x), bound);
    }
    EXPECT_GT(found, 20u);
  }
}

}  // namespace
}  // namespace blum
