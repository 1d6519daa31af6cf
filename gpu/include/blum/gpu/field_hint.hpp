/// A coarse field as what subdivision takes from outside: upper bounds on distance.
#pragma once

#include "blum/gpu/field.hpp"
#include "blum/kernel/distance_hint.hpp"
#include "blum/kernel/solid.hpp"

namespace blum {

/// Of the field only the *ids* are believed: the distance from each sample to the site that it
/// names is computed anew, so the bounds hold even if ids are wrong, from a defective driver, say.
/// Samples that name no site give no bound. For a point x the sample s beside it gives d(x) <= d(s,
/// site) + |x - s|, wherever x is. `frame`: of the solid that asks; `sites`: all faces of the same
/// mesh. Copies what it needs.
[[nodiscard]] DistanceHint field_hint(const SiteSet& sites, const DistanceField& field,
                                      const Frame& frame);

}  // namespace blum
