/// Smoothing of sheets for display. What is smoothed is no certified result any more.
#pragma once

#include <cstddef>

#include "blum/kernel/solid.hpp"
#include "blum/medial/medial_axis.hpp"

namespace blum {

struct SmoothOptions {
  int steps = 20;  ///< of both kinds together
  /// Taubin's λ and μ: parts of the way to the mean of the neighbours, in and out.
  double lambda = 0.5, mu = -0.53;
};

struct SmoothReport {
  std::size_t sheets = 0;  ///< smoothed
  std::size_t skipped =
      0;                   ///< sheets that are no oriented surface (one-sided, or touch themselves)
  std::size_t points = 0;  ///< that moved
  double largest_displacement = 0;  ///< model units
};

/// Taubin's λ|μ filter on each sheet (OpenMesh); points on seams, rims and whatever bounds a sheet
/// stay. Points that move get the distance to the boundary for their radius and are not on the axis
/// any more; `smoothed` becomes true. Source: Taubin, SIGGRAPH 1995.
SmoothReport smooth_sheets(MedialResult& result, const Solid& solid, const SmoothOptions& options);

}  // namespace blum
