// The papers' cullings on larger soups, grids and all methods: CTest label sweep.
#include <gtest/gtest.h>

#include "gl_tools.hpp"

namespace blum {
namespace {

TEST(SweepGlField, SweepsAndRanges_LoseNoOwner) {
  if (const auto driver = field_driver(FieldBackend::kEgl); !driver) {
    GTEST_SKIP() << driver.error().message;
  }
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    test::RandomSoup random(seed);
    random.on_lattice = seed % 2 == 1;
    random.sliver = seed % 5 == 4 ? 1e-4 : 0;
    const SiteSet sites = test::sites_of(random.make(4, 6, 14));
    const VoxelGrid grid = test::grid_around(sites, {35, 9, 17}, seed % 3 == 2 ? -0.2 : 0.25);
    const DistanceField brute = test::brute_of(sites, grid);
    for (const FieldMethod method : {FieldMethod::kFragments, FieldMethod::kDistanceMeshes,
                                     FieldMethod::kLinearFactorization}) {
      for (int kind = 0; kind < 6; ++kind) {
        SCOPED_TRACE(testing::Message() << seed << ' ' << field_method_name(method) << ' ' << kind);
        FieldOptions o;
        o.backend = FieldBackend::kEgl;
        o.method = method;
        o.culling = {false, kind % 2 == 0, kind < 4, kind == 2 || kind == 3, kind >= 4};
        const auto field = compute_field(sites, grid, o);
        ASSERT_TRUE(field.ok()) << field.error().message;
        std::string problem;
        (void)test::greatest_regret(sites, field.value(), brute, problem);
        EXPECT_EQ(problem, "");
        EXPECT_EQ(field.value().statistics.holes, 0u);
      }
    }
  }
}

}  // namespace
}  // namespace blum
