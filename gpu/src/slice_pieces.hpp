/// What is drawn of a site in a slice: convex polygons, and what is linear over them.
///
/// Every polygon is `dilation` pixels larger than what it stands for, on each axis, so that a
/// rasterizer that moves corners by less still covers every sample. Lengths are model units.
///
///   kFragments: the domain; the fragment shader does the rest.
///   kLinearFactorization: the domain, and the vector from the site's carrier to the sample, which
///     is affine over the slice (DiFi section 4; thesis section 2.3). Set up in double: where the
///     rasterizer interpolates from corners, as in the papers, its rounding has no bound for thin
///     polygons.
///   kDistanceMeshes: the domain cut up into cells, over each of which the distance is replaced by
///     a plane at most `mesh_error` above it (HAVOC section 4.2). The vector from a line to the
///     sample is an affine image of the slice in the plane across the line, so the elliptical cone
///     of the paper becomes a circular one there, cut into sectors; a point's hyperboloid is cut
///     into sectors and rings. In the sector around the direction b, of the angle 2 a, the length
///     |r| is replaced by r.b / cos a: equal on both border rays, above between them.
#pragma once

#include <array>
#include <vector>

#include "blum/gpu/field.hpp"
#include "scan_sites.hpp"
#include "slice_polygon.hpp"

namespace blum::detail {

/// The squared length of this vector is the squared distance (of its replacement).
using AffineVector = std::array<PixelAffine, 3>;

struct SlicePiece {
  ConvexPolygon polygon;
  AffineVector vector;  ///< zero for kFragments
};

struct SliceStyle {
  FieldMethod method = FieldMethod::kFragments;
  double mesh_error = 0;
  double dilation = 0;  ///< pixels
  double depth = 0;     ///< domains are enlarged by this along z, too (model units)
};

/// Triangles with a corner sharper than this (radians) have no pieces, but for kFragments: all of
/// their points are within kSharpCorner times their longest side of a side.
inline constexpr double kSharpCorner = 0x1p-20;

class Slice {
 public:
  Slice(const VoxelGrid& grid, std::uint32_t k) : grid_(grid), z_(grid.coordinate(2, k)) {}

  [[nodiscard]] double z() const { return z_; }
  /// w.(x - base) at sample x.
  [[nodiscard]] PixelAffine along(const Point3& w, const Point3& base) const;

  /// Appends the pieces of the site within the rectangle. `reach`: samples farther than this from
  /// the site's sphere are of no interest (infinity: all are).
  void add_pieces(const ScanSites& sites, std::uint32_t place, const PixelRect& rect,
                  const SliceStyle& style, double reach, std::vector<SlicePiece>& out) const;

 private:
  [[nodiscard]] ConvexPolygon domain(const ScanSites& sites, std::uint32_t place,
                                     const PixelRect& rect, const SliceStyle& style,
                                     double reach) const;
  const VoxelGrid& grid_;
  double z_;
};

}  // namespace blum::detail
