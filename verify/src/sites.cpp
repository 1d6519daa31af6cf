#include "sites.hpp"

#include <algorithm>
#include <limits>

namespace blum::verify {

std::vector<Point3> corners_of(const Box3& box) {
  std::vector<Point3> corners{box.lo};
  for (int k = 0; k < 3; ++k)
    for (std::size_t n = corners.size(); box.lo[k] != box.hi[k] && n > 0; --n) {
      corners.push_back(corners[n - 1]);
      corners.back()[k] = box.hi[k];
    }
  return corners;
}

Point3 center_of(const Box3& box) {
  Point3 c;
  for (int k = 0; k < 3; ++k)
    c[k] = box.lo[k] == box.hi[k] ? box.lo[k] : 0.5 * box.lo[k] + 0.5 * box.hi[k];
  return c;
}

std::array<double, 3> half_widths(const Box3& box) {
  const Point3 c = center_of(box);
  std::array<double, 3> h{};
  for (int k = 0; k < 3; ++k)
    h[k] = std::max(box.hi[k] - c[k], c[k] - box.lo[k]) * (1 + 0x1p-48) + 0x1p-1000;
  return h;
}

/// Vertices: its edges (the polar cone). Edges: their ends, and not within their faces. Faces:
/// their sides, and their inner side.
Sites::Sites(const Shape& shape) : shape_(shape), condition_(shape.sites()) {
  const auto along = [&](auto a, auto b) { return shape.along<Rational>(a, b); };
  for (std::uint32_t v = 0; v < shape.point.size(); ++v)
    for (const auto e : shape.edges_at[v])
      condition_[v].push_back({along(v, shape.other_end(e, v)), v, {}});
  for (std::uint32_t e = 0; e < shape.edge.size(); ++e) {
    const auto& [vertex, triangle, bend] = shape.edge[e];
    const Vec<Rational> u = along(vertex[0], vertex[1]), back = along(vertex[1], vertex[0]);
    condition_[shape.edge_site(e)] = {
        {u, vertex[1], {}},
        {back, vertex[0], {}},
        {outer(shape.normal<Rational>(triangle[0]), u), vertex[0], {}},
        {outer(shape.normal<Rational>(triangle[1]), back), vertex[0], {}}};
  }
  for (std::uint32_t t = 0; t < shape.triangle.size(); ++t) {
    const auto& [v, edge] = shape.triangle[t];
    const Vec<Rational>& n = shape.normal<Rational>(t);
    auto& own = condition_[shape.face_site(t)];
    for (std::size_t k = 0; k < 3; ++k)
      own.push_back({outer(along(v[k], v[(k + 1) % 3]), n), v[k], edge[k]});
    own.push_back({n, v[0], {}});
  }
}

bool Sites::hold(std::span<const Condition> conditions, const Box3& box) const {
  const auto corners = corners_of(box);
  return std::ranges::all_of(conditions, [&](const Condition& c) {
    return std::ranges::all_of(corners, [&](const Point3& x) { return sign(c, x) <= 0; });
  });
}

bool Sites::beyond(Site s, const Box3& box) const {
  const auto corners = corners_of(box);
  return std::ranges::any_of(conditions(s), [&](const Condition& c) {
    return std::ranges::all_of(corners, [&](const Point3& x) { return sign(c, x) > 0; });
  });
}

bool Sites::domain_meets(Site s, const Box3& box) const {
  if (beyond(s, box)) return false;
  if (in_domain(center_of(box), s)) return true;
  int flat = 0;
  while (flat < 3 && box.lo[flat] != box.hi[flat]) ++flat;
  for (int axis = 0; flat == 3 && axis < 3; ++axis)
    for (const Point3* end : {&box.lo, &box.hi}) {
      Box3 face = box;
      face.lo[axis] = face.hi[axis] = (*end)[axis];
      if (domain_meets(s, face)) return true;
    }
  if (flat == 3) return false;
  std::vector<Vec<Rational>> polygon;  // clipped by one condition after the other
  for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    Point3 p = box.lo;
    if (u == 1) p[u_axis(flat)] = box.hi[u_axis(flat)];
    if (v == 1) p[v_axis(flat)] = box.hi[v_axis(flat)];
    polygon.push_back(exactly<Rational>(p));
  }
  for (const Condition& c : conditions(s)) {
    const Vec<Rational> base = exactly<Rational>(shape_.point[c.base]);
    std::vector<Vec<Rational>> kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const auto &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
      const Rational hp = inner(c.w.as<Rational>(), minus(p, base)),
                     hq = inner(c.w.as<Rational>(), minus(q, base));
      if (hp <= 0) kept.push_back(p);
      if (hp * hq < 0) kept.push_back(plus(p, times(minus(q, p), Rational(hp / (hp - hq)))));
    }
    polygon = std::move(kept);
  }
  return !polygon.empty();
}

