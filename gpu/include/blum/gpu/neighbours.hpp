/// Borders of the discrete Voronoi regions, and which regions are neighbours.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "blum/gpu/field.hpp"

namespace blum {

/// Two ids, the lower first.
using SitePair = std::array<std::uint32_t, 2>;

/// Voxels one of whose 26 neighbours belongs to another site, in increasing order. Voxels beyond
/// the band count as belonging to none. Source: HAVOC section 4.4 (full scan).
[[nodiscard]] std::vector<std::size_t> boundary_voxels(const DistanceField& field);

/// Pairs of sites that own 26-neighbours, sorted, each once; kNoSite is in no pair. What the
/// samples show: pairs can be missing, and, by at most a voxel, wrong.
[[nodiscard]] std::vector<SitePair> neighbour_pairs(const DistanceField& field);

struct BoundaryWalk {
  std::vector<std::size_t> boundary;  ///< boundary voxels reached, in increasing order
  std::vector<SitePair> pairs;        ///< seen on the way, sorted, each once
  std::size_t visited = 0;            ///< voxels looked at
};

/// The same by continuation: from the seeds on over 26-neighbours, as long as these are boundary
/// voxels. Finds the connected parts of the boundary that the seeds lie on or beside, and no other.
/// Source: HAVOC section 4.4.
[[nodiscard]] BoundaryWalk walk_boundary(const DistanceField& field,
                                         std::span<const std::size_t> seeds);

/// A superset of the pairs of sites whose true, continuous Voronoi regions meet in the box of the
/// grid's voxels: sorted, each once. For every such pair there is a point x at distance d(x) from
/// both; the sample s nearest to x is at most h, half a voxel's diagonal, away; so
/// d(s, a) <= d(x) + h <= d(s) + 2h, and the same for b. The superset is made of all pairs of sites
/// within d(s) + 2h of a common sample s (plus rounding). HAVOC section 7.2 assumes instead that a
/// sample whose neighbours agree is right, which curved boundaries break.
/// Sites are closed, so an edge is a neighbour of its ends and sides. Errors (kBadArgument): a bad
/// grid, threads < 1.
[[nodiscard]] Result<std::vector<SitePair>> neighbour_superset(const SiteSet& sites,
                                                               const VoxelGrid& grid, int threads);

}  // namespace blum
