#include "look_ahead.hpp"

#include <numeric>
#include <tuple>

#include "blum/kernel/point_algebra.hpp"
#include "leaf_triangles.hpp"
#include "place.hpp"

namespace blum {

bool fine_enough(const SiteGeometry& geometry, const Leaf& leaf, EngineSet& engines, int thread,
                 BoundTools& tools, const LookAhead& look) {
  if (diameter(leaf.box) <= look.target) return true;
  CellComplex complex = leaf_complex(geometry, leaf, engines, thread);
  if (complex.triangle.empty()) return true;  // not to be told here
  const Parts parts = read_parts(complex);
  const ConeSides sides(complex.cone.size(), std::make_shared<const LeafSides>(geometry, leaf));
  std::ignore = place_points(geometry, engines.inside(), parts, sides, complex,
                             {.stop = &engines.watch().flag()});
  const AxisMesh mesh = mesh_of(geometry, engines.inside(), complex, parts, sides,
                                {.edge_length = look.edge_length, .stop = &engines.watch().flag()});
  std::vector<std::uint32_t> all(mesh.triangle.size());
  std::iota(all.begin(), all.end(), 0u);
  return bound_in_leaf(tools, *sides.front(),
                       leaf_triangles(geometry.solid().frame, mesh, all, *sides.front()),
                       look.target)
      .has_value();
}

}  // namespace blum
