// The tree of balls and what is measured with it, against a look at every ball.

#include <gtest/gtest.h>

#include "placement/placement_tools.hpp"
#include "placement/plain_reconstruction.hpp"

namespace blum {
namespace {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()(double lo, double hi) {
    return std::uniform_real_distribution(lo, hi)(engine_);
  }
  std::uint32_t below(std::size_t n) { return static_cast<std::uint32_t>(engine_() % n); }
  Point3 point() { return {(*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1)}; }

 private:
  std::mt19937 engine_;
};

/// All over, all on a line, on a grid with many ties, equal, one large among tiny ones.
std::vector<std::vector<WorkingBall>> families(Random& random) {
  std::vector<std::vector<WorkingBall>> all;
  for (const std::size_t n : {1, 2, 6, 7, 13, 200, 1000}) {
    std::vector<WorkingBall> anywhere, line, grid, equal, mixed;
    for (std::size_t i = 0; i < n; ++i) {
      anywhere.push_back({random.point(), random(0, 0.5)});
      line.push_back({{random(-1, 1), 0.25, 0.25}, random(0, 0.1)});
      grid.push_back({{random.below(4) / 4.0, random.below(4) / 4.0, random.below(4) / 4.0},
                      random.below(3) / 8.0});
      equal.push_back({{0.5, 0.5, 0.5}, 0.25});
      mixed.push_back({random.point(), i == n / 2 ? 1.5 : 1e-9});
    }
    for (auto& list : {anywhere, line, grid, equal, mixed}) all.push_back(list);
  }
  return all;
}

TEST(BallTree, AnyBalls_AnswersOfALookAtAll) {
  Random random(7);
  std::size_t held = 0, free = 0;
  for (const auto& balls : families(random)) {
    const BallTree tree(balls);
    for (int trial = 0; trial < 200; ++trial) {
      const std::uint32_t some = random.below(balls.size());
      // Anywhere, at a centre, and on a sphere to rounding: there answers hang on the last bit.
      Point3 p = trial % 4 == 0 ? balls[some].center : random.point();
      if (trial % 4 == 1) {
        const double l = length(p);
        p = balls[some].center + (balls[some].radius / l) * p;
      }
      if (trial % 4 == 2) p = {random.below(9) / 8.0, random.below(9) / 8.0, 0.5};
      const double way = test::plain_nearest(balls, p).way;
      for (const std::uint32_t guess : {BallTree::kNone, some}) {
        const BallTree::Nearest nearest = tree.nearest(p, guess);
        EXPECT_EQ(nearest.way, way);
        EXPECT_EQ(way_to(balls[nearest.ball], p), way);
        for (const double most : {-1e-13, 0.0, way, std::nextafter(way, 9.0), 0.1}) {
          const auto found = tree.any_nearer_than(p, most, some, guess);
          const bool is_there =
              test::plain_any_nearer_than(balls, p, most, some) != BallTree::kNone;
          ASSERT_EQ(found != BallTree::kNone, is_there);
          ++(is_there ? held : free);
          if (!is_there) continue;
          EXPECT_NE(found, some);
          EXPECT_LT(way_to(balls[found], p), most);
        }
      }
    }
  }
  EXPECT_GT(held, 2000u);
  EXPECT_GT(free, 2000u);
}

TEST(BallTree, NoBalls_NothingIsNear) {
  const BallTree tree({});
  EXPECT_EQ(tree.nearest({0, 0, 0}).ball, BallTree::kNone);
  EXPECT_EQ(tree.any_nearer_than({0, 0, 0}, 1, BallTree::kNone), BallTree::kNone);
}

TEST(Reconstruction, EveryNumber_IsThatOfALookAtAllBalls) {
  for (const auto& mesh : {shapes::cuboid(3, 2, 1), shapes::lbracket(), shapes::nested_voids(1),
                           shapes::planar_torus(8, 4, 2, 0.75)}) {
    const test::PlacedRun run(mesh, 0, 0.1);
    const CellComplex& complex = run.placement->mesh().complex;
    for (const ReconstructionOptions& options :
         {ReconstructionOptions{0.01, 2'000, 4'000}, ReconstructionOptions{0.001, 300, 1}}) {
      const ReconstructionError error = reconstruction_error(run.solid, complex, options),
                                plain =
                                    test::plain_reconstruction_error(run.solid, complex, options);
      EXPECT_EQ(error.balls, plain.balls);
      EXPECT_EQ(error.boundary_to_union_lo, plain.boundary_to_union_lo);
      EXPECT_EQ(error.boundary_to_union_hi, plain.boundary_to_union_hi);
      EXPECT_EQ(error.union_to_boundary_sampled, plain.union_to_boundary_sampled);
      EXPECT_EQ(error.border_samples, plain.border_samples);
      EXPECT_GT(error.border_samples, 0u);
    }
  }
}

}  // namespace
}  // namespace blum
