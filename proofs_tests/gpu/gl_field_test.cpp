// OpenGL backends against the brute-force twin: proposals within the published regret. Skipped,
// with the reason, where a library, a driver or a version of OpenGL is missing.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <random>
#include <thread>

#include "blum/gpu/field.hpp"
#include "blum/kernel/shapes.hpp"
#include "gl_tools.hpp"

namespace blum {
namespace {

using test::brute_of;
using test::greatest_regret;
using test::grid_around;
using test::RandomSoup;
using test::sites_of;

constexpr std::array<FieldMethod, 4> kMethods = {FieldMethod::kFragments, FieldMethod::kGather,
                                                 FieldMethod::kDistanceMeshes,
                                                 FieldMethod::kLinearFactorization};

class GlField : public testing::TestWithParam<FieldBackend> {
 protected:
  void SetUp() override {
    const auto driver = field_driver(GetParam());
    if (!driver) GTEST_SKIP() << driver.error().message;
    const FieldDriver& d = driver.value();
    const char* asked = std::getenv("GALLIUM_DRIVER");
    if (asked != nullptr && d.renderer.find(asked) == std::string::npos) {
      GTEST_SKIP() << "asked for " << asked << ", there is " << d.renderer;
    }
    gathers_ = d.major > 4 || (d.major == 4 && d.minor >= 3);
    if (!gathers_) {
      std::cout << "no gather: it needs OpenGL 4.3, and " << d.renderer << " has " << d.version
                << '\n';
    }
  }
  void TearDown() override {
    if (!IsSkipped()) std::cout << "greatest regret: " << greatest_ << " of the bound\n";
  }

  /// The drivers differ little: one alone does it all.
  [[nodiscard]] std::uint64_t seeds(std::uint64_t n) const {
    return GetParam() == FieldBackend::kEgl ? n : 1;
  }
  template <class Body>
  void for_each_method(const Body& body) {
    for (const FieldMethod method : kMethods) {
      if (method == FieldMethod::kGather && !gathers_) continue;
      SCOPED_TRACE(field_method_name(method));
      FieldOptions o;
      o.backend = GetParam();
      o.method = method;
      body(o);
    }
  }
  void expect_within_regret(const SiteSet& sites, const VoxelGrid& grid,
                            const FieldOptions& options, const DistanceField& brute) {
    const auto field = compute_field(sites, grid, options);
    ASSERT_TRUE(field.ok()) << field.error().message;
    std::string problem;
    const double regret = greatest_regret(sites, field.value(), brute, problem);
    EXPECT_EQ(problem, "");
    EXPECT_EQ(field.value().statistics.holes, 0u);
    greatest_ = std::max(greatest_, regret / field.value().bound.regret);
  }
  void expect_all_within_regret(const SiteSet& sites, const VoxelGrid& grid) {
    const DistanceField brute = brute_of(sites, grid);
    for_each_method([&](const FieldOptions& o) { expect_within_regret(sites, grid, o, brute); });
  }

