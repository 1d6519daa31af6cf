/// The sites on the sides of an axis inside one leaf: what its points are equally far from.
#pragma once

#include <span>
#include <vector>

#include "blum/kernel/point.hpp"
#include "blum/kernel/site_geometry.hpp"
#include "blum/medial/leaf_groups.hpp"
#include "blum/subdivision/subdivision.hpp"

namespace blum {

/// Sites of which the nearest counts. Ties between members are not on the axis.
using SiteGroup = std::vector<SiteId>;

class LeafSides {
 public:
  LeafSides(const SiteGeometry& geometry, const Leaf& leaf);

  [[nodiscard]] const Box3& box() const { return box_; }  ///< of the leaf, working frame
  /// Superset of the governors in the leaf.
  [[nodiscard]] std::span<const SiteId> candidates() const { return candidates_; }
  /// The sides that hold the given governors, each once: the sites that govern in the same piece of
  /// the leaf minus the axis alone; a governor that may be in several pieces is a side by itself,
  /// and so is each of several that are all in one piece.
  [[nodiscard]] std::vector<SiteGroup> sides_of(std::span<const SiteId> governors) const;

 private:
  Box3 box_;
  std::vector<SiteId> candidates_;
  LeafGroups groups_;
};

}  // namespace blum
