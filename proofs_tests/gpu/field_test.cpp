// The CPU backend against its brute-force twin, and what must not change a field.
#include "blum/gpu/field.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "blum/kernel/shapes.hpp"
#include "field_tools.hpp"

namespace blum {
namespace {

using test::brute_of;
using test::difference;
using test::field_of;
using test::grid_around;
using test::RandomSoup;
using test::sites_of;

void expect_like_brute(const Soup& soup, std::array<std::uint32_t, 3> size, double border = 0.25) {
  const SiteSet sites = sites_of(soup);
  const VoxelGrid grid = grid_around(sites, size, border);
  EXPECT_EQ(difference(sites, field_of(sites, grid), brute_of(sites, grid)), "");
}

TEST(DistanceField, RandomSoups_AreLikeBruteForce) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    RandomSoup random(seed);
    const int n = 1 + static_cast<int>(seed % 7);
    expect_like_brute(random.make(n, 2 * n, 4 * n), {17, 12, 9});
  }
}

TEST(DistanceField, SoupsOnALattice_AreLikeBruteForce) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    RandomSoup random(seed);
    random.on_lattice = true;
    const SiteSet sites = sites_of(random.make(2, 5, 20));
    // Samples on the lattice too: on sites, on borders of domains, on bisectors.
    const VoxelGrid grid{{13, 13, 13}, {-1.5, -1.5, -1.5}, {0.5, 0.5, 0.5}};
    EXPECT_EQ(difference(sites, field_of(sites, grid), brute_of(sites, grid)), "");
  }
}

TEST(DistanceField, Slivers_AreLikeBruteForce) {
  for (const double sliver : {1e-3, 1e-6, 1e-9, 1e-12, 1e-14, 1e-16}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      SCOPED_TRACE(testing::Message() << sliver << " " << seed);
      RandomSoup random(seed);
      random.sliver = sliver;
      expect_like_brute(random.make(0, 1, 12), {11, 12, 13});
    }
  }
}

TEST(DistanceField, SingleSitesAndThinGrids_AreLikeBruteForce) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    RandomSoup random(seed);
    expect_like_brute(random.make(seed % 3 == 0, seed % 3 == 1, seed % 3 == 2), {9, 1, 16});
    expect_like_brute(random.make(1, 1, 1), {1, 1, 1});
    expect_like_brute(random.make(1, 1, 1), {1, 40, 1}, 5);
  }
}

TEST(DistanceField, FarFromTheOriginAndAnyScale_IsLikeBruteForce) {
  for (const double scale : {0x1p-190, 1e-9, 1e12, 0x1p170}) {
    for (const double shift : {0.0, 1e6}) {
      SCOPED_TRACE(testing::Message() << scale << " " << shift);
      RandomSoup random(7);
      Soup soup = random.make(2, 4, 12);
      for (Point3& p : soup.points) {
        p = {scale * (p.x + shift), scale * (p.y - shift), scale * p.z};
      }
      const SiteSet sites = sites_of(soup);
      Box3 box = sites.box();
      for (int k = 0; k < 3; ++k) {
        box.lo[k] -= scale;
        box.hi[k] += scale;
      }
      const VoxelGrid grid = make_grid(box, {10, 11, 12}).value();
      const DistanceField field = field_of(sites, grid);
      EXPECT_EQ(difference(sites, field, brute_of(sites, grid)), "");
      EXPECT_LT(field.bound.below, scale * 1e-11);
    }
  }
}

TEST(DistanceField, Solids_AreLikeBruteForce) {
  for (const PolygonMesh& mesh :
       {shapes::cuboid(1, 2, 3), shapes::lpocket(), shapes::plate(1, 6),
        shapes::torus(8, 5, 2, 0.7), shapes::rotate_rounded(shapes::prism(7), 3),
        shapes::nested_voids(2)}) {
    expect_like_brute(soup_of(mesh), {21, 22, 23});
    expect_like_brute(soup_of(mesh), {18, 9, 17}, -0.2);  // a part of the inside alone
  }
}

TEST(DistanceField, AGridFarFromAllSites_IsLikeBruteForce) {
  const SiteSet sites = sites_of(soup_of(shapes::torus(8, 5, 2, 0.7)));
  const VoxelGrid grid = make_grid({{50, 20, -3}, {53, 23, 3}}, {12, 12, 12}).value();
  EXPECT_EQ(difference(sites, field_of(sites, grid), brute_of(sites, grid)), "");
}

