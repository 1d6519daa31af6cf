/// Directions from a foot on a face or reflex edge to the points that have it: gradients of the
/// distance to the site, however near and however small the range is.
#pragma once

#include <array>
#include <optional>

#include "engine_context.hpp"
#include "local_form.hpp"

namespace blum {

/// The unit vectors of the convex cone of `end`: an arc of less than pi, or one vector. See "Fans"
/// in docs/proofs.md.
struct Fan {
  std::array<BallVector, 2> end;              ///< of length 1
  std::array<std::optional<SiteId>, 2> face;  ///< whose inner normal the end is, if it is one
  int count = 0;                              ///< 1: face, 2: edge, 0: a vertex, nothing known
  double stretch = 1;  ///< bound on p + q for unit vectors p end[0] + q end[1]

  /// Bounds of the products of all its vectors with w. Requires: count > 0.
  [[nodiscard]] double low(const BallVector& w) const;
  [[nodiscard]] double high(const BallVector& w) const;
  /// Is the product least at an end? False: undecided.
  [[nodiscard]] bool least_at_end(const BallVector& w) const;
};

/// Fans of two sites, of what their feet can be where they tie.
struct FanPair {
  Fan a, b;
  bool tie = true;  ///< false: they cannot
};
[[nodiscard]] FanPair fans_at_ties(EngineContext& context, const LocalForm& a, const LocalForm& b,
                                   const Range& range);

/// Lower bound of 1 - grad d_a . grad d_b wherever both govern; 0: nothing known.
[[nodiscard]] double fans_apart(EngineContext& context, const LocalForm& a, const LocalForm& b,
                                const Range& range);

/// Is (grad d_a - grad d_b) . w < 0 wherever they tie? False: undecided.
[[nodiscard]] bool gains_by_fans(const FanPair& fans, const BallVector& w);
/// The same for sites that share no foot in the range. Compares end by end, with precise
/// differences of normals; equal gradients would mean equal feet.
[[nodiscard]] bool gains_by_fan_ends(EngineContext& context, const FanPair& fans,
                                     const BallVector& w);

}  // namespace blum
