/// The twelve edges of a box as sides of its faces.
#pragma once

#include <vector>

namespace blum {

/// Two (face, side) pairs that are the same edge of a box; faces as in box_face.
struct EdgePair {
  int face[2], side[2];
};

/// All twelve: the same for all boxes.
[[nodiscard]] const std::vector<EdgePair>& edge_pairs();

}  // namespace blum
