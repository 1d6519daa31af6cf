/// Directions from a foot on a face or reflex edge to the points that have it: the gradients of the
/// distance to the site, however near and however small the range is.
#pragma once

#include <array>

#include "blum/kernel/ball.hpp"
#include "blum/kernel/site_geometry.hpp"

namespace blum {

/// Unit vectors of the convex cone of `end`. See "Fans" in docs/proofs.md.
struct Fan {
  std::array<BallVector, 2> end;  ///< of length 1
  int count = 0;                  ///< 1: face, 2: edge, 0: a vertex, nothing known
  double stretch = 1;             ///< of a sum of multiples of the ends that has length 1, at most

  /// Bounds of the products of all its vectors with w. Requires: count > 0.
  [[nodiscard]] double low(const BallVector& w) const;
  [[nodiscard]] double high(const BallVector& w) const;
};

[[nodiscard]] Fan fan_of(const SiteGeometry& geometry, SiteId site);

/// Is (grad d_a - grad d_b) . w < 0 wherever both govern? False: undecided.
[[nodiscard]] bool gains_by_fans(const Fan& a, const Fan& b, const BallVector& w);

}  // namespace blum
