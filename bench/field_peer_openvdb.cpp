// OpenVDB's meshToVolume, unsigned: the whole grid, or a band of 3 voxels.
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <limits>

#include "field_peers.hpp"

namespace blum::bench {
namespace {

std::vector<float> distances(const SiteSet& sites, const VoxelGrid& grid, int threads,
                             float voxels) {
  openvdb::initialize();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  std::vector<openvdb::Vec3s> points;
  for (const Point3& p : sites.points()) {
    points.emplace_back(static_cast<float>((p.x - grid.origin.x) / grid.spacing.x),
                        static_cast<float>((p.y - grid.origin.y) / grid.spacing.y),
                        static_cast<float>((p.z - grid.origin.z) / grid.spacing.z));
  }
  std::vector<openvdb::Vec3I> triangles;
  for (const auto& t : sites.triangles()) {
    triangles.emplace_back(t.point[0], t.point[1], t.point[2]);
  }
  const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> mesh(points,
                                                                                        triangles);
  const auto transform = openvdb::math::Transform::createLinearTransform(grid.spacing.x);
  const auto volume = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
      mesh, *transform, voxels, voxels, openvdb::tools::UNSIGNED_DISTANCE_FIELD);
  auto from = volume->getConstAccessor();
  std::vector<float> out(grid.voxels(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t v = 0; v < out.size(); ++v) {
    const auto at = grid.position(v);
    const openvdb::Coord place(static_cast<int>(at[0]), static_cast<int>(at[1]),
                               static_cast<int>(at[2]));
    float value = 0;
    if (from.probeValue(place, value)) out[v] = value;
  }
  return out;
}

}  // namespace

std::vector<float> openvdb_distances(const SiteSet& sites, const VoxelGrid& grid, int threads) {
  // Half of the grid reaches all of its samples from a model in its middle. (The band goes beyond
  // the grid, too: OpenVDB knows no box.)
  return distances(sites, grid, threads, 0.5F * static_cast<float>(grid.size[0]));
}
std::vector<float> openvdb_band3(const SiteSet& sites, const VoxelGrid& grid, int threads) {
  return distances(sites, grid, threads, 3);
}

}  // namespace blum::bench
