#include "exclusion.hpp"

#include <algorithm>
#include <limits>
#include <memory>

namespace blum::verify {
namespace {

constexpr std::size_t kReferences = 8;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double up(double x) { return x * (1 + 0x1p-48) + 0x1p-1000; }

/// To x from a point of the segment from p to q (which may be one point): nearly the nearest.
BallVector from_side(const Point3& x, const Point3& p, const Point3& q) {
  const BallVector to = difference(x, p), side = difference(q, p);
  const double share = dot(to, side).mid / dot(side, side).mid;
  return minus(to, times(side, Ball(share >= 0 ? std::min(share, 1.0) : 0.0)));
}

}  // namespace

std::optional<std::array<Box3, 2>> halved(const Box3& box) {
  const auto h = half_widths(box);
  const int axis = static_cast<int>(std::ranges::max_element(h) - h.begin());
  const double m = center_of(box)[axis];
  if (!(m > box.lo[axis] && m < box.hi[axis])) return std::nullopt;
  std::array<Box3, 2> half{box, box};
  half[0].hi[axis] = half[1].lo[axis] = m;
  return half;
}

struct Exclusion::View {
  Point3 center;
  double nearest = kInfinity;                      // of what is below, squared
  BallVector from_foot;                            // to the centre, from a point of ∂O
  std::vector<std::pair<double, Site>> reference;  // the nearest sites that cover the box
  std::vector<Site> close;                         // near enough to be nearest somewhere in it
};

Exclusion::Exclusion(const Sites& sites) : sites_(sites) {
  for (std::uint32_t t = 0; t < sites.shape().triangle.size(); ++t) {
    const BallVector& n = sites.shape().normal<Ball>(t);
    const Ball length = root(dot(n, n));
    unit_.push_back({divide(n[0], length), divide(n[1], length), divide(n[2], length)});
  }
}

bool Exclusion::farther(Site a, Site b, const Box3& box, bool inside_b) const {
  const Shape& shape = sites_.shape();
  if (shape.kind(a) != Kind::kFace || shape.kind(b) != Kind::kFace)
    return sites_.farther(a, b, box);
  // Inside a plane the distance is minus the height.
  return std::ranges::all_of(corners_of(box), [&](const Point3& x) {
    return sites_.compare_heights(x, b, a) > 0 &&
           (inside_b || sites_.compare_heights(x, a, b, -1) < 0);
  });
}

bool Exclusion::never_tie(Site a, Site b, const Box3& box) const {
  return farther(a, b, box, true) || farther(b, a, box, true);
}

bool Exclusion::nearer_at_ties(Site b, Site a, Site c, const Box3& box) const {
  const Shape& shape = sites_.shape();
  for (const Site s : {a, b, c})
    if (shape.kind(s) != Kind::kFace) return false;
  if (!sites_.covers_inside(b, box)) return false;
  // There d = t d_a + (1 - t) d_c for every number t, and inside all planes distances are minus the
  // heights: affine. The best t leaves the least slope over the box.
  const auto h = half_widths(box);
  const auto normal = [&](Site s) { return unit_[shape.element(s)]; };
  const auto height = [&](Site s) {
    return dot(shape.from<Ball>(shape.corners(s)[0], center_of(box)), normal(s));
  };
  const BallVector ca = minus(normal(c), normal(a)), cb = minus(normal(c), normal(b));
  double up_sum = 0, down_sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    up_sum += h[k] * h[k] * ca[k].mid * cb[k].mid;
    down_sum += h[k] * h[k] * ca[k].mid * ca[k].mid;
  }
  const double share = up_sum / down_sum;
  if (!std::isfinite(share)) return false;
  const BallVector w = minus(cb, times(ca, Ball(share)));
  double spread = 0;
  for (std::size_t k = 0; k < 3; ++k) spread += w[k].magnitude() * h[k];
  const Ball hc = height(c), gap = (hc - height(b)) - Ball(share) * (hc - height(a));
  return gap.high() + up(spread) < 0;
}

