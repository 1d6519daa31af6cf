#include "brute_setting.hpp"

#include "blum/kernel/check.hpp"

namespace blum::brute {
namespace {

// Vector and Moving are arrays, so their operators are not found by argument.
using brute::dot;
using brute::operator-;

Affine operator-(const Affine& a, const Rational& b) { return {a.cu, a.cv, a.c - b}; }
Affine operator-(const Affine& a, const Affine& b) { return {a.cu - b.cu, a.cv - b.cv, a.c - b.c}; }
Affine operator*(const Affine& a, const Rational& k) { return {a.cu * k, a.cv * k, a.c * k}; }

Moving operator-(const Moving& x, const Vector& p) {
  return {x[0] - p[0], x[1] - p[1], x[2] - p[2]};
}

Affine dot(const Moving& x, const Vector& w) {
  Affine r;
  for (std::size_t k = 0; k < 3; ++k) {
    r.cu += x[k].cu * w[k];
    r.cv += x[k].cv * w[k];
    r.c += x[k].c * w[k];
  }
  return r;
}

Quadratic square(const Affine& a) {
  return {a.cu * a.cu, 2 * a.cu * a.cv, a.cv * a.cv, 2 * a.cu * a.c, 2 * a.cv * a.c, a.c * a.c};
}

Quadratic combine(const Quadratic& a, const Rational& k, const Quadratic& b) {
  Quadratic r;
  for (std::size_t i = 0; i < 6; ++i) r[i] = a[i] + k * b[i];
  return r;
}

Quadratic square(const Moving& x) {
  return combine(combine(square(x[0]), 1, square(x[1])), 1, square(x[2]));
}

Quadratic as_quadratic(const Affine& a) { return {0, 0, 0, a.cu, a.cv, a.c}; }

struct NotGeneric {};

/// What a site's distance and domain look like in (u, v).
struct SiteForms {
  Quadratic squared_distance;
  std::vector<Affine> domain;
};

struct TriangleForms {
  Affine plane;                 ///< n.(x - a), n outward
  std::array<Affine, 3> prism;  ///< <= 0 over the triangle
  Rational nn;
};

TriangleForms triangle_forms(const Solid& solid, const Moving& x, std::uint32_t t) {
  std::array<Vector, 3> p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = exact(solid.point[solid.triangle[t].vertex[k]]);
  const Vector n = cross(p[1] - p[0], p[2] - p[0]);
  TriangleForms out{dot(x - p[0], n), {}, dot(n, n)};
  for (std::size_t k = 0; k < 3; ++k) out.prism[k] = dot(x - p[k], cross(p[(k + 1) % 3] - p[k], n));
  return out;
}

SiteForms site_forms(const Solid& solid, const Moving& x, SiteId s, DiagramKind kind) {
  const SiteIndex index(solid);
  const std::uint32_t e = index.element(s);
  SiteForms out;
  if (index.kind(s) == SiteKind::kVertex) {
    const Vector p = exact(solid.point[e]);
    out.squared_distance = square(x - p);
    for (const std::uint32_t k : solid.edges_at(e)) {
      const auto& ends = solid.edge[k].vertex;
      const std::uint32_t other = ends[0] == e ? ends[1] : ends[0];
      out.domain.push_back(dot(x - p, exact(solid.point[other]) - p));
    }
  } else if (index.kind(s) == SiteKind::kEdge) {
    const SolidEdge& edge = solid.edge[e];
    const Vector a = exact(solid.point[edge.vertex[0]]), b = exact(solid.point[edge.vertex[1]]);
    const Vector d = b - a;
    const Rational dd = dot(d, d);
    const Affine along = dot(x - a, d);
    out.squared_distance = combine(square(x - a), -1 / dd, square(along));
    out.domain = {dot(x - b, d), along * Rational(-1)};
    for (const std::uint32_t t : edge.triangle) {
      for (const std::uint32_t v : solid.triangle[t].vertex) {
        if (v == edge.vertex[0] || v == edge.vertex[1]) continue;
        const Vector c = exact(solid.point[v]) - a;  // its part orthogonal to d points into t
        const Rational cd = dot(c, d);
        Vector w;
        for (std::size_t k = 0; k < 3; ++k) w[k] = c[k] * dd - d[k] * cd;
        out.domain.push_back(dot(x - a, w));
      }
    }
  } else {
    const TriangleForms t = triangle_forms(solid, x, e);
    out.squared_distance = combine({}, 1 / t.nn, square(t.plane));
    if (kind == DiagramKind::kMedial) out.domain.push_back(t.plane);
    out.domain.insert(out.domain.end(), t.prism.begin(), t.prism.end());
  }
  return out;
}

bool degenerate(const Solid& solid, SiteId s) {
  const SiteIndex index(solid);
  const std::uint32_t e = index.element(s);
  if (index.kind(s) == SiteKind::kVertex) return solid.vertex_degenerate[e];
  return index.kind(s) == SiteKind::kEdge && solid.edge[e].kind == EdgeKind::kFlat;
}

class Builder {
 public:
  explicit Builder(Setting& s) : s_(s) {}

