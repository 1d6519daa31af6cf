/// What places the points of an assembled axis, and says which leaves are too coarse. (The module
/// `placement` has one; this keeps its libraries out of `medial`.)
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "blum/medial/complex.hpp"
#include "blum/medial/parts.hpp"
#include "blum/subdivision/engine_set.hpp"
#include "blum/subdivision/subdivision.hpp"

namespace blum {

/// An axis between assembly and the rest of a run. Only positions, radii, governors and on_axis of
/// the complex may be changed; points must stay in their leaves.
struct AssembledAxis {
  const SiteGeometry& geometry;
  const Subdivision& subdivision;
  EngineSet& engines;
  CellComplex& complex;
  const Parts& parts;
  bool undecided = false;  ///< in some leaf: nothing will be divided, and there is no bound
};

struct ReviewVerdict {
  std::vector<std::uint32_t> divide;  ///< leaves to be divided; none: content
  /// Two-sided, between the complex as it is now and the axis, both without undecided leaves; model
  /// units.
  double hausdorff_bound = 0;
};

/// Called once after every assembly, in the calling thread.
using AxisReview = std::function<ReviewVerdict(const AssembledAxis&)>;

}  // namespace blum
