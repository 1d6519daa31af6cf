// The predicates against rational arithmetic written here anew: on random points, on degenerate
// points, and one step beside those; every stage is reached.
#include "blum/kernel/predicates.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>

#include "arrangement/cube_minus_octant.hpp"
#include "blum/kernel/closest_point.hpp"
#include "blum/kernel/inside.hpp"
#include "blum/kernel/shapes.hpp"
#include "kernel/turn_by_quaternion.hpp"

namespace blum {
namespace {

using Random = std::mt19937_64;
using Q = mpq_class;
using Vector = std::array<Q, 3>;

Vector exact(const Point3& p) { return {Q(p.x), Q(p.y), Q(p.z)}; }
Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Q dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// A solid and the same predicates in rationals, straight from theory section 1.
struct Truth {
  Solid solid;
  SiteGeometry geometry;
  SiteIndex index;

  explicit Truth(const PolygonMesh& mesh)
      : solid(build_solid(mesh).value()), geometry(solid), index(solid) {}
  Truth(const Truth&) = delete;

  Vector point(std::uint32_t v) const { return exact(solid.point[v]); }
  std::vector<std::uint32_t> corners(SiteId s) const {
    const auto i = index.element(s);
    switch (index.kind(s)) {
      case SiteKind::kVertex:
        return {i};
      case SiteKind::kEdge:
        return {solid.edge[i].vertex[0], solid.edge[i].vertex[1]};
      case SiteKind::kFace:
        break;
    }
    const auto& v = solid.triangle[i].vertex;
    return {v[0], v[1], v[2]};
  }
  Vector normal(std::uint32_t t) const {
    const auto& v = solid.triangle[t].vertex;
    return cross(point(v[1]) - point(v[0]), point(v[2]) - point(v[0]));
  }
  /// Squared distance to the carrier.
  Q carrier(const Vector& x, SiteId s) const {
    const auto c = corners(s);
    const Vector d = x - point(c[0]);
    if (c.size() == 1) return dot(d, d);
    if (c.size() == 2) {
      const Vector u = point(c[1]) - point(c[0]);
      return dot(d, d) - dot(d, u) * dot(d, u) / dot(u, u);
    }
    const Vector n = normal(index.element(s));
    return dot(d, n) * dot(d, n) / dot(n, n);
  }
  /// Squared distance to the closed site, by projecting on it and on its border.
  Q distance(const Vector& x, const std::vector<Vector>& c) const {
    const Vector d = x - c[0];
    if (c.size() == 1) return dot(d, d);
    if (c.size() == 2) {
      const Vector u = c[1] - c[0];
      Q f = dot(d, u) / dot(u, u);
      f = f < 0 ? Q(0) : f > 1 ? Q(1) : f;
      const Vector w{d[0] - f * u[0], d[1] - f * u[1], d[2] - f * u[2]};
      return dot(w, w);
    }
    const Vector n = cross(c[1] - c[0], c[2] - c[0]);
    bool in = true;
    for (std::size_t k = 0; k < 3; ++k)
      in = in && dot(cross(c[(k + 1) % 3] - c[k], x - c[k]), n) >= 0;
    if (in) return dot(d, n) * dot(d, n) / dot(n, n);
    Q best = distance(x, {c[0], c[1]});
    for (const Q& q : {distance(x, {c[1], c[2]}), distance(x, {c[2], c[0]})})
      if (q < best) best = q;
    return best;
  }
  Q distance(const Vector& x, SiteId s) const {
    std::vector<Vector> c;
    for (const auto v : corners(s)) c.push_back(point(v));
    return distance(x, c);
  }
  /// Squared distance to the whole boundary.
  Q distance(const Vector& x) const {
    Q best = -1;
    for (std::uint32_t t = 0; t < solid.triangle.size(); ++t) {
      const Q d = distance(x, index.face(t));
      if (best < 0 || d < best) best = d;
    }
    return best;
  }
  bool in_domain(const Vector& x, SiteId s) const {
    const auto i = index.element(s);
    const auto c = corners(s);
    if (c.size() == 1) {
      for (const auto e : solid.edges_at(i)) {
        const auto [a, b] = solid.edge[e].vertex;
        if (dot(x - point(i), point(a == i ? b : a) - point(i)) > 0) return false;
      }
      return true;
    }
    if (c.size() == 2) {
      const Vector u = point(c[1]) - point(c[0]);
      if (dot(x - point(c[0]), u) < 0 || dot(x - point(c[1]), u) > 0) return false;
      for (const auto t : solid.edge[i].triangle) {
        Vector into;
        for (const auto v : solid.triangle[t].vertex)
          if (v != c[0] && v != c[1]) into = point(v) - point(c[0]);
        const Q f = dot(into, u) / dot(u, u);
        for (std::size_t k = 0; k < 3; ++k) into[k] -= f * u[k];
        if (dot(x - point(c[0]), into) > 0) return false;
      }
      return true;
    }
    const Vector n = normal(i);
    if (dot(x - point(c[0]), n) > 0) return false;
    for (std::size_t k = 0; k < 3; ++k)
      if (dot(cross(point(c[(k + 1) % 3]) - point(c[k]), x - point(c[k])), n) < 0) return false;
    return true;
  }
  bool redundant(SiteId a, SiteId b) const {  // the smaller lies in the other's carrier
    if (a == b) return true;
    auto ca = corners(a), cb = corners(b);
    if (ca.size() > cb.size()) std::swap(ca, cb);
    for (const auto v : ca) {
      const Vector d = point(v) - point(cb[0]);
      if (cb.size() == 1) return false;
      const Vector u = point(cb[1]) - point(cb[0]);
      if (cb.size() == 2) {
        const Vector w = cross(d, u);
        if (w[0] != 0 || w[1] != 0 || w[2] != 0) return false;
      } else if (dot(d, cross(u, point(cb[2]) - point(cb[0]))) != 0) {
        return false;
      }
    }
    return true;
  }
};

std::vector<PolygonMesh> meshes() {
  return {shapes::cuboid(4, 2, 2),
          shapes::lbracket(),
          shapes::lpocket(),
          test::cube_minus_octant(),
          shapes::triangulate_facets(shapes::split_edges(shapes::lpocket(), 3), 4),
          shapes::torus(5, 4, 2, 1),
          shapes::rotate_rounded(shapes::lpocket(), 5),
          shapes::rotate_rounded(test::cube_minus_octant(), 6)};
}

/// Random, or built from vertices (then on many planes, walls and bisectors), or a step beside.
Point3 sample(Random& random, const Solid& solid) {
  Point3 x;
  const auto vertex = [&]() -> const Point3& { return solid.point[random() % solid.point.size()]; };
  const std::uint64_t mode = random() % 4;
  const Point3 a = vertex(), b = vertex(), c = vertex(), d = vertex();
  for (int k = 0; k < 3; ++k) switch (mode) {
      case 0:
        x[k] = std::uniform_real_distribution(-0.6, 0.6)(random);
        break;
      case 1:
        x[k] = a[k] / 2 + b[k] / 2;
        break;
      case 2:
        x[k] = (a[k] + b[k]) / 4 + (c[k] + d[k]) / 4;
        break;
      default:
        x[k] = vertex()[k] / 2 + vertex()[k] / 2;
        break;
    }
  const int k = static_cast<int>(random() % 3);
  switch (random() % 6) {
    case 0:
      x[k] = std::nextafter(x[k], 2);
      break;
    case 1:
      x[k] = std::nextafter(x[k], -2);
      break;
    case 2:
      x[k] += 1e-12;
      break;
    default:
      break;
  }
  return x;
}

TEST(Predicates, DistancesDomainsAndPlanes_AgreeWithRationals) {
  Random random(1);
  StageCounts stages;
  int zeros = 0, walls = 0;
  for (const PolygonMesh& mesh : meshes()) {
    const Truth truth(mesh);
    Predicates p(truth.geometry);
    const auto sites = truth.geometry.candidates();
    for (int n = 0; n < 1500; ++n) {
      const Point3 y = sample(random, truth.solid);
      const Vector x = exact(y);
      const SiteId a = sites[random() % sites.size()], b = sites[random() % sites.size()];
      const int s = cmp(truth.carrier(x, a), truth.carrier(x, b));
      const int sign = s > 0 ? 1 : s < 0 ? -1 : 0;
      EXPECT_EQ(p.compare_distance(y, a, b), sign);
      EXPECT_EQ(p.compare_distance(y, b, a), -sign);
      zeros += sign == 0 && a != b;
      EXPECT_EQ(p.in_domain(y, a), truth.in_domain(x, a));
      const auto t = static_cast<std::uint32_t>(random() % truth.solid.triangle.size());
      const int side =
          sgn(dot(truth.normal(t), x - truth.point(truth.solid.triangle[t].vertex[0])));
      EXPECT_EQ(p.plane_side(y, t), side);
      walls += side == 0;
    }
    stages += p.stages();
  }
  EXPECT_GT(zeros, 100);
  EXPECT_GT(walls, 100);
  EXPECT_GT(stages.filter, 1000u);
  EXPECT_GT(stages.extended, 10u);
  EXPECT_GT(stages.exact, 10u);
}

TEST(Predicates, Governors_AreTheNearestOfAllCandidates) {
  Random random(2);
  int several = 0, inside_points = 0;
  for (const PolygonMesh& mesh : meshes()) {
    const Truth truth(mesh);
    Predicates p(truth.geometry);
    const InsideOracle inside(truth.solid);
    std::vector<SiteId> found;
    for (int n = 0; n < 150; ++n) {
      const Point3 y = sample(random, truth.solid);
      const Vector x = exact(y);
      p.governors(y, truth.geometry.candidates(), found);
      std::vector<SiteId> expected;
      Q best = -1;
      for (const SiteId s : truth.geometry.candidates()) {
        if (!truth.in_domain(x, s)) continue;
        const Q d = truth.carrier(x, s);
        if (best < 0 || d < best) {
          best = d;
          expected.clear();
        }
        if (d == best) expected.push_back(s);
      }
      EXPECT_EQ(found, expected);
      several += found.size() > 1;
      if (inside.locate(y) != InsideOracle::Where::kInside) continue;
      // The rules for candidates lose nothing: the distance is that to all closed triangles.
      ++inside_points;
      ASSERT_FALSE(found.empty());
      EXPECT_TRUE(best == truth.distance(x));
    }
  }
  EXPECT_GT(several, 100);
  EXPECT_GT(inside_points, 300);
}

TEST(Predicates, RedundantAndNeverEssential_FollowTheirDefinitions) {
  Random random(3);
  int redundant = 0, never_only = 0, common = 0;
  for (const PolygonMesh& mesh : meshes()) {
    const Truth truth(mesh);
    Predicates p(truth.geometry);
    const auto sites = truth.geometry.candidates();
    const InsideOracle inside(truth.solid);
    for (const SiteId a : sites)
      for (const SiteId b : sites) {
        const bool r = truth.redundant(a, b), n = p.never_essential(a, b);
        EXPECT_EQ(p.redundant(a, b), r);
        EXPECT_EQ(n, p.never_essential(b, a));
        if (r) {
          EXPECT_TRUE(n);
        }
        redundant += r && a != b;
        never_only += n && !r;
      }
    // Where two such sites govern, their feet are equal: no other point of theirs is as near.
    std::vector<SiteId> governors;
    for (int k = 0; k < 1500; ++k) {
      const Point3 y = sample(random, truth.solid);
      if (inside.locate(y) != InsideOracle::Where::kInside) continue;
      p.governors(y, sites, governors);
      const Vector x = exact(y);
      const auto foot = [&](SiteId s) {
        const auto c = truth.corners(s);
        Vector f = truth.point(c[0]);
        const Vector d = x - f;
        if (c.size() == 2) {
          const Vector u = truth.point(c[1]) - f;
          const Q q = dot(d, u) / dot(u, u);
          for (std::size_t i = 0; i < 3; ++i) f[i] += q * u[i];
        } else if (c.size() == 3) {
          const Vector n = truth.normal(truth.index.element(s));
          const Q q = dot(d, n) / dot(n, n);
          for (std::size_t i = 0; i < 3; ++i) f[i] = x[i] - q * n[i];
        }
        return f;
      };
      for (const SiteId a : governors)
        for (const SiteId b : governors)
          if (a < b && p.never_essential(a, b)) {
            ++common;
            EXPECT_TRUE(foot(a) == foot(b));
          }
    }
  }
  EXPECT_GT(redundant, 100);
  EXPECT_GT(never_only, 10);
  EXPECT_GT(common, 100);
}

/// Two generic lines through each solid: which triangles they pierce, and in which order.
TEST(Predicates, PiercingAndCrossings_AgreeWithRationals) {
  Random random(4);
  int pierced = 0, borders = 0, edges = 0, edge_zeros = 0;
  for (const PolygonMesh& mesh : meshes()) {
    const Truth truth(mesh);
    Predicates p(truth.geometry);
    const Solid& solid = truth.solid;
    for (int n = 0; n < 60; ++n) {
      const int axis = static_cast<int>(random() % 3), ua = u_axis(axis), va = v_axis(axis);
      const Point3 y = sample(random, solid);
      const auto at = [&](int k) { return static_cast<std::size_t>(k); };
      std::vector<std::pair<Q, std::uint32_t>> crossing;
      for (std::uint32_t t = 0; t < solid.triangle.size(); ++t) {
        // Where the line meets the plane, and whether that lies strictly inside the triangle.
        const auto& v = solid.triangle[t].vertex;
        const Vector normal = truth.normal(t);
        const auto answer = p.pierces(t, axis, y[ua], y[va]);
        if (normal[at(axis)] == 0) {
          EXPECT_TRUE(!answer || *answer == 0);
          continue;
        }
        Vector x = exact(y);
        x[at(axis)] -= dot(normal, x - truth.point(v[0])) / normal[at(axis)];
        bool strictly = true, closed = true;
        for (std::size_t k = 0; k < 3; ++k) {
          const int s =
              sgn(dot(cross(truth.point(v[(k + 1) % 3]) - truth.point(v[k]), x - truth.point(v[k])),
                      normal));
          strictly = strictly && s > 0;
          closed = closed && s >= 0;
        }
        if (strictly) {
          ASSERT_TRUE(answer.has_value());
          EXPECT_EQ(*answer, sgn(normal[at(axis)]));
          crossing.emplace_back(x[at(axis)], t);
          ++pierced;
        } else if (closed) {
          EXPECT_FALSE(answer.has_value());
          ++borders;
        } else {
          EXPECT_EQ(answer, 0);
        }
      }
      for (const auto& [qa, a] : crossing)
        for (const auto& [qb, b] : crossing) {
          const int s = qa < qb ? -1 : qa > qb ? 1 : 0;
          EXPECT_EQ(p.compare_crossing(a, b, axis, y[ua], y[va]), s);
        }
      for (std::uint32_t e = 0; e < solid.edge.size(); ++e) {
        const Vector a = truth.point(solid.edge[e].vertex[0]),
                     b = truth.point(solid.edge[e].vertex[1]);
        const Q level(y[axis]);
        if (cmp(a[at(axis)], level) * cmp(b[at(axis)], level) >= 0) continue;
        const Q f = (level - a[at(axis)]) / (b[at(axis)] - a[at(axis)]);
        for (const int along : {ua, va}) {
          const Q x = a[at(along)] + f * (b[at(along)] - a[at(along)]);
          for (const double value : {y[along], x.get_d(), std::nextafter(x.get_d(), 9)}) {
            const int s = cmp(x, Q(value));
            EXPECT_EQ(p.compare_edge_crossing(e, axis, y[axis], along, value), s > 0   ? 1
                                                                               : s < 0 ? -1
                                                                                       : 0);
            ++edges;
            edge_zeros += s == 0;
          }
        }
      }
    }
  }
  EXPECT_GT(pierced, 300);
  EXPECT_GT(borders, 20);
  EXPECT_GT(edges, 1000);
  EXPECT_GT(edge_zeros, 50);
}

TEST(Predicates, RimsAgreeWithRationals) {
  Random random(5);
  int common = 0, compared = 0, parallel = 0;
  for (const PolygonMesh& mesh : meshes()) {
    const Truth truth(mesh);
    Predicates p(truth.geometry);
    const Solid& solid = truth.solid;
    const auto way = [&](std::uint32_t e) {
      return truth.point(solid.edge[e].vertex[1]) - truth.point(solid.edge[e].vertex[0]);
    };
    for (std::uint32_t v = 0; v < solid.point.size(); ++v)
      for (const auto a : solid.edges_at(v))
        for (const auto b : solid.edges_at(v)) {
          if (a == b) continue;
          const Vector r = cross(way(a), way(b));
          for (const SiteId s : truth.geometry.candidates()) {
            // The site projects v + t r to v for all t: v is its corner and r is normal to it.
            const auto c = truth.corners(s);
            bool expected = std::find(c.begin(), c.end(), v) != c.end();
            for (const auto k : c)
              expected = expected && dot(truth.point(k) - truth.point(v), r) == 0;
            if (r == Vector{} && c.size() == 3) continue;  // no direction: not a rim
            const SiteId one[] = {s};
            EXPECT_EQ(p.rim_common(v, a, b, one), expected);
            common += expected;
          }
          const int axis = static_cast<int>(random() % 3), along = u_axis(axis);
          const double level = sample(random, solid)[axis];
          const auto m = static_cast<std::size_t>(axis), l = static_cast<std::size_t>(along);
          if (r[m] == 0) {
            EXPECT_FALSE(p.compare_rim(v, a, b, axis, level, along, 0).has_value());
            ++parallel;
            continue;
          }
          const Q x = truth.point(v)[l] + (Q(level) - truth.point(v)[m]) / r[m] * r[l];
          for (const double value : {x.get_d(), std::nextafter(x.get_d(), 9), 0.25}) {
            const int s = cmp(x, Q(value));
            EXPECT_EQ(p.compare_rim(v, a, b, axis, level, along, value), s > 0   ? 1
                                                                         : s < 0 ? -1
                                                                                 : 0);
            ++compared;
          }
        }
  }
  EXPECT_GT(common, 100);
  EXPECT_GT(compared, 300);
  EXPECT_GT(parallel, 50);
}

TEST(Predicates, UnitDifference_EnclosesTheDifferenceWithSmallError) {
  int near = 0, equal = 0;
  for (const PolygonMesh& mesh : meshes()) {
    const Truth truth(mesh);
    Predicates p(truth.geometry);
    const auto faces = static_cast<std::uint32_t>(truth.solid.triangle.size());
    const auto unit = [&](std::uint32_t t, std::size_t k) {
      const Vector n = truth.normal(t);
      mpf_class squared(dot(n, n), 600), x(n[k], 600);
      return mpf_class(x / sqrt(squared));
    };
    for (std::uint32_t a = 0; a < faces; ++a)
      for (std::uint32_t b = 0; b < faces; ++b) {
        const BallVector d = p.unit_difference(truth.index.face(a), truth.index.face(b));
        const Vector na = truth.normal(a), nb = truth.normal(b), w = cross(na, nb);
        const bool same = w == Vector{} && dot(na, nb) > 0;
        double length = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          const mpf_class exact = unit(a, k) - unit(b, k);
          const mpf_class error = abs(exact - mpf_class(d[k].mid, 600));
          EXPECT_TRUE(error <= mpf_class(d[k].rad, 600) + 1e-150);
          length += exact.get_d() * exact.get_d();
          if (same) {
            EXPECT_TRUE(d[k].mid == 0 && d[k].rad == 0);
          }
        }
        equal += same && a != b;
        length = std::sqrt(length);
        if (same) continue;
        near += length < 1e-12;
        for (std::size_t k = 0; k < 3; ++k) EXPECT_LE(d[k].rad, 1e-9 * length);
      }
  }
  EXPECT_GT(equal, 20);
  EXPECT_GT(near, 2);
}

TEST(Predicates, Height_EnclosesTheExactOneHoweverNearThePlane) {
  int near = 0, on_plane = 0;
  for (const PolygonMesh& mesh : meshes()) {
    const Truth truth(mesh);
    Predicates p(truth.geometry);
    for (std::uint32_t t = 0; t < truth.solid.triangle.size(); ++t)
      for (std::uint32_t v = 0; v < truth.solid.point.size(); ++v) {
        const Ball height = p.height(v, t);
        const Vector n = truth.normal(t);
        const Q product = dot(n, truth.point(v) - truth.point(truth.solid.triangle[t].vertex[0]));
        const mpf_class exact = mpf_class(product, 600) / sqrt(mpf_class(dot(n, n), 600));
        EXPECT_TRUE(abs(exact - mpf_class(height.mid, 600)) <= mpf_class(height.rad, 600) + 1e-150);
        on_plane += product == 0;
        if (product == 0)
          EXPECT_TRUE(height.mid == 0 && height.rad == 0);
        else
          EXPECT_LE(height.rad, 1e-9 * std::abs(height.mid));
        near += product != 0 && abs(exact) < 1e-12;
      }
  }
  EXPECT_GT(on_plane, 20);
  EXPECT_GT(near, 2);
}

TEST(Predicates, SquaredDifference_EnclosesTheExactOneToManyDigits) {
  Random random(17);
  int near = 0;
  for (const PolygonMesh& mesh : meshes()) {
    const Truth truth(mesh);
    Predicates p(truth.geometry);
    const auto candidates = truth.geometry.candidates();
    std::uniform_real_distribution<double> coordinate(-1, 1);
    for (int k = 0; k < 40; ++k) {
      const Point3 x{coordinate(random), coordinate(random), coordinate(random)};
      const SiteId a = candidates[random() % candidates.size()],
                   b = candidates[random() % candidates.size()];
      const Vector y = exact(x);
      const Q truly = truth.carrier(y, a) - truth.carrier(y, b);
      const Ball d = p.squared_difference(x, a, b);
      EXPECT_TRUE(abs(truly - Q(d.mid)) <= Q(d.rad));
      EXPECT_LE(d.rad, 1e-15 * std::abs(d.mid) + 1e-25);
      near += truly != 0 && abs(truly) < Q(1e-12);
    }
  }
  EXPECT_GT(near, 0);
}

TEST(Predicates, CarrierDifference_EnclosesTheExactOneWhereCarriersNearlyAgree) {
  // Facets with holes, turned and rounded: rows of slivers, whose edges are parallel to 1e-16.
  std::vector<PolygonMesh> all = meshes();
  all.push_back(test::turn_by_quaternion(shapes::plate(3, 6), {5, 1, -2, 2}));
  Random random(18);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  int parallel = 0;
  for (const PolygonMesh& mesh : all) {
    const Truth truth(mesh);
    Predicates p(truth.geometry);
    const auto candidates = truth.geometry.candidates();
    const auto check = [&](SiteId a, SiteId b) {
      const Predicates::CarrierDifference d = p.carrier_difference(a, b);
      const Point3 x{coordinate(random), coordinate(random), coordinate(random)};
      const Vector at = exact(x), y = at - exact(d.origin);
      const int row[] = {0, 1, 2, 0, 1, 2}, column[] = {0, 1, 2, 1, 2, 0};
      Q middle(d.value.mid), radius(d.value.rad), size = abs(Q(d.value.mid));
      for (std::size_t k = 0; k < 3; ++k) {
        middle += 2 * Q(d.linear[k].mid) * y[k];
        radius += 2 * Q(d.linear[k].rad) * abs(y[k]);
        size += abs(Q(d.linear[k].mid));
      }
      for (std::size_t k = 0; k < 6; ++k) {
        const Q yy = y[row[k]] * y[column[k]] * (k < 3 ? 1 : 2);
        middle += Q(d.matrix[k].mid) * yy;
        radius += Q(d.matrix[k].rad) * abs(yy);
        size += abs(Q(d.matrix[k].mid));
      }
      const Q off = truth.carrier(at, a) - truth.carrier(at, b) - middle;
      EXPECT_TRUE(abs(off) <= radius);
      EXPECT_TRUE(radius <= size * Q(1e-13) + Q(1e-30));
      return size;
    };
    for (int k = 0; k < 40; ++k)
      check(candidates[random() % candidates.size()], candidates[random() % candidates.size()]);
    for (const SiteId a : candidates)
      for (const SiteId b : candidates) {
        if (truth.index.kind(a) != SiteKind::kEdge || truth.index.kind(b) != SiteKind::kEdge ||
            !(a < b))
          continue;
        const BallVector w = cross(truth.geometry.unit(a), truth.geometry.unit(b));
        if (dot(w, w).mid > 1e-24) continue;
        const Q size = check(a, b);
        parallel += size != 0 && size < Q(1e-14);
      }
  }
  EXPECT_GT(parallel, 2);
}

TEST(Predicates, Ties_ReachTheExactStageAndTheirNeighboursDoNot) {
  const Truth truth(shapes::rotate_rounded(shapes::cuboid(4, 3, 2), 7));
  const Truth square(shapes::cuboid(4, 2, 2));
  Predicates p(square.geometry);
  // The axis of a square section: four walls tie exactly.
  const Solid& s = square.solid;
  Point3 lo = s.point[0], hi = lo;
  for (const Point3& q : s.point)
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], q[k]);
      hi[k] = std::max(hi[k], q[k]);
    }
  const Point3 c{0.3 * lo.x + 0.7 * hi.x, (lo.y + hi.y) / 2, (lo.z + hi.z) / 2};
  std::vector<SiteId> governors;
  p.governors(c, square.geometry.candidates(), governors);
  EXPECT_GE(governors.size(), 4u);
  for (const double e : {0x1p-52, 1e-12, 1e-6}) {
    p.governors({c.x, c.y + e, c.z}, square.geometry.candidates(), governors);
    EXPECT_GE(governors.size(), 1u);
    EXPECT_LE(governors.size(), 2u);  // one wall: two triangles at most
  }
}

}  // namespace
}  // namespace blum
