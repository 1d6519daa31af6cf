/// Does one site gain on another along a direction, wherever both govern?
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine_context.hpp"
#include "fan.hpp"
#include "local_form.hpp"

namespace blum {

/// How d_a - d_b changes, wherever in the range a and b tie.
struct PairSlope {
  BallVector gradient;           ///< enclosure up to a positive factor, at the centre
  bool constant = false;         ///< two faces, or sites that touch: the same everywhere
  std::array<Ball, 6> matrix{};  ///< if not constant: it changes by twice that times the offset
  FanPair fans;                  ///< if not constant; medial diagrams only
};
[[nodiscard]] PairSlope pair_slope(EngineContext& context, const LocalForm& a, const LocalForm& b,
                                   const Range& range);

/// Is the derivative along w negative wherever a and b tie? False: undecided.
[[nodiscard]] bool gains(const PairSlope& slope, const Range& range, const BallVector& w);

/// grad(side_a * height_a - side_b * height_b) of two faces on known sides; with equal sides to a
/// small relative error however close the planes are.
[[nodiscard]] BallVector slope_of_heights(EngineContext& context, const LocalForm& a,
                                          const LocalForm& b);

/// A direction in a plane x[axis] = const or along a line: a vector, or exactly the left normal of
/// the projection along `axis` of the line from one point of the solid to another.
struct Direction {
  BallVector w;  ///< encloses it
  struct Line {
    int axis;
    std::uint32_t from, to;
  };
  std::optional<Line> line;
  [[nodiscard]] Direction reversed() const;
};
[[nodiscard]] Direction left_normal(const Solid& solid, int axis, std::uint32_t from,
                                    std::uint32_t to);

/// Voronoi diagrams: two faces on the side of their common edge where its region lies between
/// theirs, so that they tie nowhere off the edge? False: undecided.
[[nodiscard]] bool edge_is_between(const SiteGeometry& geometry, const LocalForm& a,
                                   const LocalForm& b);

/// May a and b tie somewhere in the range? False only if certain.
[[nodiscard]] bool may_tie(EngineContext& context, const LocalForm& a, const LocalForm& b,
                           const Range& range);

/// The same for sites of different groups (Groups): those that never tie essentially would share
/// their foot there (Lemma 1 of docs/proofs.md), and would be of one group.
[[nodiscard]] bool may_both_govern(EngineContext& context, const LocalForm& a, const LocalForm& b,
                                   const Range& range);

/// Is a third face nearer wherever in the range both faces govern? Then they do not tie there.
/// Medial diagrams. `b` covers the range with its side. False: undecided.
[[nodiscard]] bool parted_by(const SiteGeometry& geometry, const LocalForm& a, const LocalForm& c,
                             const LocalForm& b, const Range& range);

/// Certain sign of (p - v) . w for two points of the solid; 2: undecided.
[[nodiscard]] int side(EngineContext& context, const Direction& direction, std::uint32_t v,
                       std::uint32_t p);

/// Does a gain on b along the direction, by what the feet of points of the range can be: corners on
/// two sides of a plane, or the ends of fans? False: undecided. Requires: the sites share no foot
/// there (may_share_foot).
[[nodiscard]] bool gains_by_feet(EngineContext& context, const PairSlope& slope, SiteId a, SiteId b,
                                 const Direction& direction, std::span<const LocalForm> forms,
                                 const Range& range);

/// On which side of the plane through v, across the direction, each form's site lies: +1 ahead, -1
/// behind, 0 if it is v. Nullopt if a site has possible feet on both sides, or on the plane outside
/// v, or if two sites that are not on different sides may tie essentially.
[[nodiscard]] std::optional<std::vector<int>> sides_of(EngineContext& context,
                                                       std::span<const LocalForm> forms,
                                                       std::uint32_t v, const Direction& direction,
                                                       const Range& range);

}  // namespace blum
