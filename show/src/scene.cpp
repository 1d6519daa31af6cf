#include "blum/show/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "blum/kernel/point_algebra.hpp"
#include "blum/show/vtp_file.hpp"

namespace blum {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

struct Malformed {
  std::string message;
};

const VtpArray* find(const VtpArrays& arrays, const char* name, int components) {
  const auto found = arrays.find(name);
  if (found == arrays.end()) return nullptr;
  if (found->second.components != components) {
    throw Malformed{std::string("array ") + name + " has another number of components"};
  }
  return &found->second;
}

/// An array of indices below `end`.
template <class Index>
std::vector<Index> indices(const VtpArray& array, double end, const char* name) {
  std::vector<Index> list;
  list.reserve(array.value.size());
  for (const double v : array.value) {
    if (!(v >= 0 && v < end)) throw Malformed{std::string(name) + ": an index out of range"};
    list.push_back(static_cast<Index>(v));
  }
  return list;
}

/// A whole number that fits.
template <class Int>
Int whole(double value, const char* name) {
  if (!(value >= static_cast<double>(std::numeric_limits<Int>::min()) &&
        value <= static_cast<double>(std::numeric_limits<Int>::max()))) {
    throw Malformed{std::string(name) + ": a number out of range"};
  }
  return static_cast<Int>(value);
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
      const double length = std::sqrt(inner(n, n) * inner(other->second, other->second));
      if (!(inner(n, other->second) >= most * length)) visible.push_back(edge);
    }
  }
  return visible;
}

void read_model(const VtpFile& file, Scene& scene) {
  const VtpArray* points = find(file.field_data, "solid_points", 3);
  const VtpArray* triangles = find(file.field_data, "solid_triangles", 3);
  if (points == nullptr || triangles == nullptr) return;
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
    for (int k = 0; k < 3; ++k) {
      scene.site_counts[k] = whole<std::uint32_t>(counts->value[k], "site_counts");
    }
    if (scene.site_counts != std::array{static_cast<std::uint32_t>(scene.model_point.size()),
                                        static_cast<std::uint32_t>(scene.model_edge.size()),
                                        static_cast<std::uint32_t>(scene.model_triangle.size())}) {
      throw Malformed{"site_counts are not the numbers of the model's elements"};
    }
  }
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
  for (std::size_t i = file.line.size(); i < a->value.size(); ++i) {
    if (!(a->value[i] < sites && b->value[i] < sites)) throw Malformed{"a governor is no site"};
    scene.triangle_governor.push_back(
        {static_cast<std::int64_t>(a->value[i]), static_cast<std::int64_t>(b->value[i])});
  }
}

/// The part of an array of cells that is about triangles.
std::vector<double> of_triangles(const VtpFile& file, const VtpArray& array) {
  return {array.value.begin() + static_cast<std::ptrdiff_t>(file.line.size()), array.value.end()};
}

void read_fields(const VtpFile& file, Scene& scene) {
  const auto add_of_cells = [&](const char* name, bool is_label) {
    if (const VtpArray* array = find(file.cell_data, name, 1)) {
      scene.field.push_back({name, true, is_label, of_triangles(file, *array)});
    }
  };
  const auto add_of_points = [&](const char* name) {
    if (const VtpArray* array = find(file.point_data, name, 1)) {
      scene.field.push_back({name, false, false, array->value});
    }
  };
  add_of_points("thickness");
  add_of_cells("thickness", false);
  add_of_points("radius");
  const VtpArray* lo = find(file.cell_data, "angle_lo", 1);
  const VtpArray* hi = find(file.cell_data, "angle_hi", 1);
  if (lo != nullptr && hi != nullptr) {
    const auto low = of_triangles(file, *lo), high = of_triangles(file, *hi);
    ScalarField angle{"angle", true, false, high};
    for (std::size_t i = 0; i < high.size(); ++i) scene.triangle_angle.push_back({low[i], high[i]});
    scene.field.push_back(std::move(angle));
  }
  add_of_cells("sheet", true);
}

