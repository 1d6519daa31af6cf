/// A certified upper bound on the distance from a point to the medial axis (docs/proofs.md, "Distance
/// from the axis").
#pragma once

#include <optional>

#include "blum/kernel/inside.hpp"
#include "blum/kernel/site_tree.hpp"
#include "blum/placement/leaf_sides.hpp"

namespace blum {

class AxisDistance {
 public:
  AxisDistance(const SiteGeometry& geometry, const SiteTree& tree, const InsideOracle& inside)
      : geometry_(geometry), tree_(tree), inside_(inside) {}

  /// The axis has a point within the returned distance of p (working units, all roundings
  /// included); nullopt: none was found where the sides `a` and `b` tie. The sides only say where
  /// to look.
  [[nodiscard]] std::optional<double> at_most(const Point3& p, const SiteGroup& a, const SiteGroup& b) const;

 private:
  /// Does the axis meet the segment pq?
  [[nodiscard]] bool parts(const Point3& p, const Point3& q) const;
  struct Feet {
    Point3 center;
    double radius = 0;    ///< of a ball that holds all feet of the point
    double distance = 0;  ///< of the point from the boundary, at least
  };
  [[nodiscard]] Feet feet(const Point3& p) const;

  const SiteGeometry& geometry_;
  const SiteTree& tree_;
  const InsideOracle& inside_;
};

}  // namespace blum
