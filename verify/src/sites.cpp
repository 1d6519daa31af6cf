#include "sites.hpp"

#include <algorithm>
#include <limits>

namespace blum::verify {

BoxCorners::BoxCorners(const Box3& box) {
  for (int bits = 0; bits < 8; ++bits) {
    Point3 p;
    bool repeated = false;
    for (int k = 0; k < 3; ++k) {
      const bool high = (bits >> k & 1) != 0;
      p[k] = high ? box.hi[k] : box.lo[k];
      repeated |= high && box.hi[k] == box.lo[k];
    }
    if (!repeated) point[count++] = p;
  }
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

/// They are not iff r p + q > 0 at all corners for some r > 0.
bool exclude_each_other(std::span<const Rational> p, std::span<const Rational> q) {
  Rational low = 0;
  std::optional<Rational> high;
  for (std::size_t k = 0; k < p.size(); ++k) {
    if (sgn(p[k]) == 0) {
      if (sgn(q[k]) <= 0) return false;
      continue;
    }
    const Rational r = -q[k] / p[k];
    if (sgn(p[k]) > 0)
      low = std::max(low, r);
    else
      high = high ? std::min(*high, r) : r;
  }
  return !high || low < *high;
}

Sites::Sites(const Shape& shape) : shape_(shape) {
  for (Site s = 0; s < shape.sites(); ++s) condition_.push_back(make_conditions(s));
  for (std::uint32_t v = 0; v < shape.point.size(); ++v) cone_.push_back(vertex_cone(shape, v));
}

std::vector<Condition> Sites::make_conditions(Site s) const {
  using Type = Condition::Type;
  const auto i = shape_.element(s);
  std::vector<Condition> r;
  switch (shape_.kind(s)) {
    case Kind::kVertex:
      for (const auto e : shape_.edges_at[i]) {
        const auto& ends = shape_.edge[e].vertex;
        r.push_back({Type::kAlong, i, ends[ends[0] == i ? 1 : 0], 0, i});
      }
      break;
    case Kind::kEdge: {
      const auto [a, b] = shape_.edge[i].vertex;
      r = {{Type::kAlong, a, b, 0, b}, {Type::kAlong, b, a, 0, a}};
      r.push_back({Type::kInFace, a, b, shape_.edge[i].triangle[0], a});
      r.push_back({Type::kInFace, b, a, shape_.edge[i].triangle[1], a});
      break;
    }
    case Kind::kFace: {
      const auto& v = shape_.triangle[i].vertex;
      for (int k = 0; k < 3; ++k) r.push_back({Type::kPrism, v[k], v[(k + 1) % 3], i, v[k]});
      r.push_back({Type::kPlane, 0, 0, i, v[0]});
      break;
    }
  }
  return r;
}

std::size_t Sites::own_conditions(Site s) const {
  switch (shape_.kind(s)) {
    case Kind::kVertex:
      return 0;
    case Kind::kEdge:
      return 2;
    case Kind::kFace:
      break;
  }
  return 3;
}

template <class N>
Vec<N> Sites::direction(const Condition& c) const {
  switch (c.type) {
    case Condition::Type::kAlong:
      return shape_.along<N>(c.a, c.b);
    case Condition::Type::kPrism:
      return outer(shape_.along<N>(c.a, c.b), shape_.normal<N>(c.c));
    case Condition::Type::kInFace:
      return outer(shape_.normal<N>(c.c), shape_.along<N>(c.a, c.b));
    case Condition::Type::kPlane:
      break;
  }
  return shape_.normal<N>(c.c);
}

int Sites::sign(const Condition& c, const Point3& x) const {
  return decide([&]<class N>(const N&) {
    return sign_of(inner(direction<N>(c), minus(exactly<N>(x), exactly<N>(shape_.point[c.base]))));
  });
}

bool Sites::in_domain(const Point3& x, Site s) const {
  return std::ranges::all_of(conditions(s), [&](const Condition& c) { return sign(c, x) <= 0; });
}

bool Sites::beyond(Site s, const Box3& box) const {
  const BoxCorners corners(box);
  return std::ranges::any_of(conditions(s), [&](const Condition& c) {
    return std::ranges::all_of(corners, [&](const Point3& x) { return sign(c, x) > 0; });
  });
}

bool Sites::beyond_two(Site s, const Box3& box) const {
  const BoxCorners corners(box);
  std::vector<std::vector<Rational>> value;  // by condition, corner
  for (const Condition& c : conditions(s)) {
    value.emplace_back();
    const Vec<Rational> w = direction<Rational>(c);
    for (const Point3& x : corners)
      value.back().push_back(
          inner(w, minus(exactly<Rational>(x), exactly<Rational>(shape_.point[c.base]))));
  }
  for (std::size_t i = 0; i < value.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (exclude_each_other(value[i], value[j])) return true;
  return false;
}

bool Sites::hold(std::span<const Condition> conditions, const Box3& box) const {
  const BoxCorners corners(box);
  return std::ranges::all_of(conditions, [&](const Condition& c) {
    return std::ranges::all_of(corners, [&](const Point3& x) { return sign(c, x) <= 0; });
  });
}

bool Sites::covers(Site s, const Box3& box) const {
  return hold(conditions(s).first(own_conditions(s)), box);
}

std::vector<std::uint32_t> Sites::meeting(std::span<const std::uint32_t> triangles,
                                          const Box3& box) const {
  const BoxCorners corners(box);
  std::vector<std::uint32_t> kept;
  for (const auto t : triangles) {
    const auto& v = shape_.triangle[t].vertex;
    bool apart = false;
    for (int k = 0; k < 3 && !apart; ++k) {
      const double a = shape_.point[v[0]][k], b = shape_.point[v[1]][k], c = shape_.point[v[2]][k];
      apart = std::min({a, b, c}) > box.hi[k] || std::max({a, b, c}) < box.lo[k];
    }
    const auto all = [&](const Condition& c, int sign) {
      return std::ranges::all_of(corners,
                                 [&](const Point3& x) { return this->sign(c, x) == sign; });
    };
    const auto own = conditions(shape_.face_site(t));
    apart = apart || all(own[3], 1) || all(own[3], -1);
    for (std::size_t k = 0; k < 3 && !apart; ++k) apart = all(own[k], 1);
    if (!apart) kept.push_back(t);
  }
  return kept;
}

bool Sites::covers_inside(Site face, const Box3& box) const { return hold(conditions(face), box); }

bool Sites::covers_with_neighbour(Site face, const Box3& box) const {
  const auto t = shape_.element(face);
  const auto at = [](const Condition& c, const auto& edge) {
    return c.type == Condition::Type::kPrism &&
           std::minmax(c.a, c.b) == std::minmax(edge[0], edge[1]);
  };
  return std::ranges::any_of(shape_.triangle[t].edge, [&](std::uint32_t e) {
    const auto& edge = shape_.edge[e];
    const auto other = edge.triangle[edge.triangle[0] == t ? 1 : 0];
    const auto but_there = [&](Site s) {
      return std::ranges::all_of(conditions(s), [&](const Condition& c) {
        return at(c, edge.vertex) || hold({&c, 1}, box);
      });
    };
    return edge.bend == Bend::kFlat && but_there(face) && but_there(shape_.face_site(other));
  });
}

template <class N>
Sites::Fraction<N> Sites::squared_distance(const Vec<N>& x, Site s) const {
  const auto i = shape_.element(s);
  const Vec<N> d = minus(x, exactly<N>(shape_.point[*shape_.corners(s).begin()]));
  const N two(2.0);
  switch (shape_.kind(s)) {
    case Kind::kVertex:
      return {inner(d, d), N(1.0), times(d, two)};
    case Kind::kEdge: {
      const Vec<N> u = shape_.along<N>(shape_.edge[i].vertex[0], shape_.edge[i].vertex[1]);
      const Vec<N> m = outer(d, u);
      return {inner(m, m), inner(u, u), times(outer(u, m), two)};
    }
    case Kind::kFace:
      break;
  }
  const Vec<N> n = shape_.normal<N>(i);
  const N h = inner(n, d);
  return {N(h * h), inner(n, n), times(n, N(two * h))};
}

template <class N>
std::array<Vec<N>, 3> Sites::second_order(Site s) const {
  const auto i = shape_.element(s);
  std::array<Vec<N>, 3> m;
  Vec<N> u{N(0.0), N(0.0), N(0.0)};
  N diagonal(1.0), sign(-1.0);
  if (shape_.kind(s) == Kind::kEdge) {
    u = shape_.along<N>(shape_.edge[i].vertex[0], shape_.edge[i].vertex[1]);
    diagonal = inner(u, u);
  } else if (shape_.kind(s) == Kind::kFace) {
    u = shape_.normal<N>(i);
    diagonal = N(0.0);
    sign = N(1.0);
  }
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t k = 0; k < 3; ++k)
      m[j][k] = N((j == k ? diagonal : N(0.0)) + sign * u[j] * u[k]);
  return m;
}

bool Sites::farther(Site a, Site b, const Box3& box) const {
  const Point3 center = center_of(box);
  const auto h = half_widths(box);
  return decide([&]<class N>(const N&) {
           const Vec<N> c = exactly<N>(center);
           const auto fa = squared_distance(c, a), fb = squared_distance(c, b);
           const auto ma = second_order<N>(a), mb = second_order<N>(b);
           const auto less = [&](const N& p, const N& q) {
             return N(p * fb.denominator - q * fa.denominator);
           };
           N least = less(fa.numerator, fb.numerator);
           for (std::size_t i = 0; i < 3; ++i) {
             N change = magnitude(less(fa.gradient[i], fb.gradient[i]));
             for (std::size_t j = 0; j < 3; ++j)
               change = N(change + magnitude(less(ma[i][j], mb[i][j])) * N(h[j]));
             least = N(least - change * N(h[i]));
           }
           return sign_of(least);
         }) > 0;
}

Ball Sites::square_of_distance(const Point3& x, Site s) const {
  const auto f = squared_distance(exactly<Ball>(x), s);
  return f.denominator.sign() == 1 ? divide(f.numerator, f.denominator)
                                   : Ball(0.0, std::numeric_limits<double>::infinity());
}

int Sites::compare(const Point3& x, Site a, Site b) const {
  return decide([&]<class N>(const N&) {
    const Vec<N> p = exactly<N>(x);
    const auto fa = squared_distance(p, a), fb = squared_distance(p, b);
    return sign_of(N(fa.numerator * fb.denominator - fb.numerator * fa.denominator));
  });
}

int Sites::compare_heights(const Point3& x, Site a, Site b) const {
  return compare_heights(x, a, b, 1);
}

int Sites::compare_with_mirrored(const Point3& x, Site a, Site b) const {
  return compare_heights(x, a, b, -1);
}

int Sites::compare_heights(const Point3& x, Site a, Site b, double sign_of_b) const {
  return decide([&]<class N>(const N&) {
    const auto height = [&](Site s, N& squared_length) {
      const Vec<N> n = shape_.normal<N>(shape_.element(s));
      squared_length = inner(n, n);
      return inner(n, minus(exactly<N>(x), exactly<N>(shape_.point[*shape_.corners(s).begin()])));
    };
    N s(0.0), t(0.0);
    const N p = height(a, s), q = N(height(b, t) * N(sign_of_b));
    return compare_over_roots(p, s, q, t);
  });
}

namespace {
template <class N>
Vec<N> as(const Vec<Rational>& w);
template <>
Vec<Ball> as<Ball>(const Vec<Rational>& w) {
  return {enclose(w[0]), enclose(w[1]), enclose(w[2])};
}
template <>
Vec<Rational> as<Rational>(const Vec<Rational>& w) {
  return w;
}
}  // namespace

int Sites::slope(const Point3& x, Site a, Site b, const Vec<Rational>& w) const {
  const bool faces = shape_.kind(a) == Kind::kFace && shape_.kind(b) == Kind::kFace;
  return decide([&]<class N>(const N&) {
    const Vec<N> v = as<N>(w);
    if (faces) {
      // Inside both planes d = -height / |n|.
      const Vec<N> na = shape_.normal<N>(shape_.element(a)),
                   nb = shape_.normal<N>(shape_.element(b));
      return compare_over_roots(inner(nb, v), inner(nb, nb), inner(na, v), inner(na, na));
    }
    const auto fa = squared_distance(exactly<N>(x), a), fb = squared_distance(exactly<N>(x), b);
    return sign_of(
        N(inner(fa.gradient, v) * fb.denominator - inner(fb.gradient, v) * fa.denominator));
  });
}

int Sites::outward(const Point3& x, Site a, const Vec<Rational>& w) const {
  // grad d^2 = 2 (x - foot).
  return decide([&]<class N>(const N&) {
    return sign_of(inner(squared_distance(exactly<N>(x), a).gradient, as<N>(w)));
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
      return shape_.side_of_plane(t, shape_.point[v]) >= 0;
    });
  };
  switch (shape_.kind(site)) {
    case Kind::kVertex:
      return std::ranges::none_of(
                 shape_.edges_at[i],
                 [&](std::uint32_t e) { return shape_.edge[e].bend == Bend::kConvex; }) &&
             std::ranges::all_of(shape_.triangles_at[i], outside);
    case Kind::kEdge:
      return std::ranges::all_of(shape_.edge[i].triangle, outside);
    case Kind::kFace:
      break;
  }
  return outside(i);
}

bool Sites::never_essential(Site a, Site b) const { return a == b || behind(a, b) || behind(b, a); }

}  // namespace blum::verify
