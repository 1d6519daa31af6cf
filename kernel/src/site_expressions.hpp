/// The polynomials of the predicates, written once for every number type (Ball, Wide, Exact).
#pragma once

#include <array>

#include "blum/kernel/ball.hpp"
#include "blum/kernel/site_geometry.hpp"
#include "blum/kernel/solid.hpp"

namespace blum::detail::expression {

template <class N>
using Vec = std::array<N, 3>;

template <class N>
Vec<N> minus(const Point3& a, const Point3& b) {
  return {N(a.x) - N(b.x), N(a.y) - N(b.y), N(a.z) - N(b.z)};
}
template <class N>
Vec<N> minus(const Vec<N>& a, const Vec<N>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class N>
Vec<N> times(const Vec<N>& a, const N& s) {
  return {a[0] * s, a[1] * s, a[2] * s};
}
template <class N>
N inner(const Vec<N>& a, const Vec<N>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class N>
Vec<N> outer(const Vec<N>& a, const Vec<N>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class N>
Vec<N> normal(const Solid& s, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return outer<N>(minus<N>(s.point[b], s.point[a]), minus<N>(s.point[c], s.point[a]));
}
template <class N>
Vec<N> normal(const Solid& s, std::uint32_t triangle) {
  const auto& v = s.triangle[triangle].vertex;
  return normal<N>(s, v[0], v[1], v[2]);
}

template <class N>
Vec<N> half_space_direction(const Solid& s, const HalfSpace& h) {
  using Kind = HalfSpace::Kind;
  const Vec<N> u = minus<N>(s.point[h.b], s.point[h.a]);
  switch (h.kind) {
    case Kind::kAlong:
      return u;
    case Kind::kInFace: {
      const Vec<N> d = minus<N>(s.point[h.c], s.point[h.a]);
      return minus<N>(times<N>(d, inner<N>(u, u)), times<N>(u, inner<N>(d, u)));
    }
    case Kind::kPrism:
      return outer<N>(u, normal<N>(s, h.a, h.b, h.c));
    case Kind::kPlane:
      break;
  }
  return normal<N>(s, h.a, h.b, h.c);
}

/// Squared distance to a site's carrier as a fraction with positive denominator.
template <class N>
struct Fraction {
  N numerator, denominator;
};

template <class N>
Fraction<N> squared_distance(const SiteGeometry& g, SiteId site, const Point3& x) {
  const Solid& s = g.solid();
  const auto i = g.index().element(site);
  switch (g.index().kind(site)) {
    case SiteKind::kVertex: {
      const Vec<N> d = minus<N>(x, s.point[i]);
      return {inner<N>(d, d), N(1.0)};
    }
    case SiteKind::kEdge: {
      const Point3& a = s.point[s.edge[i].vertex[0]];
      const Vec<N> u = minus<N>(s.point[s.edge[i].vertex[1]], a);
      const Vec<N> m = outer<N>(minus<N>(x, a), u);
      return {inner<N>(m, m), inner<N>(u, u)};
    }
    case SiteKind::kFace:
      break;
  }
  const Vec<N> n = normal<N>(s, i);
  const N h = inner<N>(n, minus<N>(x, s.point[s.triangle[i].vertex[0]]));
  return {h * h, inner<N>(n, n)};
}

/// Unit outer normal, unit direction, with a relative error of about 1e-15 (precision is raised
/// until it is).
BallVector unit_normal(const Solid& s, std::uint32_t triangle);
BallVector unit_direction(const Solid& s, std::uint32_t edge);

}  // namespace blum::detail::expression
