#include "gains.hpp"

#include <algorithm>
#include <cmath>

namespace blum::verify {
namespace {

/// Sign of (p - q).w for two vertices.
int ahead(const Shape& shape, const Vec<Rational>& w, std::uint32_t q, std::uint32_t p) {
  return p == q ? 0 : sgn(inner(shape.along<Rational>(q, p), w));
}

/// D'': a plane across w parts a (ahead) from b; where they meet it goes through a common corner.
bool lies_ahead(const Shape& shape, const SharedFeet& feet, Site a, Site b,
                const Vec<Rational>& w) {
  const auto common = common_corners(shape, a, b);
  if (common.empty())
    return std::ranges::all_of(shape.corners(a), [&](std::uint32_t p) {
      return std::ranges::all_of(shape.corners(b),
                                 [&](std::uint32_t q) { return ahead(shape, w, q, p) > 0; });
    });
  const auto v = common.front();
  // One lies on its side and may touch the plane, the other strictly, but for v and an edge from
  // there that holds no foot.
  const auto parted = [&](Site s, int sign, bool strictly) {
    int on_plane = 0;
    for (const auto p : shape.corners(s)) {
      if (p == v) continue;
      const int side = ahead(shape, w, v, p);
      if (side == sign || (side == 0 && !strictly)) continue;
      if (side != 0 || ++on_plane > 1 || feet.vertex(p) || feet.edge(v, p)) return false;
    }
    return true;
  };
  return (parted(a, 1, true) && parted(b, -1, false)) ||
         (parted(a, 1, false) && parted(b, -1, true));
}

/// Bounds of the products with w of all gradients that the distance to a site can have where it
/// governs (docs/proofs.md, "Fans"); of none for a vertex.
std::optional<std::array<double, 2>> fan(const Exclusion& exclusion, Site s, const BallVector& w) {
  const Shape& shape = exclusion.sites().shape();
  const auto inward = [&](std::uint32_t t) { return exclusion.unit(shape.face_site(t)); };
  if (shape.kind(s) == Kind::kVertex) return std::nullopt;
  if (shape.kind(s) == Kind::kFace) {
    const Ball c = -dot(inward(shape.element(s)), w);
    return std::array{c.low(), c.high()};
  }
  const auto& side = shape.edge[shape.element(s)].triangle;
  const BallVector a = inward(side[0]), b = inward(side[1]), sum = plus(a, b);
  const Ball ca = -dot(a, w), cb = -dot(b, w);
  double low = std::min(ca.low(), cb.low()), high = std::max(ca.high(), cb.high());
  const double square = dot(sum, sum).low();
  if (!(square > 0)) return std::nullopt;
  const double stretch = 2 / std::sqrt(square) * (1 + 0x1p-40);  // p + q of p a + q b of length 1
  if (low < 0) low *= stretch;
  if (high > 0) high *= stretch;
  return std::array{low, high};
}

bool gains_by_fans(const Exclusion& exclusion, Site a, Site b, const Vec<Rational>& w) {
  const BallVector v{enclose(w[0]), enclose(w[1]), enclose(w[2])};
  const auto fa = fan(exclusion, a, v), fb = fan(exclusion, b, v);
  return fa && fb && (*fa)[1] < (*fb)[0];
}

/// No point x of the box has v for its foot on both edges: (x - v).e = (x - v).f = 0 for none. By
/// what may be a foot, or on a segment by exact signs.
bool vertex_is_no_foot(const Shape& shape, const Box3& box, const SharedFeet& feet, std::uint32_t v,
                       const Vec<Rational>& e, const Vec<Rational>& f) {
  if (!feet.vertex(v)) return true;
  int axis = -1, extended = 0;
  for (int k = 0; k < 3; ++k)
    if (box.lo[k] != box.hi[k]) {
      axis = k;
      ++extended;
    }
  if (extended != 1) return false;
  const Vec<Rational> d = minus(exactly<Rational>(box.lo), exactly<Rational>(shape.point[v]));
  return inner(d, e) * f[axis] != inner(d, f) * e[axis];
}

/// Two edges with one common vertex, and their directions from there.
struct Fork {
  std::uint32_t vertex;
  Vec<Rational> a, b;
};
std::optional<Fork> fork(const Shape& shape, Site a, Site b) {
  if (shape.kind(a) != Kind::kEdge || shape.kind(b) != Kind::kEdge) return std::nullopt;
  const auto common = common_corners(shape, a, b);
  if (common.size() != 1) return std::nullopt;
  const auto away = [&](Site s) {
    const auto& ends = shape.edge[shape.element(s)].vertex;
    return shape.along<Rational>(common[0], ends[ends[0] == common[0] ? 1 : 0]);
  };
  return Fork{common[0], away(a), away(b)};
}

/// Sign of w.(a / |a| - b / |b|).
int compare_along(const Fork& f, const Vec<Rational>& w) {
  return compare_over_roots<Rational>(inner(f.a, w), inner(f.a, f.a), inner(f.b, w),
                                      inner(f.b, f.b));
}

/// Points whose hull holds the feet on s of all points of the box that s governs.
std::vector<Vec<Rational>> hull_of_feet(const Shape& shape, const Box3& box, Site s) {
  std::vector<Vec<Rational>> hull;
  for (const auto v : shape.corners(s)) hull.push_back(exactly<Rational>(shape.point[v]));
  if (hull.size() != 2) return hull;
  const Vec<Rational> from = hull[0], along = minus(hull[1], from);
  Rational low = 1, high = 0;
  for (const Point3& x : BoxCorners(box)) {
    const Rational share = inner(minus(exactly<Rational>(x), from), along) / inner(along, along);
    low = std::min(low, share);
    high = std::max(high, share);
  }
  if (low > 0 && low < 1) hull[0] = plus(from, times(along, low));
  if (high > 0 && high < 1) hull[1] = plus(from, times(along, high));
  return hull;
}

/// "Depth": a point of the box with feet y_a in a face and y_b on b has |y_a - y_b|^2 = 2 d h, h
/// the depth of y_b before the face. So there is none where b is farther than that beyond a side of
/// it.
bool apart_by_depth(const Shape& shape, const Box3& box, Site a, Site b) {
  if (shape.kind(a) != Kind::kFace) return false;
  const auto& v = shape.triangle[shape.element(a)].vertex;
  const Vec<Rational> n = shape.normal<Rational>(shape.element(a));
  const auto above = [&](const Vec<Rational>& w, std::uint32_t from, const Vec<Rational>& x) {
    return Rational(inner(w, minus(x, exactly<Rational>(shape.point[from]))));
  };
  const std::vector<Vec<Rational>> feet = hull_of_feet(shape, box, b);
  Rational distance = 0, depth = 0;  // both times |n|
  for (const Point3& x : BoxCorners(box))
    distance = std::max(distance, Rational(-above(n, v[0], exactly<Rational>(x))));
  for (const auto& y : feet) depth = std::max(depth, Rational(-above(n, v[0], y)));
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec<Rational> side = outer(shape.along<Rational>(v[k], v[(k + 1) % 3]), n);
    const Rational farthest = 2 * distance * depth * inner(side, side) / inner(n, n);
    if (std::ranges::all_of(feet, [&](const auto& y) {
          const Rational beyond = above(side, v[k], y);
          return beyond > 0 && beyond * beyond > farthest;
        }))
      return true;
  }
  return false;
}

}  // namespace

