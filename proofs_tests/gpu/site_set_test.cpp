// Soups to sites: ids, edges, degenerate parts, errors.
#include "blum/gpu/site_set.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace blum {
namespace {

Soup two_triangles() {
  Soup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {9, 9, 9}};
  soup.polygons = {{0, 1, 2}, {2, 3, 0}};
  return soup;
}

TEST(SiteSet, Edges_AreCountedOnceInOrderOfAppearance) {
  Soup soup = two_triangles();
  soup.segments = {{3, 0}, {1, 0}};
  const auto set = SiteSet::build(soup);
  ASSERT_TRUE(set.ok());
  const auto edges = set.value().edges();
  ASSERT_EQ(edges.size(), 5u);
  EXPECT_EQ(edges[0], (std::array<std::uint32_t, 2>{3, 0}));
  EXPECT_EQ(edges[2], (std::array<std::uint32_t, 2>{1, 2}));
  EXPECT_EQ(set.value().size(), 5u + 5 + 2);
  EXPECT_EQ(set.value().kind({4}), SiteKind::kVertex);
  EXPECT_EQ(set.value().kind({5}), SiteKind::kEdge);
  EXPECT_EQ(set.value().kind({10}), SiteKind::kFace);
  EXPECT_EQ(set.value().element({11}), 1u);
  EXPECT_FALSE(set.value().is_used(4));
  EXPECT_EQ(set.value().box().hi, (Point3{1, 1, 0}));
}

TEST(SiteSet, Polygons_AreOneSiteWithoutTheirDiagonals) {
  Soup soup;
  soup.points = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}};  // not convex
  soup.polygons = {{0, 1, 2, 3, 4}};
  const auto set = SiteSet::build(soup);
  ASSERT_TRUE(set.ok());
  EXPECT_EQ(set.value().edges().size(), 5u);
  EXPECT_EQ(set.value().triangles().size(), 3u);
  EXPECT_EQ(set.value().diagonals().size(), 2u);
  const SiteId face = set.value().polygon(0);
  EXPECT_NEAR(set.value().squared_distance({1, 1, 3}, face).hi, 9, 1e-12);
  EXPECT_GT(set.value().squared_distance({2, 3, 0}, face).lo, 0.5) << "in the notch";
}

TEST(SiteSet, PartsWithoutArea_AreTheirSides) {
  Soup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}};
  soup.polygons = {{0, 1, 2}, {0, 1, 3}};
  soup.segments = {{0, 3}, {2, 2}};
  const auto set = SiteSet::build(soup);
  ASSERT_TRUE(set.ok());
  EXPECT_EQ(set.value().triangles().size(), 0u);
  EXPECT_EQ(set.value().edges().size(), 4u);  // 0 1, 1 2, 2 0, 1 3
  EXPECT_EQ(set.value().squared_distance({0, 1, 0}, set.value().polygon(0)).lo,
            std::numeric_limits<double>::infinity());
}

TEST(SiteSet, BadInput_IsRefusedWithItsElement) {
  const auto code = [](const Soup& soup) {
    const auto set = SiteSet::build(soup);
    return set.ok() ? std::string("none") : std::string(error_code_name(set.error().code));
  };
  EXPECT_EQ(code({}), error_code_name(ErrorCode::kNoFaces));
  Soup soup = two_triangles();
  soup.polygons.push_back({0, 1, 7});
  EXPECT_EQ(code(soup), error_code_name(ErrorCode::kIndexOutOfRange));
  EXPECT_EQ(SiteSet::build(soup).error().element, std::optional<std::size_t>(2));
  soup = two_triangles();
  soup.polygons[0] = {0, 1};
  EXPECT_EQ(code(soup), error_code_name(ErrorCode::kBadArgument));
  soup.polygons[0] = {0, 2, 1, 3};  // a bow tie
  EXPECT_EQ(code(soup), error_code_name(ErrorCode::kBadArgument));
  soup = two_triangles();
  soup.points[4].y = std::nan("");
  EXPECT_EQ(code(soup), error_code_name(ErrorCode::kNonFiniteCoordinate));
  soup.points[4].y = 0x1p201;
  EXPECT_EQ(code(soup), error_code_name(ErrorCode::kCoordinateOutOfRange));
  soup = two_triangles();
  soup.segments = {{0, 5}};
  EXPECT_EQ(code(soup), error_code_name(ErrorCode::kIndexOutOfRange));
  soup = two_triangles();
  soup.isolated = {5};
  EXPECT_EQ(code(soup), error_code_name(ErrorCode::kIndexOutOfRange));
}

}  // namespace
}  // namespace blum
