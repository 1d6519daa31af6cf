/// The diagram on a cell face, checked part by part against the claims of a certificate.
#pragma once

#include "line.hpp"

namespace blum::verify {

/// A direction in the plane of a face: (u, v), or the left normal of the projected line between two
/// vertices (exact).
struct Direction {
  double u = 0, v = 0;
  std::optional<std::array<std::uint32_t, 2>> line;
};

/// What the certificate says of one part.
struct Claim {
  enum class Type : std::uint8_t {
    kStar,    ///< Theorem D' (groups by ties) or D'' (by feet); nothing where one group is left
    kChords,  ///< Theorem D', chords
    kCone,    ///< Theorem G about `vertex`
    kRim,     ///< a rim inside the solid, of two edges at `vertex`
  };
  Type type = Type::kStar;
  bool by_feet = false;
  bool proposed = false;    ///< exact algebra decides where this does not hold
  std::vector<Site> sites;  ///< sorted; the others of the face govern nothing in the part
  std::vector<std::pair<Site, Direction>> direction;  ///< of the group that holds the site
  /// Chords: the group of `a` gains on that of `b` along the direction.
  struct Between {
    Site a, b;
    Direction along;
  };
  std::vector<Between> between;
  std::vector<std::array<Site, 3>> parted;  ///< where the first two govern, the third is nearer
  std::uint32_t vertex = 0;
  std::array<std::uint32_t, 2> edge{};
};

/// Parts of a rectangle, preorder: a node is cut across u (0) or v (1), or is a part (-1).
struct PartNode {
  int axis = -1;
  double cut = 0;
  Claim claim;
};

/// Terms as in the glossary: nodes and arcs of G; regions and pieces of (rectangle ∩ O).
struct FaceMap {
  struct Node {
    enum class Kind : std::uint8_t { kSide, kEvent, kRim, kConvexEdge } kind = Kind::kEvent;
    int side = 0;                 ///< kSide
    std::uint32_t change = 0;     ///< kSide: index in the side's line
    std::uint32_t edge = 0;       ///< kConvexEdge
    std::array<double, 4> box{};  ///< kEvent, kRim: u0, u1, v0, v1: holds it and no other
    std::uint32_t piece = kNone;
  };
  struct Arc {
    std::array<std::uint32_t, 2> node, region;
  };
  struct Region {
    std::vector<Site> labels;  ///< sorted, all governors of its points
    std::uint32_t piece = 0;
  };
  std::uint32_t number = 0;  ///< among the diagrams of the certificate
  Rect rect;
  std::array<Line, 4> side;  ///< low v, high u, high v, low u; pieces have their regions for ids
  std::vector<Node> node;
  std::vector<Arc> arc;
  std::vector<Region> region;
  std::vector<std::uint32_t> circles;               ///< by piece
  std::vector<std::array<std::uint32_t, 2>> trace;  ///< triangle, region
  std::vector<std::uint32_t> trace_point;           ///< boundary edges
};

/// The four sides of a rectangle as segments, in the order of FaceMap::side.
[[nodiscard]] Segment side_of(const Rect& rect, int side);
[[nodiscard]] inline Box3 box_of(const Rect& r) {
  return {point_on(r.axis, r.level, r.u0, r.v0), point_on(r.axis, r.level, r.u1, r.v1)};
}

/// candidates, triangles: as for LineSolver, for the rectangle. Throws Failure.
[[nodiscard]] FaceMap check_face(const Exclusion& exclusion, const Algebra& algebra,
                                 const Rect& rect, const std::array<Line, 4>& sides,
                                 std::span<const Site> candidates,
                                 std::span<const std::uint32_t> triangles,
                                 std::span<const PartNode> parts);

}  // namespace blum::verify
