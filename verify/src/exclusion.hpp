/// Sites that govern nothing in a box, and pairs that do not tie there: bounds by balls, on halves
/// of the box where the whole does not suffice.
#pragma once

#include "sites.hpp"

namespace blum::verify {

/// Across the longest side; nullopt: no number is left between its ends.
[[nodiscard]] std::optional<std::array<Box3, 2>> halved(const Box3& box);

class Exclusion {
 public:
  explicit Exclusion(const Sites& sites);

  /// Of `sites` those of which it is not certain that they govern no point of box ∩ O. `against`:
  /// sites whose distances are bounds; `triangles`: all that meet the box. Halves the box where
  /// needed, and looks at `most` boxes a site at most.
  [[nodiscard]] std::vector<Site> may_govern(std::span<const Site> sites, const Box3& box,
                                             std::span<const Site> against,
                                             std::span<const std::uint32_t> triangles,
                                             int most = 2000) const;
  /// A vertex whose polar cone misses the box, which is flat: it governs nothing there.
  [[nodiscard]] bool outside_polar_cone(Site s, const Box3& box) const;
  /// Those of `candidates` that may govern a point of box ∩ O, by one look at the whole box.
  [[nodiscard]] std::vector<Site> remaining(std::span<const Site> candidates,
                                            const Box3& box) const;
  /// Is it certain that no point of box ∩ O is governed by both?
  [[nodiscard]] bool never_tie(Site a, Site b, const Box3& box) const;
  /// Three faces: is b certain to be nearer wherever in box ∩ O both a and c govern? Then nowhere.
  [[nodiscard]] bool nearer_at_ties(Site b, Site a, Site c, const Box3& box) const;

  [[nodiscard]] const Sites& sites() const { return sites_; }

  /// Unit outer normal of a triangle.
  [[nodiscard]] const BallVector& unit(std::uint32_t t) const { return unit_[t]; }

 private:
  struct View;  // of a box: its centre, a foot of that, sites that cover it
  [[nodiscard]] View view(const Box3& box, std::span<const Site> against) const;
  /// d_a > d_b (carriers) wherever a governs, and b too if `inside_b`; that a governs nothing
  /// follows only if b covers the box, and not from `inside_b`.
  [[nodiscard]] bool farther(Site a, Site b, const Box3& box, bool inside_b) const;
  [[nodiscard]] bool behind_foot(Site s, const Box3& box, const View& view) const;
  [[nodiscard]] bool gone(Site s, const Box3& box, const View& view) const;
  struct Piece;  // what all sites have in common there
  [[nodiscard]] bool governs_nothing(Site s, Piece& piece, std::span<const std::uint32_t> triangles,
                                     int& looks) const;

  const Sites& sites_;
  std::vector<BallVector> unit_;
};

}  // namespace blum::verify
