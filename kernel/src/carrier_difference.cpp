#include <limits>

#include "blum/kernel/predicates.hpp"
#include "exact_number.hpp"
#include "site_expressions.hpp"
#include "wide_ball.hpp"

namespace blum {
namespace {

using detail::Wide;
namespace ex = detail::expression;
using WideVector = ex::Vec<Wide>;

constexpr int kRow[6] = {0, 1, 2, 0, 1, 2}, kColumn[6] = {0, 1, 2, 1, 2, 0};

/// Squared distance to a carrier about `origin`, all times a positive denominator.
struct Carrier {
  std::array<Wide, 6> matrix;
  WideVector linear;
  Wide value, denominator;
};

Carrier carrier_about(const SiteGeometry& g, SiteId site, const Point3& origin) {
  const Solid& s = g.solid();
  const auto i = g.index().element(site);
  Carrier r;
  r.denominator = Wide(1.0);
  // The matrix is `whole` times the identity plus `part` times the square of w.
  Wide whole(1.0), part(0.0);
  WideVector w{Wide(0.0), Wide(0.0), Wide(0.0)};
  if (g.index().kind(site) == SiteKind::kEdge) {
    w = ex::minus<Wide>(s.point[s.edge[i].vertex[1]], s.point[s.edge[i].vertex[0]]);
    whole = r.denominator = ex::inner<Wide>(w, w);
    part = Wide(-1.0);
  } else if (g.index().kind(site) == SiteKind::kFace) {
    w = ex::normal<Wide>(s, i);
    whole = Wide(0.0);
    part = Wide(1.0);
    r.denominator = ex::inner<Wide>(w, w);
  }
  for (std::size_t k = 0; k < 6; ++k) {
    r.matrix[k] = part * w[kRow[k]] * w[kColumn[k]];
    if (k < 3) r.matrix[k] = r.matrix[k] + whole;
  }
  const WideVector d = ex::minus<Wide>(origin, g.base(site));
  const Wide along = part * ex::inner<Wide>(w, d);
  for (std::size_t k = 0; k < 3; ++k) r.linear[k] = whole * d[k] + along * w[k];
  r.value = ex::inner<Wide>(d, r.linear);
  return r;
}

}  // namespace

Predicates::CarrierDifference Predicates::carrier_difference(SiteId a, SiteId b) {
  stages_.count(Stage::kExtended);
  CarrierDifference r;
  r.origin = geometry_->base(a);
  const Carrier ca = carrier_about(*geometry_, a, r.origin),
                cb = carrier_about(*geometry_, b, r.origin);
  const Wide scale = ca.denominator * cb.denominator;
  const auto enclose = [&](const Wide& x, const Wide& y) {
    Wide d = x * cb.denominator - y * ca.denominator;
    arb_div(d.get(), d.get(), scale.get(), Wide::kPrecision);
    return arb_is_finite(d.get()) != 0 ? detail::to_ball(d.get())
                                       : Ball(0.0, std::numeric_limits<double>::max());
  };
  r.value = enclose(ca.value, cb.value);
  for (std::size_t k = 0; k < 3; ++k) r.linear[k] = enclose(ca.linear[k], cb.linear[k]);
  for (std::size_t k = 0; k < 6; ++k) r.matrix[k] = enclose(ca.matrix[k], cb.matrix[k]);
  return r;
}

}  // namespace blum