bool Sites::covers_inside(Site face, const Box3& box) const {
  if (hold(conditions(face), box)) return true;
  const auto t = shape_.element(face);
  return std::ranges::any_of(shape_.triangle[t].edge, [&](std::uint32_t e) {
    const auto but_there = [&](Site s) {
      return std::ranges::all_of(conditions(s), [&](const Condition& c) {
        return c.edge == e || hold({&c, 1}, box);
      });
    };
    return shape_.edge[e].bend == Bend::kFlat && but_there(face) &&
           but_there(shape_.face_site(shape_.across(e, t)));
  });
}

std::vector<std::uint32_t> Sites::meeting(std::span<const std::uint32_t> triangles,
                                          const Box3& box) const {
  const auto corners = corners_of(box);
  std::vector<std::uint32_t> kept;
  for (const auto t : triangles) {
    const auto& v = shape_.triangle[t].vertex;
    bool apart = false;
    for (int k = 0; k < 3 && !apart; ++k) {
      const auto [low, high] =
          std::minmax({shape_.point[v[0]][k], shape_.point[v[1]][k], shape_.point[v[2]][k]});
      apart = low > box.hi[k] || high < box.lo[k];
    }
    if (apart || beyond(shape_.face_site(t), box) ||
        std::ranges::all_of(corners,
                            [&](const Point3& x) { return shape_.side_of_plane(t, x) < 0; }))
      continue;
    kept.push_back(t);
  }
  return kept;
}

template <class N>
Sites::Fraction<N> Sites::squared_distance(const Point3& x, Site s, bool second) const {
  const auto v = shape_.corners(s);
  const Vec<N> d = shape_.from<N>(v[0], x);
  const N zero(0.0), one(1.0), two(2.0);
  // The matrix is diagonal I + sign u u^T.
  const auto matrix = [&](const N& diagonal, const Vec<N>& u, const N& sign) {
    std::array<Vec<N>, 3> m;
    for (std::size_t j = 0; second && j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k)
        m[j][k] = N((j == k ? diagonal : zero) + sign * u[j] * u[k]);
    return m;
  };
  if (v.size() == 1)
    return {inner(d, d), one, times(d, two), matrix(one, Vec<N>{zero, zero, zero}, one)};
  if (v.size() == 2) {
    const Vec<N> u = shape_.along<N>(v[0], v[1]), m = outer(d, u);
    return {inner(m, m), inner(u, u), times(outer(u, m), two), matrix(inner(u, u), u, N(-1.0))};
  }
  const Vec<N>& n = shape_.normal<N>(shape_.element(s));
  const N h = inner(n, d);
  return {N(h * h), inner(n, n), times(n, N(two * h)), matrix(zero, n, one)};
}

