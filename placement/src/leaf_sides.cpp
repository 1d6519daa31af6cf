#include "blum/placement/leaf_sides.hpp"

#include <algorithm>
#include <bit>

namespace blum {

LeafSides::LeafSides(const SiteGeometry& geometry, const Leaf& leaf)
    : box_(leaf.box), candidates_(leaf.candidates), groups_(geometry, leaf) {}

std::vector<SiteGroup> LeafSides::sides_of(std::span<const SiteId> governors) const {
  std::vector<GroupSet> known;
  std::vector<SiteGroup> sides;
  for (const SiteId g : governors) {
    const GroupSet group = groups_.of(g);
    SiteGroup side{g};
    if (std::has_single_bit(group)) {
      if (std::find(known.begin(), known.end(), group) != known.end()) continue;
      known.push_back(group);
      side.clear();
      for (const SiteId s : candidates_)
        if (groups_.of(s) == group) side.push_back(s);
      if (side.empty()) side.push_back(g);
    }
    if (std::find(sides.begin(), sides.end(), side) == sides.end()) sides.push_back(side);
  }
  if (sides.size() == 1 && governors.size() > 1) {
    // The axis has both its sides in one piece, which goes on around it.
    sides.clear();
    for (const SiteId g : governors) sides.push_back({g});
  }
  return sides;
}

}  // namespace blum
