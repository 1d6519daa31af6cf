#include "blum/show/scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "blum/kernel/check.hpp"
#include "blum/kernel/point_algebra.hpp"
#include "blum/show/vtp_file.hpp"
#include "scene_facts.hpp"
#include "vtp_arrays.hpp"

namespace blum {
namespace {

namespace fs = std::filesystem;
/// Pages hold them in 32 bits.
constexpr double kMostLabels = 0x1p31;

using detail::find;
using detail::is_whole;
using detail::Malformed;

/// An array of indices below `end`.
template <class Index>
std::vector<Index> indices(const VtpArray& array, double end, const char* name) {
  std::vector<Index> list;
  list.reserve(array.value.size());
  for (const double v : array.value) {
    if (!is_whole(v, 0, end)) throw Malformed{std::string(name) + ": an index out of range"};
    list.push_back(static_cast<Index>(v));
  }
  return list;
}

/// Whole numbers from -1 (none) on, below `end`.
std::vector<std::int64_t> numbers_or_none(std::span<const double> values, double end,
                                          const char* name) {
  std::vector<std::int64_t> list;
  list.reserve(values.size());
  for (const double v : values) {
    if (!is_whole(v, -1, end)) throw Malformed{std::string(name) + ": a number out of range"};
    list.push_back(static_cast<std::int64_t>(v));
  }
  return list;
}

void require_finite(std::span<const double> values, const char* name) {
  for (const double v : values) {
    if (!std::isfinite(v)) throw Malformed{std::string(name) + ": a value is not finite"};
  }
}

template <std::size_t N, class T>
std::vector<std::array<T, N>> tuples(const std::vector<T>& list) {
  std::vector<std::array<T, N>> result(list.size() / N);
  for (std::size_t i = 0; i < result.size(); ++i) {
    std::copy_n(list.begin() + static_cast<std::ptrdiff_t>(N * i), N, result[i].begin());
  }
  return result;
}

/// Edges between triangles that make an angle of more than a degree.
std::vector<std::array<std::uint32_t, 2>> visible_edges(const Scene& scene) {
  const double most = std::cos(M_PI / 180);
  std::map<std::array<std::uint32_t, 2>, Point3> normal_at;
  std::vector<std::array<std::uint32_t, 2>> visible;
  for (const auto& t : scene.model_triangle) {
    const Point3& a = scene.model_point[t[0]];
    const Point3 n = cross(scene.model_point[t[1]] - a, scene.model_point[t[2]] - a);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t u = t[k], v = t[(k + 1) % 3];
      const std::array<std::uint32_t, 2> edge{std::min(u, v), std::max(u, v)};
      const auto [other, is_new] = normal_at.emplace(edge, n);
      if (is_new) continue;
      // Root by root: the product of the squares of areas overflows.
      const Point3& m = other->second;
      const double lengths = std::sqrt(inner(n, n)) * std::sqrt(inner(m, m));
      if (!(inner(n, m) >= most * lengths)) visible.push_back(edge);
    }
  }
  return visible;
}

void read_model(const VtpFile& file, Scene& scene) {
  const VtpArray* points = find(file.field_data, "solid_points", 3);
  const VtpArray* triangles = find(file.field_data, "solid_triangles", 3);
  if (points == nullptr || triangles == nullptr) return;
  detail::require_coordinates(points->value);
  for (const auto& p : tuples<3>(points->value)) scene.model_point.push_back({p[0], p[1], p[2]});
  scene.model_triangle = tuples<3>(indices<std::uint32_t>(
      *triangles, static_cast<double>(scene.model_point.size()), "solid_triangles"));
  if (const VtpArray* edges = find(file.field_data, "solid_edges", 2)) {
    scene.model_edge = tuples<2>(indices<std::uint32_t>(
        *edges, static_cast<double>(scene.model_point.size()), "solid_edges"));
  }
  scene.model_line = visible_edges(scene);
  if (const VtpArray* counts = find(file.field_data, "site_counts", 1);
      counts != nullptr && counts->value.size() == 3) {
    const std::array<std::size_t, 3> size = {scene.model_point.size(), scene.model_edge.size(),
                                             scene.model_triangle.size()};
    for (int k = 0; k < 3; ++k) {
      if (counts->value[k] != static_cast<double>(size[k])) {
        throw Malformed{"site_counts are not the numbers of the model's elements"};
      }
      scene.site_counts[k] = static_cast<std::uint32_t>(size[k]);
    }
  }
}

/// The parts of an array of cells that are about lines and triangles.
std::span<const double> of_lines(const VtpFile& file, const VtpArray& array) {
  return std::span(array.value).first(file.line.size());
}
std::span<const double> of_triangles(const VtpFile& file, const VtpArray& array) {
  return std::span(array.value).subspan(file.line.size());
}

void read_governors(const VtpFile& file, Scene& scene) {
  const double sites =
      static_cast<double>(scene.site_counts[0]) + scene.site_counts[1] + scene.site_counts[2];
  const VtpArray* begin = find(file.field_data, "governor_offset", 1);
  const VtpArray* governor = find(file.field_data, "governor", 1);
  if (begin != nullptr && governor != nullptr) {
    scene.governor = indices<std::uint32_t>(*governor, sites, "governor");
    scene.governor_begin = indices<std::uint32_t>(
        *begin, static_cast<double>(governor->value.size()) + 1, "governor_offset");
    if (scene.governor_begin.size() != file.point.size() + 1 ||
        !std::is_sorted(scene.governor_begin.begin(), scene.governor_begin.end())) {
      throw Malformed{"governor_offset is not the offsets of all points"};
    }
  }
  const VtpArray* a = find(file.cell_data, "governor_a", 1);
  const VtpArray* b = find(file.cell_data, "governor_b", 1);
  if (a == nullptr || b == nullptr) return;
  const auto first = numbers_or_none(of_triangles(file, *a), sites, "governor_a"),
             second = numbers_or_none(of_triangles(file, *b), sites, "governor_b");
  for (std::size_t i = 0; i < first.size(); ++i) {
    scene.triangle_governor.push_back({first[i], second[i]});
  }
}

void read_fields(const VtpFile& file, Scene& scene) {
  const auto add = [&](const char* name, bool per_triangle, bool is_label,
                       std::span<const double> values) {
    for (const double v : values) {
      if (std::isinf(v)) throw Malformed{std::string(name) + ": a value is infinite"};
    }
    scene.field.push_back({name, per_triangle, is_label, {values.begin(), values.end()}});
  };
  const auto add_of_points = [&](const char* name) {
    if (const auto* array = find(file.point_data, name, 1)) add(name, false, false, array->value);
  };
  add_of_points("thickness");
  if (const auto* thickness = find(file.cell_data, "thickness", 1)) {
    add("thickness", true, false, of_triangles(file, *thickness));
  }
  add_of_points("radius");
  const VtpArray* lo = find(file.cell_data, "angle_lo", 1);
  const VtpArray* hi = find(file.cell_data, "angle_hi", 1);
  if (lo != nullptr && hi != nullptr) {
    require_finite(lo->value, "angle_lo");
    require_finite(hi->value, "angle_hi");
    const auto low = of_triangles(file, *lo), high = of_triangles(file, *hi);
    for (std::size_t i = 0; i < high.size(); ++i) scene.triangle_angle.push_back({low[i], high[i]});
    add("angle", true, false, high);
  }
  if (const auto* sheet = find(file.cell_data, "sheet", 1)) {
    const std::span<const double> labels = of_triangles(file, *sheet);
    (void)numbers_or_none(labels, kMostLabels, "sheet");
    add("sheet", true, true, labels);
  }
}

void read_axis(const VtpFile& file, Scene& scene) {
  if (const VtpArray* theta = find(file.cell_data, "theta", 1)) {
    require_finite(theta->value, "theta");
    const auto lines = of_lines(file, *theta), triangles = of_triangles(file, *theta);
    scene.line_theta.assign(lines.begin(), lines.end());
    scene.triangle_theta.assign(triangles.begin(), triangles.end());
  }
  if (const VtpArray* seam = find(file.cell_data, "seam", 1)) {
    scene.line_seam = numbers_or_none(of_lines(file, *seam), kMostLabels, "seam");
  } else {
    scene.line_seam.assign(file.line.size(), -1);
  }
  // Every edge is a line or a triangle's: numbers beyond are no edges' (and would take memory).
  const double edges =
      3.0 * static_cast<double>(file.triangle.size()) + static_cast<double>(file.line.size());
  const VtpArray* line_edge = find(file.field_data, "line_edge", 1);
  const VtpArray* triangle_edge = find(file.field_data, "triangle_edge", 3);
  if (line_edge != nullptr && triangle_edge != nullptr) {
    scene.line_edge = indices<std::uint32_t>(*line_edge, edges, "line_edge");
    scene.triangle_edge = tuples<3>(indices<std::uint32_t>(*triangle_edge, edges, "triangle_edge"));
    if (scene.line_edge.size() != file.line.size() ||
        scene.triangle_edge.size() != file.triangle.size()) {
      throw Malformed{"line_edge and triangle_edge are not of all cells"};
    }
  }
  if (const VtpArray* radius = find(file.point_data, "radius", 1)) {
    require_finite(radius->value, "radius");
    scene.radius = radius->value;
  }
  if (const VtpArray* on_axis = find(file.point_data, "on_axis", 1)) {
    for (const double v : on_axis->value) scene.on_axis.push_back(v != 0);
  }
  if (const VtpArray* box = find(file.field_data, "undecided_box", 6)) {
    detail::require_coordinates(box->value);
    for (const auto& b : tuples<6>(box->value)) {
      scene.undecided.push_back({Point3{b[0], b[1], b[2]}, Point3{b[3], b[4], b[5]}});
    }
  }
}

fs::path with_suffix(const fs::path& prefix, const char* suffix) {
  fs::path file = prefix;
  file += suffix;
  return file;
}

}  // namespace

