/// Partitions of the sites that may govern a box (docs/proofs.md, Theorem D' and D'').
#pragma once

#include "exclusion.hpp"

namespace blum::verify {

struct Groups {
  std::vector<std::uint32_t> of;  ///< by position in the list of sites
  std::uint32_t count = 0;
  bool cliques = false;  ///< all pairs of a group never tie essentially (Lemma 1)

  [[nodiscard]] std::uint32_t find(std::span<const Site> sites,
                                   Site s) const;  ///< count: not there
};

/// The feet that sites of a list, which holds all governors of box ∩ O, may share there.
class SharedFeet {
 public:
  SharedFeet(const Exclusion& exclusion, std::span<const Site> sites, const Box3& box)
      : exclusion_(exclusion), sites_(sites), box_(box) {}

  /// May vertex v be the foot of a point of box ∩ O?
  [[nodiscard]] bool vertex(std::uint32_t v) const;
  /// May the open edge between v and p hold such a foot? True where they are not joined.
  [[nodiscard]] bool edge(std::uint32_t v, std::uint32_t p) const;
  [[nodiscard]] bool shared(Site a, Site b) const;
  [[nodiscard]] const Box3& box() const { return box_; }

 private:
  [[nodiscard]] bool listed(Site s) const;
  const Exclusion& exclusion_;
  std::span<const Site> sites_;
  Box3 box_;
};

[[nodiscard]] std::vector<std::uint32_t> common_corners(const Shape& shape, Site a, Site b);

/// Cliques are of sites that do not tie essentially in the box.
[[nodiscard]] Groups groups_by_ties(const Sites& sites, std::span<const Site> list,
                                    const Box3& box);
[[nodiscard]] Groups groups_by_feet(const Sites& sites, std::span<const Site> list,
                                    const SharedFeet& feet);

}  // namespace blum::verify
