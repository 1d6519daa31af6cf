/// Partitions of the sites that may govern a box, and which of two sites gains on the other along a
/// direction (docs/proofs.md, Theorem D', D'', "Depth", "Two edges at a vertex", "Halves").
#pragma once

#include <map>

#include "exclusion.hpp"

namespace blum::verify {

struct Groups {
  std::vector<std::uint32_t> of;  ///< by position in the list of sites
  std::uint32_t count = 0;
  bool cliques = false;  ///< all pairs of a group never tie essentially in the box

  /// count: not there.
  [[nodiscard]] std::uint32_t find(std::span<const Site> sites, Site s) const;
};

/// The feet that sites of a list, which holds all governors of box ∩ O, may share there.
class SharedFeet {
 public:
  SharedFeet(const Exclusion& exclusion, std::span<const Site> sites, const Box3& box)
      : exclusion_(exclusion), shape_(exclusion.sites().shape()), sites_(sites), box_(box) {}

  /// May vertex v be the foot of a point of box ∩ O?
  [[nodiscard]] bool vertex(std::uint32_t v) const;
  /// May the open edge between v and p hold such a foot? True where they are not joined.
  [[nodiscard]] bool edge(std::uint32_t v, std::uint32_t p) const;
  [[nodiscard]] bool shared(Site a, Site b) const;
  [[nodiscard]] const Box3& box() const { return box_; }

 private:
  [[nodiscard]] bool listed(Site s) const { return std::ranges::find(sites_, s) != sites_.end(); }
  const Exclusion& exclusion_;
  const Shape& shape_;
  std::span<const Site> sites_;
  Box3 box_;
  mutable std::map<std::uint32_t, bool> in_cone_;  ///< by vertex asked for: may the box meet it?
};

[[nodiscard]] Groups groups_by_ties(const Sites& sites, std::span<const Site> list,
                                    const Box3& box);
[[nodiscard]] Groups groups_by_feet(const Sites& sites, std::span<const Site> list,
                                    const SharedFeet& feet);

/// Does a gain on b along w, wherever in the box both govern? `feet`: of a list of sites that holds
/// all governors of box ∩ O.
[[nodiscard]] bool gains(const Exclusion& exclusion, const Box3& box, const SharedFeet& feet,
                         Site a, Site b, const Exact& w);

/// False: no point of box ∩ O has both for governors with different feet. Sites of two groups that
/// never tie essentially govern no point together (Lemma 1).
[[nodiscard]] bool may_both_govern(const Exclusion& exclusion, const Box3& box, Site a, Site b);

/// Does a gain on b along w, or may they not both govern, on the box or on all of its halves and
/// their halves? `w` missing: may they not both govern? Looks at `looks` boxes at most.
[[nodiscard]] bool gains_where_both_govern(const Exclusion& exclusion, const Box3& box,
                                           const SharedFeet& feet, Site a, Site b,
                                           const std::optional<Exact>& w, int& looks);

/// "Two edges at a vertex": a reason against that. False for other sites.
[[nodiscard]] bool never_tie_from_vertex(const Shape& shape, const Box3& box, Site a, Site b);

}  // namespace blum::verify
