/// Sites in 256 bits: points where two of them tie that no double can hold, and who governs there.
#pragma once

#include <gmpxx.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "../../arrangement/src/local_form.hpp"
#include "../../kernel/src/site_expressions.hpp"
#include "arrangement/face_scenes.hpp"
#include "blum/kernel/predicates.hpp"

namespace blum::test {

using Precise = mpf_class;
using PrecisePoint = std::array<Precise, 3>;

/// Ties are found to much less than that, even where two roots are one.
inline const Precise& tie_error() {
  static const Precise e(0x1p-90);
  return e;
}

inline PrecisePoint precise(const Point3& p) { return {Precise(p.x), Precise(p.y), Precise(p.z)}; }

/// from + s (to - from).
inline PrecisePoint on_line(const PrecisePoint& from, const PrecisePoint& to, const Precise& s) {
  PrecisePoint x;
  for (std::size_t k = 0; k < 3; ++k) x[k] = from[k] + s * (to[k] - from[k]);
  return x;
}

class PreciseSites {
 public:
  explicit PreciseSites(const SiteGeometry& geometry) : geometry_(geometry) {
    namespace ex = detail::expression;
    mpf_set_default_prec(256);
    const Solid& solid = geometry.solid();
    site_.resize(geometry.index().size());
    for (const SiteId s : geometry.candidates()) {
      Site& site = site_[s.value];
      site.base = precise(geometry.base(s));
      const auto i = geometry.index().element(s);
      const SiteKind kind = geometry.index().kind(s);
      if (kind == SiteKind::kEdge)
        site.way = unit(ex::minus<Precise>(solid.point[solid.edge[i].vertex[1]],
                                           solid.point[solid.edge[i].vertex[0]]));
      if (kind == SiteKind::kFace) site.way = unit(ex::normal<Precise>(solid, i));
      for (const HalfSpace& h : geometry.domain(s))
        site.condition.push_back(
            {unit(ex::half_space_direction<Precise>(solid, h)), precise(solid.point[h.base])});
    }
  }

  /// Squared distance from the carrier.
  [[nodiscard]] Precise squared(SiteId s, const PrecisePoint& x) const {
    const Site& site = site_[s.value];
    if (geometry_.index().kind(s) == SiteKind::kFace) {
      const Precise h = height(s, x);
      return h * h;
    }
    const PrecisePoint d = minus(x, site.base);
    if (geometry_.index().kind(s) == SiteKind::kVertex) return inner(d, d);
    const Precise along = inner(d, site.way);
    return inner(d, d) - along * along;
  }

  /// Signed, over the plane of a face.
  [[nodiscard]] Precise height(SiteId face, const PrecisePoint& x) const {
    const Site& site = site_[face.value];
    return inner(minus(x, site.base), site.way);
  }

  /// By how much the first `count` conditions of its domain fail; not more than 0: all hold.
  [[nodiscard]] Precise violation(SiteId s, const PrecisePoint& x, std::size_t count) const {
    const auto& conditions = site_[s.value].condition;
    Precise most = -8;
    for (std::size_t k = 0; k < std::min(count, conditions.size()); ++k) {
      const Precise v = inner(conditions[k].w, minus(x, conditions[k].base));
      if (v > most) most = v;
    }
    return most;
  }
  [[nodiscard]] bool in_domain(SiteId s, const PrecisePoint& x) const {
    return violation(s, x, site_[s.value].condition.size()) <= tie_error();
  }
  /// Is the projection on the carrier a point of the site, or of a face of the same plane beside?
  [[nodiscard]] bool projects(SiteId s, const PrecisePoint& x) const {
    const auto within = [&](SiteId t) {
      return violation(t, x, geometry_.own_conditions(t)) <= tie_error();
    };
    if (within(s)) return true;
    if (geometry_.index().kind(s) != SiteKind::kFace) return false;
    const Solid& solid = geometry_.solid();
    for (const auto e : solid.triangle[geometry_.index().element(s)].edge)
      if (solid.edge[e].kind == EdgeKind::kFlat)
        for (const auto t : solid.edge[e].triangle)
          if (within(geometry_.index().face(t))) return true;
    return false;
  }
  /// Is x, a point of the diagram's domain, in the domains of both, and none of the others nearer?
  /// Faces count on either side: between points inside the solid there may be some outside.
  [[nodiscard]] bool both_govern(SiteId a, SiteId c, const PrecisePoint& x,
                                 std::span<const SiteId> others) const {
    if (!in_domain(a, x) || !in_domain(c, x)) return false;
    const Precise d = squared(a, x);
    return std::ranges::none_of(
        others, [&](SiteId s) { return squared(s, x) < d - tie_error() && in_domain(s, x); });
  }

