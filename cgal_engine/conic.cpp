// All relevant curves, cut by Arr_conic_traits_2 over CORE. Kept for comparison: docs/oracles.md
// says what it fails on. Arcs are clipped to the window here, because CGAL takes whole conics only
// if they are ellipses.
#include <CGAL/Arr_conic_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/CORE_algebraic_number_traits.h>
#include <CGAL/Cartesian.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <unordered_map>

#include "arrange.hpp"

namespace blum::cgal {
namespace {

using Numbers = CGAL::CORE_algebraic_number_traits;
using Exact = Numbers::Algebraic;  // CORE::Expr
using RationalKernel = CGAL::Cartesian<Numbers::Rational>;
using AlgebraicKernel = CGAL::Cartesian<Exact>;
using Traits = CGAL::Arr_conic_traits_2<RationalKernel, AlgebraicKernel, Numbers>;
using Point = Traits::Point_2;
using Arc = Traits::X_monotone_curve_2;

std::size_t at(int k) { return static_cast<std::size_t>(k); }

CORE::BigInt core(const Integer& x) {
  std::ostringstream digits;
  digits << x;
  return CORE::BigInt(digits.str());
}
Numbers::Rational core(const Rational& x) {
  return Numbers::Rational(core(x.numerator()), core(x.denominator()));
}
Exact core(const Root& x) {
  Exact out(core(x.a0()));
  if (x.is_extended()) out += Exact(core(x.a1())) * sqrt(Exact(core(x.root())));
  return out;
}
Rational rational(const CORE::BigRat& x) {
  return Rational(Integer(CORE::numerator(x).get_str()), Integer(CORE::denominator(x).get_str()));
}

class ConicPoint final : public ExactPoint {
 public:
  explicit ConicPoint(const Point& p) : x_(p.x()), y_(p.y()) {}
  Window box(int bits) const override { return {range(x_, bits), range(y_, bits)}; }
  bool is_on(const Curve& curve) const override {
    const auto& [uu, uv, vv, u, v, c] = curve.c;
    const Exact value = Exact(core(uu)) * x_ * x_ + Exact(core(uv)) * x_ * y_ +
                        Exact(core(vv)) * y_ * y_ + Exact(core(u)) * x_ + Exact(core(v)) * y_ +
                        Exact(core(c));
    return CGAL::sign(value) == CGAL::ZERO;
  }

 private:
  static Range range(const Exact& x, int bits) {
    const Rational middle =
        rational(x.approx(CORE::extLong::getPosInfty(), CORE::extLong(bits + 2)).BigRatValue());
    Rational half = 1;
    mpq_div_2exp(half.mpq(), half.mpq(), static_cast<mp_bitcnt_t>(bits + 1));
    return {middle - half, middle + half};
  }
  Exact x_, y_;
};

/// One branch of a curve in the window, over [u0, u1].
struct Branch {
  Root u0, u1;
  int root = 0;
};

class ConicArcs {
 public:
  ConicArcs(const Relevant& relevant, const Window& window)
      : relevant_(relevant), window_(window) {}

  void add(int curve, std::vector<Arc>& out) const {
    const Quadratic q = quadratic(relevant_.curves.all()[at(curve)]);
    if (q.uu == 0 && q.uv == 0 && q.vv == 0) return line(q, out);
    if (q.uv == 0 && q.vv == 0 && q.v == 0)
      throw std::runtime_error("two irrational vertical lines, which conic arcs cannot be");
    for (const Branch& b : branches(q)) out.push_back(arc(q, curve, b));
  }

