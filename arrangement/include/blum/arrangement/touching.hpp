/// Sites of a Voronoi diagram that touch: where they tie with one and the same foot.
#pragma once

#include <cstdint>

#include "blum/kernel/ball.hpp"
#include "blum/kernel/predicates.hpp"

namespace blum {

/// How two different sites can tie beside a common corner or edge (docs/proofs.md, "Touching
/// sites").
struct Touch {
  enum class Kind : std::uint8_t {
    kOrdinary,  ///< ties are told by comparing distances
    kNever,     ///< they never tie: one plane or line holds both, and they do not meet
    kPlane,     ///< they tie only on the plane w.(x - base) = 0, which separates their regions
    kBisector,  ///< faces at an edge: they tie only on that plane, and w points along the
                ///< derivative of d_a - d_b there
  };
  Kind kind = Kind::kOrdinary;
  BallVector w{};          ///< kPlane: a's region lies in w.(x - base) <= 0, b's in >= 0
  std::uint32_t base = 0;  ///< kPlane, kBisector: a point of the solid
};

/// Requires a != b, candidates of the Voronoi diagram. touch(b, a) is the same with -w.
[[nodiscard]] Touch touch(Predicates& predicates, SiteId a, SiteId b);

}  // namespace blum
