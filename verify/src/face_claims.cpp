#include "face_claims.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "failure.hpp"

namespace blum::verify {
namespace {

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

/// Sign of (p - q).w for two vertices.
int ahead(const Shape& shape, const Vec<Rational>& w, std::uint32_t q, std::uint32_t p) {
  return p == q ? 0 : sgn(inner(shape.along<Rational>(q, p), w));
}

/// D'': a plane across w parts a (ahead) from b; where they meet it goes through a common corner.
bool lies_ahead(const Shape& shape, const SharedFeet& feet, Site a, Site b,
                const Vec<Rational>& w) {
  const auto common = common_corners(shape, a, b);
  if (common.empty())
    return std::ranges::all_of(shape.corners(a), [&](std::uint32_t p) {
      return std::ranges::all_of(shape.corners(b),
                                 [&](std::uint32_t q) { return ahead(shape, w, q, p) > 0; });
    });
  const auto v = common.front();
  // One lies on its side and may touch the plane, the other strictly, but for v and an edge from
  // there that holds no foot.
  const auto parted = [&](Site s, int sign, bool strictly) {
    int on_plane = 0;
    for (const auto p : shape.corners(s)) {
      if (p == v) continue;
      const int side = ahead(shape, w, v, p);
      if (side == sign || (side == 0 && !strictly)) continue;
      if (side != 0 || ++on_plane > 1 || feet.vertex(p) || feet.edge(v, p)) return false;
    }
    return true;
  };
  return (parted(a, 1, true) && parted(b, -1, false)) ||
         (parted(a, 1, false) && parted(b, -1, true));
}

/// Bounds of the products with w of all gradients that the distance to a site can have where it
/// governs (docs/proofs.md, "Fans"); of none for a vertex.
std::optional<std::array<double, 2>> fan(const Exclusion& exclusion, Site s, const BallVector& w) {
  const Shape& shape = exclusion.sites().shape();
  const auto inward = [&](std::uint32_t t) { return exclusion.unit(shape.face_site(t)); };
  if (shape.kind(s) == Kind::kVertex) return std::nullopt;
  if (shape.kind(s) == Kind::kFace) {
    const Ball c = -dot(inward(shape.element(s)), w);
    return std::array{c.low(), c.high()};
  }
  const auto& side = shape.edge[shape.element(s)].triangle;
  const BallVector a = inward(side[0]), b = inward(side[1]), sum = plus(a, b);
  const Ball ca = -dot(a, w), cb = -dot(b, w);
  double low = std::min(ca.low(), cb.low()), high = std::max(ca.high(), cb.high());
  const double square = dot(sum, sum).low();
  if (!(square > 0)) return std::nullopt;
  const double stretch = 2 / std::sqrt(square) * (1 + 0x1p-40);  // p + q of p a + q b of length 1
  if (low < 0) low *= stretch;
  if (high > 0) high *= stretch;
  return std::array{low, high};
}

bool gains_by_fans(const Exclusion& exclusion, Site a, Site b, const Vec<Rational>& w) {
  const BallVector v{enclose(w[0]), enclose(w[1]), enclose(w[2])};
  const auto fa = fan(exclusion, a, v), fb = fan(exclusion, b, v);
  return fa && fb && (*fa)[1] < (*fb)[0];
}

}  // namespace

namespace {

/// Does a gain on b along w, wherever in the part both govern?
bool gains(const Part& part, const SharedFeet& feet, Site a, Site b, const Vec<Rational>& w) {
  const Sites& sites = part.exclusion.sites();
  return std::ranges::all_of(BoxCorners(part.box),
                             [&](const Point3& x) { return sites.slope(x, a, b, w) < 0; }) ||
         gains_by_fans(part.exclusion, a, b, w) ||
         (!feet.shared(a, b) && lies_ahead(sites.shape(), feet, a, b, w));
}

/// Sites of two groups that never tie essentially govern no point together (Lemma 1).
bool may_both_govern(const Part& part, Site a, Site b) {
  return !part.exclusion.sites().never_essential(a, b) && !part.exclusion.never_tie(a, b, part.box);
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
      if (g == groups.of[j] || !may_both_govern(part, part.sites[i], part.sites[j])) continue;
      require(w[g].has_value(), "Theorem D': a group without direction");
      require(gains(part, feet, part.sites[i], part.sites[j], *w[g]),
              "Theorem D': a group does not gain along its direction");
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
          !may_both_govern(part, a, b))
        continue;
      ties.insert(ordered(g, h));
      const auto forth = along.find({g, h}), back = along.find({h, g});
      require(forth != along.end() || back != along.end(), "chords: two groups without direction");
      require(forth != along.end() ? gains(part, feet, a, b, forth->second)
                                   : gains(part, feet, b, a, back->second),
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