TEST(DistanceField, AVertexOwnsItsCone_AnEdgeItsWedge) {
  const SiteSet sites = sites_of(soup_of(shapes::cuboid(2, 2, 2)));
  const VoxelGrid grid = make_grid({{-2, -2, -2}, {4, 4, 4}}, {6, 6, 6}).value();
  const DistanceField field = field_of(sites, grid);
  EXPECT_EQ(sites.kind(field.site_at(grid.index(0, 0, 0))), SiteKind::kVertex);
  EXPECT_EQ(sites.kind(field.site_at(grid.index(2, 0, 0))), SiteKind::kEdge);
  EXPECT_EQ(sites.kind(field.site_at(grid.index(2, 2, 0))), SiteKind::kFace);
  EXPECT_DOUBLE_EQ(field.distance[grid.index(0, 0, 0)], std::sqrt(3 * 1.5 * 1.5));
  EXPECT_EQ(foot_at(sites, field, grid.index(2, 2, 0)), (Point3{0.5, 0.5, 0}));
}

TEST(DistanceField, TiesGoToTheLowestId) {
  Soup soup;
  soup.points = {{0, 0, 0}, {2, 0, 0}, {0, 0, 0}, {1, 1, 0}};
  soup.isolated = {3, 2, 1, 0};
  const SiteSet sites = sites_of(soup);
  const VoxelGrid grid{{3, 1, 1}, {-1, 0, 0}, {1, 1, 1}};  // x = -1, 0, 1
  const DistanceField field = field_of(sites, grid);
  EXPECT_EQ(field.site, (std::vector<std::uint32_t>{0, 0, 0}));
  EXPECT_EQ(brute_of(sites, grid).site, field.site);
}

// Of the sites whose bounds overlap the lowest id owns, nearest or not.
TEST(DistanceField, TheTwin_SaysByHowMuchItsOwnersMayMiss) {
  test::RandomSoup random(11);
  const SiteSet sites = sites_of(random.make(2, 4, 9));
  const VoxelGrid grid = grid_around(sites, {9, 8, 7});
  const DistanceField brute = brute_of(sites, grid);
  EXPECT_GT(brute.bound.regret, 0);
  EXPECT_EQ(brute.bound.regret, brute.bound.below + brute.bound.above);
  for (std::size_t v = 0; v < brute.site.size(); ++v) {
    const Point3 q = grid.point(v);
    double nearest = std::numeric_limits<double>::infinity();
    for (std::uint32_t s = 0; s < sites.size(); ++s) {
      if (sites.is_site({s})) {
        nearest = std::min(nearest, std::sqrt(sites.squared_distance(q, {s}).lo));
      }
    }
    const double own = std::sqrt(sites.squared_distance(q, brute.site_at(v)).hi);
    EXPECT_LE(own, nearest + brute.bound.regret + brute.bound.relative * own);
  }
}

TEST(DistanceField, Threads_ChangeNoBit) {
  const SiteSet sites = sites_of(soup_of(shapes::torus(24, 12, 2, 0.7)));
  const VoxelGrid grid = grid_around(sites, {70, 65, 33});
  FieldOptions options;
  const DistanceField one = field_of(sites, grid, options);
  for (const int threads : {2, 3, 8}) {
    options.threads = threads;
    const DistanceField more = field_of(sites, grid, options);
    EXPECT_EQ(more.site, one.site);
    EXPECT_EQ(more.distance, one.distance);
    EXPECT_EQ(more.statistics.fragments, one.statistics.fragments);
  }
}

TEST(DistanceField, NoCulling_RemovesAnOwner) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    RandomSoup random(seed);
    random.on_lattice = seed % 2 == 0;
    const SiteSet sites = sites_of(random.make(3, 6, 30));
    const VoxelGrid grid = grid_around(sites, {33, 20, 17});
    FieldOptions options;
    options.culling = {false, false};
    const DistanceField plain = field_of(sites, grid, options);
    for (const FieldCulling culling : {FieldCulling{true, false}, {false, true}, {true, true}}) {
      options.culling = culling;
      const DistanceField culled = field_of(sites, grid, options);
      if (!culling.domains) {
        EXPECT_EQ(culled.site, plain.site);
        EXPECT_EQ(culled.distance, plain.distance);
      } else {
        // Equally near sites may be culled where another one stays: the distance is the same.
        EXPECT_EQ(difference(sites, culled, plain), "");
      }
      EXPECT_LE(culled.statistics.block_sites, plain.statistics.block_sites);
    }
  }
}

