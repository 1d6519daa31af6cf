// Points that are equally far from carriers have angles of at most the bound over the box.

#include "tie_angle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

using Real = long double;
using Vector = std::array<Real, 3>;

Real inner(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// From x to its foot on the carrier.
Vector to_foot(const SiteGeometry& geometry, SiteId s, const Vector& x) {
  Vector w, u{};
  for (int k = 0; k < 3; ++k)
    w[static_cast<std::size_t>(k)] = geometry.base(s)[k] - x[static_cast<std::size_t>(k)];
  const SiteKind kind = geometry.index().kind(s);
  if (kind == SiteKind::kVertex) return w;
  for (std::size_t k = 0; k < 3; ++k) u[k] = geometry.unit(s)[k].mid;
  const Real along = inner(w, u) / inner(u, u);
  for (std::size_t k = 0; k < 3; ++k)
    w[k] = kind == SiteKind::kFace ? along * u[k] : w[k] - along * u[k];
  return w;
}

Real angle(const Vector& v, const Vector& w) {
  const Vector cross{v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2],
                     v[0] * w[1] - v[1] * w[0]};
  return std::atan2(std::sqrt(inner(cross, cross)), inner(v, w));
}

/// A point of the box near x that is equally far from all the sites, by Newton's method in the
/// axes where the box is not flat.
std::optional<Vector> on_tie(const SiteGeometry& geometry, const std::vector<SiteId>& site,
                             const Box3& box, Vector x) {
  for (int step = 0; step < 30; ++step) {
    const Vector v = to_foot(geometry, site[0], x);
    // Gauss-Seidel over the ties: each is moved onto in turn, along its gradient across those
    // before it.
    std::vector<Vector> across;
    Real worst = 0;
    Vector next = x;
    for (std::size_t t = 1; t < site.size(); ++t) {
      const Vector w = to_foot(geometry, site[t], x);
      const Real gap = inner(v, v) - inner(w, w);
      worst = std::max(worst, std::abs(gap) / (inner(v, v) + inner(w, w) + 1e-30L));
      Vector g;
      for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        g[i] = box.lo[k] == box.hi[k] ? 0 : -2 * (v[i] - w[i]);
      }
      const Vector whole = g;
      for (const Vector& a : across) {
        const Real share = inner(g, a) / inner(a, a);
        for (std::size_t i = 0; i < 3; ++i) g[i] -= share * a[i];
      }
      if (!(inner(g, g) > 1e-12L * inner(whole, whole))) return std::nullopt;
      Real left = gap;
      for (std::size_t i = 0; i < 3; ++i) left += whole[i] * (next[i] - x[i]);
      for (std::size_t i = 0; i < 3; ++i) next[i] -= left / inner(g, g) * g[i];
      across.push_back(g);
    }
    if (worst < 1e-17L) {
      for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        if (!(x[i] >= box.lo[k] && x[i] <= box.hi[k])) return std::nullopt;
      }
      return x;
    }
    x = next;
  }
  return std::nullopt;
}

struct Figures {
  std::size_t points = 0, flat = 0, large = 0, bounds = 0, sharper = 0, of_three = 0,
              sharper_third = 0, nowhere = 0;
};

/// Of a domain, or nearly.
bool beyond_a_border(const SiteGeometry& geometry, const std::vector<SiteId>& site,
                     const Vector& x) {
  for (const SiteId s : site)
    for (const HalfSpace& h : geometry.domain(s)) {
      Vector w, from;
      for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        w[i] = h.w[i].mid;
        from[i] = x[i] - static_cast<Real>(geometry.solid().point[h.base][k]);
      }
      if (inner(w, from) > -1e-12L * std::sqrt(inner(w, w))) return true;
    }
  return false;
}

void check(const SiteGeometry& geometry, const std::vector<SiteId>& site, const Box3& box,
           std::mt19937_64& random, Figures& figures) {
  std::vector<SiteView> view;
  for (const SiteId s : site) view.push_back(view_of(geometry, s, box));
  const SiteView* third = site.size() > 2 ? &view[2] : nullptr;
  const double bound = angle_on_tie_at_most(geometry, view[0], view[1], third, box);
  EXPECT_GE(bound, 0);
  EXPECT_LE(bound, kPi);
  std::uniform_real_distribution<double> unit(0, 1);
  bool met = false;
  for (int k = 0; k < 8; ++k) {
    Vector x;
    for (int i = 0; i < 3; ++i) {
      const double t = k < 6 ? unit(random) : std::round(unit(random));
      x[static_cast<std::size_t>(i)] = box.lo[i] + t * (box.hi[i] - box.lo[i]);
    }
    const auto tie = on_tie(geometry, site, box, x);
    if (!tie) continue;
    met = true;
    const Real found = angle(to_foot(geometry, site[0], *tie), to_foot(geometry, site[1], *tie));
    ++figures.points;
    figures.of_three += third ? 1 : 0;
    figures.large += found > 3 ? 1 : 0;
    figures.flat += box.lo.x == box.hi.x ? 1 : 0;
    if (bound == 0) {
      ++figures.nowhere;
      EXPECT_TRUE(beyond_a_border(geometry, site, *tie));
      continue;
    }
    // The unit vectors are rounded here.
    EXPECT_LE(found, bound + 1e-12L / std::max<Real>(1e-6L, std::sin(found)));
  }
  if (!met) return;
  ++figures.bounds;
  figures.sharper += bound < angle_at_most(view[0], view[1]) ? 1 : 0;
  figures.sharper_third +=
      third && bound < angle_on_tie_at_most(geometry, view[0], view[1], nullptr, box) ? 1 : 0;
}

