// Thickness and middle surfaces of solids whose walls are known.

#include "blum/thickness/thickness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "blum/thickness/midsurface.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

MedialResult axis_of(const Solid& solid, double most_leaf = 0) {
  MedialOptions options = test::seeded(1);
  options.max_leaf_diameter = most_leaf;
  AngleOptions angles;
  angles.wanted = true;
  return compute_medial_axis(solid, options, angles).value();
}

ThicknessOptions dense(double density, double theta = 60) {
  ThicknessOptions options;
  options.density = density;
  options.theta_deg = theta;
  return options;
}

/// A profile in the xy plane, counter-clockwise, from z = 0 to depth.
PolygonMesh extruded(const std::vector<std::array<double, 2>>& profile, double depth) {
  PolygonMesh mesh;
  const auto n = static_cast<std::uint32_t>(profile.size());
  for (const double z : {0.0, depth}) {
    for (const auto& [x, y] : profile) mesh.points.push_back({x, y, z});
  }
  std::vector<std::uint32_t> top, bottom;
  for (std::uint32_t i = 0; i < n; ++i) {
    top.push_back(n + i);
    bottom.push_back(n - 1 - i);
    mesh.faces.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
  }
  mesh.faces.push_back(top);
  mesh.faces.push_back(bottom);
  return mesh;
}

PolygonMesh tee() {  // flange 8 x 1, web 1 x 4 below it
  return extruded({{3.5, 0}, {4.5, 0}, {4.5, 4}, {8, 4}, {8, 5}, {0, 5}, {0, 4}, {3.5, 4}}, 6);
}

TEST(Thickness, Box_IsTheClosedForm) {
  const Solid solid = test::solid_of(shapes::cuboid(4, 3, 1));
  const MedialResult axis = axis_of(solid);
  const Thickness t = measure_thickness(solid, axis, dense(20)).value();
  EXPECT_NEAR(static_cast<double>(t.sample.size()), 20 * 38, 100);
  double area = 0;
  const Point3 hi{4, 3, 1};
  for (const ThicknessSample& s : t.sample) {
    area += s.area;
    double exact = 1e9;
    for (int k = 0; k < 3; ++k) {
      const bool is_face = s.position[k] < 1e-12 || s.position[k] > hi[k] - 1e-12;
      exact = std::min(exact, is_face ? hi[k] : 2 * std::min(s.position[k], hi[k] - s.position[k]));
    }
    EXPECT_NEAR(s.thickness, exact, s.error + 1e-14);
    EXPECT_LT(s.error, 1e-10);
    EXPECT_TRUE(s.counts);
  }
  EXPECT_NEAR(area, 38, 1e-9);
}

/// At 100 degrees only the sheet between the large faces is left: the wall is 1 thick.
TEST(Thickness, ThetaAboveTheEdges_OnlyTheWallCounts) {
  const Solid solid = test::solid_of(shapes::cuboid(4, 3, 1));
  const Thickness t = measure_thickness(solid, axis_of(solid), dense(20, 100)).value();
  std::size_t counted = 0;
  for (const ThicknessSample& s : t.sample) {
    if (!s.counts) continue;
    ++counted;
    EXPECT_NEAR(s.thickness, 1, s.error + 1e-14);
    EXPECT_NEAR(s.angle_deg, 180, 1e-5);
  }
  EXPECT_GT(counted, t.sample.size() / 4);
  EXPECT_LT(counted, t.sample.size());
  const ThicknessHistogram bars = histogram(t, 10);
  EXPECT_NEAR(bars.bin_width, 0.1, 1e-9);
  // 3 x 2 on both sides, less the parts that the borders of parts cut.
  EXPECT_NEAR(bars.area.back(), 12, 1);
  for (std::size_t i = 0; i + 1 < bars.area.size(); ++i) EXPECT_EQ(bars.area[i], 0);
}

