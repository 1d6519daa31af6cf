#include "blum/show/vtp_file.hpp"

#include <array>
#include <cstring>
#include <optional>
#include <pugixml.hpp>
#include <string_view>
#include <utility>

#include "blum/kernel/vtk_xml.hpp"
#include "vtp_arrays.hpp"

namespace blum {
namespace {

using detail::is_whole;
using detail::Malformed;

std::vector<std::uint8_t> decoded(std::string_view text) {
  static constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  static const auto kValue = [] {
    std::array<std::int8_t, 256> value{};
    value.fill(-1);
    for (std::size_t i = 0; i < kDigits.size(); ++i) {
      value[static_cast<unsigned char>(kDigits[i])] = static_cast<std::int8_t>(i);
    }
    return value;
  }();
  std::vector<std::uint8_t> bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '\n' || c == '\r' || c == ' ' || c == '\t') continue;
    if (c == '=') break;
    const int value = kValue[static_cast<unsigned char>(c)];
    if (value < 0) throw Malformed{"not base64"};
    group = group << 6 | static_cast<std::uint32_t>(value);
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      bytes.push_back(static_cast<std::uint8_t>(group >> bits));
    }
  }
  return bytes;
}

template <class T>
std::vector<double> numbers(std::string_view bytes) {
  std::vector<double> list(bytes.size() / sizeof(T));
  for (std::size_t i = 0; i < list.size(); ++i) {
    T value;
    std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
    list[i] = static_cast<double>(value);
  }
  return list;
}

std::vector<double> numbers(std::string_view type, std::string_view bytes) {
  if (type == "Float64") return numbers<double>(bytes);
  if (type == "Int64") return numbers<std::int64_t>(bytes);
  if (type == "UInt64") return numbers<std::uint64_t>(bytes);
  if (type == "Int32") return numbers<std::int32_t>(bytes);
  if (type == "UInt32") return numbers<std::uint32_t>(bytes);
  if (type == "UInt8") return numbers<std::uint8_t>(bytes);
  throw Malformed{"arrays of type " + std::string(type) + " are not read"};
}

VtpArray array_of(const pugi::xml_node& node) {
  if (std::string_view(node.attribute("format").value()) != "binary") {
    throw Malformed{"only inline binary arrays are read"};
  }
  const std::vector<std::uint8_t> bytes = decoded(node.child_value());
  std::uint64_t length = 0;
  if (bytes.size() < sizeof length) throw Malformed{"an array without its length"};
  std::memcpy(&length, bytes.data(), sizeof length);
  if (length != bytes.size() - sizeof length) throw Malformed{"an array is cut short"};
  VtpArray array;
  array.components = node.attribute("NumberOfComponents").as_int(1);
  array.value = numbers(node.attribute("type").value(),
                        {reinterpret_cast<const char*>(bytes.data()) + sizeof length,
                         static_cast<std::size_t>(length)});
  if (array.components < 1 || array.value.size() % static_cast<unsigned>(array.components) != 0) {
    throw Malformed{"an array is no whole number of tuples"};
  }
  return array;
}

VtpArrays arrays_of(const pugi::xml_node& parent, std::optional<std::size_t> tuples) {
  VtpArrays arrays;
  for (const pugi::xml_node& node : parent.children("DataArray")) {
    VtpArray array = array_of(node);
    if (tuples && array.value.size() != *tuples * static_cast<unsigned>(array.components)) {
      throw Malformed{std::string("array ") + node.attribute("Name").value() +
                      " has another length than its place"};
    }
    arrays.emplace(node.attribute("Name").value(), std::move(array));
  }
  return arrays;
}

/// Cells with `Corners` corners each.
template <std::size_t Corners>
std::vector<std::array<std::uint32_t, Corners>> cells_of(const pugi::xml_node& node,
                                                         std::size_t points) {
  VtpArrays arrays = arrays_of(node, std::nullopt);
  const std::vector<double>& corner = arrays["connectivity"].value;
  const std::vector<double>& offset = arrays["offsets"].value;
  if (corner.size() != Corners * offset.size()) {
    throw Malformed{"cells are not lines of two points and triangles"};
  }
  std::vector<std::array<std::uint32_t, Corners>> cells(offset.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (offset[i] != static_cast<double>(Corners * (i + 1))) throw Malformed{"wrong offsets"};
    for (std::size_t k = 0; k < Corners; ++k) {
      const double index = corner[Corners * i + k];
      if (!is_whole(index, 0, static_cast<double>(points))) {
        throw Malformed{"a cell has a corner that is no point"};
      }
      cells[i][k] = static_cast<std::uint32_t>(index);
    }
  }
  return cells;
}

VtpFile file_of(const pugi::xml_document& document) {
  const pugi::xml_node root = document.child("VTKFile");
  if (std::string_view(root.attribute("type").value()) != "PolyData") {
    throw Malformed{"no VTK PolyData"};
  }
  if (root.attribute("byte_order").value() != detail::vtk_byte_order() ||
      std::string_view(root.attribute("header_type").value()) != "UInt64" ||
      root.attribute("compressor")) {
    throw Malformed{"only this machine's byte order and plain data with UInt64 headers are read"};
  }
  const pugi::xml_node data = root.child("PolyData"), piece = data.child("Piece");
  if (!piece || piece.next_sibling("Piece")) throw Malformed{"not exactly one piece"};
  VtpFile file;
  const VtpArray coordinates = array_of(piece.child("Points").child("DataArray"));
  if (coordinates.components != 3) throw Malformed{"points without three coordinates"};
  detail::require_coordinates(coordinates.value);
  for (std::size_t i = 0; i < coordinates.value.size(); i += 3) {
    file.point.push_back(
        {coordinates.value[i], coordinates.value[i + 1], coordinates.value[i + 2]});
  }
  file.line = cells_of<2>(piece.child("Lines"), file.point.size());
  file.triangle = cells_of<3>(piece.child("Polys"), file.point.size());
  file.point_data = arrays_of(piece.child("PointData"), file.point.size());
  file.cell_data = arrays_of(piece.child("CellData"), file.line.size() + file.triangle.size());
  file.field_data = arrays_of(data.child("FieldData"), std::nullopt);
  return file;
}

}  // namespace

Result<VtpFile> read_vtp(const std::filesystem::path& file) {
  pugi::xml_document document;
  const pugi::xml_parse_result read = document.load_file(file.c_str());
  if (read.status == pugi::status_file_not_found) {
    return Error{ErrorCode::kFileNotFound, "no such file", file.string(), std::nullopt};
  }
  if (read.status == pugi::status_io_error) {
    return Error{ErrorCode::kFileUnreadable, "cannot be read", file.string(), std::nullopt};
  }
  try {
    if (!read) throw Malformed{read.description()};
    return file_of(document);
  } catch (const Malformed& problem) {
    return Error{ErrorCode::kMalformedFile, problem.message, file.string(), std::nullopt};
  }
}

}  // namespace blum
