#include "algebraic_arcs.hpp"

#include <algorithm>
#include <stdexcept>
#include <unordered_map>

#include "arrange.hpp"

namespace blum::cgal {
namespace {

using Kernel = AlgebraicTraits::Algebraic_kernel_d_2;
using Point = AlgebraicArcs::Point;
using Arc = AlgebraicArcs::Arc;

std::size_t at(int k) { return static_cast<std::size_t>(k); }

AlgebraicTraits::Polynomial_2 polynomial(const Curve& curve) {
  using P2 = AlgebraicTraits::Polynomial_2;
  using P1 = P2::NT;
  const auto& [uu, uv, vv, u, v, c] = curve.c;
  return P2(P1(c, u, uu), P1(v, uv), P1(vv));
}

class AlgebraicPoint final : public ExactPoint {
 public:
  explicit AlgebraicPoint(Kernel::Algebraic_real_2 point) : point_(std::move(point)) {}
  Window box(int bits) const override {
    Kernel kernel;
    const auto x = kernel.approximate_absolute_x_2_object()(point_, bits + 1);
    const auto y = kernel.approximate_absolute_y_2_object()(point_, bits + 1);
    return {{Rational(x.first), Rational(x.second)}, {Rational(y.first), Rational(y.second)}};
  }
  bool is_on(const Curve& curve) const override {
    Kernel kernel;
    return kernel.is_zero_at_2_object()(polynomial(curve), point_);
  }

