#include "face_claims.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "failure.hpp"

namespace blum::verify {
namespace {

constexpr int kMostLooks = 500;  // at boxes, for one pair of sites

/// The direction as an exact vector.
Exact vector_of(const Part& part, const Direction& d) {
  const auto u = static_cast<std::size_t>(u_axis(part.axis)),
             v = static_cast<std::size_t>(v_axis(part.axis));
  Vec<Rational> w{};
  w[u] = d.u;
  w[v] = d.v;
  if (d.line) {
    const auto along = part.exclusion.sites().shape().along<Rational>((*d.line)[0], (*d.line)[1]);
    w[u] = -along[v];
    w[v] = along[u];
  }
  return w;
}

}  // namespace

void check_directions(const Part& part, const Groups& groups, const SharedFeet& feet,
                      const Claim& claim) {
  if (groups.count < 2) return;
  std::map<std::uint32_t, Exact> w;
  for (const auto& [site, direction] : claim.direction)
    w[groups.find(part.sites, site)] = vector_of(part, direction);
  for (std::size_t i = 0; i < part.sites.size(); ++i)
    for (std::size_t j = 0; j < part.sites.size(); ++j) {
      const auto own = w.find(groups.of[i]);
      int looks = kMostLooks;
      require(groups.of[i] == groups.of[j] ||
                  gains_where_both_govern(
                      part.exclusion, part.box, feet, part.sites[i], part.sites[j],
                      own == w.end() ? std::nullopt : std::optional(own->second), looks),
              own == w.end() ? "Theorem D': a group without direction"
                             : "Theorem D': a group does not gain along its direction");
    }
}

void check_chords(const Part& part, const Groups& groups, const SharedFeet& feet,
                  std::span<const std::vector<std::uint32_t>> runs, const Claim& claim) {
  using Pair = std::set<std::uint32_t>;
  std::set<Pair> ties;
  for (const auto& run : runs) {
    std::map<Pair, int> shown;
    for (std::size_t k = 0; run.size() > 1 && k < run.size(); ++k)
      ++shown[{run[k], run[(k + 1) % run.size()]}];
    for (const auto& [pair, times] : shown) {
      require(times == 2, "chords: two groups beside each other not at two places of a border");
      ties.insert(pair);
    }
  }
  std::map<std::array<std::uint32_t, 2>, Exact> along;  // the first gains on the second
  for (const auto& [a, b, direction] : claim.between) {
    const auto g = groups.find(part.sites, a), h = groups.find(part.sites, b);
    require(g < groups.count && h < groups.count,
            "chords: a direction of sites that are not there");
    along[{g, h}] = vector_of(part, direction);
  }
  std::map<std::set<Site>, Site> third;
  for (const auto& [a, b, c] : claim.parted) third[{a, b}] = c;
  for (std::size_t i = 0; i < part.sites.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Site a = part.sites[i], b = part.sites[j];
      const auto g = groups.of[i], h = groups.of[j];
      if (g == h) continue;
      const auto gains_on = [&](Site p, Site q, const std::optional<Exact>& w) {
        int looks = kMostLooks;
        return gains_where_both_govern(part.exclusion, part.box, feet, p, q, w, looks);
      };
      const auto c = third.find({a, b});
      if ((c != third.end() && part.exclusion.nearer_at_ties(c->second, a, b, part.box)) ||
          !may_both_govern(part.exclusion, part.box, a, b))
        continue;
      const auto forth = along.find({g, h}), back = along.find({h, g});
      const bool without = forth == along.end() && back == along.end();
      if (without && gains_on(a, b, {})) continue;
      require(!without, "chords: two groups without direction");
      ties.insert({g, h});
      require(forth != along.end() ? gains_on(a, b, forth->second) : gains_on(b, a, back->second),
              "chords: a group does not gain along the direction");
    }
  for (const Pair& p : ties)
    for (std::uint32_t g = 0; g < groups.count; ++g)
      require(!ties.contains({*p.begin(), g}) || !ties.contains({*p.rbegin(), g}),
              "chords: three groups may meet");
}

void check_cone(const Part& part, std::uint32_t v) {
  const Sites& sites = part.exclusion.sites();
  const Shape& shape = sites.shape();
  require(shape.point[v][part.axis] != part.box.lo[part.axis],
          "Theorem G: the vertex lies in the plane");
  for (const Site s : part.sites)
    require(shape.has_corner(s, v), "Theorem G: a site does not meet the vertex");
  const auto all = [&](auto&& holds) {
    return std::ranges::all_of(corners_of(part.box), [&](const Point3& x) {
      return holds(x, shape.from<Rational>(v, x));
    });
  };
  // Squared distance from v to the opposite sides of its triangles, the least: a sphere about v of
  // this radius meets the sites at v in parts of their cones.
  std::optional<Rational> reach;
  for (const auto t : shape.triangles_at[v])
    for (const auto e : shape.triangle[t].edge) {
      const auto& [p, q] = shape.edge[e].vertex;
      const Vec<Rational>&n = shape.normal<Rational>(t), side = shape.along<Rational>(p, q);
      const Rational height = inner(n, n) / inner(side, side);
      if (p != v && q != v && (!reach || height < *reach)) reach = height;
    }
  for (const auto t : shape.triangles_at[v]) {
    // Where a point is beyond a side at v it has no foot in the triangle.
    const auto conditions = sites.own_conditions(shape.face_site(t));
    if (std::ranges::any_of(conditions, [&](const Condition& c) {
          const auto& ends = shape.edge[*c.edge].vertex;
          return (ends[0] == v || ends[1] == v) &&
                 all([&](const Point3& x, const auto&) { return sites.sign(c, x) > 0; });
        }))
      continue;
    const Vec<Rational>& n = shape.normal<Rational>(t);
    require(all([&](const Point3&, const auto& d) {
              const Rational h = inner(d, n);
              return inner(d, d) - h * h / inner(n, n) < *reach;
            }),
            "Theorem G: a foot may leave its triangle");
  }
  for (const auto e : shape.edges_at[v]) {
    const Vec<Rational> u = shape.along<Rational>(v, shape.other_end(e, v));
    require(all([&](const Point3&, const auto& d) { return inner(d, u) < 0; }) ||
                all([&](const Point3&, const auto& d) {
                  const Rational h = inner(d, u);
                  return h * h / inner(u, u) < *reach;
                }),
            "Theorem G: a foot may leave its edge");
  }
}

void check_rim(const Part& part, std::uint32_t v, const std::array<std::uint32_t, 2>& edge) {
  const Shape& shape = part.exclusion.sites().shape();
  const auto away = [&](std::uint32_t e) {
    require(shape.has_corner(shape.edge_site(e), v), "rim: the edges do not meet in the vertex");
    return shape.along<Rational>(v, shape.other_end(e, v));
  };
  const Vec<Rational> rim = outer(away(edge[0]), away(edge[1]));
  for (const Site s : part.sites) {
    require(shape.has_corner(s, v), "rim: a site does not meet the vertex");
    const auto i = shape.element(s);
    if (shape.kind(s) == Kind::kEdge)
      require(sgn(inner(away(i), rim)) == 0, "rim: an edge is not orthogonal to it");
    if (shape.kind(s) == Kind::kFace)
      require(is_zero(outer(shape.normal<Rational>(i), rim)),
              "rim: a face is not orthogonal to it");
  }
  const auto axis = static_cast<std::size_t>(part.axis);
  require(rim[axis] != 0, "rim: parallel to the plane");
  const Vec<Rational> low = shape.from<Rational>(v, part.box.lo),
                      high = shape.from<Rational>(v, part.box.hi);
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational x = low[axis] / rim[axis] * rim[k];
    require(k == axis || (x > low[k] && x < high[k]), "rim: it misses the part");
  }
}

}  // namespace blum::verify
