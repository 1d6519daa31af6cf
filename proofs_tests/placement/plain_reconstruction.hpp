/// reconstruction_error() with a look at every ball wherever one is asked for: its twin.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <vector>

#include "ball_tree.hpp"
#include "blum/kernel/point_algebra.hpp"
#include "blum/kernel/site_tree.hpp"
#include "blum/placement/reconstruction.hpp"

namespace blum::test {

inline BallTree::Nearest plain_nearest(const std::vector<WorkingBall>& balls, const Point3& p) {
  BallTree::Nearest best;
  for (std::uint32_t b = 0; b < balls.size(); ++b)
    if (const double way = way_to(balls[b], p); way < best.way) best = {way, b};
  return best;
}

inline std::uint32_t plain_any_nearer_than(const std::vector<WorkingBall>& balls, const Point3& p,
                                           double most, std::uint32_t except) {
  for (std::uint32_t b = 0; b < balls.size(); ++b)
    if (b != except && way_to(balls[b], p) < most) return b;
  return BallTree::kNone;
}

inline ReconstructionError plain_reconstruction_error(const Solid& solid,
                                                      const CellComplex& complex,
                                                      const ReconstructionOptions& options) {
  constexpr double kRounding = 1e-13;
  using Triangle = std::array<Point3, 3>;
  struct Piece {
    Triangle corner;
    double hi = 0;
    bool operator<(const Piece& other) const { return hi < other.hi; }
  };
  const Frame& frame = solid.frame;
  std::vector<WorkingBall> balls;
  for (const ComplexVertex& v : complex.vertex)
    balls.push_back({frame.to_working(v.position), frame.length_to_working(v.radius)});
  ReconstructionError error;
  error.balls = balls.size();
  if (balls.empty()) return error;

  std::priority_queue<Piece> heap;
  double lo = 0;
  const auto add = [&](const Triangle& corner) {
    const Point3 center = (1.0 / 3) * (corner[0] + corner[1] + corner[2]);
    double reach = 0;
    for (const Point3& p : corner) reach = std::max(reach, distance_between(center, p));
    const double least = plain_nearest(balls, center).way;
    lo = std::max(lo, least);
    if (least + reach + kRounding > lo) heap.push({corner, least + reach + kRounding});
  };
  for (const SolidTriangle& t : solid.triangle)
    add({solid.point[t.vertex[0]], solid.point[t.vertex[1]], solid.point[t.vertex[2]]});
  const double tolerance = options.tolerance * diameter(bounds_of(solid.point));
  for (std::size_t n = 0; n < options.most_pieces && !heap.empty(); ++n) {
    if (heap.top().hi <= lo + tolerance) break;
    const auto [a, b, c] = heap.top().corner;
    heap.pop();
    const Point3 ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Triangle& part :
         {Triangle{a, ab, ca}, Triangle{ab, b, bc}, Triangle{ca, bc, c}, Triangle{ab, bc, ca}})
      add(part);
  }
  error.boundary_to_union_lo = frame.length_to_model(lo);
  error.boundary_to_union_hi =
      frame.length_to_model(heap.empty() ? lo : std::max(lo, heap.top().hi));

  const SiteTree boundary(solid);
  const std::size_t each = std::clamp<std::size_t>(options.samples / balls.size(), 8, 2000);
  double most = 0;
  for (std::uint32_t b = 0; b < balls.size(); ++b) {
    for (std::size_t k = 0; balls[b].radius > 0 && k < each; ++k) {
      const double z = 1 - (2 * static_cast<double>(k) + 1) / static_cast<double>(each);
      const double angle = static_cast<double>(k) * std::numbers::pi * (3 - std::sqrt(5.0));
      const double r = std::sqrt(1 - z * z);
      const Point3 on_sphere = {r * std::cos(angle), r * std::sin(angle), z};
      const Point3 x = balls[b].center + balls[b].radius * on_sphere;
      if (plain_any_nearer_than(balls, x, -kRounding, b) != BallTree::kNone) continue;
      ++error.border_samples;
      most = std::max(most, std::sqrt(boundary.squared_distance(x).lo));
    }
  }
  error.union_to_boundary_sampled = frame.length_to_model(most);
  return error;
}

}  // namespace blum::test
