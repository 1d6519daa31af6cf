// Prints a .vdb file of `blum field` as JSON, for field.py: what OpenVDB itself reads.
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <cstdio>

int main(int, char** argv) {
  openvdb::initialize();
  openvdb::io::File file(argv[1]);
  file.open();
  const auto distance = openvdb::gridPtrCast<openvdb::DoubleGrid>(file.readGrid("distance"));
  const auto site = openvdb::gridPtrCast<openvdb::Int32Grid>(file.readGrid("site"));
  const auto origin = distance->transform().indexToWorld(openvdb::Vec3d(0, 0, 0));
  const auto step = distance->transform().voxelSize();
  std::printf(
      "{\"origin\": [%.17g, %.17g, %.17g], \"spacing\": [%.17g, %.17g, %.17g], \"values\": [",
      origin.x(), origin.y(), origin.z(), step.x(), step.y(), step.z());
  const char* separator = "";
  for (auto v = distance->cbeginValueOn(); v; ++v) {
    const openvdb::Coord c = v.getCoord();
    std::printf("%s[%d, %d, %d, %.17g, %d]", separator, c.x(), c.y(), c.z(), *v,
                site->tree().getValue(c));
    separator = ", ";
  }
  int inside = 0;
  for (auto v = distance->cbeginValueOff(); v; ++v) inside += v.isVoxelValue() && *v < 0;
  std::printf("], \"inactive_inside\": %d}\n", inside);
}
