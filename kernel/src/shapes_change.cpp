#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "blum/kernel/shapes.hpp"
#include "shapes_random.hpp"

namespace blum::shapes {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

/// Uniform in SO(3): Shoemake, "Uniform random rotations", Graphics Gems III.
Matrix random_rotation(Random& random) {
  const double u = random.unit(), a = 2 * std::numbers::pi * random.unit(),
               b = 2 * std::numbers::pi * random.unit();
  const double x = std::sqrt(1 - u) * std::sin(a), y = std::sqrt(1 - u) * std::cos(a);
  const double z = std::sqrt(u) * std::sin(b), w = std::sqrt(u) * std::cos(b);
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
           {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
           {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}};
}

/// The midpoint, if doubles hold it exactly.
std::optional<Point3> exact_midpoint(const Point3& a, const Point3& b) {
  Point3 middle;
  for (int axis = 0; axis < 3; ++axis) {
    const double sum = a[axis] + b[axis], half = sum / 2;
    // Knuth's TwoSum: the rounding error of the sum is exactly representable.
    const double b_part = sum - a[axis], a_part = sum - b_part;
    if ((a[axis] - a_part) + (b[axis] - b_part) != 0 || half * 2 != sum) return std::nullopt;
    middle[axis] = half;
  }
  return middle;
}

}  // namespace

PolygonMesh split_edges(const PolygonMesh& mesh, std::uint64_t seed) {
  Random random(seed);
  PolygonMesh result{mesh.points, {}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::optional<std::uint32_t>> middle;
  for (const auto& face : mesh.faces) {
    auto& polygon = result.faces.emplace_back();
    for (std::size_t i = 0; i < face.size(); ++i) {
      const std::uint32_t a = face[i], b = face[(i + 1) % face.size()];
      polygon.push_back(a);
      const auto [entry, is_new] = middle.try_emplace(std::minmax(a, b));
      if (is_new && random.bits() % 2 == 0) {
        if (const auto point = exact_midpoint(mesh.points[a], mesh.points[b])) {
          entry->second = static_cast<std::uint32_t>(result.points.size());
          result.points.push_back(*point);
        }
      }
      if (entry->second) polygon.push_back(*entry->second);
    }
  }
  return result;
}

PolygonMesh rotate_rounded(const PolygonMesh& mesh, std::uint64_t seed) {
  const auto is_triangle = [](const auto& face) { return face.size() == 3; };
  PolygonMesh result = std::all_of(mesh.faces.begin(), mesh.faces.end(), is_triangle)
                           ? mesh
                           : triangulate_facets(mesh, seed);
  Random random(seed);
  const Matrix rotation = random_rotation(random);
  for (Point3& point : result.points) {
    const Point3 p = point;
    for (int axis = 0; axis < 3; ++axis) {
      point[axis] = rotation[axis][0] * p.x + rotation[axis][1] * p.y + rotation[axis][2] * p.z;
    }
  }
  return result;
}

PolygonMesh shuffle(const PolygonMesh& mesh, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::uint32_t> order(mesh.points.size());
  std::iota(order.begin(), order.end(), 0u);
  random.shuffle(order);
  PolygonMesh result{std::vector<Point3>(mesh.points.size()), mesh.faces};
  for (std::size_t v = 0; v < order.size(); ++v) result.points[order[v]] = mesh.points[v];
  for (auto& face : result.faces) {
    for (std::uint32_t& v : face) v = order[v];
    std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(random.below(face.size())),
                face.end());
  }
  random.shuffle(result.faces);
  return result;
}

}  // namespace blum::shapes
