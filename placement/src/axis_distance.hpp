/// A certified upper bound on the distance from a point to the medial axis (docs/proofs.md,
/// "Distance from the axis").
#pragma once

#include <optional>

#include "blum/arrangement/production_engine.hpp"
#include "blum/kernel/inside.hpp"
#include "blum/kernel/site_tree.hpp"
#include "blum/placement/leaf_sides.hpp"

namespace blum {

class AxisDistance {
 public:
  AxisDistance(const SiteGeometry& geometry, ProductionEngine& engine, const SiteTree& tree,
               const InsideOracle& inside)
      : geometry_(geometry), engine_(engine), tree_(tree), inside_(inside) {}

  /// The axis has a point within the returned distance of p (working units, all roundings
  /// included); nullopt: none was found where the sides `a` and `b` tie. The sides only say where
  /// to look.
  [[nodiscard]] std::optional<double> at_most(const Point3& p, const SiteGroup& a,
                                              const SiteGroup& b) const;

  /// Has the axis a point within `most` of p? Asks for the feet of p and of some points about it,
  /// whatever sheets are there: the cheapest answer. False: not shown.
  [[nodiscard]] bool is_within(const Point3& p, double most) const;

  /// The same as `at_most` for a point in the leaf, up to `most`, where the feet of two faces are
  /// so near to each other that only exact governors tell the sides: sheets of tiny angle.
  [[nodiscard]] std::optional<double> exactly_at_most(const Point3& p, const SiteGroup& a,
                                                      const SiteGroup& b, const LeafSides& leaf,
                                                      double most) const;

 private:
  /// The second lemma. Both points are in the leaf.
  [[nodiscard]] bool exactly_parts(const Point3& p, const Point3& q, const SiteGroup& a,
                                   const SiteGroup& b, const LeafSides& leaf) const;
  /// May one point be the foot on both sites of a point within `reach` of p?
  [[nodiscard]] bool may_share_foot(SiteId s, SiteId t, const Point3& p, double reach) const;
  /// Does the axis meet the segment pq?
  [[nodiscard]] bool parts(const Point3& p, const Point3& q) const;
  struct Feet {
    Point3 center;
    double radius = 0;    ///< of a ball that holds all feet of the point
    double distance = 0;  ///< of the point from the boundary, at least
  };
  [[nodiscard]] Feet feet(const Point3& p) const;
  /// Does the axis meet the ray from the point with these feet, away from them, up to `reach`?
  [[nodiscard]] bool ends_ahead(const Point3& p, const Feet& at_p, double reach) const;
  /// Does it meet a segment between points of the circle about p, across the same ray?
  [[nodiscard]] bool parts_around(const Point3& p, const Feet& at_p, const Point3& ray,
                                  double radius) const;

  const SiteGeometry& geometry_;
  ProductionEngine& engine_;
  const SiteTree& tree_;
  const InsideOracle& inside_;
};

}  // namespace blum
