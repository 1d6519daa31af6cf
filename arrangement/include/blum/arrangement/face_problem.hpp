/// The problem an arrangement engine solves: the medial or Voronoi diagram on an axis-parallel
/// rectangle.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "blum/arrangement/face_diagram.hpp"
#include "blum/kernel/point.hpp"
#include "blum/kernel/site.hpp"
#include "blum/kernel/site_geometry.hpp"
#include "blum/kernel/solid.hpp"

namespace blum {

/// The part of the medial diagram that lies on `rect`, inside the solid O; or the part of the
/// Voronoi diagram on `rect`: there all space counts as inside, ∂O is no border, and the flag
/// `interior` is to be set.
///
/// Candidates: a superset of the governors of every point of rect ∩ O. Triangles: a superset of
/// the boundary triangles that meet `rect`. Both sorted, without repetition.
struct FaceProblem {
  const Solid* solid = nullptr;
  Rect rect;
  std::span<const SiteId> candidates;
  std::span<const std::uint32_t> triangles;
  bool interior = false;  ///< the rectangle is known to lie in O (then `triangles` is empty)
  DiagramKind kind = DiagramKind::kMedial;  ///< production engines go by their geometry's
  /// Null, or a decided diagram by the same engine of a rectangle that an axis-parallel line parts
  /// into `rect` and another one. It may save work, and does not change the answer as a labelled
  /// planar map, but that labels of regions may be more.
  const FaceDiagram* whole = nullptr;
};

}  // namespace blum
