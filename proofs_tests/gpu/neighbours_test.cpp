// Borders, neighbours, their superset, and the voxel theta-SMA.
#include "blum/gpu/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "blum/gpu/theta_sma.hpp"
#include "blum/kernel/shapes.hpp"
#include "field_tools.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

using test::field_of;
using test::grid_around;
using test::RandomSoup;
using test::sites_of;

TEST(Neighbours, FullScan_FindsWhatIsThere) {
  Soup soup;
  soup.points = {{0, 0, 0}, {4, 0, 0}, {8, 0, 0}};
  soup.isolated = {0, 1, 2};
  const SiteSet sites = sites_of(soup);
  const VoxelGrid grid{{9, 2, 1}, {0, 0, 0}, {1, 1, 1}};
  const DistanceField field = field_of(sites, grid);
  EXPECT_EQ(neighbour_pairs(field), (std::vector<SitePair>{{0, 1}, {1, 2}}));
  // x = 0..2 belong to 0, 3..6 to 1 (ties at 2 and 6 go to the lower id).
  EXPECT_EQ(boundary_voxels(field), (std::vector<std::size_t>{2, 3, 6, 7, 11, 12, 15, 16}));
  const BoundaryWalk walk = walk_boundary(field, std::vector<std::size_t>{2});
  EXPECT_EQ(walk.boundary, (std::vector<std::size_t>{2, 3, 11, 12}));
  EXPECT_EQ(walk.pairs, (std::vector<SitePair>{{0, 1}}));
  EXPECT_LT(walk.visited, grid.voxels());
}

TEST(Neighbours, ContinuationFromEveryPart_IsLikeTheFullScan) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    RandomSoup random(seed);
    const SiteSet sites = sites_of(random.make(6, 3, 4));
    FieldOptions options;
    options.band = seed % 2 == 0 ? std::numeric_limits<double>::infinity() : 0.4;
    const DistanceField field = field_of(sites, grid_around(sites, {20, 18, 12}), options);
    const std::vector<std::size_t> all = boundary_voxels(field);
    // One seed a part: the first voxel not reached from those before.
    std::vector<std::size_t> seeds;
    BoundaryWalk walk;
    for (const std::size_t v : all) {
      if (std::ranges::binary_search(walk.boundary, v)) continue;
      seeds.push_back(v);
      walk = walk_boundary(field, seeds);
    }
    EXPECT_EQ(walk.boundary, all);
    EXPECT_EQ(walk.pairs, neighbour_pairs(field));
  }
}

/// Points where two regions really meet, by bisection between random points with different owners.
TEST(NeighbourSuperset, HoldsEveryTrueNeighbour) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    RandomSoup random(seed);
    const SiteSet sites = sites_of(random.make(6, 3, 4));
    const VoxelGrid grid = grid_around(sites, {6, 5, 4});  // coarse: most pairs are not sampled
    const std::vector<SitePair> superset = neighbour_superset(sites, grid, 2).value();
    EXPECT_TRUE(std::ranges::is_sorted(superset));
    const auto nearest = [&](const Point3& q) {
      std::pair<double, std::uint32_t> best = {std::numeric_limits<double>::infinity(), 0};
      for (std::uint32_t s = 0; s < sites.size(); ++s) {
        if (sites.kind({s}) == SiteKind::kVertex && !sites.is_used(s)) continue;
        best = std::min(best, {sites.squared_distance(q, {s}).hi, s});
      }
      return best.second;
    };
    std::mt19937_64 points(seed);
    std::uniform_real_distribution<double> unit(-0.5, 0.5);
    const auto any_point = [&] {
      Point3 p;
      for (int axis = 0; axis < 3; ++axis) {
        p[axis] =
            grid.origin[axis] + grid.spacing[axis] * (grid.size[axis] * (unit(points) + 0.5) - 0.5);
      }
      return p;
    };
    std::set<SitePair> seen;
    for (int n = 0; n < 400; ++n) {
      Point3 a = any_point(), b = any_point();
      std::uint32_t sa = nearest(a), sb = nearest(b);
      for (int step = 0; step < 60 && sa != sb; ++step) {
        const Point3 m = {0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0.5 * (a.z + b.z)};
        const std::uint32_t sm = nearest(m);
        (sm == sa ? a : b) = m;
        if (sm != sa) sb = sm;
      }
      if (sa != sb) seen.insert({std::min(sa, sb), std::max(sa, sb)});
    }
    EXPECT_GT(seen.size(), 10u);
    std::size_t sampled = 0;
    const std::vector<SitePair> discrete = neighbour_pairs(field_of(sites, grid));
    for (const SitePair& pair : seen) {
      EXPECT_TRUE(std::ranges::binary_search(superset, pair)) << pair[0] << " " << pair[1];
      sampled += std::ranges::binary_search(discrete, pair);
    }
    EXPECT_TRUE(std::ranges::includes(superset, discrete));
    EXPECT_LE(sampled, seen.size());
  }
}

TEST(NeighbourSuperset, LeavesOutWhatIsFar) {
  const SiteSet sites = sites_of(soup_of(shapes::plate(3, 8)));
  const auto pairs = neighbour_superset(sites, grid_around(sites, {40, 16, 10}), 1).value();
  const std::size_t all = std::size_t{sites.size()} * (sites.size() - 1) / 2;
  EXPECT_LT(pairs.size(), all / 2);
  EXPECT_FALSE(neighbour_superset(sites, VoxelGrid{}, 1).ok());
}