  /// Where on the line, as shares from `from` to `to`, the carriers are equally far.
  [[nodiscard]] std::vector<Precise> ties(SiteId a, SiteId c, const PrecisePoint& from,
                                          const PrecisePoint& to) const {
    const auto at = [&](double s) {
      const PrecisePoint x = on_line(from, to, Precise(s));
      return Precise(squared(a, x) - squared(c, x));
    };
    const Precise zero = at(0), one = at(1), minus_one = at(-1);
    const Precise second = (one + minus_one) / 2 - zero, first = (one - minus_one) / 2;
    if (abs(second) <= abs(first) * tie_error()) {
      if (first == 0) return {};
      return {Precise(-zero / first)};
    }
    const Precise half = -first / (2 * second);
    Precise square = half * half - zero / second;
    if (abs(square) < Precise(0x1p-200) * (1 + half * half)) square = 0;  // two roots in one
    if (square < 0) return {};
    const Precise root = sqrt(square);
    return {Precise(half - root), Precise(half + root)};
  }

 private:
  struct Condition {
    PrecisePoint w, base;
  };
  struct Site {
    PrecisePoint base, way;
    std::vector<Condition> condition;
  };

  static Precise inner(const PrecisePoint& a, const PrecisePoint& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  static PrecisePoint minus(const PrecisePoint& a, const PrecisePoint& b) {
    return {Precise(a[0] - b[0]), Precise(a[1] - b[1]), Precise(a[2] - b[2])};
  }
  static PrecisePoint unit(const PrecisePoint& a) {
    const Precise length = sqrt(inner(a, a));
    return {Precise(a[0] / length), Precise(a[1] / length), Precise(a[2] / length)};
  }

  const SiteGeometry& geometry_;
  std::vector<Site> site_;
};

/// Two sites that both govern x, or a point nearer to it than that error, in the same plane of a
/// coordinate where that is exact.
struct PreciseTie {
  SiteId a{}, c{};
  PrecisePoint x;
  std::array<bool, 3> exact{};
};

/// Between two random points of the diagram's domain with different governors: near an edge as
/// often as not, on a plane of a coordinate as often as not.
inline std::optional<PreciseTie> random_tie(Random& random, const Scene& scene,
                                            const PreciseSites& sites, Predicates& predicates) {
  const SiteGeometry& geometry = *scene.geometry;
  const bool voronoi = geometry.kind() == DiagramKind::kVoronoi;
  const auto candidates = geometry.candidates();
  const auto governors = [&](const Point3& x) {
    std::vector<SiteId> g;
    if (voronoi || scene.inside->locate(x) == InsideOracle::Where::kInside)
      predicates.governors(x, candidates, g);
    return g;
  };
  Point3 p, q;
  const double size = scene.extent() * log_uniform(random, 1e-3, 0.5),
               margin = voronoi ? 0.2 * scene.extent() : 0;
  const auto& e = scene.solid->edge[random() % scene.solid->edge.size()];
  const bool near_edge = random() % 2 == 0;
  const double along = uniform(random, 0, 1);
  for (int k = 0; k < 3; ++k) {
    const double a = scene.solid->point[e.vertex[0]][k], b = scene.solid->point[e.vertex[1]][k];
    p[k] = near_edge ? a + along * (b - a) + size * uniform(random, -1, 1)
                     : uniform(random, scene.bounds.lo[k] - margin, scene.bounds.hi[k] + margin);
    q[k] = p[k] + size * uniform(random, -1, 1);
  }
  const auto level = static_cast<int>(random() % 6);
  if (level < 3) q[level] = p[level];
  for (int step = 0; step < 30; ++step) {
    const auto at_p = governors(p), at_q = governors(q);
    if (at_p.empty() || at_q.empty()) return std::nullopt;
    for (const auto& [x, g] : {std::pair{&p, &at_p}, std::pair{&q, &at_q}})
      if (g->size() > 1) return PreciseTie{(*g)[0], (*g)[1], precise(*x), {true, true, true}};
    const SiteId a = at_p[0], c = at_q[0];
    if (a == c) return std::nullopt;
    const PrecisePoint from = precise(p), to = precise(q);
    for (const Precise& s : sites.ties(a, c, from, to)) {
      if (s < 0 || s > 1) continue;
      const PrecisePoint x = on_line(from, to, s);
      const Point3 rounded{x[0].get_d(), x[1].get_d(), x[2].get_d()};
      const bool counts = voronoi || scene.inside->locate(rounded) == InsideOracle::Where::kInside;
      if (counts && sites.both_govern(a, c, x, candidates))
        return PreciseTie{a, c, x, {level == 0, level == 1, level == 2}};
    }
    Point3 m;
    for (int k = 0; k < 3; ++k) m[k] = (p[k] + q[k]) / 2;
    const auto at_m = governors(m);
    if (at_m.empty()) return std::nullopt;
    (at_m[0] == a ? p : q) = m;
  }
  return std::nullopt;
}

/// A point of a few bits with several governors, if this one is.
inline std::optional<PreciseTie> random_exact_tie(Random& random, const Scene& scene,
                                                  Predicates& predicates) {
  const SiteGeometry& geometry = *scene.geometry;
  const bool voronoi = geometry.kind() == DiagramKind::kVoronoi;
  Point3 x;
  for (int k = 0; k < 3; ++k) {
    const double lo = scene.bounds.lo[k], extent = scene.bounds.hi[k] - lo;
    const auto step = static_cast<double>(random() % 25) - (voronoi ? 4 : 0);
    x[k] = lo + extent * step / 16;
  }
  if (!voronoi && scene.inside->locate(x) != InsideOracle::Where::kInside) return std::nullopt;
  std::vector<SiteId> g;
  predicates.governors(x, geometry.candidates(), g);
  if (g.size() < 2) return std::nullopt;
  const std::size_t i = random() % g.size(), j = random() % g.size();
  if (i == j) return std::nullopt;
  return PreciseTie{g[i], g[j], precise(x), {true, true, true}};
}

/// A random box that holds the tie: in its middle, on its border or in a corner; flat where it can
/// be.
inline Range range_with(Random& random, const PreciseTie& tie, double extent) {
  const double size = extent * log_uniform(random, 1e-9, 0.5);
  const auto flat = random() % 4;
  Point3 lo, hi;
  for (int k = 0; k < 3; ++k) {
    const auto m = static_cast<std::size_t>(k);
    lo[k] = hi[k] = tie.x[m].get_d();
    if (!tie.exact[m]) {  // the double is next to it
      lo[k] = std::nextafter(lo[k] - 0x1p-80, -10);
      hi[k] = std::nextafter(hi[k] + 0x1p-80, 10);
    } else if (flat == m) {
      continue;
    }
    const double share[] = {0, 1, uniform(random, 0, 1)};
    const double below = share[random() % 3], length = size * log_uniform(random, 0.01, 1);
    lo[k] -= length * below;
    hi[k] += length * (1 - below);
  }
  return Range::of(lo, hi);
}

}  // namespace blum::test