void read_axis(const VtpFile& file, Scene& scene) {
  if (const VtpArray* theta = find(file.cell_data, "theta", 1)) {
    scene.line_theta.assign(theta->value.begin(),
                            theta->value.begin() + static_cast<std::ptrdiff_t>(file.line.size()));
    scene.triangle_theta = of_triangles(file, *theta);
  }
  const VtpArray* seam = find(file.cell_data, "seam", 1);
  for (std::size_t i = 0; i < file.line.size(); ++i) {
    scene.line_seam.push_back(seam != nullptr ? whole<std::int32_t>(seam->value[i], "seam") : -1);
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
  if (const VtpArray* radius = find(file.point_data, "radius", 1)) scene.radius = radius->value;
  if (const VtpArray* on_axis = find(file.point_data, "on_axis", 1)) {
    for (const double v : on_axis->value) scene.on_axis.push_back(v != 0);
  }
  if (const VtpArray* box = find(file.field_data, "undecided_box", 6)) {
    for (const auto& b : tuples<6>(box->value)) {
      scene.undecided.push_back({Point3{b[0], b[1], b[2]}, Point3{b[3], b[4], b[5]}});
    }
  }
}

/// Six digits are enough of a length, counts are whole.
std::string shortest(double value) {
  const bool whole = std::abs(value) < 0x1p53 && value == std::trunc(value);
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), whole ? "%.0f" : "%.6g", value);
  return text.data();
}

/// The one number of an array of one, if it is there.
std::optional<double> single(const VtpFile& file, const char* name) {
  const VtpArray* array = find(file.field_data, name, 1);
  if (array == nullptr || array->value.size() != 1) return std::nullopt;
  return array->value[0];
}

/// What the file itself says, for people.
void add_facts(const VtpFile& file, Scene& scene) {
  if (const auto certified = single(file, "certified")) {
    const bool part = single(file, "pruned").value_or(0) != 0;
    const char* yes = part ? "from a certified axis" : "yes";
    scene.fact.push_back({"certified", *certified != 0 ? yes : "no"});
  }
  if (!scene.undecided.empty()) {
    scene.fact.push_back({"undecided cells", std::to_string(scene.undecided.size())});
  }
  if (const VtpArray* betti = find(file.field_data, "betti", 3);
      betti != nullptr && betti->value.size() == 3) {
    const std::vector<double>& b = betti->value;
    scene.fact.push_back(
        {"Betti numbers", shortest(b[0]) + ' ' + shortest(b[1]) + ' ' + shortest(b[2])});
  }
  for (const auto& [name, title] :
       {std::pair("sheets", "sheets"), std::pair("seams", "seams"),
        std::pair("junctions", "junctions"), std::pair("clusters", "clusters"),
        std::pair("hausdorff_bound", "Hausdorff bound")}) {
    if (const auto value = single(file, name)) scene.fact.push_back({title, shortest(*value)});
  }
}

/// The model's name, which the file does not hold, from the summary of the run that wrote it. That
/// is any file of that name: values are looked at where they are (copies of deep ones recur).
void add_title(const VtpFile& file, const fs::path& path, Scene& scene) {
  std::ifstream stream(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(stream)), {});
  const Json summary = Json::parse(text, nullptr, false);
  const auto member = [](const Json* object, const char* key) -> const Json* {
    if (object == nullptr || !object->is_object()) return nullptr;
    const auto found = object->find(key);
    return found == object->end() ? nullptr : &*found;
  };
  const auto is = [](const Json* value, double number) {
    return value != nullptr && value->is_number_integer() && value->get<double>() == number;
  };
  const VtpArray* seed = find(file.field_data, "seed", 1);
  if (seed == nullptr || seed->value.size() != 1) return;
  if (!is(member(&summary, "seed"), seed->value[0])) return;
  if (!is(member(member(&summary, "sites"), "faces"), scene.site_counts[2])) return;
  const Json* model = member(&summary, "model");
  if (model == nullptr || !model->is_string()) return;
  scene.title = fs::path(model->get_ref<const std::string&>()).filename().string();
}

fs::path with_suffix(const fs::path& prefix, const char* suffix) {
  fs::path file = prefix;
  file += suffix;
  return file;
}

}  // namespace

Result<Scene> read_scene(const fs::path& result) {
  const bool is_file = result.extension() == ".vtp";
  const fs::path vtp = is_file ? result : with_suffix(result, ".vtp");
  const fs::path prefix = is_file ? fs::path(result).replace_extension() : result;
  Result<VtpFile> read = read_vtp(vtp);
  if (!read) return read.error();
  const VtpFile& file = read.value();
  Scene scene;
  scene.title = prefix.filename().string();
  try {
    scene.point = file.point;
    scene.triangle = file.triangle;
    scene.line = file.line;
    read_model(file, scene);
    read_governors(file, scene);
    read_fields(file, scene);
    read_axis(file, scene);
    add_facts(file, scene);
    add_title(file, with_suffix(prefix, ".json"), scene);
  } catch (const Malformed& problem) {
    return Error{ErrorCode::kMalformedFile, problem.message, vtp.string(), std::nullopt};
  }
  if (scene.point.empty() && scene.model_point.empty() && scene.undecided.empty()) {
    return Error{ErrorCode::kMalformedFile, "nothing to show in it", vtp.string(), std::nullopt};
  }
  return scene;
}

}  // namespace blum
