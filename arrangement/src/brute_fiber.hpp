/// One vertical line s = alpha through a setting: its points on curves, in exact order, and the
/// exact signs of all functions at these points and between them.
///
/// Positions on the line are numbered: point k has position 2k + 1, the open interval below it 2k,
/// the one above it 2k + 2.
#pragma once

#include <vector>

#include "brute_setting.hpp"

namespace blum::brute {

/// What holds at a position.
struct Place {
  bool within = false;        ///< in the closed rectangle or segment
  unsigned sides = 0;         ///< bit k: on limit k
  std::vector<int> triangle;  ///< indices in Setting::triangle of those that contain it
  std::vector<int> governor;  ///< indices in Setting::site
};

class Fiber {
 public:
  struct Branch {
    int curve = 0;
    int branch = 0;  ///< 0: the lower or only root, 1: the upper one
  };

  Fiber(const Setting& setting, Algebraic s);

  [[nodiscard]] int points() const { return static_cast<int>(point_.size()); }
  /// Curves through a point.
  [[nodiscard]] const std::vector<Branch>& point(int k) const { return point_[at(k)].on; }
  /// The point where a branch of a curve meets the line; a double root is both branches.
  /// Requires: there is one.
  [[nodiscard]] int point_of(int curve, int branch) const;
  /// Encloses the v coordinate of a point.
  [[nodiscard]] const Real& value(int k) const { return point_[at(k)].value; }
  [[nodiscard]] const Algebraic& abscissa() const { return s_; }
  [[nodiscard]] slong precision() const { return precision_; }

  [[nodiscard]] int sign(const Function& f, int position) const;
  [[nodiscard]] Place place(int position) const;
  /// Is g zero at point k? For any function, also one that is not of the setting. Exact.
  [[nodiscard]] bool vanishes(const Factors& g, int k) const;

 private:
  struct Point {
    std::vector<Branch> on;
    Real value;
  };
  struct Root {
    Branch on;
    Real value;
    Bound lo, hi;
  };
  enum class Equal { kNo, kYes, kUnknown };

  [[nodiscard]] static std::size_t at(int k) { return static_cast<std::size_t>(k); }
  /// Roots of a curve over s, lower first; a double root once.
  [[nodiscard]] std::vector<Real> roots(const Curve& f, slong precision) const;
  [[nodiscard]] Equal equal(const Curve& f, int branch_f, const std::vector<Real>& roots_f,
                            const Curve& g, int branch_g, const std::vector<Real>& roots_g,
                            slong precision) const;
  [[nodiscard]] bool arrange(slong precision);

  const Setting& setting_;
  Algebraic s_;
  slong precision_ = 0;
  std::vector<Point> point_;
  std::vector<std::array<int, 2>> point_of_;  ///< [curve][branch], -1: no root
};

/// Do two essentially tied governors have different feet at a point of a fiber? If not, the point
/// is on the medial axis only if it is on a rim.
[[nodiscard]] bool feet_differ(const Setting& setting, const Fiber& fiber, int point,
                               const std::vector<int>& governors);

}  // namespace blum::brute
