/// Does a plane miss the axis within a cell?
#pragma once

#include <functional>
#include <span>

#include "blum/arrangement/production_engine.hpp"
#include "blum/kernel/inside.hpp"
#include "blum/kernel/site_geometry.hpp"
#include "blum/subdivision/cut_plane.hpp"

namespace blum {

struct SectionAnswer {
  bool clear = false;  ///< certain: no point of the section inside the solid is on the axis
  /// Not clear: near this point it could not be decided, or axis is; and two sites that may tie
  /// essentially there. For the choice of a better plane.
  Point3 near{};
  std::array<SiteId, 2> tie{};
};

/// What is asked of a plane, for one cell.
using SectionTest = std::function<SectionAnswer(const CutPlane&)>;

/// Covers the part of the plane in the closed box by boxes, until in each of them no two candidates
/// can tie essentially, or it lies outside the solid. Never wrong where it says `clear`; gives up
/// after a fixed number of boxes.
/// Candidates, triangles: supersets as in FaceProblem, for the box.
/// Source: docs/proofs.md, Theorem E.
[[nodiscard]] SectionAnswer section_misses_axis(const SiteGeometry& geometry,
                                                ProductionEngine& engine,
                                                const InsideOracle& inside, const CutPlane& plane,
                                                const Box3& box, std::span<const SiteId> candidates,
                                                std::span<const std::uint32_t> triangles);

}  // namespace blum
