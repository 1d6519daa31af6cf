/// Rectangles in degenerate solids and special positions: coincidences, and what is next to them.
#pragma once

#include "arrangement/face_scenes.hpp"

namespace blum::test {

/// Rectangles whose coordinates coincide with something: vertices, middles, ties.
inline void special_problems(Random& random, const auto& use) {
  for (const Scene& s : catalogue(random)) use(s, special_rect(random, s));
}

/// Sections of a square bar, exact and nearly so: four walls at one event, or at two.
inline void square_sections(Random& random, const auto& use) {
  for (const double e : {0.0, 0x1p-51, -0x1p-51, 0x1p-48, 1e-12, -1e-12, 1e-6, -1e-6}) {
    const Scene s("square section", shapes::cuboid(5, 2, 2 + e));
    const auto low = [&] { return uniform(random, 0.2, 0.9); };
    const auto high = [&] { return uniform(random, 1.1, 1.8); };
    use(s, s.rect(0, uniform(random, 1.2, 3.8), low(), high(), low(), high()));
  }
}

/// Axes of regular prisms: n walls nearly tie there; and with a corner moved.
inline void prism_axes(Random& random, const auto& use) {
  for (int n = 3; n <= 8; ++n)
    for (const shapes::Move move : {shapes::Move{0, 0}, {0, 1}, {1e-12, 0}, {1e-6, 0}}) {
      const Scene s("prism " + std::to_string(n), moved(shapes::prism(n, 1, 4, move)));
      const double h = uniform(random, 0.02, 0.3);
      const auto side = [&](int sign) { return 5 + sign * h * uniform(random, 0.3, 1); };
      use(s, s.rect(2, 5 + uniform(random, 1.3, 2.7), side(-1), side(1), side(-1), side(1)));
    }
}

/// Eight walls with small integer normals, exactly at the same distance from an axis.
inline PolygonMesh exact_octagon() {
  PolygonMesh m;
  const double c[8][2] = {{5, -2.5}, {5, 2.5},   {1, 5.5},   {-1, 5.5},
                          {-5, 2.5}, {-5, -2.5}, {-1, -5.5}, {1, -5.5}};
  for (const double z : {0.0, 20.0})
    for (const auto& p : c) m.points.push_back({p[0], p[1], z});
  m.faces = {{7, 6, 5, 4, 3, 2, 1, 0}, {8, 9, 10, 11, 12, 13, 14, 15}};
  for (std::uint32_t k = 0; k < 8; ++k) m.faces.push_back({k, (k + 1) % 8, (k + 1) % 8 + 8, k + 8});
  return m;
}

inline void octagon_axes(Random& random, const auto& use) {
  const Scene s("octagon", moved(exact_octagon()));
  for (int k = 0; k < 6; ++k) {
    const auto r = [&](double sign) { return 5 + sign * uniform(random, 0.1, 2); };
    use(s, s.rect(2, 5 + uniform(random, 6, 14), r(-1), r(1), r(-1), r(1)));
  }
}

/// Corners on a tie and beside it; mid-planes of sheets and beside them.
inline void corners_and_mid_planes(const auto& use) {
  const Scene s("cuboid", shapes::cuboid(4, 3, 2));
  for (const double e : {0.0, 0x1p-50, -0x1p-50, 1e-12, -1e-12}) {
    use(s, s.rect(2, 0.75, 0.25 + e, 1.5, 0.25, 1.25));
    use(s, s.rect(2, 0.75, -1, 0.5 + e, -1, 0.5));
    use(s, s.rect(0, 2.125, 0.5 + e, 2.5625, 0.5, 1.75));
    use(s, s.rect(2, 1 + e, 0.5, 3.6875, 0.4375, 2.625));
    use(s, s.rect(2, 1 + e, 1.5, 2.5, 1.25, 1.75));
  }
}

/// Rims inside the solid, on solids with exact coordinates.
inline void rim_problems(Random& random, const auto& use) {
  std::vector<Scene> scenes;
  scenes.emplace_back("lpocket", shapes::lpocket());
  scenes.emplace_back("triangulated lpocket",
                      shapes::triangulate_facets(shapes::lpocket(), random()));
  scenes.emplace_back("split lpocket", shapes::split_edges(shapes::lpocket(), random()));
  for (const Scene& s : scenes)
    for (int k = 0; k < 3; ++k) {
      const auto rim = random_rim_point(random, s);
      if (!rim) continue;
      const double h = s.extent() * uniform(random, 0.005, 0.06);
      const auto r = [&] { return h * uniform(random, 0.1, 1); };
      use(s, Rect{2, rim->z, rim->x - r(), rim->x + r(), rim->y - r(), rim->y + r()});
    }
}

/// Solids and rectangles with coordinates of a few bits: what CGAL's slower methods can do.
inline void small_integer_problems(Random& random, const auto& use) {
  std::vector<Scene> scenes;
  scenes.emplace_back("cuboid", shapes::cuboid(4, 3, 2));
  scenes.emplace_back("square cuboid", shapes::cuboid(4, 2, 2));
  scenes.emplace_back("lbracket", shapes::lbracket());
  scenes.emplace_back("lpocket", shapes::lpocket());
  scenes.emplace_back("octagon", exact_octagon());
  for (const Scene& s : scenes) {
    const double unit = std::exp2(std::floor(std::log2(s.extent())) - 5);
    const auto coordinate = [&](int axis, double lo, double hi) {  // odd multiples of the unit
      const double x =
          uniform(random, s.bounds.lo[axis] + lo * s.extent(), s.bounds.lo[axis] + hi * s.extent());
      return (2 * std::floor(x / (2 * unit)) + 1) * unit;
    };
    Rect r;
    r.axis = static_cast<int>(random() % 3);
    const int u = u_axis(r.axis), v = v_axis(r.axis);
    r.level = coordinate(r.axis, 0, 0.6);
    r.u0 = coordinate(u, -0.1, 0.3);
    r.u1 = coordinate(u, 0.45, 0.8);
    r.v0 = coordinate(v, -0.1, 0.3);
    r.v1 = coordinate(v, 0.45, 0.8);
    use(s, r);
  }
}

/// One round of each.
inline void degenerate_problems(Random& random, const auto& use) {
  special_problems(random, use);
  square_sections(random, use);
  prism_axes(random, use);
  octagon_axes(random, use);
  rim_problems(random, use);
}

}  // namespace blum::test
