#include "fan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace blum {
namespace {

constexpr double kUp = 1 + 0x1p-40;

BallVector negative(const BallVector& w) { return {-w[0], -w[1], -w[2]}; }

}  // namespace

double Fan::low(const BallVector& w) const {
  double least = dot(end[0], w).low();
  if (count == 2) least = std::min(least, dot(end[1], w).low());
  return least < 0 ? least * stretch : least;
}

double Fan::high(const BallVector& w) const { return -low(negative(w)); }

Fan fan_of(const SiteGeometry& geometry, SiteId site) {
  const SiteIndex& index = geometry.index();
  Fan f;
  switch (index.kind(site)) {
    case SiteKind::kVertex:
      break;
    case SiteKind::kFace:
      f.count = 1;
      f.end[0] = negative(geometry.unit(site));
      break;
    case SiteKind::kEdge: {
      f.count = 2;
      const auto& beside = geometry.solid().edge[index.element(site)].triangle;
      for (std::size_t k = 0; k < 2; ++k)
        f.end[k] = negative(geometry.unit(index.face(beside[k])));
      // a + b <= 2 / |e1 + e2| for a unit vector a e1 + b e2.
      BallVector sum;
      for (std::size_t k = 0; k < 3; ++k) sum[k] = f.end[0][k] + f.end[1][k];
      const double square = dot(sum, sum).low();
      f.stretch = square > 0 ? 2 / std::sqrt(square) * kUp : std::numeric_limits<double>::infinity();
      break;
    }
  }
  return f;
}

bool gains_by_fans(const Fan& a, const Fan& b, const BallVector& w) {
  return a.count > 0 && b.count > 0 && a.high(w) < b.low(w);
}

}  // namespace blum
