#include "gains.hpp"

#include "blum/kernel/union_find.hpp"

namespace blum::verify {
namespace {

/// Of two affine functions by their values at the corners of a box: are both <= 0 in no point of
/// it? They are not iff r p + q > 0 at all corners for some r > 0.
bool exclude_each_other(std::span<const Rational> p, std::span<const Rational> q) {
  Rational low = 0;
  std::optional<Rational> high;
  for (std::size_t k = 0; k < p.size(); ++k) {
    if (p[k] == 0 && q[k] <= 0) return false;
    if (p[k] == 0) continue;
    const Rational r = -q[k] / p[k];
    if (p[k] > 0)
      low = std::max(low, r);
    else
      high = high ? std::min(*high, r) : r;
  }
  return !high || low < *high;
}

std::vector<std::uint32_t> common_corners(const Shape& shape, Site a, Site b) {
  std::vector<std::uint32_t> common;
  for (const auto v : shape.corners(a))
    if (shape.has_corner(b, v)) common.push_back(v);
  return common;
}

template <class Related>
Groups components(const Sites& sites, std::span<const Site> list, const Box3& box,
                  Related&& related) {
  UnionFind component;
  component.resize(static_cast<std::uint32_t>(list.size()));
  for (std::uint32_t i = 0; i < list.size(); ++i)
    for (std::uint32_t j = 0; j < i; ++j)
      if (component.find(i) != component.find(j) && related(list[i], list[j]))
        component.unite(i, j);
  Groups g{{}, 0, true};
  for (std::uint32_t i = 0; i < list.size(); ++i) {
    const auto first = component.find(i);
    g.of.push_back(first == i ? g.count++ : g.of[first]);
    for (std::uint32_t j = 0; j < i && g.cliques; ++j)
      g.cliques = g.of[i] != g.of[j] || sites.never_essential(list[i], list[j]) ||
                  never_tie_from_vertex(sites.shape(), box, list[i], list[j]);
  }
  return g;
}

/// D'': a plane across w parts a (ahead) from b; where they meet it goes through a common corner.
bool lies_ahead(const Shape& shape, const SharedFeet& feet, Site a, Site b,
                const Vec<Rational>& w) {
  const auto ahead = [&](std::uint32_t q, std::uint32_t p) {
    return sgn(inner(shape.along<Rational>(q, p), w));
  };
  const auto common = common_corners(shape, a, b);
  if (common.empty())
    return std::ranges::all_of(shape.corners(a), [&](std::uint32_t p) {
      return std::ranges::all_of(shape.corners(b), [&](auto q) { return ahead(q, p) > 0; });
    });
  const auto v = common.front();
  // One lies on its side and may touch the plane, the other strictly, but for v and an edge from
  // there that holds no foot.
  const auto parted = [&](Site s, int sign, bool strictly) {
    int on_plane = 0;
    for (const auto p : shape.corners(s)) {
      const int side = p == v ? sign : ahead(v, p);
      if (side == sign || (side == 0 && !strictly)) continue;
      if (side != 0 || ++on_plane > 1 || feet.vertex(p) || feet.edge(v, p)) return false;
    }
    return true;
  };
  return (parted(a, 1, true) && parted(b, -1, false)) ||
         (parted(a, 1, false) && parted(b, -1, true));
}

/// Points whose hull holds the feet on s of all points of the box that s governs.
std::vector<Vec<Rational>> hull_of_feet(const Shape& shape, const Box3& box, Site s) {
  std::vector<Vec<Rational>> hull;
  for (const auto v : shape.corners(s)) hull.push_back(exactly<Rational>(shape.point[v]));
  if (hull.size() != 2) return hull;
  const Vec<Rational> from = hull[0], along = minus(hull[1], from);
  Rational low = 1, high = 0;
  for (const Point3& x : corners_of(box)) {
    const Rational share = inner(minus(exactly<Rational>(x), from), along) / inner(along, along);
    low = std::min(low, share);
    high = std::max(high, share);
  }
  if (low > 0 && low < 1) hull[0] = plus(from, times(along, low));
  if (high > 0 && high < 1) hull[1] = plus(from, times(along, high));
  return hull;
}

/// "Depth": a point of the box with feet y_a in a face and y_b on b has |y_a - y_b|^2 = 2 d h, h
/// the depth of y_b before the face. So there is none where b is farther than that beyond a side of
/// it.
bool apart_by_depth(const Sites& sites, const Box3& box, Site a, Site b) {
  const Shape& shape = sites.shape();
  if (shape.kind(a) != Kind::kFace) return false;
  const auto above = [&](const Condition& c, const Vec<Rational>& x) {
    return Rational(inner(c.w.as<Rational>(), minus(x, exactly<Rational>(shape.point[c.base]))));
  };
  const std::vector<Vec<Rational>> feet = hull_of_feet(shape, box, b);
  const Condition& plane = sites.conditions(a).back();
  Rational distance = 0, depth = 0;  // both times |n|
  for (const Point3& x : corners_of(box))
    distance = std::max(distance, Rational(-above(plane, exactly<Rational>(x))));
  for (const auto& y : feet) depth = std::max(depth, Rational(-above(plane, y)));
  const Vec<Rational>& n = plane.w.as<Rational>();
  return std::ranges::any_of(sites.own_conditions(a), [&](const Condition& side) {
    const Vec<Rational>& w = side.w.as<Rational>();
    const Rational farthest = 2 * distance * depth * inner(w, w) / inner(n, n);
    return std::ranges::all_of(feet, [&](const auto& y) {
      const Rational beyond = above(side, y);
      return beyond > 0 && beyond * beyond > farthest;
    });
  });
}

}  // namespace

std::uint32_t Groups::find(std::span<const Site> sites, Site s) const {
  const auto it = std::ranges::find(sites, s);
  return it == sites.end() ? count : of[static_cast<std::size_t>(it - sites.begin())];
}

Groups groups_by_ties(const Sites& sites, std::span<const Site> list, const Box3& box) {
  return components(sites, list, box, [&](Site a, Site b) { return sites.never_essential(a, b); });
}

Groups groups_by_feet(const Sites& sites, std::span<const Site> list, const SharedFeet& feet) {
  return components(sites, list, feet.box(), [&](Site a, Site b) { return feet.shared(a, b); });
}

bool SharedFeet::vertex(std::uint32_t v) const {
  const Site s = shape_.vertex_site(v);
  if (shape_.cone[v].never_foot) return false;
  if (std::ranges::binary_search(shape_.candidates(), s) && !listed(s)) return false;
  const auto [it, fresh] = in_cone_.try_emplace(v, false);
  if (fresh) it->second = !exclusion_.outside_polar_cone(s, box_);
  return it->second;
}

bool SharedFeet::edge(std::uint32_t v, std::uint32_t p) const {
  const auto e = shape_.edge_between(v, p);
  if (!e || shape_.edge[*e].bend == Bend::kFlat) return true;
  // No ball inside touches a convex one.
  return shape_.edge[*e].bend == Bend::kReflex && listed(shape_.edge_site(*e));
}

bool SharedFeet::shared(Site a, Site b) const {
  const auto common = common_corners(shape_, a, b);
  return std::ranges::any_of(common, [&](std::uint32_t v) { return vertex(v); }) ||
         (common.size() >= 2 && edge(common[0], common[1]));
}

bool never_tie_from_vertex(const Shape& shape, const Box3& box, Site a, Site b) {
  if (shape.kind(a) != Kind::kEdge || shape.kind(b) != Kind::kEdge) return false;
  const auto common = common_corners(shape, a, b);
  if (common.size() != 1) return false;
  const auto away = [&](Site s) {
    return shape.along<Rational>(common[0], shape.other_end(shape.element(s), common[0]));
  };
  const Vec<Rational> ea = away(a), eb = away(b);
  // Feet off the vertex lie ahead of it on both edges, equally far.
  int sum = 0;
  std::vector<Rational> behind_a, behind_b;
  for (const Point3& x : corners_of(box)) {
    const Vec<Rational> d = shape.from<Rational>(common[0], x);
    behind_a.push_back(-inner(d, ea));
    behind_b.push_back(-inner(d, eb));
    sum += compare_over_roots<Rational>(behind_a.back(), inner(ea, ea), behind_b.back(),
                                        inner(eb, eb));
  }
  return std::cmp_equal(std::abs(sum), behind_a.size()) || exclude_each_other(behind_a, behind_b);
}

bool gains(const Exclusion& exclusion, const Box3& box, const SharedFeet& feet, Site a, Site b,
           const Exact& w) {
  const Sites& sites = exclusion.sites();
  if (std::ranges::all_of(corners_of(box),
                          [&](const Point3& x) { return sites.slope(x, a, b, w) < 0; }))
    return true;
  return !feet.shared(a, b) && lies_ahead(sites.shape(), feet, a, b, w.as<Rational>());
}

bool may_both_govern(const Exclusion& exclusion, const Box3& box, Site a, Site b) {
  const Sites& sites = exclusion.sites();
  return !sites.never_essential(a, b) && !exclusion.never_tie(a, b, box) && !sites.beyond(a, box) &&
         !sites.beyond(b, box) && !never_tie_from_vertex(sites.shape(), box, a, b);
}

bool gains_where_both_govern(const Exclusion& exclusion, const Box3& box, const SharedFeet& feet,
                             Site a, Site b, const std::optional<Exact>& w, int& looks) {
  if (--looks < 0) return false;
  if (!may_both_govern(exclusion, box, a, b) || (w && gains(exclusion, box, feet, a, b, *w)) ||
      apart_by_depth(exclusion.sites(), box, a, b) || apart_by_depth(exclusion.sites(), box, b, a))
    return true;
  const auto half = halved(box);
  return half && std::ranges::all_of(*half, [&](const Box3& part) {
           return gains_where_both_govern(exclusion, part, feet, a, b, w, looks);
         });
}

}  // namespace blum::verify
