// Which part counts points of the axis inside a leaf that no arc on its surface shows.

#include "angle_box.hpp"

#include <gtest/gtest.h>

#include "blum/medial/medial_axis.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

TEST(SeamCountsPair, TwoOfItsGroupsThatNoArcParts) {
  LeafParts leaf;
  leaf.arc = {{1, 2, 0}, {2, 4, 1}, {1, 8, 2}, {4, 8, 3}};
  const AngleRole seam{AngleRole::Kind::kSeam, 15, 0, true};
  EXPECT_TRUE(seam_counts_pair(leaf, seam, 1, 4));
  EXPECT_TRUE(seam_counts_pair(leaf, seam, 4, 1));
  EXPECT_TRUE(seam_counts_pair(leaf, seam, 2, 8));
  EXPECT_FALSE(seam_counts_pair(leaf, seam, 1, 2)) << "an arc's";
  EXPECT_FALSE(seam_counts_pair(leaf, seam, 2, 1)) << "an arc's";
  EXPECT_FALSE(seam_counts_pair(leaf, seam, 1, 1)) << "one group";
  EXPECT_FALSE(seam_counts_pair(leaf, seam, 1, 16)) << "not around the seam";
  EXPECT_FALSE(seam_counts_pair(leaf, seam, 1, 12)) << "one of two";
  leaf.arc.push_back({1, 6, 4});
  EXPECT_FALSE(seam_counts_pair(leaf, seam, 1, 4)) << "perhaps an arc's";
  leaf.arc.pop_back();
  EXPECT_FALSE(seam_counts_pair(leaf, {AngleRole::Kind::kSeam, 15, 0, false}, 1, 4));
  EXPECT_FALSE(seam_counts_pair(leaf, {AngleRole::Kind::kRest, 15, 0, true}, 1, 4));
}

// Sheets between reflex edges inside a leaf are the largest of their seams: without a witness on
// them the three seams were up to 5 degrees wide.
TEST(SeamCountsPair, SheetsInsideALeaf_HaveALowerBound) {
  AngleOptions a;
  a.wanted = true;
  const auto r = compute_medial_axis(test::solid_of(shapes::torus(8, 4, 2, 0.75)), test::seeded(1), a);
  ASSERT_TRUE(r && r.value().certified);
  EXPECT_EQ(r.value().angles->wide, 0u);
}

}  // namespace
}  // namespace blum
