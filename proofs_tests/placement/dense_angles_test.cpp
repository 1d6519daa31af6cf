// Bounds of separation angles against all points of fine meshes of sheets and seams: no point is
// above the upper bound, and some point comes up to the lower one.

#include <gtest/gtest.h>

#include <numbers>

#include "placement/placement_tools.hpp"

namespace blum {
namespace {

/// The points of the boundary that are as far as the nearest, to 1e-9: how many that are not one,
/// and the widest angle, in degrees, between directions to them.
struct Feet {
  std::size_t count = 0;
  double angle = -1;
};
Feet feet_at(const Solid& solid, const std::vector<Point3>& points, const Point3& q) {
  const auto all = test::feet_on_all(solid, points, q);
  long double least = all.front().distance;
  for (const auto& f : all) least = std::min(least, f.distance);
  const auto apart = [](const test::LongPoint& a, const test::LongPoint& b) {
    return std::sqrt(test::dot(test::minus(a, b), test::minus(a, b)));
  };
  std::vector<test::LongPoint> near;
  long double chord = 0;
  for (const auto& f : all) {
    if (f.distance > least * (1 + 1e-9L)) continue;
    bool is_new = true;
    for (const auto& other : near) {
      is_new = is_new && apart(f.foot, other) > 1e-4L * least;
      chord = std::max(chord, apart(f.foot, other));
    }
    if (is_new) near.push_back(f.foot);
  }
  const long double half = std::asin(std::min(1.0L, chord / (2 * least)));
  return {near.size(), static_cast<double>(2 * half) * 180 / std::numbers::pi};
}

struct Seen {
  double most = -1;
  std::size_t points = 0;
};

struct Tally {
  std::size_t points = 0, sheets = 0, seams = 0, tight = 0;
};

void look(const PolygonMesh& model, double edge, Tally& tally) {
  const Solid solid = test::solid_of(model);
  const auto points = test::model_points(solid);
  AxisPlacement placement(solid, {0.04 * test::extent(points), edge * test::extent(points)});
  AngleOptions options;
  options.wanted = true;
  const Result<MedialResult> run =
      compute_medial_axis(solid, test::seeded(1), options, {}, placement.review());
  ASSERT_TRUE(run);
  const PartAngles& angles = *run.value().angles;
  const MedialResult drawn = placement.realized(run.value());
  const CellComplex& mesh = drawn.complex;
  std::vector<bool> on_seam(mesh.vertex.size(), false);
  std::vector<Feet> feet(mesh.vertex.size());
  for (std::size_t v = 0; v < mesh.vertex.size(); ++v)
    if (mesh.vertex[v].on_axis && mesh.vertex[v].radius > 0)
      feet[v] = feet_at(solid, points, mesh.vertex[v].position);
  std::vector<Seen> sheet(angles.sheet.size()), seam(angles.seam.size());
  const auto take = [&](Seen& seen, std::uint32_t v) {
    seen.most = std::max(seen.most, feet[v].angle);
    seen.points += feet[v].count > 0 ? 1 : 0;
  };
  for (std::size_t e = 0; e < mesh.edge.size(); ++e)
    if (const auto s = drawn.parts.edge_seam[e]; s != Parts::kNoSeam)
      for (const auto v : mesh.edge[e].vertex) {
        on_seam[v] = true;
        // Its ends may be junctions, which have angles of their own.
        if (mesh.vertex[v].kind == ComplexVertex::Kind::kMesh) take(seam[s], v);
      }
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t)
    for (const auto v : corners(mesh, mesh.triangle[t]))
      // A triangle of a sheet may be flat on its seam, or end at a junction.
      if (!on_seam[v] && feet[v].count == 2) take(sheet[drawn.parts.triangle_sheet[t]], v);
  const auto judge = [&](const std::vector<Seen>& seen, const std::vector<AngleInterval>& bounds,
                         std::size_t& parts, const char* what) {
    for (std::size_t k = 0; k < seen.size(); ++k) {
      if (seen[k].points < 4) continue;
      ++parts;
      tally.points += seen[k].points;
      tally.tight += bounds[k].width() < 1 ? 1 : 0;
      EXPECT_LE(seen[k].most, bounds[k].hi + 1e-3) << what << k;
      // The widest place is between the points, or at the end, where angles grow fastest.
      EXPECT_GE(seen[k].most, bounds[k].lo - 10) << what << k;
    }
  };
  judge(sheet, angles.sheet, tally.sheets, "sheet ");
  judge(seam, angles.seam, tally.seams, "seam ");
}

PolygonMesh sheared(PolygonMesh m, double x_by_y, double x_by_z) {
  for (Point3& p : m.points) p.x += x_by_y * p.y + x_by_z * p.z;
  return m;
}

TEST(DenseAngles, PointsOfFineMeshes_ReachTheLowerBoundsAndNeverPassTheUpper) {
  Tally tally;
  look(shapes::cuboid(1, 1.25, 2), 0.05, tally);
  look(sheared(shapes::lbracket(), 0, 0.5), 0.04, tally);
  EXPECT_GT(tally.points, 5000u);
  EXPECT_GT(tally.sheets, 20u);
  EXPECT_GT(tally.seams, 10u);
  EXPECT_GT(tally.tight, 20u);
}

TEST(SweepDenseAngles, PointsOfFineMeshes_ReachTheLowerBoundsAndNeverPassTheUpper) {
  Tally tally;
  for (const auto& [name, mesh] : {std::pair("lbracket", shapes::lbracket()),
                                   std::pair("lpocket", sheared(shapes::lpocket(1, 2, 1), 0.5, 0)),
                                   std::pair("inclined", sheared(shapes::lbracket(), 0, 0.5)),
                                   std::pair("prism", shapes::prism(7, 1, 1.5))}) {
    SCOPED_TRACE(name);
    look(mesh, 0.02, tally);
  }
  EXPECT_GT(tally.points, 50'000u);
  EXPECT_GT(tally.sheets, 60u);
  EXPECT_GT(tally.seams, 50u);
  EXPECT_GT(tally.tight, 100u);
}

}  // namespace
}  // namespace blum
