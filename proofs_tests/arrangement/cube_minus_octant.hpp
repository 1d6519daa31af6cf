/// A solid with three reflex edges at a vertex.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "blum/kernel/mesh.hpp"

namespace blum::test {

/// [0,2]^3 without [1,2]^3: three reflex edges at a vertex.
inline PolygonMesh cube_minus_octant() {
  PolygonMesh m;
  const auto id = [&](const Point3& p) {
    const auto it = std::find(m.points.begin(), m.points.end(), p);
    if (it != m.points.end()) return static_cast<std::uint32_t>(it - m.points.begin());
    m.points.push_back(p);
    return static_cast<std::uint32_t>(m.points.size() - 1);
  };
  using Face = std::vector<Point3>;
  for (const Face& f : {Face{{0, 0, 2}, {2, 0, 2}, {2, 1, 2}, {1, 1, 2}, {1, 2, 2}, {0, 2, 2}},
                        Face{{1, 1, 1}, {2, 1, 1}, {2, 2, 1}, {1, 2, 1}},
                        Face{{0, 0, 0}, {0, 2, 0}, {2, 2, 0}, {2, 0, 0}}})
    for (int turn = 0; turn < 3; ++turn) {
      m.faces.emplace_back();
      for (const Point3& p : f)
        m.faces.back().push_back(id(turn == 0   ? p
                                    : turn == 1 ? Point3{p.z, p.x, p.y}
                                                : Point3{p.y, p.z, p.x}));
    }
  return m;
}

}  // namespace blum::test
