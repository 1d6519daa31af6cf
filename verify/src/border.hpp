/// What surrounds a part of a cell face: pieces of its sides, and traces of ∂O from one side to
/// another.
#pragma once

#include <map>
#include <set>

#include "line.hpp"

namespace blum::verify {

/// A part with its sides. Ties have nodes for ids, pieces elements of regions (face_map.hpp).
struct Box {
  Rect rect;
  std::array<Line, 4> side;  ///< low v, high u, high v, low u
  std::vector<Site> candidates;
};

/// The four sides of a rectangle as segments, in the order of Box::side.
[[nodiscard]] Segment side_of(const Rect& rect, int side);
[[nodiscard]] inline Box3 box_of(const Rect& r) {
  return {point_on(r.axis, r.level, r.u0, r.v0), point_on(r.axis, r.level, r.u1, r.v1)};
}

struct Step {
  enum class Kind : std::uint8_t { kPiece, kTrace, kTie, kConvexEdge } kind;
  std::uint32_t id;  ///< element, triangle, node, boundary edge
  Site label = 0;    ///< of a piece, a trace
  [[nodiscard]] bool separates() const { return kind == Kind::kTie || kind == Kind::kConvexEdge; }
};
using Circle = std::vector<Step>;

/// What lies between two separators of a circle, and the one before it (null: there is none).
struct Interval {
  const Step* separator = nullptr;
  std::vector<const Step*> step;
};
/// Throws Failure where two separators are beside each other.
[[nodiscard]] std::vector<Interval> intervals(const Circle& circle);

/// Of a part and O: circles that meet its sides, counter-clockwise; does ∂O run in it in circles?
struct Border {
  std::vector<Circle> circle;
  bool loop = false;
};

/// ∂O in the plane of a rectangle: segments of triangles between points of boundary edges.
class Traces {
 public:
  /// triangles: all that meet the rectangle. Throws Failure where a vertex lies in its plane.
  Traces(const Shape& shape, const Rect& rect, std::span<const std::uint32_t> triangles);

  [[nodiscard]] Border border(const Box& box) const;
  /// Boundary edges that cross the rectangle.
  [[nodiscard]] std::vector<std::uint32_t> edges_in(const Rect& rect) const;
  /// The triangles of the closed curve that has a trace in t.
  [[nodiscard]] std::set<std::uint32_t> loop_of(std::uint32_t t) const;

 private:
  [[nodiscard]] bool holds(const Rect& rect, std::uint32_t edge) const;

  const Shape& shape_;
  std::map<std::uint32_t, std::array<Rational, 2>> point_;       // boundary edge -> (u, v)
  std::map<std::uint32_t, std::array<std::uint32_t, 2>> trace_;  // triangle -> two edges
};

}  // namespace blum::verify
