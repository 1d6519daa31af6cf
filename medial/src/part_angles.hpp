/// Certified separation angles of all parts, by branch and bound over the leaves.
#pragma once

#include "angle_memo.hpp"
#include "blum/medial/angles.hpp"
#include "blum/subdivision/engine_set.hpp"

namespace blum {

/// The same for any number of threads, unless the run's watch fires: bounds are then as wide as
/// they are at that time, and still right. `memo`: of looks before this one at the same solid:
/// bounds that are within the tolerance stand, of others those of the same look at the same leaves.
[[nodiscard]] PartAngles part_angles(const SiteGeometry& geometry, const Subdivision& subdivision,
                                     EngineSet& engines, const CellComplex& complex,
                                     const Parts& parts, const AngleLook& look, AngleMemo& memo);

}  // namespace blum
