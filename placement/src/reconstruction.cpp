#include "blum/placement/reconstruction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>
#include <vector>

#include "ball_tree.hpp"
#include "blum/kernel/point_algebra.hpp"
#include "blum/kernel/site_tree.hpp"

namespace blum {
namespace {

constexpr double kRounding = 1e-13;  // working units

/// Part of a boundary triangle.
struct Piece {
  std::array<Point3, 3> corner;
  std::uint32_t ball = BallTree::kNone;  ///< the nearest to its centre
  double hi = 0;
  friend bool operator<(const Piece& a, const Piece& b) { return a.hi < b.hi; }
};

class BoundarySide {
 public:
  explicit BoundarySide(const BallTree& balls) : balls_(balls) {}

  /// Bisects the piece with the largest upper bound until the interval is narrow.
  void run(const Solid& solid, double tolerance, std::size_t most_pieces) {
    for (const SolidTriangle& t : solid.triangle)
      add({solid.point[t.vertex[0]], solid.point[t.vertex[1]], solid.point[t.vertex[2]]},
          BallTree::kNone);
    for (std::size_t n = 0; n < most_pieces && !heap_.empty(); ++n) {
      if (heap_.top().hi <= lo_ + tolerance) break;
      const Piece piece = heap_.top();
      heap_.pop();
      const auto& [a, b, c] = piece.corner;
      const Point3 ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const auto& part : {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c},
                               std::array{ab, bc, ca}})
        add(part, piece.ball);
    }
  }
  [[nodiscard]] double lo() const { return lo_; }
  [[nodiscard]] double hi() const { return heap_.empty() ? lo_ : std::max(lo_, heap_.top().hi); }

 private:
  void add(const std::array<Point3, 3>& corner, std::uint32_t guess) {
    const Point3 center = (1.0 / 3) * (corner[0] + corner[1] + corner[2]);
    double reach = 0;
    for (const Point3& p : corner) reach = std::max(reach, distance_between(center, p));
    const BallTree::Nearest nearest = balls_.nearest(center, guess);
    lo_ = std::max(lo_, nearest.way);
    const double hi = nearest.way + reach + kRounding;
    if (hi > lo_) heap_.push({corner, nearest.ball, hi});
  }

  const BallTree& balls_;
  std::priority_queue<Piece> heap_;
  double lo_ = 0;
};

Point3 direction(std::size_t k, std::size_t count) {
  const double z = 1 - (2 * static_cast<double>(k) + 1) / static_cast<double>(count);
  const double angle = static_cast<double>(k) * std::numbers::pi * (3 - std::sqrt(5.0));
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

}  // namespace

ReconstructionError reconstruction_error(const Solid& solid, const CellComplex& complex,
                                         const ReconstructionOptions& options) {
  const Frame& frame = solid.frame;
  std::vector<WorkingBall> balls;
  for (const ComplexVertex& v : complex.vertex)
    balls.push_back({frame.to_working(v.position), frame.length_to_working(v.radius)});
  ReconstructionError error;
  error.balls = balls.size();
  if (balls.empty()) return error;

  const BallTree tree(std::move(balls));
  BoundarySide side(tree);
  side.run(solid, options.tolerance * diameter(bounds_of(solid.point)), options.most_pieces);
  error.boundary_to_union_lo = frame.length_to_model(side.lo());
  error.boundary_to_union_hi = frame.length_to_model(side.hi());

  const SiteTree boundary(solid);
  const std::size_t each = std::clamp<std::size_t>(options.samples / error.balls, 8, 2000);
  double most = 0;
  for (std::uint32_t b = 0; b < error.balls; ++b) {
    const WorkingBall& ball = tree.balls()[b];
    if (!(ball.radius > 0)) continue;
    std::uint32_t cover = BallTree::kNone;  // the next sample is near
    for (std::size_t k = 0; k < each; ++k) {
      const Point3 x = ball.center + ball.radius * direction(k, each);
      if (const auto other = tree.any_nearer_than(x, -kRounding, b, cover);
          other != BallTree::kNone) {
        cover = other;
        continue;
      }
      ++error.border_samples;
      most = std::max(most, std::sqrt(boundary.squared_distance(x).lo));
    }
  }
  error.union_to_boundary_sampled = frame.length_to_model(most);
  return error;
}

}  // namespace blum