  bool gathers_ = false;
  double greatest_ = 0;  // regret, in units of the published bound
};

TEST_P(GlField, RandomSoups_StayWithinTheRegret) {
  for (std::uint64_t seed = 0; seed < seeds(6); ++seed) {
    SCOPED_TRACE(seed);
    RandomSoup random(seed);
    const int n = 1 + static_cast<int>(seed % 7);
    const SiteSet sites = sites_of(random.make(n, 2 * n, 4 * n));
    expect_all_within_regret(sites, grid_around(sites, {17, 12, 5}));
  }
}

TEST_P(GlField, SoupsOnALattice_StayWithinTheRegret) {
  for (std::uint64_t seed = 0; seed < seeds(6); ++seed) {
    SCOPED_TRACE(seed);
    RandomSoup random(seed);
    random.on_lattice = true;
    const SiteSet sites = sites_of(random.make(2, 5, 20));
    expect_all_within_regret(sites, {{13, 13, 4}, {-1.5, -1.5, -1}, {0.5, 0.5, 1.5}});
  }
}

TEST_P(GlField, Slivers_StayWithinTheRegret) {
  for (const double sliver : {1e-3, 1e-5, 1e-7, 1e-9, 1e-14}) {
    SCOPED_TRACE(sliver);
    RandomSoup random(5);
    random.sliver = sliver;
    const SiteSet sites = sites_of(random.make(0, 1, 12));
    expect_all_within_regret(sites, grid_around(sites, {11, 12, 5}));
  }
}

TEST_P(GlField, SolidsAndThinGrids_StayWithinTheRegret) {
  for (const PolygonMesh& mesh : {shapes::lpocket(), shapes::rotate_rounded(shapes::prism(7), 3)}) {
    const SiteSet sites = sites_of(soup_of(mesh));
    expect_all_within_regret(sites, grid_around(sites, {36, 35, 5}));
    expect_all_within_regret(sites, grid_around(sites, {1, 1, 1}));
    expect_all_within_regret(sites, grid_around(sites, {18, 1, 9}, -0.2));
  }
}

TEST_P(GlField, AnyScaleAndPlace_StaysWithinTheRegret) {
  for (const double scale : {0x1p-150, 1e-9, 0x1p150}) {
    RandomSoup random(7);
    Soup soup = random.make(2, 4, 8);
    for (Point3& p : soup.points) p = {scale * (p.x + 1e6), scale * (p.y - 1e6), scale * p.z};
    const SiteSet sites = sites_of(soup);
    Box3 box = sites.box();
    for (int k = 0; k < 3; ++k) box.hi[k] += scale;
    SCOPED_TRACE(scale);
    const VoxelGrid grid = make_grid(box, {10, 11, 6}).value();
    const DistanceField brute = brute_of(sites, grid);
    for_each_method([&](const FieldOptions& o) {
      const auto field = compute_field(sites, grid, o);
      ASSERT_TRUE(field.ok()) << field.error().message;
      EXPECT_EQ(test::difference(sites, field.value(), brute), "");
      EXPECT_LT(field.value().bound.regret, 4 * scale);
    });
  }
}

TEST_P(GlField, NoCulling_LosesAnOwner) {
  for (std::uint64_t seed = 0; seed < seeds(2); ++seed) {
    RandomSoup random(seed);
    const SiteSet sites = sites_of(random.make(3, 4, 8));
    const VoxelGrid grid = grid_around(sites, {37, 34, 6});
    const DistanceField brute = brute_of(sites, grid);
    for_each_method([&](FieldOptions o) {
      for (const FieldCulling& culling :
           {FieldCulling{false, false}, {true, false}, {false, true}}) {
        o.culling = culling;
        o.threads = 2;
        expect_within_regret(sites, grid, o, brute);
      }
    });
  }
}

TEST_P(GlField, ABand_KeepsWhatIsWithin) {
  const SiteSet sites = sites_of(soup_of(shapes::torus(12, 8, 2, 0.7)));
  const VoxelGrid grid = grid_around(sites, {40, 40, 6}, 0.5);
  for_each_method([&](FieldOptions o) {
    const DistanceField full = test::field_of(sites, grid, o);
    o.band = 0.31;
    const DistanceField band = test::field_of(sites, grid, o);
    std::size_t kept = 0;
    for (std::size_t v = 0; v < full.site.size(); ++v) {
      const bool is_kept = band.site[v] != kNoSite.value;
      kept += is_kept;
      if (full.distance[v] <= o.band - full.bound.regret) EXPECT_TRUE(is_kept);
      if (is_kept) {
        EXPECT_LE(band.distance[v], o.band);
        EXPECT_NEAR(band.distance[v], full.distance[v], full.bound.regret + 1e-12);
      }
    }
    EXPECT_GT(kept, 200u);
  });
}

/// llvmpipe leaves a shader's loops after 65,535 rounds: scans of 100,000 triangles came out wrong.
TEST_P(GlField, MoreSitesABlockThanRoundsOfALoop_AreAllLookedAt) {
  if (!gathers_) GTEST_SKIP() << "no gather";
  const VoxelGrid grid{{8, 8, 2}, {-0.002, -0.002, -0.0005}, {0.0005, 0.0005, 0.0005}};
  FieldOptions o;
  o.backend = GetParam();
  o.method = FieldMethod::kGather;
  // Segments on a sphere, the first of them nearer than the others, somewhere in the list.
  std::mt19937 random(11);
  std::normal_distribution<> normal;
  for (int trial = 0; trial < 4; ++trial) {
    Soup soup;
    for (std::uint32_t k = 0; k < 30'000; ++k) {
      Point3 p{normal(random), normal(random), normal(random)};
      const double scale = (k == 0 ? 0.997 : 1) / std::hypot(p.x, p.y, p.z);
      for (int j = 0; j < 3; ++j) p[j] *= scale;
      soup.points.push_back(p);
      soup.points.push_back({p.x - 0.001 * p.y, p.y + 0.001 * p.x, p.z});
      soup.segments.push_back({2 * k, 2 * k + 1});
    }
    const SiteSet sites = sites_of(soup);
    expect_within_regret(sites, grid, o, brute_of(sites, grid));
  }
}

TEST_P(GlField, SeveralContexts_WorkAtOnce) {
  const SiteSet sites = sites_of(soup_of(shapes::torus(8, 5, 2, 0.7)));
  const VoxelGrid grid = grid_around(sites, {20, 21, 6});
  FieldOptions mine;
  mine.backend = GetParam();
  const DistanceField alone = test::field_of(sites, grid, mine);
  const DistanceField brute = brute_of(sites, grid);
  std::array<DistanceField, 4> fields;
  std::vector<std::thread> threads;
  for (std::size_t n = 0; n < fields.size(); ++n) {
    threads.emplace_back([&, n] {
      FieldOptions o = mine;
      // The other library's contexts, too, where there are any.
      const FieldBackend other = test::kGlBackends[n % 2];
      if (field_driver(other).ok()) o.backend = other;
      fields[n] = test::field_of(sites, grid, o);
    });
  }
  for (std::thread& t : threads) t.join();
  for (const DistanceField& field : fields) {
    std::string problem;
    (void)greatest_regret(sites, field, brute, problem);
    EXPECT_EQ(problem, "");
    if (field.backend == GetParam()) EXPECT_EQ(field.site, alone.site);
  }
}

TEST_P(GlField, ThreadsChangeNoBit) {
  const SiteSet sites = sites_of(soup_of(shapes::torus(12, 8, 2, 0.7)));
  const VoxelGrid grid = grid_around(sites, {33, 30, 9});
  for_each_method([&](FieldOptions o) {
    const DistanceField one = test::field_of(sites, grid, o);
    o.threads = 5;
    const DistanceField more = test::field_of(sites, grid, o);
    EXPECT_EQ(one.site, more.site);
    EXPECT_EQ(one.distance, more.distance);
  });
}

// The papers' cullings, each alone, on soups that are open, intersecting and partly off the grid.
TEST_P(GlField, SweepsAndRanges_LoseNoOwner) {
  for (std::uint64_t seed = 0; seed < seeds(3); ++seed) {
    SCOPED_TRACE(seed);
    RandomSoup random(seed);
    random.on_lattice = seed % 2 == 1;
    const SiteSet sites = sites_of(random.make(2, 3, 4));
    const VoxelGrid grid = grid_around(sites, {35, 4, 10}, seed == 2 ? -0.2 : 0.25);
    const DistanceField brute = brute_of(sites, grid);
    for_each_method([&](FieldOptions o) {
      const auto method = static_cast<std::uint64_t>(o.method);
      if (o.method == FieldMethod::kGather || (seed > 0 && method % 3 != seed % 3)) return;
      for (const bool domains : {false, true}) {
        for (int kind = 0; kind < 3; ++kind) {
          SCOPED_TRACE(kind);
          o.culling = {};
          o.culling.blocks = false;
          o.culling.domains = domains;
          o.culling.sweep = kind < 2;
          o.culling.clamping = kind == 1;
          o.culling.ranges = kind == 2;
          expect_within_regret(sites, grid, o, brute);
        }
      }
    });
  }
}

// What they are for: fewer sites a slice, fewer fragments a voxel.
TEST_P(GlField, SweepsClampingAndRanges_SaveWork) {
  if (GetParam() != FieldBackend::kEgl) GTEST_SKIP() << "the same without another driver";
  const SiteSet sites = sites_of(soup_of(shapes::torus(8, 4, 2, 0.7)));
  const VoxelGrid grid = grid_around(sites, {36, 12, 12});
  FieldOptions o;
  o.backend = GetParam();
  const auto statistics = [&](bool sweep, bool clamping, bool ranges) {
    o.culling = {};
    o.culling.blocks = false;
    o.culling.domains = false;
    o.culling.sweep = sweep;
    o.culling.clamping = clamping;
    o.culling.ranges = ranges;
    return test::field_of(sites, grid, o).statistics;
  };
  const FieldStatistics all = statistics(false, false, false);
  const FieldStatistics sweep = statistics(true, false, false);
  const FieldStatistics clamped = statistics(true, true, false);
  const FieldStatistics ranges = statistics(false, false, true);
  EXPECT_GT(sweep.queries, 0u);
  EXPECT_LT(sweep.block_sites, all.block_sites);
  EXPECT_GT(culling_efficiency(sweep), culling_efficiency(all));
  EXPECT_LT(clamped.fragments, sweep.fragments);
  EXPECT_GT(clamping_efficiency(clamped, grid.voxels()), clamping_efficiency(sweep, grid.voxels()));
  EXPECT_LT(ranges.block_sites / static_cast<double>(ranges.blocks),
            static_cast<double>(all.block_sites) / static_cast<double>(all.blocks));
}

// Without blocks all sites are processed for every block, as on the CPU: so are the owners counted.
TEST_P(GlField, GatherWithoutBlocks_CountsAsTheCpu) {
  if (!gathers_) GTEST_SKIP() << "gather needs OpenGL 4.3";
  RandomSoup random(3);
  const SiteSet sites = sites_of(random.make(3, 4, 12));
  const VoxelGrid grid = grid_around(sites, {37, 34, 19});
  FieldOptions o;
  o.culling = {false, true};
  const FieldStatistics cpu = test::field_of(sites, grid, o).statistics;
  o.backend = GetParam();
  o.method = FieldMethod::kGather;
  const FieldStatistics gl = test::field_of(sites, grid, o).statistics;
  EXPECT_EQ(gl.blocks, cpu.blocks);
  EXPECT_EQ(gl.block_sites, cpu.block_sites);
  EXPECT_EQ(gl.fragments, cpu.fragments);
  // Floats may see an owner of few samples where doubles see another.
  EXPECT_NEAR(culling_efficiency(gl), culling_efficiency(cpu), 0.01 * culling_efficiency(cpu));
}

// Meshes of the least spacing's error would have cells without end.
TEST_P(GlField, SpacingsThatDifferMuch_HaveMeshesAllTheSame) {
  const SiteSet sites = sites_of(soup_of(shapes::torus(6, 4, 2, 0.7)));
  const VoxelGrid grid = {{9, 8, 3}, {-2.9, -2.8, 0.1}, {0.7, 0.7, 1e-12}};
  const DistanceField brute = brute_of(sites, grid);
  FieldOptions o;
  o.backend = GetParam();
  o.method = FieldMethod::kDistanceMeshes;
  expect_within_regret(sites, grid, o, brute);
}

INSTANTIATE_TEST_SUITE_P(Drivers, GlField, testing::ValuesIn(test::kGlBackends),
                         [](const auto& driver) {
                           return std::string(field_backend_name(driver.param));
                         });

TEST(FieldBackend, Names_AreKnownAndGlOptionsChecked) {
  const SiteSet sites = sites_of(soup_of(shapes::cuboid(1, 1, 1)));
  const VoxelGrid grid = grid_around(sites, {4, 4, 4});
  FieldOptions o;
  o.culling.sweep = true;
  EXPECT_EQ(compute_field(sites, grid, o).error().code, ErrorCode::kBadArgument);  // the CPU's
  o.backend = FieldBackend::kEgl;
  EXPECT_EQ(compute_field(sites, grid, o).error().code, ErrorCode::kBadArgument);  // and blocks
  o.culling = {};
  o.mesh_error = 0;
  EXPECT_EQ(compute_field(sites, grid, o).error().code, ErrorCode::kBadArgument);
  for (const double bad :
       {-1.0, 1e-40, 1e-37, 0.999e-3, 1.001e3, std::numeric_limits<double>::infinity(),
        std::numeric_limits<double>::quiet_NaN()}) {
    o.mesh_error = bad;
    EXPECT_NE(options_problem(o), "") << bad;
  }
  for (const double good : {1e-3, 0.5, 1e3}) {
    o.mesh_error = good;
    EXPECT_EQ(options_problem(o), "") << good;
  }
  EXPECT_FALSE(field_driver(FieldBackend::kCpu).ok());
  const BackendChoice choice = choose_backend();
  EXPECT_TRUE(choice.backend == FieldBackend::kCpu || choice.backend == FieldBackend::kEgl);
  EXPECT_NE(choice.reason, "");
  const auto egl = field_driver(FieldBackend::kEgl);
  EXPECT_EQ(choice.backend == FieldBackend::kEgl, egl.ok() && egl.value().is_hardware);
}

}  // namespace
}  // namespace blum
