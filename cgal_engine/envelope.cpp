// The lower envelope of the sites' squared distances over their domains, by CGAL's Envelope_3. Its
// edges, with the curves of the boundary, cut the rectangle.
#include <CGAL/envelope_3.h>

#include <algorithm>
#include <stdexcept>

#include "algebraic_arcs.hpp"
#include "arrange.hpp"

namespace blum::cgal {
namespace {

std::size_t at(int k) { return static_cast<std::size_t>(k); }

using Corner = std::array<Rational, 2>;

/// A convex polygon, counter-clockwise.
using Polygon = std::vector<Corner>;

Rational value(const Affine& a, const Corner& p) { return a.cu * p[0] + a.cv * p[1] + a.c; }

/// The part of the polygon where a <= 0; empty or of fewer than 3 corners if it has no interior.
Polygon clip(const Polygon& polygon, const Affine& a) {
  Polygon out;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Corner &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const Rational x = value(a, p), y = value(a, q);
    if (x <= 0) out.push_back(p);
    if ((x < 0 && y > 0) || (x > 0 && y < 0)) {
      const Rational t = x / (x - y);
      out.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])});
    }
  }
  return out;
}

Rational twice_area(const Polygon& p) {
  Rational sum = 0;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const Corner &a = p[k], &b = p[(k + 1) % p.size()];
    sum += a[0] * b[1] - a[1] * b[0];
  }
  return sum;
}

Quadratic line_through(const Corner& p, const Corner& q) {
  return {0, 0, 0, q[1] - p[1], p[0] - q[0], p[1] * (q[0] - p[0]) - p[0] * (q[1] - p[1])};
}

/// What the surfaces of one envelope refer to.
struct Setting {
  const Forms& forms;
  const CurveTable& curves;
  const AlgebraicArcs& arcs;
  Window window;

  int sign(int i, int j, const Sample& p) const {
    return static_cast<int>(CGAL::sign(cgal::value(difference(i, j), p)));
  }
  Quadratic difference(int i, int j) const {
    return forms.site[at(i)].squared_distance - forms.site[at(j)].squared_distance;
  }
};

/// The squared distance to one site over its domain in the window.
struct Surface {
  const Setting* setting = nullptr;
  int site = -1;
  std::shared_ptr<const Polygon> domain;
};

/// Partially defined quadratics over conics.
class QuadraticTraits : public AlgebraicTraits {
 public:
  using Traits_2 = AlgebraicTraits;
  using Xy_monotone_surface_3 = Surface;
  using Surface_3 = Surface;

  struct Make_xy_monotone_3 {
    template <class Out>
    Out operator()(const Surface& s, bool, Out out) const {
      *out++ = s;
      return out;
    }
  };
  Make_xy_monotone_3 make_xy_monotone_3_object() const { return {}; }

  struct Construct_projected_boundary_2 {
    template <class Out>
    Out operator()(const Surface& s, Out out) const {
      const Polygon& p = *s.domain;
      for (std::size_t k = 0; k < p.size(); ++k) {
        const Corner &a = p[k], &b = p[(k + 1) % p.size()];
        const int line = s.setting->curves.find(zeros(line_through(a, b)).on.at(0));
        if (line < 0) throw std::logic_error("a line of a domain is missing");
        // The domain lies to the left of a -> b; "positive" is to the left of lower -> greater.
        *out++ = CGAL::make_object(std::pair<X_monotone_curve_2, CGAL::Oriented_side>(
            s.setting->arcs.segment(line, a, b),
            a < b ? CGAL::ON_POSITIVE_SIDE : CGAL::ON_NEGATIVE_SIDE));
      }
      return out;
    }
  };
  Construct_projected_boundary_2 construct_projected_boundary_2_object() const { return {}; }

  struct Construct_projected_intersections_2 {
    template <class Out>
    Out operator()(const Surface& s, const Surface& t, Out out) const {
      constexpr Multiplicity kUnknown = 0;
      for (const Curve& c : zeros(s.setting->difference(s.site, t.site)).on) {
        const int k = s.setting->curves.find(c);
        if (k < 0) continue;  // not where both may govern
        const AlgebraicArcs::Part part = s.setting->arcs.part(k);
        for (const auto& arc : part.arc) *out++ = CGAL::make_object(std::pair(arc, kUnknown));
        for (const auto& point : part.point) *out++ = CGAL::make_object(point);
      }
      return out;
    }
  };
  Construct_projected_intersections_2 construct_projected_intersections_2_object() const {
    return {};
  }

  struct Compare_z_at_xy_3 {
    CGAL::Comparison_result operator()(const Point_2& p, const Surface& s, const Surface& t) const {
      return CGAL::sign(sign_at(s.setting->difference(s.site, t.site),
                                *AlgebraicArcs::exact_point(p), s.setting->curves, {}));
    }
    CGAL::Comparison_result operator()(const X_monotone_curve_2& arc, const Surface& s,
                                       const Surface& t) const {
      const AlgebraicArcs& arcs = s.setting->arcs;
      return CGAL::sign(s.setting->sign(s.site, t.site, arcs.sample(arc, arcs.number(arc))));
    }
    CGAL::Comparison_result operator()(const Surface& s, const Surface& t) const {
      const Window& w = s.setting->window;
      return CGAL::sign(s.setting->sign(
          s.site, t.site,
          {Root((w.u.lo + w.u.hi) / Rational(2)), Root((w.v.lo + w.v.hi) / Rational(2))}));
    }
  };
  Compare_z_at_xy_3 compare_z_at_xy_3_object() const { return {}; }

