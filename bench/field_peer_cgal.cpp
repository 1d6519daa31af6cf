// The CGAL AABB tree, closest points hinted with the last one. (GPL: in the benchmark alone.)
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>

#include "blum/kernel/parallel.hpp"
#include "field_peers.hpp"

namespace blum::bench {

std::vector<float> cgal_distances(const SiteSet& sites, const VoxelGrid& grid, int threads) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Triangles = std::vector<Kernel::Triangle_3>;
  using Tree = CGAL::AABB_tree<
      CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::iterator>>>;
  const auto point = [](const Point3& p) { return Kernel::Point_3(p.x, p.y, p.z); };
  Triangles triangles;
  for (const auto& t : sites.triangles()) {
    triangles.emplace_back(point(sites.points()[t.point[0]]), point(sites.points()[t.point[1]]),
                           point(sites.points()[t.point[2]]));
  }
  Tree tree(triangles.begin(), triangles.end());
  tree.build();
  std::vector<float> out(grid.voxels());
  for_each_in_parallel(threads, grid.size[2], [&](int, std::size_t k) {
    auto hint = triangles[0].vertex(0);
    for (std::uint32_t j = 0; j < grid.size[1]; ++j) {
      for (std::uint32_t i = 0; i < grid.size[0]; ++i) {
        const auto q = point(grid.point(i, j, static_cast<std::uint32_t>(k)));
        hint = tree.closest_point(q, hint);
        out[grid.index(i, j, static_cast<std::uint32_t>(k))] =
            static_cast<float>(std::sqrt(CGAL::squared_distance(q, hint)));
      }
    }
  });
  return out;
}

}  // namespace blum::bench
