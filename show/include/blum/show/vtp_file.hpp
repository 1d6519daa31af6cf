/// Reading VTK XML PolyData back, as Blum writes it: inline binary arrays, one base64 run each, not
/// compressed, in the byte order of this machine.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "blum/kernel/point.hpp"
#include "blum/kernel/result.hpp"

namespace blum {

/// Numbers of any type as doubles: ids below 2^53 stay exact.
struct VtpArray {
  int components = 1;
  std::vector<double> value;
};
using VtpArrays = std::map<std::string, VtpArray>;

struct VtpFile {
  std::vector<Point3> point;
  std::vector<std::array<std::uint32_t, 2>> line;      ///< all lines have two ends
  std::vector<std::array<std::uint32_t, 3>> triangle;  ///< all polygons have three corners
  VtpArrays point_data, cell_data, field_data;         ///< cells: lines, then triangles
};

/// Every array has been checked to have the length that its place asks for, every index to be one
/// of a point. Errors: kFileNotFound, kFileUnreadable, kMalformedFile (also for files of others
/// that use what is not read: ASCII, appended or compressed data, several pieces, other polygons).
[[nodiscard]] Result<VtpFile> read_vtp(const std::filesystem::path& file);

}  // namespace blum
