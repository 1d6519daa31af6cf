/// The conditions of the theorems that accept a part of a face.
#pragma once

#include "face.hpp"

namespace blum::verify {

/// A part with the sites that may govern it.
struct Part {
  const Exclusion& exclusion;
  Box3 box;  ///< flat on `axis`
  int axis = 0;
  std::vector<Site> sites;
};

/// Theorem D', D'': does the group of each site gain along the direction that is claimed for it?
void check_directions(const Part& part, const Groups& groups, const SharedFeet& feet,
                      const Claim& claim);

/// Theorem D', chords. `runs`: of each circle, the groups of its intervals.
void check_chords(const Part& part, const Groups& groups, const SharedFeet& feet,
                  std::span<const std::vector<std::uint32_t>> runs, const Claim& claim);

/// Theorem G: all sites have the corner v, which is not in the plane, and feet on their cones stay
/// in them.
void check_cone(const Part& part, std::uint32_t v);

/// The rim of two edges at v pierces the part, and all sites are constant along it.
void check_rim(const Part& part, std::uint32_t v, const std::array<std::uint32_t, 2>& edge);

}  // namespace blum::verify
