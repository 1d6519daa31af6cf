/// The separation angle over a part of a leaf: what may tie there, and for which part of K.
#pragma once

#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "angle_directions.hpp"
#include "blum/arrangement/production_engine.hpp"
#include "blum/medial/leaf_groups.hpp"

namespace blum {

/// Which points of the axis in a leaf are asked for.
struct AngleRole {
  enum class Kind : std::uint8_t { kArc, kSeam, kRest } kind = Kind::kArc;
  GroupSet a = 0, b = 0;  ///< kArc: the two sides; kSeam: a, the groups around the node
  bool distinct = true;   ///< kSeam: points of it have feet in three groups
};

/// A closed box (flat or not) in a leaf, with a superset of the sites that govern points of it.
struct AngleBox {
  Box3 box;
  std::vector<SiteId> candidates;
};

/// Pairs that never tie essentially, remembered. One a thread.
class TiePairs {
 public:
  explicit TiePairs(ProductionEngine& engine) : engine_(engine) {}
  [[nodiscard]] bool never(SiteId a, SiteId b);

 private:
  ProductionEngine& engine_;
  std::unordered_map<std::uint64_t, bool> never_;
};

/// Upper bound, radians, and the pair of sites it comes from.
struct AngleBound {
  double hi = 0;  ///< 0: no such point is in the box
  SiteId a{}, b{};
};

/// Lower bound of the angle at any point of the box with feet in `count` of `groups`, among them
/// all of `must`, radians; nullopt: there is none.
[[nodiscard]] std::optional<double> least_where_groups_meet(const SiteGeometry& geometry,
                                                            const LeafParts& leaf,
                                                            const AngleBox& box, GroupSet groups,
                                                            GroupSet must, int count);

/// Is a point with feet in the groups g and h and in no other certainly one that the seam counts,
/// though it has no three feet? No arc of the leaf may be between the two.
[[nodiscard]] bool seam_counts_pair(const LeafParts& leaf, const AngleRole& role, GroupSet g,
                                    GroupSet h);

[[nodiscard]] AngleBound bound_in_box(const SiteGeometry& geometry, TiePairs& pairs,
                                      const LeafParts& leaf, const AngleRole& role,
                                      const AngleBox& box);

}  // namespace blum
