#include "flatten_slivers.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "blum/kernel/point_algebra.hpp"
#include "exact_geometry.hpp"

namespace blum {
namespace {

using Face = std::vector<std::uint32_t>;
using Side = std::pair<std::uint32_t, std::uint32_t>;  // in the direction of its face

bool has_collapsed(const PolygonMesh& before, const PolygonMesh& after, const Face& face) {
  if (face.size() != 3) return false;
  const auto turn = [&](const PolygonMesh& mesh, int axis) {
    return exact::orient2d_along(axis, mesh.points[face[0]], mesh.points[face[1]],
                                 mesh.points[face[2]]);
  };
  const auto at = [&](int k) -> const Point3& { return after.points[face[k]]; };
  if (exact::collinear(at(0), at(1), at(2))) return true;
  for (int axis = 0; axis < 3; ++axis) {
    if (at(0)[axis] == at(1)[axis] && at(0)[axis] == at(2)[axis]) {
      return turn(after, axis) * turn(before, axis) < 0;
    }
  }
  return false;
}

/// Begins the triangle at the corner opposite its longest side.
void begin_at_middle(const PolygonMesh& mesh, Face& triangle) {
  const auto opposite = [&](int k) {
    return distance_between(mesh.points[triangle[(k + 1) % 3]], mesh.points[triangle[(k + 2) % 3]]);
  };
  int middle = 0;
  for (int k = 1; k < 3; ++k) {
    if (opposite(k) > opposite(middle)) middle = k;
  }
  std::rotate(triangle.begin(), triangle.begin() + middle, triangle.end());
}

std::map<Side, std::uint32_t> faces_along_sides(const PolygonMesh& mesh) {
  std::map<Side, std::uint32_t> face_along;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const Face& face = mesh.faces[f];
    for (std::size_t k = 0; k < face.size(); ++k) {
      face_along[{face[k], face[(k + 1) % face.size()]}] = f;
    }
  }
  return face_along;
}

}  // namespace

std::size_t drop_collapsed_triangles(const PolygonMesh& before, PolygonMesh& after) {
  std::vector<std::uint32_t> collapsed;
  for (std::uint32_t f = 0; f < after.faces.size(); ++f) {
    if (has_collapsed(before, after, after.faces[f])) collapsed.push_back(f);
  }
  if (collapsed.empty()) return 0;

  for (const std::uint32_t f : collapsed) begin_at_middle(after, after.faces[f]);
  std::vector<bool> is_sliver(after.faces.size(), false);
  for (const std::uint32_t f : collapsed) is_sliver[f] = true;
  std::map<Side, std::uint32_t> face_along = faces_along_sides(after);
  // A sliver beside a sliver waits until that one is gone.
  for (std::size_t left = collapsed.size() + 1; collapsed.size() < left;) {
    left = collapsed.size();
    std::erase_if(collapsed, [&](std::uint32_t f) {
      const Face& sliver = after.faces[f];
      const std::uint32_t b = sliver[0], c = sliver[1], a = sliver[2];
      const std::uint32_t heir = face_along.at({a, c});
      if (is_sliver[heir]) return false;
      Face& face = after.faces[heir];
      face.insert(std::find(face.begin(), face.end(), c), b);
      face_along[{a, b}] = face_along[{b, c}] = heir;
      after.faces[f].clear();
      return true;
    });
  }
  return std::erase_if(after.faces, [](const Face& face) { return face.empty(); });
}

}  // namespace blum
