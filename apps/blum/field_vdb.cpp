#include "field_vdb.hpp"

#ifdef BLUM_HAS_OPENVDB
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <sstream>

#include "blum/kernel/output_files.hpp"
#include "blum/kernel/output_stream.hpp"
#endif

namespace blum::app {
namespace {

#ifdef BLUM_HAS_OPENVDB
template <class Grid>
typename Grid::Ptr grid_of(const FieldImage& image, const char* name,
                           typename Grid::ValueType background) {
  const Point3 &origin = image.grid.origin, &spacing = image.grid.spacing;
  typename Grid::Ptr grid = Grid::create(background);
  grid->setName(name);
  grid->setTransform(
      std::make_shared<openvdb::math::Transform>(std::make_shared<openvdb::math::ScaleTranslateMap>(
          openvdb::Vec3d(spacing.x, spacing.y, spacing.z),
          openvdb::Vec3d(origin.x, origin.y, origin.z))));
  return grid;
}

std::optional<Error> write_vdb(const FieldImage& image, const std::filesystem::path& file) {
  if (image.order > 1) {
    return Error{ErrorCode::kBadArgument, "a .vdb file holds one value a sample", file.string(),
                 std::nullopt};
  }
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
  std::ostringstream bytes(std::ios_base::binary);
  openvdb::io::Stream(bytes).write(openvdb::GridPtrVec{distance, site});
  const std::vector<detail::OutputFile> files = {
      {file, [&](detail::OutputStream& out) { out << std::string_view(bytes.view()); }}};
  return detail::write_files(files);
}
#endif

}  // namespace

bool has_vdb() {
#ifdef BLUM_HAS_OPENVDB
  return true;
#else
  return false;
#endif
}

bool is_vdb(const std::filesystem::path& file) { return file.extension() == ".vdb"; }

std::vector<std::filesystem::path> output_files(const std::filesystem::path& file) {
  if (is_vdb(file)) return {file};
  return field_files(file);
}

std::optional<Error> write_field_file(const FieldImage& image, const std::filesystem::path& file) {
#ifdef BLUM_HAS_OPENVDB
  if (is_vdb(file)) return write_vdb(image, file);
#endif
  return write_field(image, file);
}

}  // namespace blum::app