  PlanarCells cells(const std::vector<Arc>& arcs) const {
    CGAL::Arrangement_2<Traits> arrangement;
    CGAL::insert(arrangement, arcs.begin(), arcs.end());
    PlanarCells out;
    std::unordered_map<const void*, int> face, vertex;
    for (auto f = arrangement.faces_begin(); f != arrangement.faces_end(); ++f) {
      if (f->is_unbounded()) continue;
      face[&*f] = static_cast<int>(out.face.size());
      out.face.emplace_back();
      out.face.back().holes = static_cast<int>(f->number_of_inner_ccbs());
    }
    const auto face_of = [&](const auto& f) {
      const auto it = face.find(&*f);
      return it == face.end() ? -1 : it->second;
    };
    for (auto v = arrangement.vertices_begin(); v != arrangement.vertices_end(); ++v) {
      vertex[&*v] = static_cast<int>(out.vertex.size());
      out.vertex.emplace_back().point = std::make_shared<ConicPoint>(v->point());
    }
    std::vector<int> above;
    for (auto e = arrangement.edges_begin(); e != arrangement.edges_end(); ++e) {
      PlanarCells::Edge edge;
      edge.vertex = {vertex.at(&*e->source()), vertex.at(&*e->target())};
      edge.face = {face_of(e->face()), face_of(e->twin()->face())};
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

 private:
  static Traits::Rat_kernel::Point_2 rational_point(const Rational& u, const Rational& v) {
    return {core(u), core(v)};
  }

  void line(const Quadratic& q, std::vector<Arc>& out) const {
    // Clipped by its parameter: the point is (u, v) with u running, or v on a vertical line.
    Range t = q.v != 0 ? window_.u : window_.v;
    const Range& other = q.v != 0 ? window_.v : window_.u;
    const Rational slope = Rational(0) - (q.v != 0 ? q.u / q.v : q.v / q.u);
    const Rational shift = Rational(0) - q.c / (q.v != 0 ? q.v : q.u);
    if (slope == 0) {
      if (shift < other.lo || shift > other.hi) return;
    } else {
      Rational a = (other.lo - shift) / slope, b = (other.hi - shift) / slope;
      if (a > b) std::swap(a, b);
      t = {std::max(t.lo, a), std::min(t.hi, b)};
    }
    if (t.lo >= t.hi) return;
    const auto point = [&](const Rational& x) {
      const Rational y = slope * x + shift;
      return q.v != 0 ? rational_point(x, y) : rational_point(y, x);
    };
    monotone(Traits::Curve_2(Traits::Rat_segment_2(point(t.lo), point(t.hi))), out);
  }

  static void monotone(const Traits::Curve_2& curve, std::vector<Arc>& out) {
    if (!curve.is_valid()) throw std::runtime_error("Arr_conic_traits_2 rejects a valid arc");
    std::vector<boost::variant<Point, Arc>> parts;
    Traits().make_x_monotone_2_object()(curve, std::back_inserter(parts));
    for (const auto& p : parts)
      if (const Arc* a = boost::get<Arc>(&p)) out.push_back(*a);
  }

  /// Between consecutive abscissae where the curve meets the window's border, turns round, or has
  /// an asymptote.
  std::vector<Branch> branches(const Quadratic& q) const {
    std::vector<Root> cut{Root(window_.u.lo), Root(window_.u.hi)};
    const auto add = [&](const Roots& r) {
      for (int k = 0; k < r.count; ++k)
        if (r.root[at(k)] > Root(window_.u.lo) && r.root[at(k)] < Root(window_.u.hi))
          cut.push_back(r.root[at(k)]);
    };
    for (const Rational& v : {window_.v.lo, window_.v.hi})
      add(roots(q.uu, q.uv * v + q.u, (q.vv * v + q.v) * v + q.c));
    const Rational two = 2, four = 4;
    add(roots(q.uv * q.uv - four * q.vv * q.uu, two * q.uv * q.v - four * q.vv * q.u,
              q.v * q.v - four * q.vv * q.c));
    if (q.vv == 0) add(roots(0, q.uv, q.v));
    std::sort(cut.begin(), cut.end(), [](const Root& a, const Root& b) { return a < b; });
    std::vector<Branch> out;
    for (std::size_t k = 0; k + 1 < cut.size(); ++k) {
      if (!(cut[k] < cut[k + 1])) continue;
      const Rational u = between(cut[k], cut[k + 1]);
      const Roots r = over(q, u);
      for (int i = 0; i < r.count; ++i)
        if (r.root[at(i)] > Root(window_.v.lo) && r.root[at(i)] < Root(window_.v.hi))
          out.push_back({cut[k], cut[k + 1], i});
    }
    return out;
  }

  static Roots over(const Quadratic& q, const Rational& u) {
    return roots(q.vv, q.uv * u + q.v, (q.uu * u + q.u) * u + q.c);
  }

  static Point point(const Quadratic& q, const Root& abscissa, int root) {
    const Exact u = core(abscissa), b = Exact(core(q.uv)) * u + Exact(core(q.v)),
                c = (Exact(core(q.uu)) * u + Exact(core(q.u))) * u + Exact(core(q.c));
    if (q.vv == 0) return {u, -c / b};
    const Exact a(core(q.vv));
    Exact square = b * b - Exact(4) * a * c;
    if (CGAL::sign(square) == CGAL::NEGATIVE) throw std::logic_error("end of a branch");
    const Exact s = sqrt(square);
    const bool plus = (root == 1) == (q.vv > 0);
    return {u, (plus ? s - b : -s - b) / (Exact(2) * a)};
  }

  Arc arc(const Quadratic& q, int curve, const Branch& b) const {
    const Point source = point(q, b.u0, b.root), target = point(q, b.u1, b.root);
    const Rational u = between(b.u0, b.u1);
    const Roots r = over(q, u);
    const Point middle(Exact(core(u)), core(r.root[at(b.root)]));
    const CGAL::Orientation turn = AlgebraicKernel().orientation_2_object()(source, middle, target);
    const auto& c = relevant_.curves.all()[at(curve)].c;  // uu, uv, vv, u, v, 1
    const auto rat = [](const Integer& x) { return Numbers::Rational(core(x)); };
    std::vector<Arc> out;
    monotone(Traits::Curve_2(rat(c[0]), rat(c[2]), rat(c[1]), rat(c[3]), rat(c[4]), rat(c[5]), turn,
                             source, target),
             out);
    if (out.size() != 1) throw std::runtime_error("Arr_conic_traits_2 cuts an x-monotone arc");
    return out[0];
  }

  int number(const Arc& arc) const {
    const auto rat = [](const CORE::BigInt& x) { return Rational(Integer(x.get_str())); };
    const Zeros z =
        zeros({rat(arc.r()), rat(arc.t()), rat(arc.s()), rat(arc.u()), rat(arc.v()), rat(arc.w())});
    const int k = z.on.size() == 1 ? relevant_.curves.find(z.on[0]) : -1;
    if (k < 0) throw std::runtime_error("Arr_conic_traits_2 changed the curve of an arc");
    return k;
  }

  /// A rational number between two different ones.
  static Rational between_exact(const Exact& a, const Exact& b) {
    for (int bits = 32; bits < 1 << 14; bits *= 2) {
      const Rational x =
          (ConicPoint({a, b}).box(bits).u.hi + ConicPoint({a, b}).box(bits).v.lo) / Rational(2);
      const Exact y(core(x));
      if (a < y && y < b) return x;
    }
    throw std::runtime_error("two equal ends of an arc");
  }

  Sample sample(const Arc& arc, int curve) const {
    const Quadratic q = quadratic(relevant_.curves.all()[at(curve)]);
    if (arc.is_vertical())
      return {roots(q.uu, q.u, q.c).root[0], Root(between_exact(arc.left().y(), arc.right().y()))};
    const Rational u = between_exact(arc.left().x(), arc.right().x());
    const Roots r = over(q, u);
    if (r.count == 1) return {Root(u), r.root[0]};
    if (r.count != 2) throw std::runtime_error("Arr_conic_traits_2: an arc where its curve is not");
    const Rational v = between(r.root[0], r.root[1]);
    const auto side =
        Traits().compare_y_at_x_2_object()(Point(Exact(core(u)), Exact(core(v))), arc);
    return {Root(u), r.root[side == CGAL::SMALLER ? 1 : 0]};
  }

  const Relevant& relevant_;
  Window window_;
};

}  // namespace

PlanarCells arrange_conic(const Relevant& relevant, const Window& window) {
  const ConicArcs arcs(relevant, window);
  std::vector<Arc> all;
  for (int c = 0; c < static_cast<int>(relevant.curves.all().size()); ++c) arcs.add(c, all);
  return arcs.cells(all);
}

}  // namespace blum::cgal
