/// A reflex edge just in front of the plane of a nearly parallel face, as slivers leave them.
#pragma once

#include <optional>

#include "engine_context.hpp"
#include "local_form.hpp"

namespace blum {

/// At every point of the range that both of two sites govern, (foot on the first) - (foot on the
/// second) is s across + r with s >= reach and |r| <= rest. See "Ledges" in docs/proofs.md.
struct Ledge {
  BallVector across;  ///< of length 1
  double reach = 0, rest = 0;

  /// Has that difference of feet a positive component along w? False: undecided.
  [[nodiscard]] bool ahead(const BallVector& w) const;
};

/// Nullopt: not known to be one.
[[nodiscard]] std::optional<Ledge> find_ledge(EngineContext& context, const LocalForm& a,
                                              const LocalForm& b, const Range& range);

}  // namespace blum
