/// Where the governors change along an axis-parallel segment: computed here, from nothing but the
/// sites, so that all that meets in the segment agrees about it.
#pragma once

#include "gains.hpp"

namespace blum::verify {

class Algebra;

inline constexpr std::uint32_t kNone = 0xffffffffu;

/// The end of a stretch inside O: a double, or the crossing of a triangle, enclosed from outside.
struct StretchEnd {
  double t = 0;
  std::uint32_t triangle = kNone;
  Site label = 0;  ///< a governor there
};

/// Changes in order, and the open pieces between them (one more). `id`: names for who has the line.
struct Line {
  struct Change {
    bool boundary = false;       ///< the segment crosses ∂O in `triangle`; else an essential tie
    std::uint32_t triangle = 0;  ///< boundary
    StretchEnd below, above;     ///< a tie lies between them, the only one
    std::uint32_t id = kNone;
  };
  struct Piece {
    bool inside = false;
    Site label = 0;  ///< inside: a governor of points of the piece
    std::uint32_t id = kNone;
  };
  Segment segment;
  std::vector<Change> change;
  std::vector<Piece> piece;
};

[[nodiscard]] inline Point3 at(const Segment& s, double t) { return point_on(s.axis, t, s.u, s.v); }

class LineSolver {
 public:
  LineSolver(const Exclusion& exclusion, const Algebra& algebra)
      : exclusion_(exclusion), algebra_(algebra) {}

  /// candidates: all governors of points of segment ∩ O; triangles: all that meet it. Throws
  /// Failure where the segment is not in general position, or neither bisection decides nor, where
  /// no number is left between two, exact algebra.
  [[nodiscard]] Line solve(const Segment& segment, bool starts_inside,
                           std::span<const Site> candidates,
                           std::span<const std::uint32_t> triangles) const;

  /// The two parts of a line at m, which agree with it. Throws like solve.
  [[nodiscard]] std::array<Line, 2> cut(const Line& line, double m,
                                        std::span<const Site> candidates) const;

 private:
  [[nodiscard]] std::optional<Site> label(const Point3& x, std::span<const Site> candidates) const;
  void ties(const Segment& line, const StretchEnd& a, const StretchEnd& b,
            std::span<const Site> candidates, std::vector<Line::Change>& out, int depth) const;
  [[nodiscard]] bool at_most_one(const Segment& line, const StretchEnd& a, const StretchEnd& b,
                                 std::span<const Site> sites, const Groups& groups,
                                 const SharedFeet& feet, bool thorough,
                                 std::vector<Line::Change>& out) const;

  const Exclusion& exclusion_;
  const Algebra& algebra_;
};

}  // namespace blum::verify
