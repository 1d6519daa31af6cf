/// The solid from its axis: the union of the balls about the axis' points, and how far its border
/// is from the boundary.
#pragma once

#include <cstddef>

#include "blum/kernel/solid.hpp"
#include "blum/medial/complex.hpp"

namespace blum {

struct ReconstructionOptions {
  /// Width of the interval for boundary_to_union, as a part of the diagonal, where the budget
  /// suffices.
  double tolerance = 0.0005;
  std::size_t most_pieces = 400'000;  ///< of the boundary
  std::size_t samples = 200'000;      ///< on the balls' spheres, together
};

/// Lengths in model units. The union is that of the balls about the complex' *vertices*, not about
/// all its points: it shrinks from the solid as the mesh gets coarser.
struct ReconstructionError {
  std::size_t balls = 0;
  /// Largest distance from a point of the boundary to the union: certainly in [lo, hi], up to 1e-12
  /// of the diagonal. (Balls lie in the closed solid, so it is that to the union's border.)
  double boundary_to_union_lo = 0, boundary_to_union_hi = 0;
  /// Largest distance from the union's border to the boundary, among sampled points of the border:
  /// a lower bound of the true one.
  double union_to_boundary_sampled = 0;
  std::size_t border_samples = 0;  ///< sampled points that no other ball covers
};

[[nodiscard]] ReconstructionError reconstruction_error(const Solid& solid,
                                                       const CellComplex& complex,
                                                       const ReconstructionOptions& options);

}  // namespace blum
