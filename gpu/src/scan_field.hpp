/// The CPU backend: sites culled by a hierarchy of blocks, then scan converted.
#pragma once

#include "blum/gpu/field.hpp"

namespace blum::detail {

/// Fills field.site, distance, bound and statistics; false if interrupted. Requires: the options
/// and the grid have been checked, field.grid and field.band set, the vectors sized.
[[nodiscard]] bool scan_field(const SiteSet& sites, const FieldOptions& options,
                              DistanceField& field);
[[nodiscard]] bool brute_field(const SiteSet& sites, const FieldOptions& options,
                               DistanceField& field);

}  // namespace blum::detail
