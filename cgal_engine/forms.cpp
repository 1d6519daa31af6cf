#include "forms.hpp"

#include <CGAL/Simple_cartesian.h>

#include <algorithm>

namespace blum::cgal {
namespace {

using Kernel = CGAL::Simple_cartesian<Rational>;

Vector exact(const Point3& p) { return {Rational(p.x), Rational(p.y), Rational(p.z)}; }
Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Rational dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// (x - a) . w
Affine height(const Moving& x, const Vector& a, const Vector& w) {
  Affine out{0, 0, Rational(0) - dot(a, w)};
  for (std::size_t k = 0; k < 3; ++k) out = out + w[k] * x[k];
  return out;
}

Moving constant(const Vector& p) {
  return {Affine{0, 0, p[0]}, Affine{0, 0, p[1]}, Affine{0, 0, p[2]}};
}

/// p + t w
Moving along(const Moving& p, const Affine& t, const Vector& w) {
  Moving out = p;
  for (std::size_t k = 0; k < 3; ++k) out[k] = out[k] + w[k] * t;
  return out;
}

struct Corners {
  std::vector<std::uint32_t> id;
  std::vector<Vector> at;
};

Corners corners(const Solid& solid, SiteId s) {
  const SiteIndex index(solid);
  const std::uint32_t e = index.element(s);
  Corners out;
  if (index.kind(s) == SiteKind::kVertex) out.id = {e};
  if (index.kind(s) == SiteKind::kEdge)
    out.id.assign(solid.edge[e].vertex.begin(), solid.edge[e].vertex.end());
  if (index.kind(s) == SiteKind::kFace)
    out.id.assign(solid.triangle[e].vertex.begin(), solid.triangle[e].vertex.end());
  for (const auto v : out.id) out.at.push_back(exact(solid.point[v]));
  return out;
}

bool degenerate(const Solid& solid, SiteId s) {
  const SiteIndex index(solid);
  const std::uint32_t e = index.element(s);
  if (index.kind(s) == SiteKind::kVertex) return solid.vertex_degenerate[e];
  return index.kind(s) == SiteKind::kEdge && solid.edge[e].kind == EdgeKind::kFlat;
}

TriangleForm triangle_form(const Solid& solid, const Moving& x, std::uint32_t t) {
  std::array<Vector, 3> p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = exact(solid.point[solid.triangle[t].vertex[k]]);
  const Vector n = cross(minus(p[1], p[0]), minus(p[2], p[0]));
  TriangleForm out{t, height(x, p[0], n), {}};
  for (std::size_t k = 0; k < 3; ++k)
    out.prism[k] = height(x, p[k], cross(minus(p[(k + 1) % 3], p[k]), n));
  return out;
}

SiteForm site_form(const Solid& solid, const Moving& x, SiteId s) {
  const SiteIndex index(solid);
  const std::uint32_t e = index.element(s);
  const Corners c = corners(solid, s);
  SiteForm out;
  out.id = s;
  switch (index.kind(s)) {
    case SiteKind::kVertex:
      out.foot = constant(c.at[0]);
      for (const std::uint32_t k : solid.edges_at(e)) {
        const auto& ends = solid.edge[k].vertex;
        out.domain.push_back(
            height(x, c.at[0], minus(exact(solid.point[ends[ends[0] == e ? 1 : 0]]), c.at[0])));
      }
      break;
    case SiteKind::kEdge: {
      const Vector d = minus(c.at[1], c.at[0]);
      const Rational dd = dot(d, d);
      out.foot = along(constant(c.at[0]), (Rational(1) / dd) * height(x, c.at[0], d), d);
      out.domain = {height(x, c.at[1], d), Rational(-1) * height(x, c.at[0], d)};
      for (const std::uint32_t t : solid.edge[e].triangle)
        for (const std::uint32_t v : solid.triangle[t].vertex) {
          if (v == c.id[0] || v == c.id[1]) continue;
          // Orthogonal to the edge, in the triangle's plane, into the triangle.
          Vector w = minus(exact(solid.point[v]), c.at[0]);
          const Rational part = dot(w, d) / dd;
          for (std::size_t k = 0; k < 3; ++k) w[k] -= part * d[k];
          out.domain.push_back(height(x, c.at[0], w));
        }
      break;
    }
    case SiteKind::kFace: {
      const Vector n = cross(minus(c.at[1], c.at[0]), minus(c.at[2], c.at[0]));
      out.foot = along(x, (Rational(-1) / dot(n, n)) * height(x, c.at[0], n), n);
      const TriangleForm t = triangle_form(solid, x, e);
      out.domain = {t.plane, t.prism[0], t.prism[1], t.prism[2]};
      break;
    }
  }
  for (std::size_t k = 0; k < 3; ++k)
    out.squared_distance = out.squared_distance + square(x[k] - out.foot[k]);
  return out;
}

bool carrier_holds(const std::vector<Kernel::Point_3>& big, const Kernel::Point_3& p) {
  if (big.size() == 1) return big[0] == p;
  if (big.size() == 2) return CGAL::collinear(big[0], big[1], p);
  return CGAL::coplanar(big[0], big[1], big[2], p);
}

bool redundant(const Solid& solid, SiteId a, SiteId b) {
  const auto points = [&](SiteId s) {
    std::vector<Kernel::Point_3> out;
    for (const Vector& p : corners(solid, s).at) out.emplace_back(p[0], p[1], p[2]);
    return out;
  };
  auto big = points(a), small = points(b);
  if (big.size() < small.size()) std::swap(big, small);
  return std::all_of(small.begin(), small.end(),
                     [&](const auto& p) { return carrier_holds(big, p); });
}

Forms forms(const Solid& solid, const Moving& x, std::span<const SiteId> candidates,
            std::span<const std::uint32_t> triangles) {
  Forms out;
  out.solid = &solid;
  out.x = x;
  for (const SiteId s : candidates)
    if (!degenerate(solid, s)) out.site.push_back(site_form(solid, x, s));
  for (const std::uint32_t t : triangles) out.triangle.push_back(triangle_form(solid, x, t));
  const std::size_t n = out.site.size();
  out.essential.assign(n, std::vector<char>(n, 0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j)
      out.essential[i][j] = out.essential[j][i] = !redundant(solid, out.site[i].id, out.site[j].id);
  return out;
}

std::size_t at(int k) { return static_cast<std::size_t>(k); }

}  // namespace

bool Forms::essential_pair(std::span<const int> a, std::span<const int> b) const {
  for (const int i : a)
    for (const int j : b)
      if (essential[at(i)][at(j)]) return true;
  return false;
}

std::vector<int> Forms::governors(const Sample& p) const {
  std::vector<int> out;
  Root least;
  for (std::size_t i = 0; i < site.size(); ++i) {
    const SiteForm& s = site[i];
    const Root d = value(s.squared_distance, p);
    const auto order = out.empty() ? CGAL::SMALLER : CGAL::compare(d, least);
    if (order == CGAL::LARGER) continue;
    if (!std::all_of(s.domain.begin(), s.domain.end(),
                     [&](const Affine& a) { return CGAL::sign(value(a, p)) != CGAL::POSITIVE; }))
      continue;
    if (order == CGAL::SMALLER) out.clear();
    least = d;
    out.push_back(static_cast<int>(i));
  }
  return out;
}

std::vector<int> Forms::triangles(const Sample& p) const {
  std::vector<int> out;
  for (std::size_t t = 0; t < triangle.size(); ++t) {
    const TriangleForm& f = triangle[t];
    if (CGAL::sign(value(f.plane, p)) == CGAL::ZERO &&
        std::all_of(f.prism.begin(), f.prism.end(),
                    [&](const Affine& a) { return CGAL::sign(value(a, p)) != CGAL::POSITIVE; }))
      out.push_back(static_cast<int>(t));
  }
  return out;
}

bool Forms::feet_differ(const std::vector<int>& sites, const Sample& p) const {
  for (const int i : sites)
    for (std::size_t k = 0; k < 3; ++k)
      if (CGAL::sign(value(site[at(i)].foot[k] - site[at(sites[0])].foot[k], p)) != CGAL::ZERO)
        return true;
  return false;
}

Forms rect_forms(const Solid& solid, const Rect& rect, std::span<const SiteId> candidates,
                 std::span<const std::uint32_t> triangles) {
  Moving x;
  x[at(rect.axis)] = {0, 0, Rational(rect.level)};
  x[at(u_axis(rect.axis))] = {1, 0, 0};
  x[at(v_axis(rect.axis))] = {0, 1, 0};
  return forms(solid, x, candidates, triangles);
}

Forms segment_forms(const Solid& solid, const Segment& segment, std::span<const SiteId> candidates,
                    std::span<const std::uint32_t> triangles) {
  Moving x;
  x[at(segment.axis)] = {0, 1, 0};
  x[at(u_axis(segment.axis))] = {0, 0, Rational(segment.u)};
  x[at(v_axis(segment.axis))] = {0, 0, Rational(segment.v)};
  return forms(solid, x, candidates, triangles);
}

}  // namespace blum::cgal
