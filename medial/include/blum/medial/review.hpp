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

/// How long the step before took, seconds. After `subdivide`, `refine_s` is 0.
struct StepTimes {
  double refine_s = 0, assemble_s = 0;
};

/// An axis between assembly and the rest of a run. Only positions, radii, governors and on_axis of
/// the complex may be changed; points must stay in their leaves.
struct AssembledAxis {
  const SiteGeometry& geometry;
  const Subdivision& subdivision;
  EngineSet& engines;
  CellComplex& complex;
  const Parts& parts;
  bool undecided = false;  ///< in some leaf: nothing will be divided, and there is no bound
  StepTimes time = {};
};

struct ReviewVerdict {
  std::vector<std::uint32_t>
      divide;  ///< leaves to be divided, the most urgent first; none: content
  /// Two-sided, between the complex as it is now and the axis, both without undecided leaves; model
  /// units.
  double hausdorff_bound = 0;
  /// See Refinement; empty: parts of half the size are fine enough. Called until the next review.
  std::function<bool(const Leaf& part, int thread)> fine_enough;
  /// The run was stopped meanwhile, and the axis of the review before is better: the run goes back
  /// to it, and the bound above is that of the review before.
  bool go_back = false;
};

/// Called once after every assembly, in the calling thread.
using AxisReview = std::function<ReviewVerdict(const AssembledAxis&)>;

}  // namespace blum
