#include <algorithm>
#include <utility>

#include "exact_geometry.hpp"
#include "mesh_box_tree.hpp"
#include "validate_surface.hpp"

namespace blum {
namespace {

// A mesh made to have a quadratic number of intersections must not cost that much: the count then
// becomes a lower bound.
constexpr std::size_t kMaxPairs = 1'000'000;

}  // namespace

void find_self_intersections(std::span<const Point3> points, const Surface& surface,
                             DefectCollector& defects) {
  const auto& triangle = surface.triangle;
  std::vector<Box3> boxes;
  boxes.reserve(triangle.size());
  for (const auto& t : triangle) boxes.push_back(box_of(points[t[0]], points[t[1]], points[t[2]]));
  const BoxTree tree(std::move(boxes));
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  bool complete = true;
  for (std::uint32_t i = 0; i < triangle.size() && complete; ++i) {
    const std::uint32_t face_i = surface.face_of_triangle[i];
    tree.visit_meeting(tree.boxes()[i], [&](std::uint32_t j) {
      if (j <= i || surface.face_of_triangle[j] == face_i) return;
      if (!exact::triangles_meet_improperly(points, triangle[i], triangle[j])) return;
      pairs.emplace_back(face_i, surface.face_of_triangle[j]);
    });
    complete = pairs.size() < kMaxPairs;
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<std::uint32_t> first_triangle;
  for (std::uint32_t t = 0; t < triangle.size(); ++t) {
    const std::uint32_t face = surface.face_of_triangle[t];
    if (first_triangle.size() <= face) first_triangle.resize(face + 1, t);
  }
  for (const auto& [f, g] : pairs) {
    defects.add(DefectKind::kSelfIntersection, {f, g},
                std::array{triangle[first_triangle[f]][0], triangle[first_triangle[g]][0]});
  }
  if (!complete) defects.mark_as_lower_bound(DefectKind::kSelfIntersection);
}

}  // namespace blum