  Function function(const Quadratic& g) {
    const auto factors = s_.factor(g);
    if (!factors) throw NotGeneric{};
    Function f{factors->sign, {}};
    for (const auto& [curve, exponent] : factors->curve) {
      const auto [it, fresh] = known_.try_emplace(curve, static_cast<int>(s_.curve.size()));
      if (fresh) s_.curve.push_back(curve);
      f.curve.emplace_back(it->second, exponent);
    }
    return f;
  }

  void build(std::span<const SiteId> candidates, const std::vector<Affine>& limits) {
    const Solid& solid = *s_.solid;
    std::vector<SiteForms> forms;
    for (const SiteId c : candidates) {
      if (degenerate(solid, c)) continue;
      s_.site.push_back(c);
      forms.push_back(site_forms(solid, s_.x, c, s_.kind));
    }
    const std::size_t k = s_.site.size();
    s_.difference.assign(k, std::vector<Function>(k));
    s_.essential.assign(k, std::vector<char>(k, 0));
    for (std::size_t i = 0; i < k; ++i) {
      s_.domain.emplace_back();
      for (const Affine& a : forms[i].domain) s_.domain.back().push_back(function(as_quadratic(a)));
      for (std::size_t j = 0; j < i; ++j) {
        Function f = function(combine(forms[i].squared_distance, -1, forms[j].squared_distance));
        s_.difference[i][j] = f;
        f.sign = -f.sign;
        s_.difference[j][i] = std::move(f);
        s_.essential[i][j] = s_.essential[j][i] =
            s_.kind == DiagramKind::kVoronoi || !redundant(solid, s_.site[i], s_.site[j]);
      }
    }
    for (const std::uint32_t t : s_.triangle) {
      const TriangleForms form = triangle_forms(solid, s_.x, t);
      s_.plane.push_back(function(as_quadratic(form.plane)));
      s_.prism.emplace_back();
      for (const Affine& a : form.prism) s_.prism.back().push_back(function(as_quadratic(a)));
    }
    for (const Affine& a : limits) {
      s_.limit.push_back(function(as_quadratic(a)));
      s_.limit_value.push_back(a.c);
    }
  }

 private:
  Setting& s_;
  std::map<Curve, int> known_;
};

}  // namespace

std::optional<Factors> Setting::factor(const Quadratic& g) const {
  const auto& [uu, uv, vv, u, v, one] = g;
  std::array<std::array<Rational, 3>, 3> q;  // [power of v][power of s], with u = s - shear * v
  q[2][0] = uu * shear * shear - uv * shear + vv;
  q[1][1] = uv - 2 * shear * uu;
  q[1][0] = v - shear * u;
  q[0][2] = uu;
  q[0][1] = u;
  q[0][0] = one;
  mpz_class denominator = 1;
  for (const auto& row : q)
    for (const Rational& a : row) denominator = lcm(denominator, a.get_den());
  std::array<Poly, 3> c;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (q[i][j] != 0)
        c[i].set(static_cast<slong>(j), q[i][j].get_num() * (denominator / q[i][j].get_den()));
  Factors out;
  if (!factorize(c, out)) return std::nullopt;
  return out;
}

std::optional<std::pair<int, int>> Setting::essential_pair(const std::vector<int>& a,
                                                           const std::vector<int>& b) const {
  for (const int i : a)
    for (const int j : b)
      if (essential[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)])
        return std::pair(i, j);
  return std::nullopt;
}

