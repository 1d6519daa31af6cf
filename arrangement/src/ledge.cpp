#include "ledge.hpp"

#include <algorithm>
#include <cmath>

namespace blum {
namespace {

constexpr double kNearlyParallel = 1e-3;
constexpr double kUp = 1 + 0x1p-40, kDown = 1 - 0x1p-40;

BallVector negative(const BallVector& w) { return {-w[0], -w[1], -w[2]}; }

double length_upper(const BallVector& w) { return std::sqrt(dot(w, w).high()) * kUp; }

}  // namespace

std::optional<Ledge> find_ledge(EngineContext& context, const LocalForm& a, const LocalForm& b,
                                const Range& range) {
  if (a.kind == SiteKind::kEdge && b.kind == SiteKind::kFace) {
    auto ledge = find_ledge(context, b, a, range);
    if (ledge) ledge->across = negative(ledge->across);
    return ledge;
  }
  if (a.kind != SiteKind::kFace || b.kind != SiteKind::kEdge) return std::nullopt;
  const LocalForm &face = a, &edge = b;
  const SiteGeometry& geometry = context.geometry;
  const Solid& solid = geometry.solid();
  const BallVector &n = geometry.unit(face.site), &u = geometry.unit(edge.site);
  const double slope = dot(n, u).magnitude();
  if (slope > kNearlyParallel) return std::nullopt;
  const Ball distance = Ball(0.0, spread(n, range)) - face.height;
  const double nearest = distance.low(), farthest = distance.high();
  if (!(nearest > 0)) return std::nullopt;

  // Depth of the edge in front of the plane, where feet of the range may lie: linear along it.
  const auto [p, q] = solid.edge[geometry.index().element(edge.site)].vertex;
  const Ball at_p = -context.height(p, face.site), at_q = -context.height(q, face.site);
  const BallVector along = difference(solid.point[q], solid.point[p]);
  const Ball whole = root(dot(along, along));
  const Ball foot =
      dot(u, difference(range.center, solid.point[p])) + Ball(0.0, spread(u, range));
  const auto depth = [&](double t) {
    const Ball part = divide(Ball(t), whole);
    return at_p + (at_q - at_p) * part;
  };
  const Ball first = depth(std::max(0.0, foot.low())),
             last = depth(std::min(whole.high(), foot.high()));
  const double least = std::min(first.low(), last.low()),
               most = std::max(first.high(), last.high());
  if (!(least > 0)) return std::nullopt;

  Ledge r;
  r.rest = 2 * (most + farthest * slope) * kUp;
  const double square = (2 * nearest * least - r.rest * r.rest * kUp) * kDown;
  if (!(square > 0)) return std::nullopt;
  r.reach = std::sqrt(square) * kDown;

  // The triangle lies on one side of the edge, but for less than that.
  r.across = cross(n, u);
  const Ball norm = root(dot(r.across, r.across));
  for (Ball& c : r.across) c = divide(c, norm);
  double low = 0, high = 0;
  for (const auto c : solid.triangle[geometry.index().element(face.site)].vertex)
    for (const auto e : {p, q}) {
      const Ball side = dot(r.across, difference(solid.point[c], solid.point[e]));
      low = std::min(low, side.low());
      high = std::max(high, side.high());
    }
  if (-low < r.reach) return r;
  if (high < r.reach) {
    r.across = negative(r.across);
    return r;
  }
  return std::nullopt;
}

bool Ledge::ahead(const BallVector& w) const {
  return dot(across, w).low() * reach * kDown > rest * length_upper(w) * kUp;
}

}  // namespace blum
