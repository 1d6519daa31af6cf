// Simplified axes of solids with their own angles.

#include "blum/medial/simplify.hpp"

#include <gtest/gtest.h>

#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

const std::vector<double> kAngles{0, 30, 60, 89, 91, 120, 150, 180};

MedialResult angled(const PolygonMesh& mesh) {
  AngleOptions a;
  a.wanted = true;
  a.boxes_per_leaf = 100;
  return compute_medial_axis(test::solid_of(mesh), test::seeded(1), a).value();
}

TEST(Simplify, EveryTheta_HmaKeepsTheBettiNumbersAndNests) {
  for (const auto& scene : test::scenes()) {
    if (scene.name == "torus_8_4" || scene.name.starts_with("star")) continue;
    SCOPED_TRACE(scene.name);
    const MedialResult r = angled(scene.mesh);
    std::size_t cells = r.complex.triangle.size() + 1;
    for (const ThetaRow& row : theta_table(r, kAngles)) {
      if (row.how != Simplify::kHomotopy) continue;
      EXPECT_EQ(row.betti, r.solid_betti) << row.theta_deg;
      const MedialResult part = simplified(r, row.theta_deg, row.how);
      EXPECT_LE(part.complex.triangle.size(), cells);
      cells = part.complex.triangle.size();
    }
    // Nothing has a cost below zero: the axis as it is.
    const MedialResult all = simplified(r, 0, Simplify::kHomotopy);
    EXPECT_EQ(all.complex.triangle.size(), r.complex.triangle.size());
    EXPECT_EQ(all.complex.vertex.size(), r.complex.vertex.size());
  }
}

TEST(Simplify, Table_IsTheSameAsTextAndCsv) {
  const MedialResult r = angled(shapes::cuboid(1, 1, 2));
  const std::vector<double> theta{0, 91};
  const auto rows = theta_table(r, theta);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[3].shape.curves, 1u);
  EXPECT_EQ(rows[3].shape.area, 0);
  EXPECT_NE(theta_table_csv(rows).find("\n91,hma,0,0,1,0,0,1,0,0\n"), std::string::npos);
  EXPECT_NE(theta_table_text(rows).find("    91  hma"), std::string::npos);
}

}  // namespace
}  // namespace blum
