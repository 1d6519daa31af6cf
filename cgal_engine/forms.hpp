/// A problem as polynomials on its rectangle or segment: squared distances, closed domains and feet
/// of the sites, planes and prisms of the boundary triangles. Written anew from theory section 1:
/// shares nothing with the production and brute engines but the types of problem and answer.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "blum/kernel/point.hpp"
#include "blum/kernel/site.hpp"
#include "blum/kernel/solid.hpp"
#include "numbers.hpp"

namespace blum::cgal {

using Vector = std::array<Rational, 3>;
/// A point that depends affinely on (u, v).
using Moving = std::array<Affine, 3>;

struct SiteForm {
  SiteId id;
  Moving foot;                 ///< of the point at (u, v), on the carrier
  Quadratic squared_distance;  ///< to the carrier
  std::vector<Affine> domain;  ///< the foot lies in the closed site iff all are <= 0
};

struct TriangleForm {
  std::uint32_t id = 0;
  Affine plane;                 ///< 0 on the triangle's plane
  std::array<Affine, 3> prism;  ///< all <= 0 over the closed triangle
};

struct Forms {
  const Solid* solid = nullptr;
  Moving x;
  std::vector<SiteForm> site;  ///< candidates that are not degenerate
  std::vector<TriangleForm> triangle;
  std::vector<std::vector<char>> essential;  ///< [i][j]: neither carrier contains the other

  [[nodiscard]] bool essential_pair(std::span<const int> a, std::span<const int> b) const;
  /// Indices of the sites that govern the point, sorted. Exact.
  [[nodiscard]] std::vector<int> governors(const Sample& p) const;
  /// Indices of the triangles that hold the point, sorted. Exact.
  [[nodiscard]] std::vector<int> triangles(const Sample& p) const;
  /// Do two of the sites have different feet at p?
  [[nodiscard]] bool feet_differ(const std::vector<int>& sites, const Sample& p) const;
};

[[nodiscard]] Forms rect_forms(const Solid& solid, const Rect& rect,
                               std::span<const SiteId> candidates,
                               std::span<const std::uint32_t> triangles);
/// On a segment v is the parameter, and u does not occur.
[[nodiscard]] Forms segment_forms(const Solid& solid, const Segment& segment,
                                  std::span<const SiteId> candidates,
                                  std::span<const std::uint32_t> triangles);

}  // namespace blum::cgal
