/// Which curves can matter in a rectangle: by exact bounds on the parts of a grid.
#pragma once

#include <vector>

#include "curves.hpp"
#include "forms.hpp"

namespace blum::cgal {

struct Relevant {
  CurveTable curves;
  std::array<int, 4> side;    ///< the curve of each side of the window, in the order of Side
  std::vector<int> boundary;  ///< curves of planes and prisms of boundary triangles
  std::vector<char> site;     ///< per site of the forms: may govern somewhere in the window
  std::vector<std::array<int, 2>> pair;  ///< two that may tie
};

/// Off the curves found here the governors and the boundary triangles at a point of the window do
/// not change. Sound: a site is left out of a part only if it governs nowhere there (its domain
/// misses the part, or a site whose domain covers the part is nearer everywhere); a curve only if
/// it misses every part where both its sites may govern.
[[nodiscard]] Relevant relevant_curves(const Forms& forms, const Window& window);

}  // namespace blum::cgal