  /// Beside an arc on which the surfaces are equal: above, or to the left of a vertical one.
  template <bool kAbove>
  struct Compare_beside {
    CGAL::Comparison_result operator()(const X_monotone_curve_2& arc, const Surface& s,
                                       const Surface& t) const {
      const AlgebraicArcs& arcs = s.setting->arcs;
      const Quadratic q = s.setting->difference(s.site, t.site);
      Sample p = arcs.sample(arc, arcs.number(arc));
      const bool vertical = arc.is_vertical();
      Root& moving = vertical ? p.u : p.v;
      const Rational fixed = (vertical ? p.v : p.u).a0();
      const Roots r = vertical
                          ? roots(q.uu, q.uv * fixed + q.u, (q.vv * fixed + q.v) * fixed + q.c)
                          : roots(q.vv, q.uv * fixed + q.v, (q.uu * fixed + q.u) * fixed + q.c);
      const bool up = vertical ? !kAbove : kAbove;
      Root next = up ? Root(above(moving)) : Root(below(moving));
      for (int k = 0; k < r.count; ++k) {
        const Root& x = r.root[at(k)];
        if (up ? x > moving && x < next : x < moving && x > next) next = x;
      }
      moving = Root(up ? between(moving, next) : between(next, moving));
      return CGAL::sign(s.setting->sign(s.site, t.site, p));
    }
  };
  using Compare_z_at_xy_above_3 = Compare_beside<true>;
  using Compare_z_at_xy_below_3 = Compare_beside<false>;
  Compare_z_at_xy_above_3 compare_z_at_xy_above_3_object() const { return {}; }
  Compare_z_at_xy_below_3 compare_z_at_xy_below_3_object() const { return {}; }
};

}  // namespace

Relevant with_domains(const Forms& forms, const Relevant& relevant) {
  Relevant out = relevant;
  for (std::size_t i = 0; i < forms.site.size(); ++i)
    if (relevant.site[i])
      for (const Affine& a : forms.site[i].domain)
        for (const Curve& c : zeros(quadratic(a)).on) out.curves.add(c);
  return out;
}

PlanarCells arrange_envelope(const Forms& forms, const Relevant& relevant, const Window& window) {
  const AlgebraicArcs arcs(relevant, window);
  const Setting setting{forms, relevant.curves, arcs, window};
  const Polygon whole{{window.u.lo, window.v.lo},
                      {window.u.hi, window.v.lo},
                      {window.u.hi, window.v.hi},
                      {window.u.lo, window.v.hi}};
  std::vector<int> added(relevant.side.begin(), relevant.side.end());
  added.insert(added.end(), relevant.boundary.begin(), relevant.boundary.end());
  std::vector<Surface> surfaces;
  for (std::size_t i = 0; i < forms.site.size(); ++i) {
    if (!relevant.site[i]) continue;
    Polygon domain = whole;
    for (const Affine& a : forms.site[i].domain) domain = clip(domain, a);
    // A corner may be there twice where a line of the domain meets one.
    domain.erase(std::unique(domain.begin(), domain.end()), domain.end());
    while (domain.size() > 1 && domain.front() == domain.back()) domain.pop_back();
    if (twice_area(domain) > 0) {
      surfaces.push_back(
          {&setting, static_cast<int>(i), std::make_shared<const Polygon>(std::move(domain))});
    } else if (!domain.empty()) {  // a segment or point: no surface to CGAL, but it may govern
      for (const Affine& a : forms.site[i].domain)
        for (const Curve& c : zeros(quadratic(a)).on) added.push_back(relevant.curves.find(c));
    }
  }
  std::sort(added.begin(), added.end());
  added.erase(std::unique(added.begin(), added.end()), added.end());

  CGAL::Envelope_diagram_2<QuadraticTraits> diagram;
  CGAL::lower_envelope_3(surfaces.begin(), surfaces.end(), diagram);
  std::vector<AlgebraicArcs::Arc> all;
  std::vector<AlgebraicArcs::Point> points;
  for (auto e = diagram.edges_begin(); e != diagram.edges_end(); ++e) all.push_back(e->curve());
  for (auto v = diagram.vertices_begin(); v != diagram.vertices_end(); ++v)
    if (v->is_isolated()) points.push_back(v->point());
  for (const int c : added) {
    const AlgebraicArcs::Part part = arcs.part(c);
    all.insert(all.end(), part.arc.begin(), part.arc.end());
    points.insert(points.end(), part.point.begin(), part.point.end());
  }
  return arcs.cells(all, points);
}

}  // namespace blum::cgal
