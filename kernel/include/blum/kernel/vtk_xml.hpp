/// Parts of VTK XML files (PolyData, ImageData) with inline uncompressed binary arrays: each is one base64 run
/// of its length in bytes (UInt64) and its values, in the byte order named in the header.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "blum/kernel/output_stream.hpp"
#include "blum/kernel/point.hpp"

namespace blum::detail {

/// Up to the content of the PolyData element.
[[nodiscard]] constexpr std::string_view vtp_head() {
  return std::endian::native == std::endian::little
             ? "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
               "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n"
             : "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
               "byte_order=\"BigEndian\" header_type=\"UInt64\">\n<PolyData>\n";
}
[[nodiscard]] constexpr std::string_view vtk_byte_order() {
  return std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
}
inline constexpr std::string_view kVtpTail = "</PolyData>\n</VTKFile>\n";

template <class T>
constexpr std::string_view vtk_type() {
  if constexpr (std::same_as<T, double>) return "Float64";
  if constexpr (std::same_as<T, std::int64_t>) return "Int64";
  if constexpr (std::same_as<T, std::uint64_t>) return "UInt64";
  if constexpr (std::same_as<T, std::int32_t>) return "Int32";
  if constexpr (std::same_as<T, std::uint32_t>) return "UInt32";
  if constexpr (std::same_as<T, std::uint8_t>) return "UInt8";
}

/// One DataArray. Arrays of FieldData have to name their number of tuples, others may not need it.
template <class T>
class DataArray {
 public:
  DataArray(OutputStream& out, std::string_view name, std::size_t tuples, int components = 1)
      : out_(out), base64_(out) {
    out_ << "<DataArray type=\"" << vtk_type<T>() << "\" Name=\"" << name
         << "\" NumberOfComponents=\"" << components << "\" NumberOfTuples=\"" << tuples
         << "\" format=\"binary\">\n";
    base64_.put(static_cast<std::uint64_t>(sizeof(T) * tuples * static_cast<unsigned>(components)));
  }
  DataArray(const DataArray&) = delete;
  DataArray& operator=(const DataArray&) = delete;
  ~DataArray() {
    base64_.end();
    out_ << "\n</DataArray>\n";
  }
  template <class Value>
  void put(Value value) {
    base64_.put(static_cast<T>(value));
  }
  void put(const Point3& p) {
    put(p.x);
    put(p.y);
    put(p.z);
  }

 private:
  OutputStream& out_;
  Base64 base64_;
};

/// The "offsets" array of cells with equally many corners.
inline void put_offsets(OutputStream& out, std::size_t cells, std::size_t corners_each) {
  DataArray<std::int64_t> array(out, "offsets", cells);
  for (std::size_t i = 1; i <= cells; ++i) array.put(i * corners_each);
}

}  // namespace blum::detail
