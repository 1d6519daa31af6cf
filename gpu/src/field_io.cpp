#include "blum/gpu/field_io.hpp"

#include <bit>
#include <string>
#include <string_view>

#include "blum/kernel/check.hpp"
#include "blum/kernel/output_files.hpp"
#include "blum/kernel/output_stream.hpp"
#include "blum/kernel/vtk_xml.hpp"

namespace blum {
namespace {

using detail::OutputStream;

void put_three(OutputStream& out, const Point3& p, std::string_view separator) {
  out << p.x << separator << p.y << separator << p.z;
}

template <class T>
void put_raw(OutputStream& out, std::span<const T> values) {
  const auto bytes = std::as_bytes(values);
  out << std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

void put_vti(OutputStream& out, const FieldImage& image) {
  const VoxelGrid& g = image.grid;
  const int order = static_cast<int>(image.order);
  std::string extent;
  for (int axis = 0; axis < 3; ++axis) {
    extent += (axis > 0 ? " 0 " : "0 ") + std::to_string(g.size[axis] - 1);
  }
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\""
      << detail::vtk_byte_order() << "\" header_type=\"UInt64\">\n<ImageData WholeExtent=\""
      << extent << "\" Origin=\"";
  put_three(out, g.origin, " ");
  out << "\" Spacing=\"";
  put_three(out, g.spacing, " ");
  out << "\">\n<Piece Extent=\"" << extent << "\">\n<PointData Scalars=\"distance\">\n";
  {
    detail::DataArray<double> array(out, "distance", g.voxels(), order);
    for (const double d : image.distance) array.put(d);
  }
  {
    detail::DataArray<std::uint32_t> array(out, "site", g.voxels(), order);
    for (const std::uint32_t s : image.site) array.put(s);
  }
  if (!image.side.empty()) {
    detail::DataArray<std::uint8_t> array(out, "side", g.voxels());
    for (const FieldSide s : image.side) array.put(static_cast<std::uint8_t>(s));
  }
  out << "</PointData>\n</Piece>\n</ImageData>\n</VTKFile>\n";
}

void put_nrrd(OutputStream& out, const FieldImage& image) {
  const VoxelGrid& g = image.grid;
  const bool is_list = image.order > 1;
  out << "NRRD0005\ntype: double\ndimension: " << (is_list ? 4 : 3) << "\nsizes:";
  if (is_list) out << ' ' << image.order;
  for (const std::uint32_t n : g.size) out << ' ' << n;
  out << "\nspace dimension: 3\nspace directions:" << (is_list ? " none" : "") << " ("
      << g.spacing.x << ",0,0) (0," << g.spacing.y << ",0) (0,0," << g.spacing.z
      << ")\nspace origin: (";
  put_three(out, g.origin, ",");
  out << ")\nkinds:" << (is_list ? " list" : "") << " domain domain domain\nendian: "
      << (std::endian::native == std::endian::little ? "little" : "big") << "\nencoding: raw\n\n";
  put_raw(out, image.distance);
}

void put_npy(OutputStream& out, const FieldImage& image) {
  const VoxelGrid& g = image.grid;
  std::string header = "{'descr': '";
  header += std::endian::native == std::endian::little ? "<f8" : ">f8";
  header += "', 'fortran_order': False, 'shape': (";
  for (int axis = 2; axis >= 0; --axis) header += std::to_string(g.size[axis]) + ", ";
  if (image.order > 1) header += std::to_string(image.order) + ", ";
  header += "), }";
  constexpr std::size_t kPrefix = 10;  // magic, version, length: all together a multiple of 64
  while ((kPrefix + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  BLUM_CHECK(header.size() < 65536);
  out << "\x93NUMPY" << '\x01' << '\0' << static_cast<char>(header.size() & 255)
      << static_cast<char>(header.size() >> 8) << header;
  put_raw(out, image.distance);
}

void put_geometry(OutputStream& out, const FieldImage& image) {
  const VoxelGrid& g = image.grid;
  out << "{\n  \"size\": [" << g.size[0] << ", " << g.size[1] << ", " << g.size[2]
      << "],\n  \"origin\": [";
  put_three(out, g.origin, ", ");
  out << "],\n  \"spacing\": [";
  put_three(out, g.spacing, ", ");
  out << "],\n  \"order\": " << image.order << "\n}\n";
}

}  // namespace

std::vector<std::filesystem::path> field_files(const std::filesystem::path& file) {
  const std::filesystem::path extension = file.extension();
  if (extension == ".vti" || extension == ".nrrd") return {file};
  if (extension != ".npy") return {};
  std::filesystem::path geometry = file;
  geometry += ".json";
  return {file, geometry};
}

std::optional<Error> write_field(const FieldImage& image, const std::filesystem::path& file) {
  const std::vector<std::filesystem::path> names = field_files(file);
  if (names.empty()) {
    return Error{ErrorCode::kBadArgument, "not .vti, .nrrd or .npy", file.string(), std::nullopt};
  }
  BLUM_CHECK(image.distance.size() == image.order * image.grid.voxels());
  const std::filesystem::path extension = file.extension();
  const auto put = [&](OutputStream& out) {
    if (extension == ".vti") {
      put_vti(out, image);
    } else if (extension == ".nrrd") {
      put_nrrd(out, image);
    } else {
      put_npy(out, image);
    }
  };
  std::vector<detail::OutputFile> files = {{file, put}};
  if (names.size() > 1) {
    files.push_back({names[1], [&](OutputStream& out) { put_geometry(out, image); }});
  }
  return detail::write_files(files);
}

}  // namespace blum