std::vector<SiteId> Setting::ids(const std::vector<int>& sites) const {
  std::vector<SiteId> out;
  for (const int i : sites) out.push_back(site[static_cast<std::size_t>(i)]);
  return out;
}

Moving Setting::foot(int i) const {
  const SiteIndex index(*solid);
  const SiteId s = site[static_cast<std::size_t>(i)];
  const std::uint32_t e = index.element(s);
  const auto constant = [](const Vector& p) {
    return Moving{Affine{0, 0, p[0]}, Affine{0, 0, p[1]}, Affine{0, 0, p[2]}};
  };
  if (index.kind(s) == SiteKind::kVertex) return constant(exact(solid->point[e]));
  Moving out;
  if (index.kind(s) == SiteKind::kEdge) {
    const Vector a = exact(solid->point[solid->edge[e].vertex[0]]);
    const Vector d = exact(solid->point[solid->edge[e].vertex[1]]) - a;
    const Affine along = dot(x - a, d);
    out = constant(a);
    for (std::size_t k = 0; k < 3; ++k)
      out[k] = out[k] - along * Rational(-d[k] / brute::dot(d, d));
  } else {
    const auto& corner = solid->triangle[e].vertex;
    const Vector a = exact(solid->point[corner[0]]);
    const Vector n = cross(exact(solid->point[corner[1]]) - a, exact(solid->point[corner[2]]) - a);
    const Affine height = dot(x - a, n);
    out = x;
    for (std::size_t k = 0; k < 3; ++k)
      out[k] = out[k] - height * Rational(n[k] / brute::dot(n, n));
  }
  return out;
}

Setting segment_setting(const Solid& solid, const Segment& segment,
                        std::span<const SiteId> candidates,
                        std::span<const std::uint32_t> triangles, DiagramKind kind) {
  Setting s;
  s.solid = &solid;
  s.kind = kind;
  s.triangle.assign(triangles.begin(), triangles.end());
  s.x[static_cast<std::size_t>(segment.axis)] = {0, 1, 0};
  s.x[static_cast<std::size_t>(u_axis(segment.axis))] = {0, 0, Rational(segment.u)};
  s.x[static_cast<std::size_t>(v_axis(segment.axis))] = {0, 0, Rational(segment.v)};
  Builder(s).build(candidates, {{0, 1, -Rational(segment.t0)}, {0, -1, Rational(segment.t1)}});
  return s;
}

Setting rect_setting(const Solid& solid, const Rect& rect, std::span<const SiteId> candidates,
                     std::span<const std::uint32_t> triangles, bool interior, DiagramKind kind) {
  for (int attempt = 0; attempt < 1000; ++attempt) {
    Setting s;
    s.solid = &solid;
    s.interior = interior;
    s.kind = kind;
    s.triangle.assign(triangles.begin(), triangles.end());
    s.x[static_cast<std::size_t>(rect.axis)] = {0, 0, Rational(rect.level)};
    s.x[static_cast<std::size_t>(u_axis(rect.axis))] = {1, 0, 0};
    s.x[static_cast<std::size_t>(v_axis(rect.axis))] = {0, 1, 0};
    s.shear = Rational(11 + attempt, 32);
    s.shear.canonicalize();
    try {
      Builder(s).build(candidates, {{0, 1, -Rational(rect.v0)},    // kLowV
                                    {-1, 0, Rational(rect.u1)},    // kHighU
                                    {0, -1, Rational(rect.v1)},    // kHighV
                                    {1, 0, -Rational(rect.u0)}});  // kLowU
      return s;
    } catch (const NotGeneric&) {
      // A line or asymptote is parallel to the sweep line: finitely many shears do that.
    }
  }
  BLUM_CHECK(!"no generic shear");
  return {};
}

}  // namespace blum::brute
