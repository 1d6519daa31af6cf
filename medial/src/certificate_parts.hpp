/// What a certificate says of the parts of a diagram (docs/certificate.md).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <nlohmann/json.hpp>

#include "blum/arrangement/face_diagram.hpp"
#include "blum/arrangement/part_record.hpp"
#include "blum/kernel/predicates.hpp"
#include "blum/kernel/site_geometry.hpp"

namespace blum {

/// A site as certificates number it; `edge_number`: of each boundary edge.
[[nodiscard]] std::size_t site_number(const SiteIndex& index,
                                      std::span<const std::uint32_t> edge_number, SiteId s);

/// The list of parts of a diagram. Where exact algebra or Theorem S decided one, stars are proposed
/// with one event each, with directions found in double: they are right or not, which the checker
/// sees. The boxes of those events become the parts that hold them.
[[nodiscard]] nlohmann::json part_claims(const SiteGeometry& geometry, Predicates& predicates,
                                         std::span<const std::uint32_t> edge_number,
                                         std::span<const PartRecord> records, FaceDiagram& face);

}  // namespace blum
