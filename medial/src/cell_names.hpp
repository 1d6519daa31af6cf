/// Cells of the complex by origin, as certificates name them (docs/certificate.md).
#pragma once

#include <cstdint>
#include <vector>

#include <nlohmann/json.hpp>

#include "blum/kernel/site_geometry.hpp"
#include "blum/medial/complex.hpp"
#include "blum/medial/filtration.hpp"

namespace blum {

/// An arc as a certificate states it: the number of its diagram, and its place there.
struct ArcName {
  std::uint32_t diagram = 0, arc = 0;
  bool reversed = false;  ///< runs the other way in the complex
};

/// `arc`: of each edge of the complex that is an arc; `edge_number`: of boundary edges in
/// certificates. All must outlive it.
class CellNames {
 public:
  CellNames(const SiteGeometry& geometry, const CellComplex& complex,
            const std::vector<std::uint32_t>& edge_number, const std::vector<ArcName>& arc);

  /// [face, cell]
  [[nodiscard]] nlohmann::json pair(const ElementaryCollapse& c) const;

 private:
  using Json = nlohmann::json;
  [[nodiscard]] Json vertex(std::uint32_t v) const;
  [[nodiscard]] Json edge(std::uint32_t e) const;
  [[nodiscard]] Json over(const char* kind, std::uint32_t cone, const Json& base) const;

  const SiteGeometry& geometry_;
  const CellComplex& complex_;
  const std::vector<std::uint32_t>& edge_number_;
  const std::vector<ArcName>& arc_;
  /// Of each vertex: an edge that it is an end of, an arc where it can be; apices: a spoke.
  std::vector<std::uint32_t> edge_at_;
  std::vector<std::uint32_t> leaf_of_edge_;  // convex edges
};

}  // namespace blum