TEST(Thickness, RefinedAxis_AllCentresAreOnKnownSheetsOfTheirAngle) {
  for (const PolygonMesh& mesh : {shapes::lbracket(), tee()}) {
    const Solid solid = test::solid_of(mesh);
    const MedialResult axis = axis_of(solid, 0.7);
    const Thickness t = measure_thickness(solid, axis, dense(10)).value();
    EXPECT_LE(t.unknown_sheets, t.sample.size() / 200);
    // The angle at the centre is at most that of its sheet.
    for (const ThicknessSample& s : t.sample) {
      if (s.sheet < 0) continue;
      EXPECT_LE(s.angle_deg, axis.angles->sheet[static_cast<std::size_t>(s.sheet)].hi + 1e-6);
    }
  }
}

TEST(Thickness, AnyNumberOfThreads_EqualSamples) {
  const Solid solid = test::solid_of(shapes::plate(1, 6));
  const MedialResult axis = axis_of(solid);
  ThicknessOptions options = dense(40);
  const Thickness one = measure_thickness(solid, axis, options).value();
  options.threads = 3;
  const Thickness three = measure_thickness(solid, axis, options).value();
  ASSERT_EQ(one.sample.size(), three.sample.size());
  for (std::size_t i = 0; i < one.sample.size(); ++i) {
    EXPECT_EQ(one.sample[i].thickness, three.sample[i].thickness);
    EXPECT_EQ(one.sample[i].position, three.sample[i].position);
  }
  options.seed = 2;
  EXPECT_NE(measure_thickness(solid, axis, options).value().sample[0].position,
            one.sample[0].position);
}

TEST(Thickness, BadDensity_Refused) {
  const Solid solid = test::solid_of(shapes::cuboid(4, 3, 1));
  const MedialResult axis = axis_of(solid);
  for (const double density : {0.0, -1.0, 1e9, std::nan("")}) {
    EXPECT_FALSE(measure_thickness(solid, axis, dense(density)).ok());
  }
}

TEST(Midsurface, Box_IsTheMiddleRectangle) {
  const Solid solid = test::solid_of(shapes::cuboid(4, 3, 1));
  const Midsurface m = midsurface(axis_of(solid), {});
  EXPECT_EQ(m.sheets, 1u);
  EXPECT_EQ(m.junction_lines, 0u);
  EXPECT_NEAR(m.most, 1, 1e-9);
}

/// Flange left, flange right and web meet along one line of edges; the walls are 1 thick.
TEST(Midsurface, TProfile_ThreeSheetsMeet) {
  const Solid solid = test::solid_of(tee());
  const MedialResult axis = axis_of(solid, 0.7);
  ASSERT_TRUE(axis.certified);
  const Midsurface m = midsurface(axis, {});
  EXPECT_GT(m.junction_lines, 0u);
  double junction = 0;
  for (std::size_t i = 0; i < m.line.size(); ++i) {
    if (m.line_sheets[i] < 3) continue;
    const Point3 &a = m.point[m.line[i][0]], &b = m.point[m.line[i][1]];
    junction += std::abs(a.z - b.z);
    // Equally far from the top and both inner corners: y = 4.375.
    EXPECT_NEAR(a.x, 4, 0.75);
    EXPECT_NEAR(a.y, 4.375, 0.75);
  }
  EXPECT_GT(junction, 3);
  EXPECT_GE(m.most, 1.25 - 0.1);
  // Both flanges and the web: 7 + 3.5 long or so, 5 wide.
  EXPECT_NEAR(m.area, 10.4 * 5, 8);
}

TEST(Midsurface, MostThickness_LeavesThickSheetsOut) {
  const Solid solid = test::solid_of(shapes::cuboid(4, 3, 1));
  MidsurfaceOptions options;
  options.most_thickness = 0.9;
  EXPECT_EQ(midsurface(axis_of(solid), options).sheets, 0u);
  options.most_thickness = 1.1;
  EXPECT_EQ(midsurface(axis_of(solid), options).sheets, 1u);
}

}  // namespace
}  // namespace blum
