#include "ball_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "blum/kernel/point_algebra.hpp"

namespace blum {
namespace {

constexpr std::uint32_t kLeafSize = 6;
/// More than distances and differences of numbers of at most 4 are rounded by.
constexpr double kRoundings = 1e-14;
/// Halving 2^32 balls takes 32 levels, with one node waiting at each.
constexpr std::size_t kDeepest = 64;

}  // namespace

double way_to(const WorkingBall& ball, const Point3& p) {
  return distance_between(p, ball.center) - ball.radius;
}

BallTree::BallTree(std::vector<WorkingBall> balls) : ball_(std::move(balls)), item_(ball_.size()) {
  std::iota(item_.begin(), item_.end(), 0U);
  node_.reserve(ball_.size());
  if (!ball_.empty()) build(0, static_cast<std::uint32_t>(ball_.size()));
}

std::uint32_t BallTree::build(std::uint32_t begin, std::uint32_t end) {
  const auto index = static_cast<std::uint32_t>(node_.size());
  node_.emplace_back();
  Node node;
  node.begin = begin;
  node.end = end;
  node.box = {ball_[item_[begin]].center, ball_[item_[begin]].center};
  for (std::uint32_t i = begin; i < end; ++i) {
    const WorkingBall& b = ball_[item_[i]];
    node.radius = std::max(node.radius, b.radius);
    for (int k = 0; k < 3; ++k) {
      node.box.lo[k] = std::min(node.box.lo[k], b.center[k]);
      node.box.hi[k] = std::max(node.box.hi[k], b.center[k]);
    }
  }
  if (end - begin > kLeafSize) {
    int axis = 0;
    for (int k = 1; k < 3; ++k)
      if (node.box.hi[k] - node.box.lo[k] > node.box.hi[axis] - node.box.lo[axis]) axis = k;
    const std::uint32_t half = begin + (end - begin) / 2;
    std::nth_element(item_.begin() + begin, item_.begin() + half, item_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       const double x = ball_[a].center[axis], y = ball_[b].center[axis];
                       return x != y ? x < y : a < b;
                     });
    build(begin, half);
    node.right = build(half, end);
  }
  node_[index] = node;
  return index;
}

double BallTree::least_way(const Node& node, const Point3& p) {
  Point3 off;
  for (int k = 0; k < 3; ++k)
    off[k] = std::max({0.0, node.box.lo[k] - p[k], p[k] - node.box.hi[k]});
  return length(off) - node.radius - kRoundings;
}

BallTree::Nearest BallTree::nearest(const Point3& p, std::uint32_t guess) const {
  Nearest best;
  if (guess != kNone) best = {way_to(ball_[guess], p), guess};
  if (node_.empty()) return best;
  struct Waiting {
    double way;
    std::uint32_t node;
  };
  std::array<Waiting, kDeepest> stack;
  std::size_t top = 0;
  stack[top++] = {least_way(node_[0], p), 0};
  while (top > 0) {
    const Waiting next = stack[--top];
    if (next.way > best.way) continue;
    const Node& node = node_[next.node];
    if (node.right == 0) {
      for (std::uint32_t i = node.begin; i < node.end; ++i)
        if (const double way = way_to(ball_[item_[i]], p); way < best.way) best = {way, item_[i]};
      continue;
    }
    Waiting left = {least_way(node_[next.node + 1], p), next.node + 1},
            right = {least_way(node_[node.right], p), node.right};
    if (left.way < right.way) std::swap(left, right);
    stack[top++] = left;
    stack[top++] = right;  // the nearer one first
  }
  return best;
}

std::uint32_t BallTree::any_nearer_than(const Point3& p, double most, std::uint32_t except,
                                        std::uint32_t guess) const {
  const auto is_one = [&](std::uint32_t b) { return b != except && way_to(ball_[b], p) < most; };
  if (guess != kNone && is_one(guess)) return guess;
  if (node_.empty()) return kNone;
  std::array<std::uint32_t, kDeepest> stack;
  std::size_t top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const std::uint32_t index = stack[--top];
    const Node& node = node_[index];
    if (least_way(node, p) >= most) continue;
    if (node.right == 0) {
      for (std::uint32_t i = node.begin; i < node.end; ++i)
        if (is_one(item_[i])) return item_[i];
      continue;
    }
    stack[top++] = node.right;
    stack[top++] = index + 1;
  }
  return kNone;
}

}  // namespace blum
