// Extruded shapes: all facets are axis-parallel or vertical, so their polygons are exactly planar.
#include <algorithm>
#include <cmath>
#include <limits>

#include "blum/kernel/check.hpp"
#include "blum/kernel/shapes.hpp"
#include "shapes_circle.hpp"

namespace blum::shapes {
namespace {

using Loop = std::vector<std::uint32_t>;
using Outline = std::vector<std::array<double, 2>>;

/// Appends the outline (counter-clockwise seen from above) at height z.
Loop add_loop(PolygonMesh& mesh, const Outline& outline, double z) {
  Loop loop;
  for (const auto& [x, y] : outline) {
    loop.push_back(static_cast<std::uint32_t>(mesh.points.size()));
    mesh.points.push_back({x, y, z});
  }
  return loop;
}

/// Vertical walls between two loops; the solid lies inside the loop, or outside for a hole.
void add_walls(PolygonMesh& mesh, const Loop& low, const Loop& high, bool is_hole) {
  for (std::size_t i = 0; i < low.size(); ++i) {
    std::size_t a = i, b = (i + 1) % low.size();
    if (is_hole) std::swap(a, b);
    mesh.faces.push_back({low[a], low[b], high[b], high[a]});
  }
}

Loop reversed(Loop loop) {
  std::reverse(loop.begin(), loop.end());
  return loop;
}

PolygonMesh extrude(const Outline& outline, double z0, double z1) {
  PolygonMesh mesh;
  const Loop low = add_loop(mesh, outline, z0), high = add_loop(mesh, outline, z1);
  mesh.faces.push_back(reversed(low));
  mesh.faces.push_back(high);
  add_walls(mesh, low, high, false);
  return mesh;
}

/// The corners from `first` back to `last`, against the loop's direction, both included.
void append_backwards(Loop& polygon, const Loop& loop, std::size_t first, std::size_t last) {
  for (std::size_t i = first;; i = (i + loop.size() - 1) % loop.size()) {
    polygon.push_back(loop[i]);
    if (i == last) return;
  }
}

/// A hole in a rectangular facet, with a leftmost and a rightmost corner.
struct Hole {
  Loop loop;
  std::size_t left, right;
};

/// Cuts the rectangle `outer` (counter-clockwise from its lower left corner) with a row of holes,
/// each right of the one before, into the polygons below and above the chain lower left corner -
/// holes - upper right corner. The chain meets no hole: between two holes it runs right of the
/// first and left of the second.
std::array<Loop, 2> cut_rectangle(const Loop& outer, const std::vector<Hole>& holes) {
  Loop below{outer[0], outer[1], outer[2]}, above{outer[2], outer[3], outer[0]};
  for (auto hole = holes.rbegin(); hole != holes.rend(); ++hole) {
    append_backwards(below, hole->loop, hole->right, hole->left);
  }
  for (const Hole& hole : holes) append_backwards(above, hole.loop, hole.left, hole.right);
  return {below, above};
}

Outline rectangle(double a, double b) { return {{0, 0}, {a, 0}, {a, b}, {0, b}}; }

double moved(double x, Move move) {
  x += move.amount;
  const double goal = std::copysign(std::numeric_limits<double>::infinity(), move.ulps);
  for (int i = 0; i < std::abs(move.ulps); ++i) x = std::nextafter(x, goal);
  return x;
}

}  // namespace

PolygonMesh cuboid(double a, double b, double c) {
  BLUM_CHECK(a > 0 && b > 0 && c > 0);
  return extrude(rectangle(a, b), 0, c);
}

PolygonMesh lbracket(double a, double b, double t, double depth) {
  BLUM_CHECK(0 < t && t < std::min(a, b) && depth > 0);
  return extrude({{0, 0}, {a, 0}, {a, t}, {t, t}, {t, b}, {0, b}}, 0, depth);
}

PolygonMesh lpocket(double w, double depth, double floor) {
  BLUM_CHECK(w > 0 && depth > 0 && floor > 0);
  const Outline pocket{{w, w},         {3 * w, w},     {3 * w, 2 * w},
                       {2 * w, 2 * w}, {2 * w, 3 * w}, {w, 3 * w}};
  PolygonMesh mesh;
  const Loop bottom = add_loop(mesh, rectangle(4 * w, 4 * w), 0);
  const Loop top = add_loop(mesh, rectangle(4 * w, 4 * w), floor + depth);
  const Loop ground = add_loop(mesh, pocket, floor);
  const Loop rim = add_loop(mesh, pocket, floor + depth);
  mesh.faces.push_back(reversed(bottom));
  mesh.faces.push_back(ground);
  for (Loop& piece : cut_rectangle(top, {{rim, 0, 2}})) mesh.faces.push_back(std::move(piece));
  add_walls(mesh, bottom, top, false);
  add_walls(mesh, ground, rim, true);
  return mesh;
}

PolygonMesh prism(int n, double radius, double height, Move move) {
  BLUM_CHECK(n >= 3 && radius > 0 && height > 0);
  Outline outline;
  for (int k = 0; k < n; ++k) {
    const auto [c, s] = unit_circle(k, n);
    outline.push_back({radius * c, radius * s});
  }
  PolygonMesh mesh = extrude(outline, 0, height);
  if (move.amount == 0 && move.ulps == 0) return mesh;

  const auto corner = static_cast<std::uint32_t>(n);
  mesh.points[corner].x = moved(mesh.points[corner].x, move);
  mesh.points[corner].z = moved(mesh.points[corner].z, move);
  std::vector<Loop> ears;
  for (Loop& face : mesh.faces) {
    const auto at = std::find(face.begin(), face.end(), corner);
    if (at == face.end() || face.size() == 3) continue;
    std::rotate(face.begin(), at, face.end());
    ears.push_back({face.back(), face[0], face[1]});
    face.erase(face.begin());
  }
  mesh.faces.insert(mesh.faces.end(), ears.begin(), ears.end());
  return mesh;
}

PolygonMesh plate(int count, int sides, double pitch, double thickness) {
  BLUM_CHECK(count >= 0 && sides >= 3 && pitch > 0 && thickness > 0);
  const Outline outline = rectangle(pitch * std::max(count, 1), pitch);
  if (count == 0) return extrude(outline, 0, thickness);
  PolygonMesh mesh;
  const Loop bottom = add_loop(mesh, outline, 0), top = add_loop(mesh, outline, thickness);
  add_walls(mesh, bottom, top, false);
  std::vector<Hole> low, high;
  for (int i = 0; i < count; ++i) {
    Outline hole;
    for (int k = 0; k < sides; ++k) {
      const auto [c, s] = unit_circle(k, sides);
      hole.push_back({pitch * (i + 0.5) + pitch / 4 * c, pitch / 2 + pitch / 4 * s});
    }
    const auto left = static_cast<std::size_t>(sides / 2);
    low.push_back({add_loop(mesh, hole, 0), left, 0});
    high.push_back({add_loop(mesh, hole, thickness), left, 0});
    add_walls(mesh, low.back().loop, high.back().loop, true);
  }
  for (const Loop& piece : cut_rectangle(bottom, low)) mesh.faces.push_back(reversed(piece));
  for (Loop& piece : cut_rectangle(top, high)) mesh.faces.push_back(std::move(piece));
  return mesh;
}

PolygonMesh nested_voids(int k) {
  BLUM_CHECK(k >= 1);
  PolygonMesh mesh;
  for (int j = 0; j < 2 * k; ++j) {
    // Sides of three lengths, so that only the distance between the walls is degenerate.
    const double x = 2 * k - j, y = x + 0.5, z = x + 1;
    const Outline outline{{-x, -y}, {x, -y}, {x, y}, {-x, y}};
    const Loop low = add_loop(mesh, outline, -z), high = add_loop(mesh, outline, z);
    const bool is_void = j % 2 == 1;
    mesh.faces.push_back(is_void ? low : reversed(low));
    mesh.faces.push_back(is_void ? reversed(high) : high);
    add_walls(mesh, low, high, is_void);
  }
  return mesh;
}

}  // namespace blum::shapes
