#include "blum/kernel/flatten.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "blum/kernel/point_algebra.hpp"
#include "flat_edges.hpp"
#include "flatten_levels.hpp"
#include "flatten_slivers.hpp"
#include "validate_surface.hpp"

namespace blum {
namespace {

/// What an axis may have of the tolerance: less than 1/sqrt(3), by more than rounding can add.
constexpr double kShareOfAnAxis = 0.577;
/// Cosine of the largest angle between an axis and what is nearly parallel to it. Noise turns small
/// faces and edges far more than large ones, so this is no small angle.
constexpr double kNearlyParallel = 0.9;

using Face = std::vector<std::uint32_t>;

Point3 newell_normal(const std::vector<Point3>& points, const Face& face) {
  Point3 n;
  for (std::size_t k = 1; k + 1 < face.size(); ++k) {
    const Point3 part =
        cross(points[face[k]] - points[face[0]], points[face[k + 1]] - points[face[0]]);
    for (int axis = 0; axis < 3; ++axis) n[axis] += part[axis];
  }
  return n;
}

bool is_nearly_parallel(const Point3& direction, int axis) {
  return std::abs(direction[axis]) > kNearlyParallel * length(direction);
}

/// Which vertices' coordinates along an axis are those of a nearly axis-parallel facet or edge that
/// moves of at most `reach` can make exactly parallel?
std::vector<bool> level_vertices(const PolygonMesh& mesh, int axis, double reach) {
  std::vector<bool> level(mesh.points.size(), false);
  const auto at = [&](std::uint32_t v) -> const Point3& { return mesh.points[v]; };
  for (const Face& face : mesh.faces) {
    const auto [low, high] = std::minmax_element(
        face.begin(), face.end(),
        [&](std::uint32_t v, std::uint32_t w) { return at(v)[axis] < at(w)[axis]; });
    if (at(*high)[axis] - at(*low)[axis] <= 2 * reach &&
        is_nearly_parallel(newell_normal(mesh.points, face), axis)) {
      for (const std::uint32_t v : face) level[v] = true;
    }
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::uint32_t v = face[k], w = face[(k + 1) % face.size()];
      const Point3 along = at(w) - at(v);
      for (const int upright : {u_axis(axis), v_axis(axis)}) {
        const int other = 3 - axis - upright;
        if (std::max(std::abs(along[axis]), std::abs(along[other])) <= 2 * reach &&
            is_nearly_parallel(along, upright)) {
          level[v] = level[w] = true;
        }
      }
    }
  }
  return level;
}

void put_on_levels(PolygonMesh& mesh, int axis, const std::vector<bool>& is_level, double reach) {
  std::vector<double> coordinates;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (is_level[v]) coordinates.push_back(mesh.points[v][axis]);
  }
  const Levels levels(std::move(coordinates), reach);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    double& x = mesh.points[v][axis];
    // Not assigned where it is equal: -0 stays what it is.
    if (const double level = is_level[v] ? levels.level_of(x) : x; level != x) x = level;
  }
}

Error broken(const std::string& what) {
  return {
      ErrorCode::kInvalidSolid,
      "the coplanar tolerance is too large for this solid: with its facets made coplanar it is " +
          what,
      {},
      std::nullopt};
}

FlattenReport::Edges count_edges(const Solid& solid, double tolerance) {
  const std::vector<bool> nearly_flat = nearly_flat_edges(solid, tolerance);
  return {static_cast<std::size_t>(
              std::count_if(solid.edge.begin(), solid.edge.end(),
                            [](const SolidEdge& e) { return e.kind == EdgeKind::kFlat; })),
          static_cast<std::size_t>(std::count(nearly_flat.begin(), nearly_flat.end(), true))};
}

}  // namespace

Result<Flattened> flatten_facets(const PolygonMesh& mesh, double tolerance) {
  if (!(tolerance >= 0 && tolerance <= 1)) {
    return Error{ErrorCode::kBadArgument, "the coplanar tolerance is not in [0, 1]", {}, {}};
  }
  const Surface surface = analyse_surface(mesh);
  const Result<Solid> solid = build_solid(mesh, surface);
  if (!solid) return solid.error();

  Flattened flattened{mesh, {}, {}};
  PolygonMesh& changed = flattened.mesh;
  FlattenReport& report = flattened.report;
  report.tolerance = tolerance;
  const double allowed = tolerance * diameter(bounds_of(mesh.points)),
               reach = kShareOfAnAxis * allowed;
  for (int axis = 0; axis < 3; ++axis) {
    // What is level is read off the mesh as given, so that the axes do not influence each other.
    put_on_levels(changed, axis, level_vertices(mesh, axis, reach), reach);
  }
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (changed.points[v] == mesh.points[v]) continue;
    ++report.vertices_moved;
    report.largest_displacement =
        std::max(report.largest_displacement, distance_between(changed.points[v], mesh.points[v]));
  }
  report.slivers_dropped = drop_collapsed_triangles(mesh, changed);

  const Surface changed_surface = analyse_surface(changed);
  Result<Solid> changed_solid = build_solid(changed, changed_surface);
  if (!changed_solid) return broken(changed_solid.error().message);
  if (changed_surface.inverted != surface.inverted ||
      changed_solid.value().betti() != solid.value().betti()) {
    return broken("a solid of other Betti numbers, or inside out");
  }
  report.before = count_edges(solid.value(), allowed);
  report.after = count_edges(changed_solid.value(), allowed);
  flattened.solid = std::move(changed_solid).value();
  return flattened;
}

}  // namespace blum