 private:
  Kernel::Algebraic_real_2 point_;
};

Kernel::Algebraic_real_2 real(const Point& p) { return {p.x(), p.curve(), p.arcno()}; }

}  // namespace

AlgebraicArcs::AlgebraicArcs(const Relevant& relevant, const Window& window)
    : relevant_(relevant), window_(window) {
  for (const Curve& c : relevant.curves.all()) analysis_.push_back(analysis(c));
  for (std::size_t k = 0; k < 4; ++k) {
    std::vector<boost::variant<Point, Arc>> parts;
    traits_.make_x_monotone_2_object()(analysis_[at(relevant.side[k])], std::back_inserter(parts));
    line_[k] = boost::get<Arc>(parts.at(0));
  }
}

AlgebraicArcs::Analysis AlgebraicArcs::analysis(const Curve& curve) const {
  return traits_.construct_curve_2_object()(polynomial(curve));
}

std::shared_ptr<const ExactPoint> AlgebraicArcs::exact_point(const Point& p) {
  return std::make_shared<AlgebraicPoint>(real(p));
}

Arc AlgebraicArcs::segment(int line, const std::array<Rational, 2>& p,
                           const std::array<Rational, 2>& q) const {
  std::vector<boost::variant<Point, Arc>> parts;
  traits_.make_x_monotone_2_object()(analysis_[at(line)], std::back_inserter(parts));
  const Arc& whole = boost::get<Arc>(parts.at(0));
  const auto point = [&](const std::array<Rational, 2>& a) {
    const Quadratic level{0, 0, 0, 0, 1, Rational(0) - a[1]};
    return Point(AlgebraicTraits::Algebraic_real_1(a[0]),
                 whole.is_vertical() ? analysis(zeros(level).on.at(0)) : analysis_[at(line)], 0);
  };
  const Point a = point(p), b = point(q);
  const bool ordered = p < q;
  if (whole.is_vertical()) return Arc(ordered ? a : b, ordered ? b : a, analysis_[at(line)]);
  return whole.trim(ordered ? a : b, ordered ? b : a);
}

Sample AlgebraicArcs::sample(const Arc& arc, int curve) const {
  const Quadratic q = quadratic(relevant_.curves.all()[at(curve)]);
  if (!arc.is_vertical()) {
    const Rational u = arc.boundary_in_x_range_interior();
    const Roots r = roots(q.vv, q.uv * u + q.v, (q.uu * u + q.u) * u + q.c);
    const int k = arc.arcno();
    if (k >= r.count) throw std::logic_error("number of an arc");
    return {Root(u), r.root[at(k)]};
  }
  // The curve is one vertical line, or two.
  const Roots r = roots(q.uu, q.u, q.c);
  if (q.uv != 0 || q.vv != 0 || q.v != 0 || r.count == 0) throw std::logic_error("vertical arc");
  // Between the ends; an end at infinity is replaced by one far outside the window.
  const Rational far = abs(window_.v.lo) + abs(window_.v.hi) + Rational(1);
  const auto end = [&](CGAL::Arr_curve_end which, int bits) -> Range {
    if (!arc.is_finite(which)) {
      const Rational v = which == CGAL::ARR_MIN_END ? Rational(0) - far : far;
      return {v, v};
    }
    return AlgebraicPoint(real(arc.curve_end(which))).box(bits).v;
  };
  for (int bits = 64;; bits *= 2) {
    const Range low = end(CGAL::ARR_MIN_END, bits), high = end(CGAL::ARR_MAX_END, bits);
    if (low.hi >= high.lo) continue;
    const Rational v = (low.hi + high.lo) / Rational(2);
    std::size_t k = 0;
    if (r.count == 2) {
      const Rational middle = Rational(0) - q.u / (Rational(2) * q.uu);
      k = arc.x() > AlgebraicTraits::Algebraic_real_1(middle) ? 1 : 0;
    }
    return {r.root[k], Root(v)};
  }
}

bool AlgebraicArcs::in_window(const Sample& p) const {
  const auto in = [](const Root& x, const Range& r) {
    return CGAL::compare(x, Root(r.lo)) != CGAL::SMALLER &&
           CGAL::compare(x, Root(r.hi)) != CGAL::LARGER;
  };
  return in(p.u, window_.u) && in(p.v, window_.v);
}

std::vector<Arc> AlgebraicArcs::split(std::vector<Arc> arcs, const Arc& border) const {
  std::vector<Arc> out;
  for (const Arc& arc : arcs) {
    if (arc.is_vertical() && border.is_vertical()) {  // CGAL 5.5 asserts that this is not asked
      out.push_back(arc);
      continue;
    }
    using Crossing = std::pair<Point, AlgebraicTraits::Multiplicity>;
    std::vector<boost::variant<Crossing, Arc>> found;
    traits_.intersect_2_object()(arc, border, std::back_inserter(found));
    Arc rest = arc;
    for (const auto& f : found) {
      const Crossing* crossing = boost::get<Crossing>(&f);
      if (crossing == nullptr) continue;  // the border itself
      const Point& p = crossing->first;
      const auto is_end = [&](CGAL::Arr_curve_end which) {
        return rest.is_finite(which) && traits_.equal_2_object()(rest.curve_end(which), p);
      };
      if (is_end(CGAL::ARR_MIN_END) || is_end(CGAL::ARR_MAX_END)) continue;
      Arc low;
      traits_.split_2_object()(rest, p, low, rest);
      out.push_back(low);
    }
    out.push_back(rest);
  }
  return out;
}

AlgebraicArcs::Part AlgebraicArcs::part(int curve) const {
  std::vector<boost::variant<Point, Arc>> parts;
  traits_.make_x_monotone_2_object()(analysis_[at(curve)], std::back_inserter(parts));
  Part out;
  std::vector<Arc> arcs;
  for (const auto& p : parts) {
    if (const Arc* arc = boost::get<Arc>(&p)) {
      arcs.push_back(*arc);
    } else {
      const Point& point = boost::get<Point>(p);
      const Window box = AlgebraicPoint(real(point)).box(64);
      if (box.u.hi >= window_.u.lo && box.u.lo <= window_.u.hi && box.v.hi >= window_.v.lo &&
          box.v.lo <= window_.v.hi)
        out.point.push_back(point);
    }
  }
  for (std::size_t k = 0; k < 4; ++k)
    if (relevant_.side[k] != curve) arcs = split(std::move(arcs), line_[k]);
  for (const Arc& arc : arcs)
    if (in_window(sample(arc, curve))) out.arc.push_back(arc);
  return out;
}

int AlgebraicArcs::number(const Arc& arc) const {
  for (std::size_t k = 0; k < analysis_.size(); ++k)
    if (arc.curve().is_identical(analysis_[k])) return static_cast<int>(k);
  for (std::size_t k = 0; k < analysis_.size(); ++k)
    if (arc.curve().polynomial_2() == analysis_[k].polynomial_2()) return static_cast<int>(k);
  throw std::logic_error("an arc of an unknown curve");
}

PlanarCells AlgebraicArcs::cells(const std::vector<Arc>& arcs,
                                 const std::vector<Point>& points) const {
  CGAL::Arrangement_2<AlgebraicTraits> arrangement;
  CGAL::insert(arrangement, arcs.begin(), arcs.end());
  for (const Point& p : points) CGAL::insert_point(arrangement, p);

  PlanarCells out;
  std::unordered_map<const void*, int> face, vertex;
  for (auto f = arrangement.faces_begin(); f != arrangement.faces_end(); ++f) {
    if (f->is_unbounded()) continue;
    face[&*f] = static_cast<int>(out.face.size());
    out.face.emplace_back();
    out.face.back().holes =
        static_cast<int>(f->number_of_inner_ccbs() + f->number_of_isolated_vertices());
  }
  const auto face_of = [&](const auto& f) {
    const auto it = face.find(&*f);
    return it == face.end() ? -1 : it->second;
  };
  for (auto v = arrangement.vertices_begin(); v != arrangement.vertices_end(); ++v) {
    vertex[&*v] = static_cast<int>(out.vertex.size());
    PlanarCells::Vertex node;
    node.point = exact_point(v->point());
    if (v->is_isolated()) node.face = face_of(v->face());
    out.vertex.push_back(std::move(node));
  }
  std::vector<int> above;
  for (auto e = arrangement.edges_begin(); e != arrangement.edges_end(); ++e) {
    PlanarCells::Edge edge;
    edge.vertex = {vertex.at(&*e->source()), vertex.at(&*e->target())};
    edge.face = {face_of(e->face()), face_of(e->twin()->face())};  // left, right
    edge.curve = number(e->curve());
    edge.sample = sample(e->curve(), edge.curve);
    above.push_back(e->curve().is_vertical()                    ? -1
                    : e->direction() == CGAL::ARR_LEFT_TO_RIGHT ? 0
                                                                : 1);
    for (const int v : edge.vertex)
      out.vertex[at(v)].edge.push_back(static_cast<int>(out.edge.size()));
    out.edge.push_back(std::move(edge));
  }
  sample_faces(out, relevant_.curves, window_, above);
  return out;
}

PlanarCells arrange_algebraic(const Relevant& relevant, const Window& window) {
  const AlgebraicArcs arcs(relevant, window);
  std::vector<Arc> all;
  std::vector<Point> points;
  for (int c = 0; c < static_cast<int>(relevant.curves.all().size()); ++c) {
    AlgebraicArcs::Part part = arcs.part(c);
    all.insert(all.end(), part.arc.begin(), part.arc.end());
    points.insert(points.end(), part.point.begin(), part.point.end());
  }
  return arcs.cells(all, points);
}

}  // namespace blum::cgal
