/// Per-site data for filters and box bounds: carriers, domains, candidates of a diagram.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "blum/kernel/ball.hpp"
#include "blum/kernel/site.hpp"
#include "blum/kernel/solid.hpp"

namespace blum {

/// One condition w.(x - p) <= 0 of a site's domain. The unit vector along w is enclosed; the exact
/// w is rebuilt from `kind` and the points when the filter fails.
struct HalfSpace {
  enum class Kind : std::uint8_t {
    kAlong,   ///< w = b - a
    kInFace,  ///< w = component of c - a orthogonal to b - a, times |b - a|^2
    kPrism,   ///< w = (b - a) x n, n = (b - a) x (c - a) the outer normal of triangle a b c
    kPlane,   ///< w = n
  };
  Kind kind = Kind::kAlong;
  std::uint32_t a = 0, b = 0, c = 0;  ///< points of the solid
  std::uint32_t base = 0;             ///< p
  BallVector w;                       ///< of length 1
};

/// Which diagram of a solid's sites.
enum class DiagramKind : std::uint8_t {
  kMedial,   ///< inside the solid; ties between sites whose feet are equal do not count
  kVoronoi,  ///< in all of space, faces two-sided; every tie between two sites counts
};

/// Geometry of all sites of a solid. Immutable; holds a pointer to the solid.
class SiteGeometry {
 public:
  explicit SiteGeometry(const Solid& solid, DiagramKind kind = DiagramKind::kMedial);

  [[nodiscard]] DiagramKind kind() const { return kind_; }

  [[nodiscard]] const Solid& solid() const { return *solid_; }
  [[nodiscard]] const SiteIndex& index() const { return index_; }

  /// Sites that can govern points of the diagram's domain, sorted. Medial: all faces, reflex edges,
  /// and vertices with a reflex edge whose polar cone has an interior. (A ball inside the solid
  /// cannot touch its boundary on a convex edge, nor at a vertex without reflex edges.) Voronoi:
  /// all sites that are not degenerate (count_sites).
  [[nodiscard]] std::span<const SiteId> candidates() const { return candidates_; }

  /// The closed domain of a candidate, as half-spaces: points outside it are not governed by it.
  /// Faces: prism and, medial, inner side; edges: slab and both in-face directions; vertices: polar
  /// cone.
  [[nodiscard]] std::span<const HalfSpace> domain(SiteId s) const {
    return std::span(half_).subspan(half_begin_[s.value],
                                    half_begin_[s.value + 1] - half_begin_[s.value]);
  }
  /// How many of the leading domain conditions say "the projection on the carrier lies in the
  /// closed site" (the rest are incidence conditions).
  [[nodiscard]] std::uint32_t own_conditions(SiteId s) const;

  [[nodiscard]] const Point3& base(SiteId s) const;  ///< a point of the site
  /// Unit outer normal (face) or unit direction (edge), enclosed.
  [[nodiscard]] const BallVector& unit(SiteId s) const { return unit_[s.value]; }

  /// Vertices of the site (1 to 3 points of the solid).
  [[nodiscard]] std::array<std::uint32_t, 3> corners(SiteId s, int& count) const;
  [[nodiscard]] bool has_corner(SiteId s, std::uint32_t vertex) const;

 private:
  const Solid* solid_;
  DiagramKind kind_;
  SiteIndex index_;
  std::vector<SiteId> candidates_;
  std::vector<HalfSpace> half_;
  std::vector<std::uint32_t> half_begin_;
  std::vector<BallVector> unit_;
};

}  // namespace blum
