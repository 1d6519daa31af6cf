/// Dividing leaves of a subdivision that are certified, but too coarse for something else.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "blum/subdivision/subdivision.hpp"

namespace blum {

struct Refinement {
  /// Accepted leaves, the most urgent first.
  std::span<const std::uint32_t> leaves;
  /// Parts of a leaf that meet the axis have at most this part of its diameter.
  double fraction = 0.5;
  /// Is an accepted part that meets the axis fine enough? If not, it is divided in its turn, to
  /// `next_fraction` of its diameter. Empty: all are. Called from all threads at once, with the
  /// number of the thread; must depend on the part alone.
  std::function<bool(const Leaf& part, int thread)> fine_enough;
  double next_fraction = 0.9;
  /// No more cells are begun after it.
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
};

struct Refined {
  Subdivision subdivision;
  std::size_t divided = 0;  ///< leaves; the others of the list stay as they were
};

/// `coarse` with the given leaves divided. A leaf with a part that is not accepted, by any reason
/// or for want of time, stays as it is; all leaves that are not in the list do. Numbers of leaves
/// change. The same for any number of threads, unless a budget is reached. Error kInterrupted if
/// on_progress returned false.
[[nodiscard]] Result<Refined> refine(const SiteGeometry& geometry,
                                     const SubdivisionOptions& options, EngineSet& engines,
                                     const Subdivision& coarse, const Refinement& refinement);

}  // namespace blum
