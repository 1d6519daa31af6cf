/// Which sites meet which face along sheets of a medial axis.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "blum/kernel/site.hpp"
#include "blum/medial/medial_axis.hpp"

namespace blum::detail {

class Partners {
 public:
  Partners(const Solid& solid, const MedialResult& axis);

  /// Sites that have a sheet with the face, or are near one of its junctions; sorted.
  [[nodiscard]] const std::vector<SiteId>& of(std::uint32_t face) const { return partner_[face]; }

  /// The sheet between the face's facet and the site, or its facet, that is nearest to x (model
  /// units); -1 if none is.
  [[nodiscard]] std::int32_t sheet(std::uint32_t face, SiteId site, const Point3& x) const;

 private:
  using Key = std::uint32_t;
  /// The same for all that lies inside one facet: how that is cut into triangles means nothing.
  [[nodiscard]] Key key(SiteId site) const;

  const Solid& solid_;
  const MedialResult& axis_;
  SiteIndex sites_;
  std::vector<std::vector<SiteId>> partner_;
  /// Triangles of the complex between two facets or sites.
  struct Between {
    std::vector<std::uint32_t> triangle;
    bool one_sheet = true;  ///< the usual case
  };
  std::map<std::pair<Key, Key>, Between> between_;
};

}  // namespace blum::detail
