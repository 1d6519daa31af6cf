#include "face_claims.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "failure.hpp"
#include "gains.hpp"

namespace blum::verify {
namespace {

constexpr int kMostLooks = 500;  // at boxes, for one pair of sites

/// The direction as an exact vector.
Vec<Rational> vector_of(const Part& part, const Direction& d) {
  const int u = u_axis(part.axis), v = v_axis(part.axis);
  Vec<Rational> w{};
  if (d.line) {
    const Vec<Rational> along =
        part.exclusion.sites().shape().along<Rational>((*d.line)[0], (*d.line)[1]);
    w[u] = -along[v];
    w[v] = along[u];
  } else {
    w[u] = d.u;
    w[v] = d.v;
  }
  return w;
}

}  // namespace

void check_directions(const Part& part, const Groups& groups, const SharedFeet& feet,
                      const Claim& claim) {
  if (groups.count < 2) return;
  std::vector<std::optional<Vec<Rational>>> w(groups.count);
  for (const auto& [site, direction] : claim.direction) {
    const auto g = groups.find(part.sites, site);
    if (g < groups.count) w[g] = vector_of(part, direction);
  }
  for (std::size_t i = 0; i < part.sites.size(); ++i)
    for (std::size_t j = 0; j < part.sites.size(); ++j) {
      const auto g = groups.of[i];
      int looks = kMostLooks;
      require(
          g == groups.of[j] || gains_where_both_govern(part.exclusion, part.box, feet,
                                                       part.sites[i], part.sites[j], w[g], looks),
          w[g] ? "Theorem D': a group does not gain along its direction"
               : "Theorem D': a group without direction");
    }
}

void check_chords(const Part& part, const Groups& groups, const SharedFeet& feet,
                  std::span<const std::vector<std::uint32_t>> runs, const Claim& claim) {
  using Pair = std::array<std::uint32_t, 2>;
  const auto ordered = [](std::uint32_t g, std::uint32_t h) {
    return Pair{std::min(g, h), std::max(g, h)};
  };
  std::set<Pair> ties;
  for (const auto& run : runs) {
    std::map<Pair, int> shown;
    for (std::size_t k = 0; run.size() > 1 && k < run.size(); ++k)
      ++shown[ordered(run[k], run[(k + 1) % run.size()])];
    for (const auto& [pair, times] : shown) {
      require(times == 2, "chords: two groups beside each other not at two places of a border");
      ties.insert(pair);
    }
  }
  std::map<Pair, Vec<Rational>> along;  // the first gains on the second
  for (const auto& [a, b, direction] : claim.between) {
    const auto g = groups.find(part.sites, a), h = groups.find(part.sites, b);
    require(g < groups.count && h < groups.count,
            "chords: a direction of sites that are not there");
    along[{g, h}] = vector_of(part, direction);
  }
  std::map<Pair, Site> third;
  for (const auto& [a, b, c] : claim.parted) third[ordered(a, b)] = c;
  for (std::size_t i = 0; i < part.sites.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Site a = part.sites[i], b = part.sites[j];
      const auto g = groups.of[i], h = groups.of[j];
      if (g == h) continue;
      const auto c = third.find(ordered(a, b));
      if ((c != third.end() && part.exclusion.nearer_at_ties(c->second, a, b, part.box)) ||
          !may_both_govern(part.exclusion, part.box, a, b))
        continue;
      const auto forth = along.find({g, h}), back = along.find({h, g});
      int looks = kMostLooks;
      const bool without = forth == along.end() && back == along.end();
      if ((without || claim.proposed) &&
          gains_where_both_govern(part.exclusion, part.box, feet, a, b, {}, looks))
        continue;
      require(!without, "chords: two groups without direction");
      looks = kMostLooks;
      ties.insert(ordered(g, h));
      require(
          forth != along.end()
              ? gains_where_both_govern(part.exclusion, part.box, feet, a, b, forth->second, looks)
              : gains_where_both_govern(part.exclusion, part.box, feet, b, a, back->second, looks),
          "chords: a group does not gain along the direction");
    }
  for (const Pair& p : ties)
    for (std::uint32_t g = 0; g < groups.count; ++g)
      require(!ties.contains(ordered(p[0], g)) || !ties.contains(ordered(p[1], g)),
              "chords: three groups may meet");
}

void check_cone(const Part& part, std::uint32_t v) {
  const Sites& sites = part.exclusion.sites();
  const Shape& shape = sites.shape();
  require(v < shape.point.size() && shape.point[v][part.axis] != part.box.lo[part.axis],
          "Theorem G: the vertex lies in the plane");
  for (const Site s : part.sites)
    require(shape.corners(s).has(v), "Theorem G: a site does not meet the vertex");
  const BoxCorners corners(part.box);
  // Squared distance from v to the opposite sides of its triangles, the least: a sphere about v of
  // this radius meets the sites at v in parts of their cones.
  std::optional<Rational> reach;
  for (const auto t : shape.triangles_at[v]) {
    const auto& c = shape.triangle[t].vertex;
    const auto k = static_cast<std::size_t>(std::ranges::find(c, v) - c.begin());
    const Vec<Rational> n = shape.normal<Rational>(t),
                        side = shape.along<Rational>(c[(k + 1) % 3], c[(k + 2) % 3]);
    const Rational height = inner(n, n) / inner(side, side);
    if (!reach || height < *reach) reach = height;
  }
  const auto all = [&](auto&& holds) { return std::ranges::all_of(corners, holds); };
  const auto from_v = [&](const Point3& x) {
    return minus(exactly<Rational>(x), exactly<Rational>(shape.point[v]));
  };
  for (const auto t : shape.triangles_at[v]) {
    const auto& c = shape.triangle[t].vertex;
    const auto k = static_cast<std::size_t>(std::ranges::find(c, v) - c.begin());
    const auto conditions = sites.conditions(shape.face_site(t));
    const auto never = [&](std::size_t side) {
      return all([&](const Point3& x) { return sites.sign(conditions[side], x) > 0; });
    };
    if (never(k) || never((k + 2) % 3)) continue;
    const Vec<Rational> n = shape.normal<Rational>(t);
    const Rational nn = inner(n, n);
    require(all([&](const Point3& x) {
              const Vec<Rational> d = from_v(x);
              const Rational h = inner(d, n);
              return inner(d, d) - h * h / nn < *reach;
            }),
            "Theorem G: a foot may leave its triangle");
  }
  for (const auto e : shape.edges_at[v]) {
    const auto& ends = shape.edge[e].vertex;
    const Vec<Rational> u = shape.along<Rational>(v, ends[ends[0] == v ? 1 : 0]);
    if (all([&](const Point3& x) { return sgn(inner(from_v(x), u)) < 0; })) continue;
    require(all([&](const Point3& x) {
              const Rational h = inner(from_v(x), u);
              return h * h / inner(u, u) < *reach;
            }),
            "Theorem G: a foot may leave its edge");
  }
}

void check_rim(const Part& part, std::uint32_t v, const std::array<std::uint32_t, 2>& edge) {
  const Shape& shape = part.exclusion.sites().shape();
  const auto away = [&](std::uint32_t e) {
    require(e < shape.edge.size(), "rim: no such edge");
    const auto& ends = shape.edge[e].vertex;
    require(ends[0] == v || ends[1] == v, "rim: the edges do not meet in the vertex");
    return shape.along<Rational>(v, ends[ends[0] == v ? 1 : 0]);
  };
  const Vec<Rational> rim = outer(away(edge[0]), away(edge[1]));
  for (const Site s : part.sites) {
    require(shape.corners(s).has(v), "rim: a site does not meet the vertex");
    const auto i = shape.element(s);
    if (shape.kind(s) == Kind::kEdge) {
      require(sgn(inner(away(i), rim)) == 0, "rim: an edge is not orthogonal to it");
    } else if (shape.kind(s) == Kind::kFace) {
      for (const Rational& x : outer(shape.normal<Rational>(i), rim))
        require(sgn(x) == 0, "rim: a face is not orthogonal to it");
    }
  }
  require(sgn(rim[part.axis]) != 0, "rim: parallel to the plane");
  const Vec<Rational> o = exactly<Rational>(shape.point[v]);
  const Rational t = (Rational(part.box.lo[part.axis]) - o[part.axis]) / rim[part.axis];
  for (const int k : {u_axis(part.axis), v_axis(part.axis)}) {
    const Rational x = o[k] + t * rim[k];
    require(x > part.box.lo[k] && x < part.box.hi[k], "rim: it misses the part");
  }
}

}  // namespace blum::verify