TEST(DistanceField, ABand_KeepsWhatIsWithin) {
  const SiteSet sites = sites_of(soup_of(shapes::torus(12, 8, 2, 0.7)));
  const VoxelGrid grid = grid_around(sites, {40, 40, 24}, 0.5);
  const DistanceField full = field_of(sites, grid);
  FieldOptions options;
  options.band = 0.31;
  const DistanceField band = field_of(sites, grid, options);
  std::size_t kept = 0;
  for (std::size_t v = 0; v < full.site.size(); ++v) {
    if (full.distance[v] <= options.band) {
      ++kept;
      EXPECT_EQ(band.site[v], full.site[v]);
      EXPECT_EQ(band.distance[v], full.distance[v]);
    } else {
      EXPECT_EQ(band.site[v], kNoSite.value);
      EXPECT_EQ(band.distance[v], std::numeric_limits<double>::infinity());
      EXPECT_LE(band.interval(v).lo, full.interval(v).hi);
    }
  }
  EXPECT_GT(kept, 1000u);
  EXPECT_LT(band.statistics.fragments, full.statistics.fragments);
  EXPECT_EQ(band.statistics.blocks, full.statistics.blocks) << "blocks without sites count, too";
}

TEST(DistanceField, BadOptions_AreRefused) {
  const SiteSet sites = sites_of(soup_of(shapes::cuboid(1, 1, 1)));
  const VoxelGrid grid = grid_around(sites, {4, 4, 4});
  FieldOptions options;
  options.band = -1;
  EXPECT_EQ(compute_field(sites, grid, options).error().code, ErrorCode::kBadArgument);
  options.band = std::nan("");
  EXPECT_EQ(compute_field(sites, grid, options).error().code, ErrorCode::kBadArgument);
  options = {};
  options.threads = 0;
  EXPECT_EQ(compute_field(sites, grid, options).error().code, ErrorCode::kBadArgument);
  EXPECT_EQ(compute_field(sites, VoxelGrid{}, {}).error().code, ErrorCode::kBadArgument);
  options = {};
  options.on_progress = [](double) { return false; };
  EXPECT_EQ(compute_field(sites, grid, options).error().code, ErrorCode::kInterrupted);
}

// Exact comparison: at how many samples is the owner's polygon, exactly, not the nearest one?
TEST(DistanceField, Owners_AreExactlyNearestUpToTheBound) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    RandomSoup random(seed);
    random.shares_points = false;
    const Soup soup = random.make(0, 0, 40);
    const SiteSet sites = sites_of(soup);
    const VoxelGrid grid = grid_around(sites, {12, 12, 12});
    const DistanceField field = field_of(sites, grid);
    std::size_t exact_ties = 0;
    for (std::size_t v = 0; v < field.site.size(); ++v) {
      const Point3 q = grid.point(v);
      const auto corners = [&](std::size_t f) {
        const auto& t = sites.triangles()[f].point;
        return std::array<Point3, 3>{sites.points()[t[0]], sites.points()[t[1]],
                                     sites.points()[t[2]]};
      };
      std::size_t best = 0;
      for (std::size_t f = 1; f < sites.triangles().size(); ++f) {
        if (compare_distance_to_triangles(q, corners(f), corners(best)) < 0) best = f;
      }
      // The exact nearest triangle's distance lies in the interval, and some triangle at exactly
      // that distance holds the owner.
      const SquaredDistanceBounds d = squared_distance_to_triangle(q, corners(best));
      EXPECT_GE(std::sqrt(d.hi), field.interval(v).lo);
      EXPECT_LE(std::sqrt(d.lo), field.interval(v).hi);
      bool is_owner_exact = false;
      for (std::size_t f = 0; f < sites.triangles().size(); ++f) {
        const auto& t = sites.triangles()[f].point;
        const SiteId owner = field.site_at(v);
        const auto has = [&](std::uint32_t p) { return t[0] == p || t[1] == p || t[2] == p; };
        const std::uint32_t e = sites.element(owner);
        const bool holds = sites.kind(owner) == SiteKind::kVertex ? has(e)
                           : sites.kind(owner) == SiteKind::kEdge
                               ? has(sites.edges()[e][0]) && has(sites.edges()[e][1])
                               : sites.triangles()[f].polygon == e;
        is_owner_exact |= holds && compare_distance_to_triangles(q, corners(f), corners(best)) == 0;
      }
      exact_ties += !is_owner_exact;
    }
    EXPECT_EQ(exact_ties, 0u) << "samples in general position: no near ties";
  }
}

}  // namespace
}  // namespace blum
