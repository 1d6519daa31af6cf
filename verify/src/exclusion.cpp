#include "exclusion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "inside.hpp"

namespace blum::verify {
namespace {

constexpr std::size_t kReferences = 8;

double up(double x) { return x * (1 + 0x1p-48) + 0x1p-1000; }

BallVector over_length(const BallVector& x) {
  const Ball length = root(dot(x, x));
  return {divide(x[0], length), divide(x[1], length), divide(x[2], length)};
}

/// Infinite where the square is none (an overflow): bounds fail to say anything then.
double root_bound(const Ball& square) {
  const double high = square.high();
  return high >= 0 ? up(std::sqrt(high)) : std::numeric_limits<double>::infinity();
}

/// A point near the closed site, within kOnSite of it: corners of at most 1 combined in double. Any
/// shares between 0 and 1 give a bound; these give a good one.
Point3 point_near(const Shape& shape, Site s, const Point3& x) {
  const Corners corners = shape.corners(s);
  std::array<std::uint32_t, 3> v = corners.vertex;
  const auto from = [&](std::size_t k, const Point3& p) {
    return minus(exactly<double>(p), exactly<double>(shape.point[v[k]]));
  };
  const auto share = [](const Vec<double>& d, const Vec<double>& along, double most) {
    const double t = inner(d, along) / inner(along, along);
    return t > 0 ? std::min(t, most) : 0.0;
  };
  Vec<double> base{}, tip{};
  double up = 0;  // share of the tip
  if (corners.count == 3) {
    // Along the longest side and across it: other sides of a needle tell nothing of its width.
    const auto length = [&](std::size_t k) {
      const Vec<double> d = from(k, shape.point[v[(k + 1) % 3]]);
      return inner(d, d);
    };
    for (int turn = 0; turn < 2 && length(0) < std::max(length(1), length(2)); ++turn)
      std::ranges::rotate(v, v.begin() + 1);
    base = from(0, shape.point[v[1]]);
    tip = from(0, shape.point[v[2]]);
    up = share(from(0, x), minus(tip, times(base, share(tip, base, 1))), 1);
  } else if (corners.count == 2) {
    base = from(0, shape.point[v[1]]);
  }
  const double along = share(minus(from(0, x), times(tip, up)), base, 1 - up);
  Point3 p;
  for (int k = 0; k < 3; ++k) p[k] = shape.point[v[0]][k] + along * base[k] + up * tip[k];
  return p;
}
constexpr double kOnSite = 0x1p-46;

}  // namespace

std::optional<std::array<Box3, 2>> halved(const Box3& box) {
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (box.hi[k] - box.lo[k] > box.hi[axis] - box.lo[axis]) axis = k;
  const double m = 0.5 * box.lo[axis] + 0.5 * box.hi[axis];
  if (!(m > box.lo[axis] && m < box.hi[axis])) return std::nullopt;
  std::array<Box3, 2> half{box, box};
  half[0].hi[axis] = half[1].lo[axis] = m;
  return half;
}

struct Exclusion::View {
  Point3 center;
  double radius = 0;
  double nearest = std::numeric_limits<double>::infinity();  // bound on d(center)
  std::vector<Site> reference;                               // the nearest sites that cover the box
};

Exclusion::Exclusion(const Sites& sites) : sites_(sites) {
  const Shape& shape = sites.shape();
  unit_.resize(shape.sites());
  for (std::uint32_t e = 0; e < shape.edge.size(); ++e)
    unit_[shape.edge_site(e)] =
        over_length(shape.along<Ball>(shape.edge[e].vertex[0], shape.edge[e].vertex[1]));
  for (std::uint32_t t = 0; t < shape.triangle.size(); ++t)
    unit_[shape.face_site(t)] = over_length(shape.normal<Ball>(t));
}

bool Exclusion::farther(Site a, Site b, const Box3& box, bool inside_b) const {
  const Shape& shape = sites_.shape();
  if (shape.kind(a) == Kind::kFace && shape.kind(b) == Kind::kFace)
    // Inside a plane the distance is minus the height.
    return std::ranges::all_of(BoxCorners(box), [&](const Point3& x) {
      return sites_.compare_heights(x, b, a) > 0 &&
             (inside_b || sites_.compare_with_mirrored(x, a, b) < 0);
    });
  return sites_.farther(a, b, box);
}

bool Exclusion::never_tie(Site a, Site b, const Box3& box) const {
  return farther(a, b, box, true) || farther(b, a, box, true);
}

bool Exclusion::nearer_at_ties(Site b, Site a, Site c, const Box3& box) const {
  const Shape& shape = sites_.shape();
  if (std::ranges::any_of(std::array{a, b, c},
                          [&](Site s) { return shape.kind(s) != Kind::kFace; }) ||
      (!sites_.covers_inside(b, box) && !sites_.covers_with_neighbour(b, box)))
    return false;
  // There d = t d_a + (1 - t) d_c for every number t, and inside all planes distances are minus the
  // heights: affine. The best t leaves the least slope over the box.
  const Point3 center = center_of(box);
  const auto h = half_widths(box);
  const auto height = [&](Site s) {
    return dot(difference(center, shape.point[*shape.corners(s).begin()]), unit_[s]);
  };
  const BallVector ca = minus(unit_[c], unit_[a]), cb = minus(unit_[c], unit_[b]);
  double up_sum = 0, down_sum = 0;
  for (int k = 0; k < 3; ++k) {
    up_sum += h[k] * h[k] * ca[k].mid * cb[k].mid;
    down_sum += h[k] * h[k] * ca[k].mid * ca[k].mid;
  }
  const double share = up_sum / down_sum;
  if (!std::isfinite(share)) return false;
  const Ball t(share);
  const BallVector w = minus(cb, times(ca, t));
  double spread = 0;
  for (int k = 0; k < 3; ++k) spread += w[k].magnitude() * h[k];
  const Ball hc = height(c), gap = (hc - height(b)) - t * (hc - height(a));
  return gap.high() + up(spread) < 0;
}

Exclusion::View Exclusion::view(const Box3& box, std::span<const Site> against) const {
  const Shape& shape = sites_.shape();
  View v;
  v.center = center_of(box);
  const auto h = half_widths(box);
  v.radius = up(std::sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]));
  std::vector<std::pair<double, Site>> covering;
  for (const Site s : against) {
    if (sites_.covers(s, box)) {
      const double d = root_bound(sites_.square_of_distance(v.center, s));
      v.nearest = std::min(v.nearest, d);
      covering.emplace_back(d, s);
    }
    const BallVector offset = difference(v.center, point_near(shape, s, v.center));
    v.nearest = std::min(v.nearest, up(root_bound(dot(offset, offset)) + kOnSite));
  }
  std::ranges::sort(covering);
  if (covering.size() > kReferences) covering.resize(kReferences);
  for (const auto& [d, s] : covering) v.reference.push_back(s);
  return v;
}

