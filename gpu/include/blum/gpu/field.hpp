/// The discrete Voronoi diagram and distance field of a set of sites, with a bound on every voxel.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "blum/gpu/grid.hpp"
#include "blum/gpu/site_set.hpp"
#include "blum/kernel/point.hpp"
#include "blum/kernel/result.hpp"

namespace blum {

enum class FieldBackend : std::uint8_t {
  kCpu,    ///< scan conversion in double, culled by blocks: the default and the reference
  kBrute,  ///< all sites for all samples, certified bounds alone: the twin that tests compare with
};
[[nodiscard]] const char* field_backend_name(FieldBackend backend);

/// What the CPU backend leaves out early. None of it changes the field; each can be switched off.
struct FieldCulling {
  bool blocks = true;   ///< sites too far from a block of samples, hierarchically
  bool domains = true;  ///< samples that a neighbour of the site is nearer to for certain
};

struct FieldOptions {
  FieldBackend backend = FieldBackend::kCpu;
  /// Samples farther than this from every site are left without site (model units).
  double band = std::numeric_limits<double>::infinity();
  int threads = 1;  ///< the field does not depend on it, bit by bit
  FieldCulling culling;
  /// Called from any thread with the part done, in [0, 1]; false stops the computation.
  std::function<bool(double)> on_progress;
};

/// What compute_field refuses of the options; empty if nothing.
[[nodiscard]] std::string options_problem(const FieldOptions& options);

/// An enclosure of a distance (model units).
struct DistanceInterval {
  double lo = 0, hi = 0;
};

/// The distance d of a sample to the nearest site and the stored value D satisfy
/// D - below - relative D <= d <= D + above + relative D. Derived in docs/fields.md.
struct FieldBound {
  double below = 0, above = 0, relative = 0;
};

/// Work done, as section 2.13 of the thesis counts it (CPU backend; zeros from others).
struct FieldStatistics {
  std::uint64_t blocks = 0;       ///< of at most 8 x 8 x 8 samples
  std::uint64_t block_sites = 0;  ///< sites processed, summed over the blocks
  std::uint64_t owner_sites = 0;  ///< of these, sites that own a sample of the block
  std::uint64_t fragments = 0;    ///< pairs of a sample and a site whose distance was evaluated
  std::uint64_t tree_tests = 0;   ///< tests of a site against a node of the block hierarchy
  FieldStatistics& operator+=(const FieldStatistics& o);
};

struct DistanceField {
  VoxelGrid grid;
  std::vector<std::uint32_t> site;  ///< SiteId::value by voxel; kNoSite.value beyond the band
  std::vector<double> distance;     ///< by voxel; infinity beyond the band
  double band = std::numeric_limits<double>::infinity();
  FieldBound bound;
  FieldBackend backend = FieldBackend::kCpu;
  FieldStatistics statistics;

  [[nodiscard]] SiteId site_at(std::size_t voxel) const { return {site[voxel]}; }
  /// Certified to hold the exact distance from the sample to the nearest site; the distance to
  /// site_at(voxel) lies in it, too. Beyond the band: [about band, infinity].
  [[nodiscard]] DistanceInterval interval(std::size_t voxel) const;
};

/// Requires: sites within the box [-2^200, 2^200]^3 (SiteSet::build sees to it).
/// Errors: kBadArgument (a bad grid, a band that is negative or NaN, threads < 1), kInterrupted.
///
/// The owner of a sample is the site with the least *computed* distance, the lowest id among those
/// with equal ones: a site whose certified interval lies above another's never owns it.
[[nodiscard]] Result<DistanceField> compute_field(const SiteSet& sites, const VoxelGrid& grid,
                                                  const FieldOptions& options);

/// The point of site_at(voxel) nearest to the sample, rounded. Requires: the voxel has a site.
[[nodiscard]] Point3 foot_at(const SiteSet& sites, const DistanceField& field, std::size_t voxel);

/// About how many bytes compute_field needs at its peak, beside the SiteSet: 12 a voxel, and what
/// 300,000 sites were measured to take, in proportion.
[[nodiscard]] std::uint64_t field_memory_bytes(const SiteSet& sites, const VoxelGrid& grid,
                                               const FieldOptions& options);

}  // namespace blum
