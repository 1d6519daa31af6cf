/// What the checker cannot show by itself, by the exact algebra that the program has, too: of all
/// that is shared it alone decides something (docs/certificate.md, "Exact parts").
#pragma once

#include "blum/kernel/solid.hpp"
#include "face_map.hpp"
#include "failure.hpp"

namespace blum::verify {

class Algebra {
 public:
  /// With nothing but what the shape knows.
  explicit Algebra(const Shape& shape);

  /// The diagram on a rectangle that meets O. sites: all governors of points of rect ∩ O;
  /// triangles: all that meet it. Pieces of the sides get their regions for ids. Throws Undecided,
  /// and Failure where the sides are others.
  [[nodiscard]] FaceMap diagram(const Rect& rect, const std::array<Line, 4>& side,
                                std::span<const Site> sites,
                                std::span<const std::uint32_t> triangles) const;
  /// The number of essential ties on a segment that lies in O; sites: all governors of its points.
  /// Throws Undecided.
  [[nodiscard]] std::size_t ties(const Segment& segment, std::span<const Site> sites) const;

  mutable std::size_t diagrams = 0, segments = 0;  ///< that were decided

 private:
  Solid solid_;
};

}  // namespace blum::verify