bool Exclusion::gone(Site s, const Box3& box, const View& view) const {
  if (sites_.beyond(s, box)) return true;
  // Distances change by at most the radius.
  const double limit = up(view.nearest + 2 * view.radius);
  if (sites_.square_of_distance(view.center, s).low() > up(limit * limit)) return true;
  return std::ranges::any_of(view.reference,
                             [&](Site r) { return r != s && farther(s, r, box, false); });
}

bool Exclusion::halves(Site s, const Box3& box, std::span<const Site> against,
                       std::span<const std::uint32_t> triangles, int& looks) const {
  if (--looks < 0) return false;
  if (gone(s, box, view(box, against))) return true;
  const std::vector<std::uint32_t> meeting = sites_.meeting(triangles, box);
  if (meeting.empty() && is_inside(sites_.shape(), center_of(box)) == false) return true;
  const auto half = halved(box);
  return half && halves(s, (*half)[0], against, meeting, looks) &&
         halves(s, (*half)[1], against, meeting, looks);
}

bool Exclusion::outside_polar_cone(Site s, const Box3& box) const {
  const bool flat = box.lo.x == box.hi.x || box.lo.y == box.hi.y || box.lo.z == box.hi.z;
  return flat && sites_.shape().kind(s) == Kind::kVertex &&
         !polar_cone_meets(sites_.shape(), sites_.shape().element(s), box);
}

bool Exclusion::governs_nothing(Site s, const Box3& box, std::span<const Site> against,
                                const std::vector<std::uint32_t>& triangles, int most) const {
  if (outside_polar_cone(s, box)) return true;
  int looks = most;
  return halves(s, box, against, triangles, looks) || (looks < 0 && sites_.beyond_two(s, box));
}

std::vector<Site> Exclusion::remaining(std::span<const Site> candidates, const Box3& box) const {
  const View v = view(box, candidates);
  std::vector<Site> kept;
  for (const Site s : candidates)
    if (!gone(s, box, v)) kept.push_back(s);
  return kept;
}

}  // namespace blum::verify
