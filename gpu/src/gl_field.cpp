#include "gl_field.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "blum/kernel/parallel.hpp"

namespace blum::detail {
namespace {

/// Distances in double of the sites that the driver names, whatever these are.
class Refinement {
 public:
  Refinement(const SiteSet& set, const FieldOptions& options, DistanceField& field)
      : set_(set), options_(options), field_(field) {}

  void take(const std::vector<std::uint32_t>& ids) {
    const VoxelGrid& grid = field_.grid;
    const std::size_t slice = std::size_t{grid.size[0]} * grid.size[1];
    for_each_in_parallel(options_.threads, grid.size[2], [&](int, std::size_t k) {
      double widest = 0;
      for (std::size_t v = k * slice; v < (k + 1) * slice; ++v) {
        // What is stored already has been offered.
        if (ids[v] != field_.site[v] && set_.is_site({ids[v]})) {
          widest = std::max(widest, offer(v, ids[v]));
        }
      }
      raise(widest);
    });
  }

  /// Does anew what nothing was proposed for; false if that is more than a driver's rounding
  /// explains.
  bool fill_holes() {
    // Beyond a band it is right that nothing is proposed.
    if (field_.band < std::numeric_limits<double>::infinity()) return true;
    std::vector<std::size_t> holes;
    for (std::size_t v = 0; v < field_.site.size(); ++v) {
      if (field_.site[v] == kNoSite.value) holes.push_back(v);
    }
    field_.statistics.holes = holes.size();
    if (holes.size() > 64 + field_.site.size() / 256) return false;
    for_each_in_parallel(options_.threads, holes.size(), [&](int, std::size_t n) {
      double widest = 0;
      for (std::uint32_t s = 0; s < set_.size(); ++s) {
        if (set_.is_site({s})) widest = std::max(widest, offer(holes[n], s));
      }
      raise(widest);
    });
    return true;
  }
  [[nodiscard]] double widest() const { return widest_; }

 private:
  /// The width of the distance's enclosure.
  double offer(std::size_t voxel, std::uint32_t id) {
    const SquaredDistanceBounds d = set_.squared_distance(field_.grid.point(voxel), {id});
    const double distance = std::sqrt(d.hi);
    double& best = field_.distance[voxel];
    if (distance <= field_.band && distance < std::numeric_limits<double>::infinity() &&
        (distance < best || (distance == best && id < field_.site[voxel]))) {
      best = distance;
      field_.site[voxel] = id;
    }
    return distance < std::numeric_limits<double>::infinity() ? distance - std::sqrt(d.lo) : 0;
  }
  void raise(double widest) {
    const std::scoped_lock lock(mutex_);
    widest_ = std::max(widest_, widest);
  }

  const SiteSet& set_;
  const FieldOptions& options_;
  DistanceField& field_;
  std::mutex mutex_;
  double widest_ = 0;
};

/// docs/fields.md, "OpenGL": what a proposed site can be farther than the nearest one.
double regret_of(const ScanSites& sites, const VoxelGrid& grid, const SliceStyle& style,
                 int subpixel_bits) {
  const double evaluation = 256 * kFloatUnit * sites.reach + sites.dropped;
  if (style.method == FieldMethod::kFragments || style.method == FieldMethod::kGather) {
    return evaluation;
  }
  const double moved =
      (style.dilation + std::ldexp(1, -subpixel_bits)) * (grid.spacing.x + grid.spacing.y);
  const double sharp = kSharpCorner * sites.reach;
  if (style.method == FieldMethod::kLinearFactorization) return evaluation + sharp + 2 * moved;
  return evaluation + sharp + 8 * moved + style.mesh_error;
}

}  // namespace

std::optional<Error> gl_field(const SiteSet& set, const FieldOptions& options,
                              DistanceField& field) {
  const auto bad = [](std::string what) {
    return Error{ErrorCode::kBadArgument, std::move(what), {}, {}};
  };
  auto made = GlContext::make(options.backend);
  if (!made) return made.error();
  GlContext& context = *made.value();
  const GlContext::Current current(context);
  if (!current) return bad("the OpenGL context cannot be made current");

  const VoxelGrid& grid = field.grid;
  const ScanSites sites =
      make_scan_sites(set, grid.sample_box(), options.culling.domains, kFloatUnit);
  const double finest = std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z});
  // Spacings may differ so much that meshes of the least one's error would have no end of cells.
  const double mesh_error = std::max(options.mesh_error * finest, kFloatUnit * sites.reach);
  GlJob job{
      sites, options,         grid, gl_frame(sites, set, grid), {options.method, mesh_error, 0},
      0,     field.statistics};
  Refinement refinement(set, options, field);
  const UseProposals use = [&](const std::vector<std::uint32_t>& ids) { refinement.take(ids); };
  bool is_done = false;
  int bits = 8;
  if (options.method == FieldMethod::kGather) {
    std::string problem;
    is_done = gather(context, job, problem, use);
    if (!problem.empty()) return bad(problem);
  } else {
    GlRaster raster(context.gl(), grid, sites, job.frame, options.method);
    if (!raster.problem().empty()) return bad(raster.problem());
    bits = raster.subpixel_bits();
    job.style.dilation = std::ldexp(4, -bits);
    job.slack = 1.25 * regret_of(sites, grid, job.style, bits);
    is_done = options.culling.sweep    ? draw_sweep(raster, job, use)
              : options.culling.ranges ? draw_ranges(raster, job, use)
                                       : draw_tiles(raster, job, use);
    if (raster.has_failed()) return bad("the OpenGL driver reports an error");
  }
  if (!is_done) return Error{ErrorCode::kInterrupted, "interrupted", {}, {}};
  if (!refinement.fill_holes()) {
    return bad("the OpenGL driver (" + context.driver().renderer + ") left " +
               std::to_string(field.statistics.holes) + " samples without a site");
  }
  field.bound.regret = regret_of(sites, grid, job.style, bits);
  field.bound.below = field.bound.regret + refinement.widest();
  field.bound.above = 0;
  field.bound.relative = 0x1p-51;
  return std::nullopt;
}

}  // namespace blum::detail
