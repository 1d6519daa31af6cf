#include "box_edges.hpp"

#include "blum/arrangement/face_diagram.hpp"
#include "blum/subdivision/cell_test.hpp"

namespace blum {

const std::vector<EdgePair>& edge_pairs() {
  static const std::vector<EdgePair> pairs = [] {
    const Box3 unit{{0, 0, 0}, {1, 2, 3}};
    std::vector<EdgePair> found;
    for (int f = 0; f < 6; ++f)
      for (int s = 0; s < 4; ++s)
        for (int g = f + 1; g < 6; ++g)
          for (int t = 0; t < 4; ++t)
            if (side_segment(box_face(unit, f), s) == side_segment(box_face(unit, g), t))
              found.push_back({{f, g}, {s, t}});
    return found;
  }();
  return pairs;
}

}  // namespace blum
