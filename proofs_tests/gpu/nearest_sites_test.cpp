// The k nearest primitives, against all of them, sorted; and voxel images.
#include "blum/gpu/nearest_sites.hpp"

#include <gtest/gtest.h>

#include "blum/gpu/feature_transform.hpp"
#include "field_tools.hpp"

namespace blum {
namespace {

using test::RandomSoup;
using test::sites_of;

NearestSites nearest_of(const SiteSet& sites, const VoxelGrid& grid, std::uint32_t order,
                        const FieldOptions& options = {}) {
  return nearest_sites(sites, grid, order, options).value();
}

TEST(NearestSites, CulledSearch_IsLikeBruteForce) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    for (const std::uint32_t order : {1u, 2u, 5u}) {
      SCOPED_TRACE(testing::Message() << seed << " order " << order);
      RandomSoup random(seed);
      random.on_lattice = seed % 2 == 1;
      const SiteSet sites = sites_of(random.make(4, 8, 20));
      const VoxelGrid grid = test::grid_around(sites, {19, 10, 9});
      FieldOptions brute;
      brute.backend = FieldBackend::kBrute;
      const NearestSites expected = nearest_of(sites, grid, order, brute);
      const NearestSites found = nearest_of(sites, grid, order);
      EXPECT_EQ(found.site, expected.site);
      EXPECT_EQ(found.distance, expected.distance);
      brute.threads = 3;
      EXPECT_EQ(nearest_of(sites, grid, order, brute).site, expected.site);
    }
  }
}

TEST(NearestSites, FirstOne_IsTheField) {
  RandomSoup random(3);
  const SiteSet sites = sites_of(random.make(3, 3, 30));
  const VoxelGrid grid = test::grid_around(sites, {16, 16, 16});
  const NearestSites two = nearest_of(sites, grid, 2);
  const DistanceField field = test::field_of(sites, grid);
  for (std::size_t v = 0; v < grid.voxels(); ++v) {
    EXPECT_NEAR(two.distance[2 * v], field.distance[v],
                two.bound.below + field.bound.below + 1e-15 * field.distance[v]);
    EXPECT_LE(two.distance[2 * v], two.distance[2 * v + 1]);
  }
}

TEST(NearestSites, FewerPrimitivesThanAsked_OrABand_LeavesGaps) {
  Soup soup;
  soup.points = {{0, 0, 0}, {4, 0, 0}};
  soup.isolated = {0, 1};
  const SiteSet sites = sites_of(soup);
  const VoxelGrid grid{{3, 1, 1}, {0, 0, 0}, {1, 1, 1}};
  const NearestSites three = nearest_of(sites, grid, 3);
  EXPECT_EQ(three.site[0], 0u);
  EXPECT_EQ(three.site[1], 1u);
  EXPECT_EQ(three.site[2], kNoSite.value);
  EXPECT_EQ(three.site[6], 0u) << "a tie: the lower number first";
  EXPECT_EQ(three.site[7], 1u);
  FieldOptions options;
  options.band = 1.5;
  EXPECT_EQ(nearest_of(sites, grid, 2, options).site,
            (std::vector<std::uint32_t>{0, kNoSite.value, 0, kNoSite.value, kNoSite.value,
                                        kNoSite.value}));
  EXPECT_FALSE(nearest_sites(sites, grid, 0, {}).ok());
  EXPECT_FALSE(nearest_sites(sites, grid, 65, {}).ok());
}

TEST(FeatureTransform, RandomImages_AreLikeBruteForce) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const auto below = [&](std::uint32_t n) {
      return std::uniform_int_distribution<std::uint32_t>(0, n - 1)(random);
    };
    VoxelGrid grid;
    grid.size = {1 + below(14), 1 + below(12), 1 + below(10)};
    // Unit voxels give many ties; others are anisotropic.
    grid.spacing = seed % 2 == 0 ? Point3{1, 1, 1} : Point3{0.3, 1.7, 0.9};
    std::vector<std::uint8_t> image(grid.voxels(), 0);
    const std::uint32_t features = 1 + below(seed % 3 == 0 ? 3 : 40);
    for (std::uint32_t n = 0; n < features; ++n) image[below(image.size())] = 1;
    const FeatureTransform out = feature_transform(grid, image, 2).value();
    for (std::size_t v = 0; v < image.size(); ++v) {
      std::size_t best = 0;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t f = 0; f < image.size(); ++f) {
        if (image[f] == 0) continue;
        double sum = 0;
        for (int axis = 0; axis < 3; ++axis) {
          const double d = (static_cast<double>(grid.position(f)[axis]) - grid.position(v)[axis]) *
                           grid.spacing[axis];
          sum += d * d;
        }
        if (sum < least) {
          least = sum;
          best = f;
        }
      }
      EXPECT_EQ(out.feature[v], best);
      EXPECT_NEAR(out.distance[v], std::sqrt(least), 0x1p-50 * std::sqrt(least));
    }
    EXPECT_EQ(feature_transform(grid, image, 1).value().feature, out.feature);
  }
}

TEST(FeatureTransform, BadInput_IsRefused) {
  const VoxelGrid grid{{2, 2, 2}, {0, 0, 0}, {1, 1, 1}};
  EXPECT_FALSE(feature_transform(grid, std::vector<std::uint8_t>(8, 0), 1).ok());
  EXPECT_FALSE(feature_transform(grid, std::vector<std::uint8_t>(7, 1), 1).ok());
  EXPECT_FALSE(feature_transform(grid, std::vector<std::uint8_t>(8, 1), 0).ok());
  EXPECT_FALSE(feature_transform(VoxelGrid{}, {}, 1).ok());
  // Whose squares are not what they should be.
  const VoxelGrid tiny{{2, 2, 2}, {0, 0, 0}, {1, 1e-200, 1}};
  EXPECT_FALSE(feature_transform(tiny, std::vector<std::uint8_t>(8, 1), 1).ok());
}

TEST(FeatureTransform, Stopped_IsAnError) {
  const VoxelGrid grid{{3, 4, 5}, {0, 0, 0}, {1, 1, 1}};
  const std::vector<std::uint8_t> image(60, 1);
  double last = 0;
  const auto all = feature_transform(grid, image, 1, [&](double part) {
    EXPECT_GT(part, last);
    last = part;
    return true;
  });
  EXPECT_TRUE(all.ok());
  EXPECT_EQ(last, 1);
  const auto none = feature_transform(grid, image, 2, [](double) { return false; });
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().code, ErrorCode::kInterrupted);
}

TEST(FeatureTransform, AllSetOrOne_IsPlain) {
  const VoxelGrid grid{{4, 3, 2}, {1, 2, 3}, {0.5, 2, 0.25}};
  const FeatureTransform all = feature_transform(grid, std::vector<std::uint8_t>(24, 7), 1).value();
  std::vector<std::uint8_t> image(24, 0);
  image[23] = 1;
  const FeatureTransform one = feature_transform(grid, image, 1).value();
  for (std::size_t v = 0; v < 24; ++v) {
    EXPECT_EQ(all.feature[v], v);
    EXPECT_EQ(all.distance[v], 0);
    EXPECT_EQ(one.feature[v], 23u);
  }
  EXPECT_EQ(one.distance[0], std::sqrt(1.5 * 1.5 + 4 * 4 + 0.25 * 0.25));
}

}  // namespace
}  // namespace blum
