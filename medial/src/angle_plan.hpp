/// Who bounds what: the roles that each part plays in the leaves, and where to look for witnesses.
#pragma once

#include <cstdint>
#include <vector>

#include "angle_box.hpp"

namespace blum {

struct AngleTask {
  std::uint32_t leaf = 0;  // index into the list of LeafParts
  AngleRole role;
};

/// Where to look for a witness: near a point of K on the part.
struct AngleStart {
  std::uint32_t task = 0;
  Point3 x;
  double reach = 0;  // seams are looked for in a box of this half width
  SiteId a{}, b{};   // sheets: one governor on each side
};

/// Which tasks each part has, and where witnesses may be found.
struct AnglePlan {
  std::vector<std::vector<AngleTask>> tasks;  // by part
  std::vector<std::vector<AngleStart>> starts;
};

[[nodiscard]] AnglePlan angle_plan(const Solid& solid, const std::vector<LeafParts>& leaves,
                                   const CellComplex& complex, const Parts& parts,
                                   const PartNumbers& number);

}  // namespace blum
