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
  kCpu,     ///< scan conversion in double, culled by blocks: the default and the reference
  kBrute,   ///< all sites for all samples, certified bounds alone: the twin that tests compare with
  kEgl,     ///< OpenGL through EGL: a device's driver, or the surfaceless platform's
  kOsmesa,  ///< OpenGL through OSMesa: Mesa's renderers without hardware
};
[[nodiscard]] const char* field_backend_name(FieldBackend backend);
[[nodiscard]] inline bool is_opengl(FieldBackend backend) {
  return backend == FieldBackend::kEgl || backend == FieldBackend::kOsmesa;
}

/// How the OpenGL backends find the sites that they propose.
enum class FieldMethod : std::uint8_t {
  /// Domain polygons rasterized slice by slice, the distance evaluated for every fragment.
  kFragments,
  /// A compute shader (OpenGL 4.3): every sample of a block looks at the block's sites.
  kGather,
  /// HAVOC: meshes of planes over the slice, at most `mesh_error` above the distance.
  kDistanceMeshes,
  /// DiFi: the distance vector is linear over a domain polygon.
  kLinearFactorization,
};
[[nodiscard]] const char* field_method_name(FieldMethod method);

/// What is left out early. None of it loses the owner of a sample; each can be switched alone.
struct FieldCulling {
  bool blocks = true;   ///< sites too far from a block of samples, hierarchically
  bool domains = true;  ///< samples that a neighbour of the site is nearer to for certain
  /// Thesis 2.7: two sweeps over the slices; a site that an occlusion query finds hidden behind
  /// others is not drawn again. OpenGL, any method that draws; instead of `blocks`.
  bool sweep = false;
  /// Thesis 2.8: draws no farther from a site than the last slice's greatest distance and a step.
  /// Only with `sweep`.
  bool clamping = false;
  /// Thesis 2.9: the same for tiles of a slice along all axes. OpenGL, any method that draws;
  /// instead of `blocks` and `sweep`.
  bool ranges = false;
};

struct FieldOptions {
  FieldBackend backend = FieldBackend::kCpu;
  /// Samples farther than this from every site are left without site (model units).
  double band = std::numeric_limits<double>::infinity();
  int threads = 1;  ///< the field does not depend on it, bit by bit
  FieldCulling culling;
  FieldMethod method = FieldMethod::kFragments;  ///< of the OpenGL backends
  /// Of distance meshes, in units of the smallest spacing; 1e-3 to 1e3. Meshes are no finer than
  /// 2^-24 of the 1-norm diameter of samples and sites, below which floats round as much anyway.
  double mesh_error = 0.5;
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
///
/// `regret`: the stored site is at most that much farther than the nearest one, up to the rounding
/// that `relative` covers. The CPU's backends: below + above. OpenGL: part of `below`, and it holds
/// for any driver that computes and rasterizes as the specification says. Nothing else rests on the
/// driver but what follows from `below`: that samples without a site lie beyond a finite band,
/// lower ends of intervals, and the sides that `sides_of` takes from these instead of the exact
/// test.
struct FieldBound {
  double below = 0, above = 0, relative = 0, regret = 0;
};

/// Work done, as section 2.13 of the thesis counts it (zeros from the brute-force backend).
/// Parts are blocks of at most 8 x 8 x 8 samples (CPU, gather), a slice of a tile of at most
/// 32 x 32 samples (OpenGL, and with `ranges`; a whole slice without `blocks`) or a slice (`sweep`,
/// both directions counted).
struct FieldStatistics {
  std::uint64_t blocks = 0;  ///< parts
  /// Sites processed, summed over the parts; where polygons are drawn: sites with a polygon there.
  std::uint64_t block_sites = 0;
  std::uint64_t owner_sites = 0;  ///< of these, sites that own a sample of the part
  /// Pairs of a sample and a site whose distance was evaluated; where polygons are drawn: the area
  /// of these polygons in pixels.
  std::uint64_t fragments = 0;
  std::uint64_t tree_tests = 0;  ///< tests of a site against a node of the block hierarchy
  std::uint64_t queries = 0;     ///< occlusion queries
  std::uint64_t holes = 0;       ///< samples that the driver proposed no site for: done anew
  FieldStatistics& operator+=(const FieldStatistics& o);
};
/// Thesis 2.13: sites that own samples of a part, of the sites processed for it.
[[nodiscard]] double culling_efficiency(const FieldStatistics& statistics);
/// Thesis 2.13: samples a site owns, on average, by samples a site is evaluated at.
[[nodiscard]] double clamping_efficiency(const FieldStatistics& statistics, std::size_t voxels);

/// An OpenGL driver, as it describes itself.
struct FieldDriver {
  std::string renderer, version;
  int major = 0, minor = 0;
  bool is_hardware = false;
};
/// Errors (kBadArgument): no such library or driver; the message says which package brings it.
[[nodiscard]] Result<FieldDriver> field_driver(FieldBackend backend);

struct BackendChoice {
  FieldBackend backend = FieldBackend::kCpu;
  std::string reason;
};
/// EGL where it has a driver for hardware, else the CPU. For fields whose sides matter take the
/// CPU: FieldBound says what rests on a driver.
[[nodiscard]] BackendChoice choose_backend();

struct DistanceField {
  VoxelGrid grid;
  std::vector<std::uint32_t> site;  ///< SiteId::value by voxel; kNoSite.value beyond the band
  std::vector<double> distance;     ///< by voxel; infinity beyond the band
  double band = std::numeric_limits<double>::infinity();
  FieldBound bound;
  FieldBackend backend = FieldBackend::kCpu;
  FieldStatistics statistics;

  [[nodiscard]] SiteId site_at(std::size_t voxel) const { return {site[voxel]}; }
  /// Certified to hold the exact distance from the sample to the nearest site (`lo` of an OpenGL
  /// backend if its driver is right: FieldBound); the distance to site_at(voxel) lies in it, too.
  /// Beyond the band: [about band, infinity].
  [[nodiscard]] DistanceInterval interval(std::size_t voxel) const;
};

/// Requires: sites within the box [-2^200, 2^200]^3 (SiteSet::build sees to it).
/// Errors: kBadArgument (a bad grid, a band that is negative or NaN, threads < 1; OpenGL: no
/// driver, a grid too large for it, or too many samples without a proposal), kInterrupted.
///
/// The owner of a sample is the site with the least *computed* distance, the lowest id among those
/// with equal ones: a site whose certified interval lies above another's never owns it. OpenGL
/// backends only propose owners: their distances are computed in double, and differ from the
/// nearest by bound.regret at most.
[[nodiscard]] Result<DistanceField> compute_field(const SiteSet& sites, const VoxelGrid& grid,
                                                  const FieldOptions& options);

/// The point of site_at(voxel) nearest to the sample, rounded. Requires: the voxel has a site.
[[nodiscard]] Point3 foot_at(const SiteSet& sites, const DistanceField& field, std::size_t voxel);

/// About how many bytes compute_field needs at its peak, beside the SiteSet and a driver's own: 12
/// a voxel (OpenGL: 16), and what 300,000 sites were measured to take, in proportion.
[[nodiscard]] std::uint64_t field_memory_bytes(const SiteSet& sites, const VoxelGrid& grid,
                                               const FieldOptions& options);

}  // namespace blum
