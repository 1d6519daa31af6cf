/// Balls by where they are: which is nearest to a point, and does one hold it?
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "blum/kernel/point.hpp"

namespace blum {

/// Working units.
struct WorkingBall {
  Point3 center;
  double radius = 0;
};

/// What stands for the distance from a ball: negative inside.
[[nodiscard]] double way_to(const WorkingBall& ball, const Point3& p);

/// A hierarchy of boxes about centres, each with the largest radius in it. Answers are those of a
/// look at every ball, to the last bit: nodes are passed over with room for their own rounding.
/// Cheap only to query, from many threads if need be.
class BallTree {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// Balls of finite centres and radii, of absolute values at most 4 (for the roundings).
  explicit BallTree(std::vector<WorkingBall> balls);

  [[nodiscard]] std::span<const WorkingBall> balls() const { return ball_; }

  struct Nearest {
    double way = std::numeric_limits<double>::infinity();
    std::uint32_t ball = kNone;  ///< any of those at that way
  };
  /// Least way_to of all balls; none if there are none. `guess`, a ball that may be near, saves
  /// time.
  [[nodiscard]] Nearest nearest(const Point3& p, std::uint32_t guess = kNone) const;

  /// Some ball other than `except` to which the way is less than `most`; kNone: there is none.
  [[nodiscard]] std::uint32_t any_nearer_than(const Point3& p, double most, std::uint32_t except,
                                              std::uint32_t guess = kNone) const;

 private:
  struct Node {
    Box3 box;                          ///< of centres
    double radius = 0;                 ///< the largest
    std::uint32_t begin = 0, end = 0;  ///< in item_
    std::uint32_t right = 0;           ///< 0: a leaf; the left child is the next node
  };
  std::uint32_t build(std::uint32_t begin, std::uint32_t end);
  [[nodiscard]] static double least_way(const Node& node, const Point3& p);

  std::vector<WorkingBall> ball_;
  std::vector<std::uint32_t> item_;
  std::vector<Node> node_;
};

}  // namespace blum
