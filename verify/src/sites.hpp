/// What is exactly known of distances to sites: domains, comparisons, Lemma 1, and signs of affine
/// functions on boxes, which are decided at the corners.
#pragma once

#include <optional>
#include <vector>

#include "vertex_cone.hpp"

namespace blum::verify {

/// w.(x - p) <= 0 for every point x of the solid that the site governs.
struct Condition {
  enum class Type : std::uint8_t {
    kAlong,   ///< w = b - a, p = b: beyond the end of an edge; or an edge of a polar cone, p = a
    kPrism,   ///< w = (b - a) x n, n the normal of triangle c
    kInFace,  ///< w = n x (b - a): from the edge into triangle c
    kPlane,   ///< w = n
  };
  Type type;
  std::uint32_t a = 0, b = 0, c = 0;
  std::uint32_t base = 0;
};

/// Corners of a box that may be flat on some axes, without repetition.
struct BoxCorners {
  explicit BoxCorners(const Box3& box);
  std::array<Point3, 8> point;
  int count = 0;
  [[nodiscard]] const Point3* begin() const { return point.data(); }
  [[nodiscard]] const Point3* end() const { return point.data() + count; }
};

[[nodiscard]] Point3 center_of(const Box3& box);
/// At least half the box's size about that.
[[nodiscard]] std::array<double, 3> half_widths(const Box3& box);

/// Of two affine functions by their values at the corners of a box: are both <= 0 in no point of
/// it?
[[nodiscard]] bool exclude_each_other(std::span<const Rational> p, std::span<const Rational> q);

class Sites {
 public:
  explicit Sites(const Shape& shape);

  [[nodiscard]] const Shape& shape() const { return shape_; }

  /// The conditions of a site; the first own_conditions(s) of them say that the projection on the
  /// carrier lies in the closed site.
  [[nodiscard]] std::span<const Condition> conditions(Site s) const { return condition_[s]; }
  [[nodiscard]] std::size_t own_conditions(Site s) const;
  /// Sign of w.(x - p).
  [[nodiscard]] int sign(const Condition& c, const Point3& x) const;

  /// Is x in the closed domain of s?
  [[nodiscard]] bool in_domain(const Point3& x, Site s) const;
  /// Is one condition violated at every point of the box?
  [[nodiscard]] bool beyond(Site s, const Box3& box) const;
  /// Is one of two conditions violated at every point of the box, though neither on the whole?
  [[nodiscard]] bool beyond_two(Site s, const Box3& box) const;
  /// Does every point of the box project into the closed site?
  [[nodiscard]] bool covers(Site s, const Box3& box) const;
  /// And lie on the inner side of this face?
  [[nodiscard]] bool covers_inside(Site face, const Box3& box) const;

  /// The same for a face and, if it leaves the face across a flat edge, the neighbour there.
  [[nodiscard]] bool covers_with_neighbour(Site face, const Box3& box) const;

  /// The triangles that may meet the box: no coordinate, no side or plane of theirs parts them.
  [[nodiscard]] std::vector<std::uint32_t> meeting(std::span<const std::uint32_t> triangles,
                                                   const Box3& box) const;

  /// Sign of d_a(x) - d_b(x), distances to the carriers.
  [[nodiscard]] int compare(const Point3& x, Site a, Site b) const;
  /// Is d_a > d_b on the whole box, distances to the carriers? By their difference at the centre
  /// and how much it can change.
  [[nodiscard]] bool farther(Site a, Site b, const Box3& box) const;
  /// Bounds of the squared distance from x to the carrier.
  [[nodiscard]] Ball square_of_distance(const Point3& x, Site s) const;
  /// Sign of the signed height of x over face a minus that over face b.
  [[nodiscard]] int compare_heights(const Point3& x, Site a, Site b) const;
  /// And of the one plus the other.
  [[nodiscard]] int compare_with_mirrored(const Point3& x, Site a, Site b) const;
  /// Sign of grad(d_a - d_b).w at a tie x of the two carriers; for two faces with x inside both
  /// planes, that of the distances themselves, which is constant.
  [[nodiscard]] int slope(const Point3& x, Site a, Site b, const Vec<Rational>& w) const;
  /// Sign of (x - foot of x).w, foot on the carrier.
  [[nodiscard]] int outward(const Point3& x, Site a, const Vec<Rational>& w) const;

  /// The governors of x among `candidates`, which must hold them all.
  [[nodiscard]] std::vector<Site> governors(const Point3& x,
                                            std::span<const Site> candidates) const;

  [[nodiscard]] const VertexCone& cone(std::uint32_t v) const { return cone_[v]; }

  /// Lemma 1: ties of a and b inside the solid have one foot.
  [[nodiscard]] bool never_essential(Site a, Site b) const;

 private:
  template <class N>
  [[nodiscard]] Vec<N> direction(const Condition& c) const;
  /// Squared distance to the carrier of s as a fraction, and the gradient of its numerator.
  template <class N>
  struct Fraction {
    N numerator, denominator;
    Vec<N> gradient;
  };
  template <class N>
  [[nodiscard]] Fraction<N> squared_distance(const Vec<N>& x, Site s) const;
  /// Its numerator's quadratic part.
  template <class N>
  [[nodiscard]] std::array<Vec<N>, 3> second_order(Site s) const;
  [[nodiscard]] bool behind(Site site, Site other) const;

  [[nodiscard]] std::vector<Condition> make_conditions(Site s) const;
  [[nodiscard]] bool hold(std::span<const Condition> conditions, const Box3& box) const;
  [[nodiscard]] int compare_heights(const Point3& x, Site a, Site b, double sign_of_b) const;

  const Shape& shape_;
  std::vector<std::vector<Condition>> condition_;
  std::vector<VertexCone> cone_;
};

}  // namespace blum::verify
