#include <array>

#include "blum/kernel/check.hpp"
#include "blum/kernel/predicates.hpp"
#include "exact_number.hpp"
#include "site_expressions.hpp"

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

void cross_of_edges(ArbVector& n, const Solid& s, std::uint32_t triangle, slong precision) {
  ArbVector p, q;
  const auto& v = s.triangle[triangle].vertex;
  arb_t t;
  arb_init(t);
  for (int k = 0; k < 3; ++k) {
    const auto minus = [&](arb_ptr r, std::uint32_t head) {
      arb_set_d(r, s.point[head][k]);
      arb_set_d(t, s.point[v[0]][k]);
      arb_sub(r, r, t, precision);
    };
    minus(&p.x[k], v[1]);
    minus(&q.x[k], v[2]);
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

Ball to_ball(arb_srcptr x) {
  const double mid = arf_get_d(arb_midref(x), ARF_RND_NEAR);
  const double rad = mag_get_d(arb_radref(x));  // rounded up by less than one part in 2^-29
  return {mid, rad * (1 + 0x1p-20) + std::abs(mid) * Ball::kUnit};
}

BallVector to_balls(const ArbVector& v) {
  return {to_ball(&v.x[0]), to_ball(&v.x[1]), to_ball(&v.x[2])};
}

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

BallVector unit_normal(const Solid& s, std::uint32_t triangle) {
  for (slong precision = 128; precision <= kMaxPrecision; precision *= 2) {
    ArbVector n;
    cross_of_edges(n, s, triangle, precision);
    normalise(n, precision);
    bool finite = true;
    for (auto& c : n.x) finite &= arb_is_finite(&c) != 0;
    if (finite) {
      const BallVector r = to_balls(n);
      if (relatively_small_error(r)) return r;
    }
  }
  broken_invariant("triangle without a normal", __FILE__, __LINE__);
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

}  // namespace blum
