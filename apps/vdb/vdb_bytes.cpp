#include "vdb_bytes.hpp"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <sstream>

namespace {

template <class Grid>
typename Grid::Ptr grid_of(const blum::FieldImage& image, const char* name,
                           typename Grid::ValueType background) {
  const blum::Point3 &origin = image.grid.origin, &spacing = image.grid.spacing;
  typename Grid::Ptr grid = Grid::create(background);
  grid->setName(name);
  grid->setTransform(
      std::make_shared<openvdb::math::Transform>(std::make_shared<openvdb::math::ScaleTranslateMap>(
          openvdb::Vec3d(spacing.x, spacing.y, spacing.z),
          openvdb::Vec3d(origin.x, origin.y, origin.z))));
  return grid;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) void blum_vdb_bytes(const blum::FieldImage& image,
                                                                      std::string& bytes) {
  openvdb::initialize();
  const auto distance =
      grid_of<openvdb::DoubleGrid>(image, "distance", std::numeric_limits<double>::infinity());
  const auto site = grid_of<openvdb::Int32Grid>(image, "site", -1);
  auto to_distance = distance->getAccessor();
  auto to_site = site->getAccessor();
  for (std::size_t v = 0; v < image.grid.voxels(); ++v) {
    if (!(image.distance[v] < std::numeric_limits<double>::infinity())) continue;
    const auto at = image.grid.position(v);
    const openvdb::Coord place(static_cast<int>(at[0]), static_cast<int>(at[1]),
                               static_cast<int>(at[2]));
    if (!std::isfinite(image.distance[v])) {
      to_distance.setValueOff(place, image.distance[v]);  // inside, beyond the band
      continue;
    }
    to_distance.setValue(place, image.distance[v]);
    to_site.setValue(place, static_cast<std::int32_t>(image.site[v]));
  }
  std::ostringstream stream(std::ios_base::binary);
  openvdb::io::Stream(stream).write(openvdb::GridPtrVec{distance, site});
  bytes = std::move(stream).str();
}
