/// From Arb's balls to balls of doubles.
#pragma once

#include <arb.h>

#include <cmath>

#include "blum/kernel/ball.hpp"

namespace blum::detail {

/// Requires: x finite.
[[nodiscard]] inline Ball to_ball(arb_srcptr x) {
  const double mid = arf_get_d(arb_midref(x), ARF_RND_NEAR);
  const double rad = mag_get_d(arb_radref(x));  // rounded up by less than one part in 2^-29
  const double underflow = arb_is_zero(x) ? 0.0 : Ball::kTiny;
  return {mid, rad * (1 + 0x1p-20) + std::abs(mid) * Ball::kUnit + underflow};
}

}  // namespace blum::detail
