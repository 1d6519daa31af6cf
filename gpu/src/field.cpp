#include "blum/gpu/field.hpp"

#include <algorithm>
#include <cmath>

#include "gl_field.hpp"
#include "scan_field.hpp"

namespace blum {

const char* field_backend_name(FieldBackend backend) {
  switch (backend) {
    case FieldBackend::kCpu:
      return "cpu";
    case FieldBackend::kBrute:
      return "brute";
    case FieldBackend::kEgl:
      return "egl";
    case FieldBackend::kOsmesa:
      return "osmesa";
  }
  return "";
}

const char* field_method_name(FieldMethod method) {
  switch (method) {
    case FieldMethod::kFragments:
      return "fragments";
    case FieldMethod::kGather:
      return "gather";
    case FieldMethod::kDistanceMeshes:
      return "havoc";
    case FieldMethod::kLinearFactorization:
      return "difi";
  }
  return "";
}

FieldStatistics& FieldStatistics::operator+=(const FieldStatistics& o) {
  blocks += o.blocks;
  block_sites += o.block_sites;
  owner_sites += o.owner_sites;
  fragments += o.fragments;
  tree_tests += o.tree_tests;
  queries += o.queries;
  holes += o.holes;
  return *this;
}

double culling_efficiency(const FieldStatistics& s) {
  return s.block_sites == 0
             ? 1
             : static_cast<double>(s.owner_sites) / static_cast<double>(s.block_sites);
}

double clamping_efficiency(const FieldStatistics& s, std::size_t voxels) {
  if (s.owner_sites == 0 || s.fragments == 0) return 1;
  const double owned = static_cast<double>(voxels) / static_cast<double>(s.owner_sites);
  return owned * static_cast<double>(s.block_sites) / static_cast<double>(s.fragments);
}

DistanceInterval DistanceField::interval(std::size_t voxel) const {
  const double d = distance[voxel];
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  // The sums err by less than `relative`, which has that much to spare.
  if (d == kInfinity) return {std::max(0.0, band - bound.below - bound.relative * band), kInfinity};
  return {std::max(0.0, d - bound.below - bound.relative * d),
          d + bound.above + bound.relative * d};
}

std::string options_problem(const FieldOptions& options) {
  if (!(options.band >= 0)) return "the band is no distance";
  if (options.threads < 1) return "fewer than one thread";
  // Smaller ones make meshes without end, greater ones have no use; NaN is neither.
  if (!(options.mesh_error >= 1e-3 && options.mesh_error <= 1e3)) {
    return "the error of distance meshes is not between 0.001 and 1000 spacings";
  }
  const FieldCulling& c = options.culling;
  if (!c.sweep && !c.ranges && !c.clamping) return {};
  if (!is_opengl(options.backend) || options.method == FieldMethod::kGather) {
    return "sweeps, clamping and ranges are for OpenGL backends that draw";
  }
  if (c.clamping && !c.sweep) return "clamping needs the sweep";
  if (int{c.sweep} + int{c.ranges} + int{c.blocks} > 1) {
    return "blocks, sweep and ranges exclude each other";
  }
  return {};
}

Result<DistanceField> compute_field(const SiteSet& sites, const VoxelGrid& grid,
                                    const FieldOptions& options) {
  const auto bad = [](std::string what) {
    return Error{ErrorCode::kBadArgument, std::move(what), {}, {}};
  };
  if (std::string problem = grid_problem(grid); !problem.empty()) return bad(std::move(problem));
  if (std::string problem = options_problem(options); !problem.empty()) {
    return bad(std::move(problem));
  }
  DistanceField field;
  field.grid = grid;
  field.band = options.band;
  field.backend = options.backend;
  field.site.assign(grid.voxels(), kNoSite.value);
  field.distance.assign(grid.voxels(), std::numeric_limits<double>::infinity());
  if (is_opengl(options.backend)) {
    if (auto problem = detail::gl_field(sites, options, field)) return *std::move(problem);
    return field;
  }
  const bool is_done = options.backend == FieldBackend::kBrute
                           ? detail::brute_field(sites, options, field)
                           : detail::scan_field(sites, options, field);
  if (!is_done) return Error{ErrorCode::kInterrupted, "interrupted", {}, {}};
  return field;
}

Point3 foot_at(const SiteSet& sites, const DistanceField& field, std::size_t voxel) {
  Point3 foot;
  (void)sites.squared_distance(field.grid.point(voxel), field.site_at(voxel), &foot);
  return foot;
}

std::uint64_t field_memory_bytes(const SiteSet& sites, const VoxelGrid& grid,
                                 const FieldOptions& options) {
  // Per voxel an id and a distance. Per site, measured: its record and conditions (twice while they
  // are sorted), the tables that they are made from, its places in the lists of the tasks.
  const std::uint64_t per_site = options.backend == FieldBackend::kBrute ? 16 : 1000;
  const std::uint64_t per_voxel = is_opengl(options.backend) ? 16 : 12;  // the proposed ids
  return per_voxel * grid.voxels() + per_site * sites.size();
}

}  // namespace blum