bool gains_from_vertex(const Shape& shape, const Box3& box, const SharedFeet& feet, Site a, Site b,
                       const Vec<Rational>& w) {
  const auto f = fork(shape, a, b);
  return f && compare_along(*f, w) > 0 &&
         vertex_is_no_foot(shape, box, feet, f->vertex, f->a, f->b);
}

bool never_tie_from_vertex(const Shape& shape, const Box3& box, Site a, Site b) {
  const auto f = fork(shape, a, b);
  if (!f) return false;
  // Feet off the vertex lie ahead of it on both edges.
  int sum = 0;
  std::vector<Rational> behind_a, behind_b;
  const BoxCorners corners(box);
  for (const Point3& x : corners) {
    const Vec<Rational> d = minus(exactly<Rational>(x), exactly<Rational>(shape.point[f->vertex]));
    sum += compare_along(*f, d);
    behind_a.push_back(-inner(d, f->a));
    behind_b.push_back(-inner(d, f->b));
  }
  return std::abs(sum) == corners.count || exclude_each_other(behind_a, behind_b);
}

bool gains(const Exclusion& exclusion, const Box3& box, const SharedFeet& feet, Site a, Site b,
           const Vec<Rational>& w) {
  const Sites& sites = exclusion.sites();
  return std::ranges::all_of(BoxCorners(box),
                             [&](const Point3& x) { return sites.slope(x, a, b, w) < 0; }) ||
         gains_by_fans(exclusion, a, b, w) ||
         gains_from_vertex(sites.shape(), box, feet, a, b, w) ||
         (!feet.shared(a, b) && lies_ahead(sites.shape(), feet, a, b, w));
}

bool gains_where_both_govern(const Exclusion& exclusion, const Box3& box, const SharedFeet& feet,
                             Site a, Site b, const std::optional<Vec<Rational>>& w, int& looks) {
  if (--looks < 0) return false;
  const Shape& shape = exclusion.sites().shape();
  if (!may_both_govern(exclusion, box, a, b) || (w && gains(exclusion, box, feet, a, b, *w)) ||
      apart_by_depth(shape, box, a, b) || apart_by_depth(shape, box, b, a))
    return true;
  const auto half = halved(box);
  return half && std::ranges::all_of(*half, [&](const Box3& part) {
           return gains_where_both_govern(exclusion, part, feet, a, b, w, looks);
         });
}

bool may_both_govern(const Exclusion& exclusion, const Box3& box, Site a, Site b) {
  const Sites& sites = exclusion.sites();
  return !sites.never_essential(a, b) && !exclusion.never_tie(a, b, box) && !sites.beyond(a, box) &&
         !sites.beyond(b, box) && !never_tie_from_vertex(sites.shape(), box, a, b);
}

}  // namespace blum::verify
