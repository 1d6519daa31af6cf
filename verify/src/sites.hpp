/// What is exactly known of distances to sites: domains, comparisons, Lemma 1, and signs of affine
/// functions on boxes, which are decided at the corners.
#pragma once

#include "shape.hpp"

namespace blum::verify {

/// w.(x - p) <= 0 for every point x of the solid that the site governs.
struct Condition {
  Exact w;
  std::uint32_t base = 0;             ///< p
  std::optional<std::uint32_t> edge;  ///< of a face: the side beyond which it does not hold
};

/// Corners of a box that may be flat on some axes, without repetition.
[[nodiscard]] std::vector<Point3> corners_of(const Box3& box);
[[nodiscard]] Point3 center_of(const Box3& box);
/// At least half the box's size about that.
[[nodiscard]] std::array<double, 3> half_widths(const Box3& box);

class Sites {
 public:
  explicit Sites(const Shape& shape);

  [[nodiscard]] const Shape& shape() const { return shape_; }

  /// The conditions of a site; the first of them, own_conditions(s), say that the projection on the
  /// carrier lies in the closed site.
  [[nodiscard]] std::span<const Condition> conditions(Site s) const { return condition_[s]; }
  [[nodiscard]] std::span<const Condition> own_conditions(Site s) const {
    const auto kind = shape_.kind(s);
    return conditions(s).first(kind == Kind::kVertex ? 0 : kind == Kind::kEdge ? 2 : 3);
  }
  /// Sign of w.(x - p).
  [[nodiscard]] int sign(const Condition& c, const Point3& x) const {
    return decide(
        [&]<class N>(const N&) { return sign_of(inner(c.w.as<N>(), shape_.from<N>(c.base, x))); });
  }

  /// Is x in the closed domain of s?
  [[nodiscard]] bool in_domain(const Point3& x, Site s) const {
    return hold(conditions(s), {x, x});
  }
  /// Is one condition violated at every point of the box?
  [[nodiscard]] bool beyond(Site s, const Box3& box) const;
  /// Do all conditions hold together at a point of the box? Requires a candidate: its domain is
  /// connected and unbounded, so it leaves a box that it meets.
  [[nodiscard]] bool domain_meets(Site s, const Box3& box) const;
  /// Does every point of the box project into the closed site?
  [[nodiscard]] bool covers(Site s, const Box3& box) const { return hold(own_conditions(s), box); }
  /// And lie on the inner side of this face? Or leave it across a flat edge only, for the other
  /// face there?
  [[nodiscard]] bool covers_inside(Site face, const Box3& box) const;
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
  /// Sign of the signed height of x over face a minus `sign_of_b` times that over face b.
  [[nodiscard]] int compare_heights(const Point3& x, Site a, Site b, double sign_of_b = 1) const;
  /// Sign of grad(d_a - d_b).w at a tie x of the two carriers; for two faces with x inside both
  /// planes, that of the distances themselves, which is constant.
  [[nodiscard]] int slope(const Point3& x, Site a, Site b, const Exact& w) const;
  /// Sign of (x - foot of x).w, foot on the carrier.
  [[nodiscard]] int outward(const Point3& x, Site a, const Exact& w) const;

  /// The governors of x among `candidates`, which must hold them all.
  [[nodiscard]] std::vector<Site> governors(const Point3& x,
                                            std::span<const Site> candidates) const;

  /// Lemma 1: ties of a and b inside the solid have one foot.
  [[nodiscard]] bool never_essential(Site a, Site b) const {
    return a == b || behind(a, b) || behind(b, a);
  }

 private:
  /// Squared distance to the carrier of s as a fraction; the gradient of its numerator, and the
  /// quadratic part.
  template <class N>
  struct Fraction {
    N numerator, denominator;
    Vec<N> gradient;
    std::array<Vec<N>, 3> second;
  };
  template <class N>
  [[nodiscard]] Fraction<N> squared_distance(const Point3& x, Site s, bool second = false) const;
  [[nodiscard]] bool behind(Site site, Site other) const;
  [[nodiscard]] bool hold(std::span<const Condition> conditions, const Box3& box) const;

  const Shape& shape_;
  std::vector<std::vector<Condition>> condition_;
};

}  // namespace blum::verify
