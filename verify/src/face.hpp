/// Checks the diagram on a cell face part by part against the claims of a certificate.
#pragma once

#include "exact.hpp"

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

/// candidates, triangles: as for LineSolver, for the rectangle. Throws Failure.
[[nodiscard]] FaceMap check_face(const Exclusion& exclusion, const Algebra& algebra,
                                 const Rect& rect, const std::array<Line, 4>& sides,
                                 std::span<const Site> candidates,
                                 std::span<const std::uint32_t> triangles,
                                 std::span<const PartNode> parts);

}  // namespace blum::verify
