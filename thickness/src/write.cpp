#include <bit>
#include <limits>
#include <string_view>
#include <type_traits>

#include "blum/kernel/output_files.hpp"
#include "blum/kernel/vtk_xml.hpp"
#include "blum/thickness/midsurface.hpp"
#include "blum/thickness/thickness.hpp"

namespace blum {
namespace {

using detail::DataArray;
using detail::OutputFile;
using detail::OutputStream;

std::filesystem::path with_suffix(const std::filesystem::path& prefix, const char* suffix) {
  std::filesystem::path file = prefix;
  file += suffix;
  return file;
}

void begin_piece(OutputStream& out, std::size_t points, std::size_t lines, std::size_t polys) {
  out << detail::vtp_head() << "<Piece NumberOfPoints=\"" << points
      << "\" NumberOfVerts=\"0\" NumberOfLines=\"" << lines
      << "\" NumberOfStrips=\"0\" NumberOfPolys=\"" << polys << "\">\n";
}

template <class Cells>
void put_cells(OutputStream& out, std::string_view element, const Cells& cells,
               std::size_t corners) {
  out << '<' << element << ">\n";
  {
    DataArray<std::int64_t> array(out, "connectivity", corners * cells.size());
    for (const auto& cell : cells) {
      for (const std::uint32_t v : cell) array.put(v);
    }
  }
  detail::put_offsets(out, cells.size(), corners);
  out << "</" << element << ">\n";
}

void put_points(OutputStream& out, const std::vector<Point3>& points) {
  out << "<Points>\n";
  {
    DataArray<double> array(out, "Points", points.size(), 3);
    for (const Point3& p : points) array.put(p);
  }
  out << "</Points>\n";
}

template <class T, class Items, class Value>
void put_array(OutputStream& out, std::string_view name, const Items& items, Value value) {
  DataArray<T> array(out, name, items.size());
  for (const auto& item : items) array.put(value(item));
}

void put_vtp(OutputStream& out, const Thickness& t) {
  begin_piece(out, t.point.size(), 0, t.part.size());
  out << "<CellData Scalars=\"thickness\">\n";
  const auto put = [&]<class T>(std::string_view name, T, auto value) {
    put_array<T>(out, name, t.sample, value);
  };
  using S = ThicknessSample;
  put("thickness", double{},
      [](const S& s) { return s.counts ? s.thickness : std::numeric_limits<double>::quiet_NaN(); });
  put("thickness_any", double{}, [](const S& s) { return s.thickness; });
  put("error", double{}, [](const S& s) { return s.error; });
  put("contact_angle", double{}, [](const S& s) { return s.angle_deg; });
  put("sheet", std::int32_t{}, [](const S& s) { return s.sheet; });
  put("counts", std::uint8_t{}, [](const S& s) { return s.counts ? 1 : 0; });
  put("face", std::uint32_t{}, [](const S& s) { return s.triangle; });
  out << "</CellData>\n";
  put_points(out, t.point);
  put_cells(out, "Lines", std::vector<std::array<std::uint32_t, 2>>(), 2);
  put_cells(out, "Polys", t.part, 3);
  out << "</Piece>\n" << detail::kVtpTail;
}

/// Little-endian, whatever the machine.
template <class T>
void put_binary(OutputStream& out, T value) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if constexpr (std::endian::native == std::endian::big) {
    for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
  }
  out << std::string_view(bytes.data(), bytes.size());
}

void put_ply(OutputStream& out, const Thickness& t) {
  out << "ply\nformat binary_little_endian 1.0\ncomment thickness in model units\nelement vertex "
      << t.sample.size()
      << "\nproperty double x\nproperty double y\nproperty double z\nproperty double thickness\n"
         "property double error\nproperty double angle\nproperty int sheet\n"
         "property uchar counts\nend_header\n";
  for (const ThicknessSample& s : t.sample) {
    for (const double v :
         {s.position.x, s.position.y, s.position.z, s.thickness, s.error, s.angle_deg}) {
      put_binary(out, v);
    }
    put_binary(out, s.sheet);
    put_binary(out, static_cast<std::uint8_t>(s.counts ? 1 : 0));
  }
}

void put_vtp(OutputStream& out, const Midsurface& m) {
  begin_piece(out, m.point.size(), m.line.size(), m.triangle.size());
  out << "<PointData Scalars=\"thickness\">\n";
  put_array<double>(out, "thickness", m.thickness, [](double v) { return v; });
  put_array<std::uint8_t>(out, "on_axis", m.on_axis, [](bool v) { return v ? 1 : 0; });
  out << "</PointData>\n<CellData Scalars=\"sheet\">\n";
  const auto on_cells = [&](std::string_view name, auto of_line, auto of_triangle) {
    DataArray<std::int32_t> array(out, name, m.line.size() + m.triangle.size());
    for (std::size_t i = 0; i < m.line.size(); ++i) array.put(of_line(i));
    for (std::size_t i = 0; i < m.triangle.size(); ++i) array.put(of_triangle(i));
  };
  const auto none = [](std::size_t) { return -1; };
  on_cells("sheet", none, [&](std::size_t i) { return m.sheet[i]; });
  on_cells(
      "seam", [&](std::size_t i) { return m.line_sheets[i] >= 3 ? 0 : -1; }, none);
  on_cells(
      "triangles_at", [&](std::size_t i) { return m.line_sheets[i]; }, none);
  out << "</CellData>\n";
  put_points(out, m.point);
  put_cells(out, "Lines", m.line, 2);
  put_cells(out, "Polys", m.triangle, 3);
  out << "</Piece>\n" << detail::kVtpTail;
}

void put_ply(OutputStream& out, const Midsurface& m) {
  out << "ply\nformat binary_little_endian 1.0\ncomment thickness in model units\nelement vertex "
      << m.point.size()
      << "\nproperty double x\nproperty double y\nproperty double z\nproperty double thickness\n"
         "element face "
      << m.triangle.size()
      << "\nproperty list uchar int vertex_indices\nproperty int sheet\nend_header\n";
  for (std::size_t i = 0; i < m.point.size(); ++i) {
    const Point3& p = m.point[i];
    for (const double v : {p.x, p.y, p.z, m.thickness[i]}) put_binary(out, v);
  }
  for (std::size_t i = 0; i < m.triangle.size(); ++i) {
    put_binary(out, std::uint8_t{3});
    for (const std::uint32_t v : m.triangle[i]) put_binary(out, static_cast<std::int32_t>(v));
    put_binary(out, m.sheet[i]);
  }
}

template <class What>
std::optional<Error> write_both(const What& what, const std::filesystem::path& prefix) {
  const std::array<OutputFile, 2> files = {
      OutputFile{with_suffix(prefix, ".vtp"), [&](OutputStream& out) { put_vtp(out, what); }},
      OutputFile{with_suffix(prefix, ".ply"), [&](OutputStream& out) { put_ply(out, what); }}};
  return detail::write_files(files);
}

}  // namespace

std::optional<Error> write_thickness(const Thickness& thickness,
                                     const std::filesystem::path& prefix) {
  return write_both(thickness, prefix);
}

std::optional<Error> write_midsurface(const Midsurface& midsurface,
                                      const std::filesystem::path& prefix) {
  return write_both(midsurface, prefix);
}

}  // namespace blum
