#include <array>
#include <limits>

#include "blum/kernel/check.hpp"
#include "blum/kernel/predicates.hpp"
#include "exact_number.hpp"
#include "site_expressions.hpp"
#include "wide_ball.hpp"

namespace blum {
namespace {

struct ArbVector {
  std::array<arb_struct, 3> x;
  ArbVector() {
    for (auto& c : x) arb_init(&c);
  }
  ~ArbVector() {
    for (auto& c : x) arb_clear(&c);
  }
  ArbVector(const ArbVector&) = delete;
  ArbVector& operator=(const ArbVector&) = delete;
};

void difference_of(arb_ptr r, double a, double b, slong precision) {
  arb_t t;
  arb_init(t);
  arb_set_d(r, a);
  arb_set_d(t, b);
  arb_sub(r, r, t, precision);
  arb_clear(t);
}

void cross_of_edges(ArbVector& n, const Solid& s, std::uint32_t triangle, slong precision) {
  ArbVector p, q;
  const auto& v = s.triangle[triangle].vertex;
  arb_t t;
  arb_init(t);
  for (int k = 0; k < 3; ++k) {
    difference_of(&p.x[k], s.point[v[1]][k], s.point[v[0]][k], precision);
    difference_of(&q.x[k], s.point[v[2]][k], s.point[v[0]][k], precision);
  }
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    arb_mul(&n.x[k], &p.x[i], &q.x[j], precision);
    arb_mul(t, &p.x[j], &q.x[i], precision);
    arb_sub(&n.x[k], &n.x[k], t, precision);
  }
  arb_clear(t);
}

void normalise(ArbVector& n, slong precision) {
  arb_t t, sum;
  arb_init(t);
  arb_init(sum);
  for (auto& c : n.x) {
    arb_mul(t, &c, &c, precision);
    arb_add(sum, sum, t, precision);
  }
  arb_rsqrt(sum, sum, precision);
  for (auto& c : n.x) arb_mul(&c, &c, sum, precision);
  arb_clear(t);
  arb_clear(sum);
}

using detail::to_ball;

BallVector to_balls(const ArbVector& v) {
  return {to_ball(&v.x[0]), to_ball(&v.x[1]), to_ball(&v.x[2])};
}

bool relatively_small_error(const Ball& x) { return x.rad <= 1e-14 * std::abs(x.mid); }

bool relatively_small_error(const BallVector& v) {
  double size = 0, error = 0;
  for (const Ball& c : v) {
    size = std::max(size, std::abs(c.mid));
    error = std::max(error, c.rad);
  }
  return error <= 1e-14 * size;
}

/// Far beyond the separation of distinct normals of double triangles in the working frame.
constexpr slong kMaxPrecision = 1 << 16;

}  // namespace

namespace detail::expression {

namespace {

template <class Fill>
BallVector unit_of(Fill&& fill) {
  for (slong precision = 128; precision <= kMaxPrecision; precision *= 2) {
    ArbVector n;
    fill(n, precision);
    normalise(n, precision);
    bool finite = true;
    for (auto& c : n.x) finite &= arb_is_finite(&c) != 0;
    if (finite) {
      const BallVector r = to_balls(n);
      if (relatively_small_error(r)) return r;
    }
  }
  broken_invariant("edge or triangle without a direction", __FILE__, __LINE__);
}

}  // namespace

BallVector unit_normal(const Solid& s, std::uint32_t triangle) {
  return unit_of([&](ArbVector& n, slong precision) { cross_of_edges(n, s, triangle, precision); });
}

BallVector unit_direction(const Solid& s, std::uint32_t edge) {
  const Point3 &a = s.point[s.edge[edge].vertex[0]], &b = s.point[s.edge[edge].vertex[1]];
  return unit_of([&](ArbVector& n, slong precision) {
    for (int k = 0; k < 3; ++k) difference_of(&n.x[k], b[k], a[k], precision);
  });
}

}  // namespace detail::expression

BallVector Predicates::unit_difference(SiteId a, SiteId b) {
  const BallVector &ua = geometry_->unit(a), &ub = geometry_->unit(b);
  BallVector d;
  for (int k = 0; k < 3; ++k) d[k] = ua[k] - ub[k];
  if (relatively_small_error(d)) return d;

  const Solid& s = geometry_->solid();
  const auto ta = geometry_->index().element(a), tb = geometry_->index().element(b);
  // Equal directions are decided exactly first, so that the loop below ends.
  using detail::Exact;
  namespace ex = detail::expression;
  const auto na = ex::normal<Exact>(s, ta), nb = ex::normal<Exact>(s, tb);
  const auto c = ex::outer<Exact>(na, nb);
  stages_.count(Stage::kExact);
  if (c[0].sign() == 0 && c[1].sign() == 0 && c[2].sign() == 0 &&
      ex::inner<Exact>(na, nb).sign() > 0)
    return {Ball(0.0), Ball(0.0), Ball(0.0)};
  for (slong precision = 128; precision <= kMaxPrecision; precision *= 2) {
    ArbVector x, y;
    cross_of_edges(x, s, ta, precision);
    cross_of_edges(y, s, tb, precision);
    normalise(x, precision);
    normalise(y, precision);
    for (int k = 0; k < 3; ++k) arb_sub(&x.x[k], &x.x[k], &y.x[k], precision);
    const BallVector r = to_balls(x);
    if (relatively_small_error(r)) return r;
  }
  broken_invariant("normals neither equal nor separated", __FILE__, __LINE__);
}

Ball Predicates::height(std::uint32_t point, std::uint32_t t) {
  const Solid& s = geometry_->solid();
  const Point3 &p = s.point[point], &q = s.point[s.triangle[t].vertex[0]];
  const Ball quick = dot(geometry_->unit(geometry_->index().face(t)), difference(p, q));
  if (relatively_small_error(quick)) return quick;

  // Zero is decided exactly first, so that the loop below ends.
  if (plane_side(p, t) == 0) return Ball(0.0);
  for (slong precision = 128; precision <= kMaxPrecision; precision *= 2) {
    ArbVector n, d;
    cross_of_edges(n, s, t, precision);
    normalise(n, precision);
    arb_t sum;
    arb_init(sum);
    for (int k = 0; k < 3; ++k) {
      difference_of(&d.x[k], p[k], q[k], precision);
      arb_addmul(sum, &n.x[k], &d.x[k], precision);
    }
    const bool finite = arb_is_finite(sum) != 0;
    const Ball r = finite ? to_ball(sum) : Ball{};
    arb_clear(sum);
    if (finite && relatively_small_error(r)) return r;
  }
  broken_invariant("point neither on a plane nor beside it", __FILE__, __LINE__);
}

Ball Predicates::squared_difference(const Point3& x, SiteId a, SiteId b) {
  using detail::Wide;
  const auto fa = detail::expression::squared_distance<Wide>(*geometry_, a, x);
  const auto fb = detail::expression::squared_distance<Wide>(*geometry_, b, x);
  stages_.count(Stage::kExtended);
  Wide r = fa.numerator * fb.denominator - fb.numerator * fa.denominator;
  const Wide scale = fa.denominator * fb.denominator;
  arb_div(r.get(), r.get(), scale.get(), Wide::kPrecision);
  constexpr double kUnbounded = std::numeric_limits<double>::max();
  return arb_is_finite(r.get()) != 0 ? to_ball(r.get()) : Ball(0.0, kUnbounded);
}

}  // namespace blum
