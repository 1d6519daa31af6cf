/// The answer to a FaceProblem: a labelled planar map of rect ∩ O cut along the essential ties.
///
/// Terms. *Inside* means in the open solid O. A *node on a side* is a point of an essential tie on
/// the boundary of the rectangle. G is the graph of essential ties in rect ∩ O, closed by the
/// points where convex boundary edges cross the rectangle. *Regions* are the components of
/// (rect ∩ O) \ G; redundant ties do not separate regions. A *piece* is a component of rect ∩ O.
/// A *trace* is the segment (triangle ∩ rect) of one boundary triangle.
///
/// General position is required of the rectangle: no boundary vertex on it, no boundary edge and
/// no point with three essentially different governors on its sides, no corner on a tie, no sheet
/// tangent to it. Status kBadPosition says that this failed: the caller moves the plane.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "blum/kernel/point.hpp"
#include "blum/kernel/site.hpp"

namespace blum {

/// One breakpoint of a segment diagram, in increasing order along the segment.
struct Breakpoint {
  enum class Kind : std::uint8_t {
    kBoundary,  ///< the segment crosses ∂O through the interior of `triangle`
    kTie,       ///< an essential tie: the governor changes from `below` to `above`
  };
  Kind kind = Kind::kTie;
  double lo = 0, hi = 0;       ///< the breakpoint's parameter lies in [lo, hi]
  std::uint32_t triangle = 0;  ///< kBoundary
  SiteId below{}, above{};     ///< kTie: an exact governor at lo and one at hi (but see below)
  /// kTie: where the end of [lo, hi] is not a double but the crossing of ∂O, its triangle.
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::uint32_t lo_triangle = kNone, hi_triangle = kNone;
};

/// The diagram on an axis-parallel segment: breakpoints and the open intervals between them.
/// interval[k] lies below breakpoint[k]; there is one more interval than breakpoints.
/// In Voronoi diagrams several ties may lie between the same two neighbouring doubles: then they
/// have the same lo and hi, and the order of the list; below governs lo for the first of them,
/// above governs hi for the last.
struct SegmentDiagram {
  struct Interval {
    bool inside = false;
    SiteId witness{};  ///< inside: one exact governor of points of the interval
  };
  Segment segment;
  std::vector<Breakpoint> breakpoint;
  std::vector<Interval> interval;
};

/// Are both ties between the same two neighbouring doubles?
[[nodiscard]] inline bool share_a_gap(const Breakpoint& a, const Breakpoint& b) {
  return a.kind == Breakpoint::Kind::kTie && b.kind == Breakpoint::Kind::kTie && a.lo == b.lo &&
         a.hi == b.hi && a.lo < a.hi && a.hi == std::nextafter(a.lo, a.hi);
}

/// Is it one of several ties between the same two doubles?
[[nodiscard]] inline bool shares_its_gap(const SegmentDiagram& line, std::size_t k) {
  const auto& b = line.breakpoint;
  return (k > 0 && share_a_gap(b[k - 1], b[k])) ||
         (k + 1 < b.size() && share_a_gap(b[k], b[k + 1]));
}

/// Sides of a rectangle, each as a segment with increasing parameter.
enum Side : std::uint8_t { kLowV = 0, kHighU = 1, kHighV = 2, kLowU = 3 };

/// The side's segment: kLowV and kHighV run along u, kLowU and kHighU along v.
[[nodiscard]] inline Segment side_segment(const Rect& r, int side) {
  const int u = u_axis(r.axis), v = v_axis(r.axis);
  // A segment along axis a stores its other coordinates in the order (u_axis(a), v_axis(a)).
  if (side == kLowV || side == kHighV) {
    const double fixed_v = side == kLowV ? r.v0 : r.v1;
    return {u, fixed_v, r.level, r.u0, r.u1};  // u_axis(u) == v, v_axis(u) == axis
  }
  const double fixed_u = side == kLowU ? r.u0 : r.u1;
  return {v, r.level, fixed_u, r.v0, r.v1};  // u_axis(v) == axis, v_axis(v) == u
}

struct FaceNode {
  enum class Kind : std::uint8_t {
    kSide,        ///< a kTie breakpoint of a side
    kEvent,       ///< three or more regions meet (a seam crosses the rectangle)
    kRim,         ///< a rim inside the solid crosses the rectangle (theory section 1)
    kConvexEdge,  ///< a convex boundary edge crosses the rectangle
  };
  Kind kind = Kind::kEvent;
  std::uint8_t side = 0;                  ///< kSide
  std::uint32_t breakpoint = 0;           ///< kSide: index in that side's diagram
  std::uint32_t boundary_edge = 0;        ///< kConvexEdge
  std::uint32_t piece = 0;                ///< the piece whose closure holds the node
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;  ///< the node lies in this rectangle
  std::vector<SiteId> governors;          ///< sites that tie here; see `exact`
  bool exact = true;  ///< false: a cluster of events shown as one node (theory, Theorem D)
};

/// An arc of G: an essential tie between two nodes. Its interior meets no other node.
struct FaceArc {
  std::uint32_t from = 0, to = 0;  ///< node indices
  SiteId left{}, right{};          ///< one governor on each side, unordered
  static constexpr std::uint32_t kUnknown = 0xffffffffu;
  /// The regions on its two sides (equal beside a rim), unordered; kUnknown where an engine does
  /// not say.
  std::array<std::uint32_t, 2> region{kUnknown, kUnknown};
};

struct FaceRegion {
  std::vector<SiteId> labels;  ///< sorted superset of the governors of the region's points
  std::uint32_t piece = 0;
};

struct FacePiece {
  std::uint32_t boundary_circles = 1;  ///< the piece is a disk with boundary_circles - 1 holes
};

struct FaceTrace {
  std::uint32_t triangle = 0;
  std::uint32_t region = 0;  ///< the region that touches ∂O along this trace
};

struct FaceTracePoint {
  std::uint32_t boundary_edge = 0;  ///< a boundary edge that crosses the rectangle's interior
};

enum class FaceStatus : std::uint8_t {
  kDecided,
  kBadPosition,  ///< an exact coincidence with the rectangle was met
  kUndecided,    ///< the budget (depth) was spent, e.g. at a near-tangency
};

struct FaceDiagram {
  FaceStatus status = FaceStatus::kDecided;
  std::string reason;  ///< for people, where status is not kDecided
  Rect rect;
  std::array<std::shared_ptr<const SegmentDiagram>, 4> side;
  /// region of each interval of each side; kOutside where the interval is outside O.
  static constexpr std::uint32_t kOutside = 0xffffffffu;
  std::array<std::vector<std::uint32_t>, 4> side_region;
  std::vector<FaceNode> node;
  std::vector<FaceArc> arc;
  std::vector<FaceRegion> region;
  std::vector<FacePiece> piece;
  std::vector<FaceTrace> trace;
  std::vector<FaceTracePoint> trace_point;
};

}  // namespace blum
