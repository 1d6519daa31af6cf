/// Solids and rectangles for Voronoi diagrams on rectangles.
#pragma once

#include <cmath>
#include <vector>

#include "arrangement/cube_minus_octant.hpp"
#include "arrangement/face_scenes.hpp"
#include "blum/kernel/shapes.hpp"

namespace blum::test {

inline std::vector<Scene> voronoi_scenes() {
  constexpr auto kind = DiagramKind::kVoronoi;
  std::vector<Scene> out;
  out.emplace_back("cuboid", moved(shapes::cuboid(2, 3, 1)), kind);
  out.emplace_back("lbracket", moved(shapes::lbracket()), kind);
  out.emplace_back("tetrahedron",
                   moved({{{0, 0, 0}, {3, 0, 1}, {1, 3, 0}, {1, 1, 3}},
                          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}}),
                   kind);
  out.emplace_back("cube_minus_octant", moved(cube_minus_octant()), kind);
  out.emplace_back("lpocket", moved(shapes::lpocket()), kind);
  out.emplace_back("prism", moved(shapes::prism(6)), kind);
  out.emplace_back("torus", moved(shapes::planar_torus(8, 4, 2, 0.75)), kind);
  out.emplace_back("void", moved(shapes::nested_voids(1)), kind);
  return out;
}

/// Solids with edges that are flat but for rounding: their regions are thinner than doubles tell.
inline std::vector<Scene> nearly_flat_voronoi_scenes() {
  constexpr auto kind = DiagramKind::kVoronoi;
  std::vector<Scene> out;
  out.emplace_back("rounded torus", moved(shapes::torus(8, 4, 2, 0.75)), kind);
  out.emplace_back("turned cuboid", shapes::rotate_rounded(shapes::cuboid(2, 3, 1), 1), kind);
  out.emplace_back("turned bracket", shapes::rotate_rounded(shapes::lbracket(), 2), kind);
  out.emplace_back("turned prism", shapes::rotate_rounded(shapes::prism(6), 3), kind);
  return out;
}

/// A rectangle about a point near the boundary or in the box around the solid.
inline Rect voronoi_rect(Random& random, const Scene& scene) {
  const double size = scene.extent() * std::exp(uniform(random, std::log(0.02), std::log(0.6)));
  Point3 c;
  for (int k = 0; k < 3; ++k) {
    const double margin = 0.3 * (scene.bounds.hi[k] - scene.bounds.lo[k]);
    c[k] = uniform(random, scene.bounds.lo[k] - margin, scene.bounds.hi[k] + margin);
  }
  if (random() % 3 != 0) {  // about a point of an edge, or beyond it
    const auto& e = scene.solid->edge[random() % scene.solid->edge.size()];
    const Point3 &a = scene.solid->point[e.vertex[0]], &b = scene.solid->point[e.vertex[1]];
    const double s = uniform(random, -0.1, 1.1);
    for (int k = 0; k < 3; ++k)
      c[k] = a[k] + s * (b[k] - a[k]) + 0.4 * size * uniform(random, -1, 1);
  }
  Rect r;
  r.axis = static_cast<int>(random() % 3);
  r.level = c[r.axis];
  const int u = u_axis(r.axis), v = v_axis(r.axis);
  const double hu = size * uniform(random, 0.3, 1), hv = size * uniform(random, 0.3, 1);
  r.u0 = c[u] - hu;
  r.u1 = c[u] + hu;
  r.v0 = c[v] - hv;
  r.v1 = c[v] + hv;
  return r;
}

}  // namespace blum::test