Box3 bounds_of(const Scene& scene) {
  std::vector<Point3> all = scene.point;
  all.insert(all.end(), scene.model_point.begin(), scene.model_point.end());
  for (const auto& corners : scene.undecided) all.insert(all.end(), corners.begin(), corners.end());
  BLUM_REQUIRE(!all.empty());
  return bounds_of(std::span<const Point3>(all));
}

Result<Scene> read_scene(const fs::path& result) {
  const bool is_file = result.extension() == ".vtp";
  const fs::path vtp = is_file ? result : with_suffix(result, ".vtp");
  const fs::path prefix = is_file ? fs::path(result).replace_extension() : result;
  Result<VtpFile> read = read_vtp(vtp);
  if (!read) return read.error();
  const VtpFile& file = read.value();
  Scene scene;
  try {
    scene.point = file.point;
    scene.triangle = file.triangle;
    scene.line = file.line;
    read_model(file, scene);
    read_governors(file, scene);
    read_fields(file, scene);
    read_axis(file, scene);
    scene.fact = detail::facts_of(file, scene);
    scene.title = detail::title_of(file, scene, with_suffix(prefix, ".json"))
                      .value_or(prefix.filename().string());
  } catch (const Malformed& problem) {
    return Error{ErrorCode::kMalformedFile, problem.message, vtp.string(), std::nullopt};
  }
  if (scene.point.empty() && scene.model_point.empty() && scene.undecided.empty()) {
    return Error{ErrorCode::kMalformedFile, "nothing to show in it", vtp.string(), std::nullopt};
  }
  return scene;
}

}  // namespace blum