bool Sites::farther(Site a, Site b, const Box3& box) const {
  const auto h = half_widths(box);
  return decide([&]<class N>(const N&) {
           const auto fa = squared_distance<N>(center_of(box), a, true),
                      fb = squared_distance<N>(center_of(box), b, true);
           const auto less = [&](const N& p, const N& q) {
             return N(p * fb.denominator - q * fa.denominator);
           };
           N least = less(fa.numerator, fb.numerator);
           for (std::size_t i = 0; i < 3; ++i) {
             N change = magnitude(less(fa.gradient[i], fb.gradient[i]));
             for (std::size_t j = 0; j < 3; ++j)
               change = N(change + magnitude(less(fa.second[i][j], fb.second[i][j])) * N(h[j]));
             least = N(least - change * N(h[i]));
           }
           return sign_of(least);
         }) > 0;
}

Ball Sites::square_of_distance(const Point3& x, Site s) const {
  const auto f = squared_distance<Ball>(x, s);
  return f.denominator.sign() == 1 ? divide(f.numerator, f.denominator)
                                   : Ball(0.0, std::numeric_limits<double>::infinity());
}

int Sites::compare(const Point3& x, Site a, Site b) const {
  return decide([&]<class N>(const N&) {
    const auto fa = squared_distance<N>(x, a), fb = squared_distance<N>(x, b);
    return sign_of(N(fa.numerator * fb.denominator - fb.numerator * fa.denominator));
  });
}

int Sites::compare_heights(const Point3& x, Site a, Site b, double sign_of_b) const {
  return decide([&]<class N>(const N&) {
    const Vec<N>&n = shape_.normal<N>(shape_.element(a)), &m = shape_.normal<N>(shape_.element(b));
    return compare_over_roots(inner(n, shape_.from<N>(shape_.corners(a)[0], x)), inner(n, n),
                              N(inner(m, shape_.from<N>(shape_.corners(b)[0], x)) * N(sign_of_b)),
                              inner(m, m));
  });
}

int Sites::slope(const Point3& x, Site a, Site b, const Exact& w) const {
  return decide([&]<class N>(const N&) {
    const Vec<N>& v = w.as<N>();
    if (shape_.kind(a) == Kind::kFace && shape_.kind(b) == Kind::kFace) {
      // Inside both planes d = -height / |n|.
      const Vec<N>&n = shape_.normal<N>(shape_.element(a)),
            &m = shape_.normal<N>(shape_.element(b));
      return compare_over_roots(inner(m, v), inner(m, m), inner(n, v), inner(n, n));
    }
    const auto fa = squared_distance<N>(x, a), fb = squared_distance<N>(x, b);
    return sign_of(
        N(inner(fa.gradient, v) * fb.denominator - inner(fb.gradient, v) * fa.denominator));
  });
}

int Sites::outward(const Point3& x, Site a, const Exact& w) const {
  // grad d^2 = 2 (x - foot).
  return decide([&]<class N>(const N&) {
    return sign_of(inner(squared_distance<N>(x, a).gradient, w.as<N>()));
  });
}

std::vector<Site> Sites::governors(const Point3& x, std::span<const Site> candidates) const {
  std::vector<Site> best;
  for (const Site s : candidates) {
    const int c = best.empty() ? -1 : compare(x, s, best.front());
    if (c > 0 || !in_domain(x, s)) continue;
    if (c < 0) best.clear();
    best.push_back(s);
  }
  return best;
}

bool Sites::behind(Site site, Site other) const {
  const auto i = shape_.element(site);
  const auto outside = [&](std::uint32_t t) {
    return std::ranges::all_of(shape_.corners(other), [&](std::uint32_t v) {
      return shape_.has_corner(shape_.face_site(t), v) ||
             shape_.side_of_plane(t, shape_.point[v]) >= 0;
    });
  };
  if (shape_.kind(site) == Kind::kFace) return outside(i);
  if (shape_.kind(site) == Kind::kEdge)
    return std::ranges::all_of(shape_.edge[i].triangle, outside);
  return !shape_.has(i, Bend::kConvex) && std::ranges::all_of(shape_.triangles_at[i], outside);
}

}  // namespace blum::verify
