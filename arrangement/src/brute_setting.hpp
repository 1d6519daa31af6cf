/// A problem of the oracle as signs of polynomials: squared distances, closed domains, boundary
/// triangles and limits, restricted to the plane of a rectangle or to the line of a segment.
///
/// In the plane the coordinates are (s, v) with s = u + shear * v; on a line v is the parameter and
/// s does not occur.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "blum/kernel/point.hpp"
#include "blum/kernel/site.hpp"
#include "blum/kernel/site_geometry.hpp"
#include "blum/kernel/solid.hpp"
#include "brute_algebra.hpp"

namespace blum::brute {

/// cu * u + cv * v + c.
struct Affine {
  Rational cu, cv, c;
};
/// A quadratic polynomial in (u, v): uu, uv, vv, u, v, 1.
using Quadratic = std::array<Rational, 6>;
using Vector = std::array<Rational, 3>;
/// A point that depends affinely on (u, v).
using Moving = std::array<Affine, 3>;

/// sign * product of curves^exponent, up to a positive constant.
struct Function {
  int sign = 0;
  std::vector<std::pair<int, int>> curve;  ///< index in Setting::curve, exponent
};

struct Setting {
  const Solid* solid = nullptr;
  bool interior = false;  ///< FaceProblem::interior
  DiagramKind kind = DiagramKind::kMedial;
  Moving x;  ///< the point with coordinates (u, v)
  Rational shear;
  std::vector<SiteId> site;  ///< candidates without degenerate features
  std::vector<std::uint32_t> triangle;

  std::vector<Curve> curve;
  std::vector<std::vector<Function>> difference;  ///< [i][j]: d_i^2 - d_j^2
  std::vector<std::vector<Function>> domain;      ///< [i]: i's domain is where all are <= 0
  std::vector<Function> plane;                    ///< [t]: zero on the plane of triangle t
  std::vector<std::vector<Function>> prism;       ///< [t]: all <= 0 on the triangle
  std::vector<Function> limit;                    ///< all >= 0 in the rectangle or segment
  std::vector<Rational> limit_value;  ///< [k]: constant of limit k, which is +-u or +-v plus it
  std::vector<std::vector<char>> essential;  ///< [i][j]: ties count

  /// The function g of (u, v) in the coordinates (s, v); nullopt if the shear is not generic.
  [[nodiscard]] std::optional<Factors> factor(const Quadratic& g) const;
  /// Does an essential pair occur, the one in `a`, the other in `b`?
  [[nodiscard]] std::optional<std::pair<int, int>> essential_pair(const std::vector<int>& a,
                                                                  const std::vector<int>& b) const;
  [[nodiscard]] std::vector<SiteId> ids(const std::vector<int>& sites) const;
  /// Foot of x on the carrier of site i.
  [[nodiscard]] Moving foot(int i) const;
};

/// The setting on the line of the segment; limit[0] at t0, limit[1] at t1.
[[nodiscard]] Setting segment_setting(const Solid& solid, const Segment& segment,
                                      std::span<const SiteId> candidates,
                                      std::span<const std::uint32_t> triangles, DiagramKind kind);
/// The setting in the plane of the rectangle; limit[k] belongs to Side k.
[[nodiscard]] Setting rect_setting(const Solid& solid, const Rect& rect,
                                   std::span<const SiteId> candidates,
                                   std::span<const std::uint32_t> triangles, bool interior,
                                   DiagramKind kind);

/// Carriers equal or one contained in the other. Exact.
[[nodiscard]] bool redundant(const Solid& solid, SiteId a, SiteId b);
/// Is p, not on the boundary, inside? Exact parity along a ray that meets no edge of the boundary.
[[nodiscard]] bool inside(const Solid& solid, const Vector& p);

[[nodiscard]] Vector exact(const Point3& p);
[[nodiscard]] Vector cross(const Vector& a, const Vector& b);
[[nodiscard]] Rational dot(const Vector& a, const Vector& b);
[[nodiscard]] Vector operator-(const Vector& a, const Vector& b);
[[nodiscard]] bool is_zero(const Vector& a);

}  // namespace blum::brute