TEST(TieAngle, PointsOnTies_AreWithinTheBound) {
  std::mt19937_64 random(11);
  Figures figures;
  for (const auto& scene : test::scenes()) {
    SCOPED_TRACE(scene.name);
    const Solid solid = test::solid_of(scene.mesh);
    const SiteGeometry geometry(solid);
    const auto candidates = geometry.candidates();
    std::uniform_real_distribution<double> unit(0, 1), sign(-1, 1);
    for (int k = 0; k < 400; ++k) {
      std::vector<SiteId> site;
      for (int i = 0; i < 2 + k % 2; ++i) site.push_back(candidates[random() % candidates.size()]);
      const double size = std::pow(10.0, -7 * unit(random));
      Box3 box;
      // About points that are equally far, sites, or anywhere.
      Vector center{sign(random), sign(random), sign(random)};
      const Box3 all{{-2, -2, -2}, {2, 2, 2}};
      if (k % 4 < 2) center = on_tie(geometry, site, all, center).value_or(center);
      if (k % 4 == 3)
        for (int i = 0; i < 3; ++i) center[static_cast<std::size_t>(i)] = geometry.base(site[0])[i];
      for (int i = 0; i < 3; ++i) {
        const double c = static_cast<double>(center[static_cast<std::size_t>(i)]);
        box.lo[i] = c - size * unit(random);
        box.hi[i] = k % 8 == 1 && i == 0 ? box.lo[i] : c + size * std::round(unit(random));
      }
      check(geometry, site, box, random, figures);
    }
  }
  EXPECT_GT(figures.points, 1000u);
  EXPECT_GT(figures.of_three, 100u);
  EXPECT_GT(figures.flat, 20u);
  EXPECT_GT(figures.large, 20u);
  EXPECT_GT(figures.sharper, figures.bounds / 4);
  EXPECT_GT(figures.sharper_third, 20u);
  EXPECT_GT(figures.nowhere, 100u);
}

// About a point of the sheet of two parallel edges, in boxes that are long along them and a tenth,
// a hundredth, ... of their distance across.
TEST(TieAngle, BoundIsOfSecondOrder) {
  const Solid solid = test::solid_of(shapes::cuboid(1, 1, 1));
  const SiteGeometry geometry(solid);
  const SiteIndex& index = geometry.index();
  const auto along = [&](std::uint32_t e) { return geometry.unit(index.edge(e)); };
  std::size_t tried = 0;
  for (std::uint32_t e = 0; e < solid.edge.size(); ++e)
    for (std::uint32_t f = 0; f < e; ++f) {
      const SiteId a = index.edge(e), b = index.edge(f);
      const auto u = along(e), v = along(f);
      if (std::abs(std::abs(u[0].mid * v[0].mid + u[1].mid * v[1].mid + u[2].mid * v[2].mid) - 1) >
          1e-12)
        continue;
      // Off the plane of both by their distance: 2 atan(1 / 2) there, and the same along them.
      const Point3 p = geometry.base(a), q = geometry.base(b);
      Point3 across{q.x - p.x, q.y - p.y, q.z - p.z};
      double t = 0;
      for (int k = 0; k < 3; ++k) t += across[k] * u[k].mid;
      for (int k = 0; k < 3; ++k) across[k] -= t * u[k].mid;
      const double distance = std::hypot(across.x, across.y, across.z);
      if (!(distance > 0.1)) continue;
      const Point3 up{across.y * u[2].mid - across.z * u[1].mid,
                      across.z * u[0].mid - across.x * u[2].mid,
                      across.x * u[1].mid - across.y * u[0].mid};
      if (std::hypot(up.x, up.y, up.z) >
          1.01 * std::max({std::abs(up.x), std::abs(up.y), std::abs(up.z)}))
        continue;  // not along an axis
      ++tried;
      for (const double size : {1e-1, 1e-2, 1e-3}) {
        Box3 box;
        for (int k = 0; k < 3; ++k) {
          const double c = p[k] + 0.5 * across[k] + up[k];
          const double half = distance * (std::abs(u[k].mid) > 0.9 ? 1.0 : 0.5 * size);
          box.lo[k] = c - half;
          box.hi[k] = c + half;
        }
        // The largest angle of the box is at its side that is nearest the edges.
        const double largest = 2 * std::atan2(0.5 * distance, distance * (1 - 0.5 * size));
        const double bound = angle_on_tie_at_most(geometry, view_of(geometry, a, box),
                                                  view_of(geometry, b, box), nullptr, box);
        EXPECT_GE(bound, largest - 1e-12);
        EXPECT_LT(bound - largest, 2 * size * size);
      }
    }
  EXPECT_GT(tried, 8u);
}

}  // namespace
}  // namespace blum
