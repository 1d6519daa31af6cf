/// What is to be seen of a result: a coloured surface with its lines, and the model around it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "blum/kernel/point.hpp"
#include "blum/kernel/result.hpp"

namespace blum {

/// One number a point or a triangle of the surface, to colour it by.
struct ScalarField {
  std::string name;
  bool per_triangle = false;
  bool is_label = false;      ///< numbers that name things: no order, one colour each
  std::vector<double> value;  ///< NaN: none
};

/// All coordinates in model units. Sites are numbered vertices, edges, triangles of the model.
struct Scene {
  std::string title;                             ///< the model's name, where known
  std::vector<std::array<std::string, 2>> fact;  ///< name and value, for people

  std::vector<Point3> point;
  std::vector<std::array<std::uint32_t, 3>> triangle;
  std::vector<ScalarField> field;  ///< the first is the one to start with
  std::vector<std::array<std::uint32_t, 2>> line;
  std::vector<std::int64_t> line_seam;  ///< number of the seam, -1 on rims

  /// Of medial axes with angles: up to which angle a cell stays (the filtration); empty without.
  std::vector<double> triangle_theta, line_theta;
  /// Edges of the complex, by which the sheets of a part of it are counted; empty where the file
  /// has none. Two edges may have the same ends.
  std::vector<std::array<std::uint32_t, 3>> triangle_edge;
  std::vector<std::uint32_t> line_edge;

  /// What picking shows; empty where the file has none.
  std::vector<double> radius;                                  ///< of each point
  std::vector<std::uint8_t> on_axis;                           ///< of each point
  std::vector<std::array<double, 2>> triangle_angle;           ///< bounds, degrees
  std::vector<std::array<std::int64_t, 2>> triangle_governor;  ///< sites
  std::vector<std::uint32_t> governor_begin, governor;         ///< of points, in compressed rows
  std::array<std::uint32_t, 3> site_counts{};

  std::vector<Point3> model_point;
  std::vector<std::array<std::uint32_t, 3>> model_triangle;
  std::vector<std::array<std::uint32_t, 2>> model_edge;  ///< as sites are numbered
  std::vector<std::array<std::uint32_t, 2>> model_line;  ///< edges that are not flat to the eye

  std::vector<std::array<Point3, 2>> undecided;  ///< boxes: lowest, highest corner
};

/// Around all points and boxes, of which there is one at least.
[[nodiscard]] Box3 bounds_of(const Scene& scene);

/// Reads PREFIX.vtp, or the .vtp file that is named; all facts are its own. The model's name alone
/// is from the summary PREFIX.json beside it, where there is one with the same seed and number of
/// faces. Results of `blum medial`, `voronoi`, `thickness` and `midsurface`. Errors: those of
/// read_vtp, kMalformedFile.
[[nodiscard]] Result<Scene> read_scene(const std::filesystem::path& result);

}  // namespace blum