TEST(ThetaSma, OfASlab_IsItsMiddlePlane) {
  const PolygonMesh mesh = shapes::cuboid(8, 8, 1);
  const SiteSet sites = sites_of(soup_of(mesh));
  // Samples at z = +-1/16 from the middle: the facets between them are the middle plane.
  const VoxelGrid grid = make_grid({{-1, -1, -0.5}, {9, 9, 1.5}}, {40, 40, 16}).value();
  const DistanceField field = field_of(sites, grid);
  const FieldSides sides = sides_of(build_solid(mesh).value(), field, 1);
  const VoxelSma sma = theta_sma(sites, field, &sides, 0.9 * std::numbers::pi);
  EXPECT_FALSE(sma.facets.empty());
  std::size_t expected = 0;
  for (std::size_t v = 0; v < grid.voxels(); ++v) {
    const Point3 p = grid.point(v);
    // Below the middle, nearest to the bottom, nearer to it than to any wall.
    expected += p.z > 0.4 && p.z < 0.5 && std::min({p.x, p.y, 8 - p.x, 8 - p.y}) > 0.5;
  }
  EXPECT_EQ(sma.facets.size(), expected);
  for (const VoxelFacet& f : sma.facets) {
    EXPECT_EQ(f.axis, 2);
    EXPECT_NEAR(grid.point(f.voxel).z, 0.5 - 1.0 / 16, 1e-12);
  }
  // The sheets to the edges separate by 90 degrees: they come with a smaller theta only.
  EXPECT_GT(theta_sma(sites, field, &sides, 0.4 * std::numbers::pi).facets.size(), expected);
  // Without sides the outside is looked at too; there is no axis outside of a convex body.
  EXPECT_EQ(theta_sma(sites, field, nullptr, 0.9 * std::numbers::pi).facets, sma.facets);
}

/// The foot of a sample in long double, over all triangles; nullopt if another point is as near.
std::optional<test::LongPoint> only_foot(const PolygonMesh& mesh, const test::LongPoint& x) {
  std::vector<std::pair<long double, test::LongPoint>> all;
  for (const auto& face : mesh.faces)
    for (std::size_t k = 2; k < face.size(); ++k) {
      const test::LongPoint y = test::nearest_on_triangle(
          x, {test::wide(mesh.points[face[0]]), test::wide(mesh.points[face[k - 1]]),
              test::wide(mesh.points[face[k]])});
      const auto d = test::minus(x, y);
      all.emplace_back(std::sqrt(test::dot(d, d)), y);
    }
  const auto least = std::ranges::min(all);
  for (const auto& [d, y] : all) {
    const auto gap = test::minus(y, least.second);
    if (d < least.first + 1e-9L && test::dot(gap, gap) > 1e-12L) return std::nullopt;
  }
  return least.second;
}

TEST(ThetaSma, OfAnySolid_HasTheFacetsThatExactFeetTell) {
  for (const PolygonMesh& mesh : {shapes::lbracket(4, 3, 1, 2), shapes::planar_torus(8, 4, 2, 0.75),
                                  shapes::rotate_rounded(shapes::prism(5), 3)}) {
    const SiteSet sites = sites_of(soup_of(mesh));
    const VoxelGrid grid = grid_around(sites, {17, 19, 16}, 0.1);
    const DistanceField field = field_of(sites, grid);
    const FieldSides sides = sides_of(build_solid(mesh).value(), field, 1);
    std::vector<std::optional<test::LongPoint>> to_foot(grid.voxels());  // unit, where inside
    std::vector<bool> known(grid.voxels(), true);
    for (std::size_t v = 0; v < grid.voxels(); ++v) {
      if (sides.side[v] != FieldSide::kInside) continue;
      const auto x = test::wide(grid.point(v));
      const auto y = only_foot(mesh, x);
      known[v] = y.has_value();
      if (!y) continue;
      const auto d = test::minus(*y, x);
      const long double length = std::sqrt(test::dot(d, d));
      to_foot[v] = test::LongPoint{d[0] / length, d[1] / length, d[2] / length};
    }
    for (const double degrees : {30.0, 75.0, 120.0}) {
      const double theta = degrees * std::numbers::pi / 180;
      const VoxelSma sma = theta_sma(sites, field, &sides, theta);
      std::size_t wanted = 0, compared = 0;
      for (std::size_t v = 0; v < grid.voxels(); ++v)
        for (int axis = 0; axis < 3; ++axis) {
          const auto at = grid.position(v);
          const std::size_t step = axis == 0   ? 1
                                   : axis == 1 ? grid.size[0]
                                               : std::size_t{grid.size[0]} * grid.size[1];
          const bool has = std::ranges::find(sma.facets, VoxelFacet{v, axis}) != sma.facets.end();
          if (at[axis] + 1 == grid.size[axis]) {
            EXPECT_FALSE(has);
            continue;
          }
          if (!known[v] || !known[v + step]) continue;
          const auto &a = to_foot[v], &b = to_foot[v + step];
          if (!a || !b) {
            EXPECT_FALSE(has) << v;
            continue;
          }
          const auto k = static_cast<std::size_t>(axis);
          const long double angle = std::acos(std::clamp(test::dot(*a, *b), -1.0L, 1.0L)),
                            apart = (*b)[k] - (*a)[k];
          if (std::abs(angle - theta) < 1e-6L || std::abs(apart) < 1e-6L) continue;
          ++compared;
          wanted += angle >= theta && apart > 0;
          EXPECT_EQ(has, angle >= theta && apart > 0) << v << " axis " << axis;
        }
      EXPECT_GT(compared, 100u);
      EXPECT_TRUE(wanted > 10 || degrees > 100) << degrees;
    }
  }
}

}  // namespace
}  // namespace blum
