// Grids: samples as exact points, and what is refused.
#include "blum/gpu/grid.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace blum {
namespace {

TEST(VoxelGrid, FillsItsBox_WithAnyResolutionPerAxis) {
  const auto grid = make_grid({{-1, 0, 2}, {3, 3, 2.5}}, {8, 3, 1});
  ASSERT_TRUE(grid.ok());
  EXPECT_EQ(grid.value().spacing, (Point3{0.5, 1, 0.5}));
  EXPECT_EQ(grid.value().point(0, 0, 0), (Point3{-0.75, 0.5, 2.25}));
  EXPECT_EQ(grid.value().point(7, 2, 0), (Point3{2.75, 2.5, 2.25}));
  EXPECT_EQ(grid.value().voxels(), 24u);
}

TEST(VoxelGrid, IndexAndPosition_AreInverse) {
  const VoxelGrid grid = make_grid({{0, 0, 0}, {1, 1, 1}}, {5, 3, 4}).value();
  std::size_t next = 0;
  for (std::uint32_t k = 0; k < 4; ++k)
    for (std::uint32_t j = 0; j < 3; ++j)
      for (std::uint32_t i = 0; i < 5; ++i, ++next) {
        EXPECT_EQ(grid.index(i, j, k), next);
        EXPECT_EQ(grid.position(next), (std::array<std::uint32_t, 3>{i, j, k}));
      }
}

TEST(VoxelGrid, BadInput_IsRefusedWithAReason) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Box3 unit = {{0, 0, 0}, {1, 1, 1}};
  for (const auto& result :
       {make_grid(unit, {0, 1, 1}), make_grid(unit, {1, (1u << 20) + 1, 1}),
        make_grid({{0, 0, 0}, {1, 0, 1}}, {2, 2, 2}), make_grid({{0, 0, 2}, {1, 1, 1}}, {2, 2, 2}),
        make_grid({{kNan, 0, 0}, {1, 1, 1}}, {2, 2, 2}),
        make_grid({{0, 0, 0}, {0x1p201, 1, 1}}, {2, 2, 2}),
        make_grid({{1, 0, 0}, {1 + 0x1p-50, 1, 1}}, {100, 2, 2})}) {
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::kBadArgument);
    EXPECT_NE(result.error().message, "");
  }
}

}  // namespace
}  // namespace blum
