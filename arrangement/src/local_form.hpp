/// Squared distance to a carrier expanded about the centre of a box, and what can be concluded
/// about all points of the box from it.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "blum/kernel/ball.hpp"
#include "blum/kernel/site_geometry.hpp"

namespace blum {

struct EngineContext;

/// A box, rectangle, segment or point: centre and half widths (0 on the axes it does not extend
/// in).
struct Range {
  Point3 center;
  std::array<double, 3> half{};

  /// Hull of [lo, hi]: half widths rounded up.
  static Range of(const Point3& lo, const Point3& hi);
  [[nodiscard]] double radius() const;  ///< half diagonal, rounded up
};

/// Upper bound of |w.(x - centre)| over the range.
[[nodiscard]] double spread(const BallVector& w, const Range& range);

/// Upper bound of the length of a vector.
[[nodiscard]] double length_above(const BallVector& x);

/// Entry of a symmetric matrix stored as xx, yy, zz, xy, yz, zx.
[[nodiscard]] inline const Ball& entry(const std::array<Ball, 6>& a, int i, int j) {
  return i == j ? a[i] : a[(i + j == 1) ? 3 : (i + j == 3) ? 4 : 5];
}

/// d^2(c + x) = value + gradient.x + x.A x, all enclosed.
struct LocalForm {
  SiteId site{};
  SiteKind kind = SiteKind::kVertex;
  Ball value;
  BallVector gradient;
  std::array<Ball, 6> a;  ///< xx, yy, zz, xy, yz, zx
  Ball height;            ///< faces: signed distance of c, negative inside
  int side = 0;           ///< faces: sign of the height wherever the face governs; 0: not certain
  bool covers = false;    ///< every point of the range projects into the closed site (or, for a
                          ///< face, into a coplanar neighbour)
  bool covers_side = false;   ///< and (faces) the height has the sign `side` there
  std::uint32_t crossed = 0;  ///< bit k: condition k of its domain may fail somewhere in the range

  [[nodiscard]] const Ball& matrix(int i, int j) const { return entry(a, i, j); }
};

/// d_a^2 - d_b^2 (carriers) at c + x = value + gradient.x + x.A x, all enclosed.
struct PairForm {
  Ball value;
  BallVector gradient;
  std::array<Ball, 6> a;

  [[nodiscard]] const Ball& matrix(int i, int j) const { return entry(a, i, j); }
  /// Upper bound of |gradient.x + x.A x| over the range.
  [[nodiscard]] double slack(const Range& range) const;
};

/// Are they edges so nearly parallel that the difference of their forms may be all error?
[[nodiscard]] bool nearly_parallel_edges(const SiteGeometry& geometry, const LocalForm& a,
                                         const LocalForm& b);
/// The difference of their forms; of such edges from precise coefficients.
[[nodiscard]] PairForm pair_form(EngineContext& context, const LocalForm& a, const LocalForm& b,
                                 const Range& range);

[[nodiscard]] inline Ball with_sign(const Ball& x, int sign) { return sign > 0 ? x : -x; }
/// side_a * a - side_b * b, for signs +-1.
[[nodiscard]] BallVector signed_difference(const BallVector& a, int side_a, const BallVector& b,
                                           int side_b);

/// Sign of w.(x - p) where it is certain to be the same at all points x of the range, else 0.
[[nodiscard]] int sign_over(const BallVector& w, const Point3& p, const Range& range);

/// Does every point x of the range satisfy w.(x - p) <= 0? False also means "not certain".
[[nodiscard]] bool holds_everywhere(const SiteGeometry& geometry, const HalfSpace& h,
                                    const Range& range);

/// Form of `site` about range.center. Returns false if the whole range lies outside its domain.
[[nodiscard]] bool local_form(const SiteGeometry& geometry, SiteId site, const Range& range,
                              LocalForm& out);

/// Is d_a^2 - d_b^2 > 0 (carriers) at every point of the range where a can govern? Requires, for
/// the conclusion "a does not govern", that b.covers; without it only "a and b do not tie, b nearer
/// by carrier".
/// With a context, faces are also compared by heights_compared, and other sites more precisely
/// where the error of the values decides.
[[nodiscard]] bool certainly_farther(const SiteGeometry& geometry, const LocalForm& a,
                                     const LocalForm& b, const Range& range,
                                     EngineContext* context = nullptr);

/// Certain sign of height(a) - height(b), signed distances to the planes of two faces that meet in
/// a vertex or are nearly parallel, over the whole range, to a small relative error however close
/// the planes are; 0: undecided, or faces of another kind.
[[nodiscard]] int heights_compared(EngineContext& context, SiteId a, SiteId b, const Range& range);

/// Unit vector along a boundary edge from its end `vertex`.
[[nodiscard]] BallVector away_from(const SiteGeometry& geometry, std::uint32_t edge,
                                   std::uint32_t vertex);

/// Does no point of the range have the vertex as foot, by its polar cone? True only if certain.
[[nodiscard]] bool outside_polar_cone(const SiteGeometry& geometry, std::uint32_t vertex,
                                      const Range& range);

/// Keeps those candidates that may govern a point of the range (inside the solid): by domains, by
/// distance bounds (thesis section 5.4.2), by comparison with candidates that cover the range.
/// Order is kept. `hint`: an upper bound on the distance from the centre to the boundary, known
/// from elsewhere. `context`: see certainly_farther.
void prune(const SiteGeometry& geometry, std::span<const SiteId> candidates, const Range& range,
           std::vector<LocalForm>& out, EngineContext* context = nullptr,
           double hint = std::numeric_limits<double>::infinity());

}  // namespace blum