Exclusion::View Exclusion::view(const Box3& box, std::span<const Site> against) const {
  const Shape& shape = sites_.shape();
  View v{center_of(box), kInfinity, {}, {}, {}};
  std::vector<double> square_to(against.size(), kInfinity);
  const auto look = [&](std::size_t i, const BallVector& from_foot) {
    const double square = dot(from_foot, from_foot).mid;
    if (square < square_to[i]) square_to[i] = square;
    if (!(square < v.nearest)) return;
    v.nearest = square;
    v.from_foot = from_foot;
  };
  for (std::size_t i = 0; i < against.size(); ++i) {
    const Site s = against[i];
    const auto corner = shape.corners(s);
    const bool face = shape.kind(s) == Kind::kFace;
    const bool covers_center = sites_.covers(s, {v.center, v.center});
    // Its foot where the centre projects into it; else that on its sides.
    if (face && covers_center) {
      const BallVector& n = unit_[shape.element(s)];
      look(i, times(n, dot(shape.from<Ball>(corner[0], v.center), n)));
    } else {
      for (std::size_t k = 0; k < corner.size(); ++k)
        look(i, from_side(v.center, shape.point[corner[k]],
                          shape.point[corner[(k + 1) % corner.size()]]));
    }
    if (covers_center && sites_.covers(s, box)) {
      const double square = sites_.square_of_distance(v.center, s).mid;
      v.reference.emplace_back(square >= 0 ? square : kInfinity, s);  // none: an overflow
    }
  }
  std::ranges::sort(v.reference);
  v.reference.resize(std::min(v.reference.size(), kReferences));
  const auto h = half_widths(box);
  const double reach = std::sqrt(v.nearest) + 2 * std::hypot(h[0], h[1], h[2]);
  for (std::size_t i = 0; i < against.size(); ++i)
    if (!(std::sqrt(square_to[i]) > reach)) v.close.push_back(against[i]);
  return v;
}

/// "Points": is a point of ∂O nearer to all of the box than the carrier of s?
bool Exclusion::behind_foot(Site s, const Box3& box, const View& view) const {
  if (view.nearest == kInfinity) return false;
  return std::ranges::all_of(corners_of(box), [&](const Point3& x) {
    const BallVector r = plus(view.from_foot, difference(x, view.center));
    return dot(r, r).high() < sites_.square_of_distance(x, s).low();
  });
}

bool Exclusion::gone(Site s, const Box3& box, const View& view) const {
  return sites_.beyond(s, box) || behind_foot(s, box, view) ||
         std::ranges::any_of(view.reference, [&](const auto& r) {
           return r.second != s && farther(s, r.second, box, false);
         });
}

struct Exclusion::Piece {
  Box3 box;
  View view;
  std::optional<std::vector<std::uint32_t>> triangles{};  // those that meet it, once asked for
  bool outside = false;
  std::array<std::unique_ptr<Piece>, 2> half{};
};

bool Exclusion::governs_nothing(Site s, Piece& piece, std::span<const std::uint32_t> triangles,
                                int& looks) const {
  if (--looks < 0) return false;
  if (gone(s, piece.box, piece.view)) return true;
  if (!piece.triangles) {
    piece.triangles = sites_.meeting(triangles, piece.box);
    // Where no triangle meets the box around it, a half is on that box's side.
    piece.outside = !triangles.empty() && piece.triangles->empty() &&
                    is_inside(sites_.shape(), center_of(piece.box)) == false;
  }
  if (piece.outside) return true;
  const auto box = halved(piece.box);
  for (std::size_t k = 0; box && k < 2; ++k) {
    auto& half = piece.half[k];
    if (!half) half = std::make_unique<Piece>((*box)[k], view((*box)[k], piece.view.close));
    if (!governs_nothing(s, *half, *piece.triangles, looks)) return false;
  }
  return box.has_value();
}

bool Exclusion::outside_polar_cone(Site s, const Box3& box) const {
  return sites_.shape().kind(s) == Kind::kVertex && corners_of(box).size() < 8 &&
         !sites_.domain_meets(s, box);
}

std::vector<Site> Exclusion::may_govern(std::span<const Site> sites, const Box3& box,
                                        std::span<const Site> against,
                                        std::span<const std::uint32_t> triangles, int most) const {
  if (sites.empty()) return {};
  Piece whole{box, view(box, against)};
  std::vector<Site> kept;
  std::ranges::copy_if(sites, std::back_inserter(kept), [&](Site s) {
    int looks = most;
    return !outside_polar_cone(s, box) && !governs_nothing(s, whole, triangles, looks) &&
           sites_.domain_meets(s, box);
  });
  return kept;
}

std::vector<Site> Exclusion::remaining(std::span<const Site> candidates, const Box3& box) const {
  const View v = view(box, candidates);
  std::vector<Site> kept;
  for (const Site s : candidates)
    if (!gone(s, box, v)) kept.push_back(s);
  return kept;
}

}  // namespace blum::verify
