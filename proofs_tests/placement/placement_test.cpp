// Points moved onto the axis, meshes, and what is made of them.

#include <gtest/gtest.h>

#include "blum/kernel/closest_point.hpp"
#include "blum/placement/feet.hpp"
#include "blum/placement/reconstruction.hpp"
#include "blum/placement/smooth.hpp"
#include "place.hpp"
#include "placement/placement_tools.hpp"

namespace blum {
namespace {

using test::PlacedRun;

std::vector<test::Scene> scenes() {
  return {{"cube", shapes::cuboid(1, 1, 1)},  {"lbracket", shapes::lbracket()},
          {"lpocket", shapes::lpocket()},     {"square prism", shapes::prism(4, 1, 3)},
          {"voids", shapes::nested_voids(1)}, {"torus", shapes::planar_torus(8, 4, 2, 0.75)}};
}

TEST(Placement, PointsOnTheAxis_HaveTwoFeetAtTheirRadius) {
  std::size_t points = 0;
  for (const auto& scene : scenes()) {
    SCOPED_TRACE(scene.name);
    const PlacedRun run(scene.mesh, 0, 0.1);
    const CellComplex& c = run.placement->mesh().complex;
    for (const ComplexVertex& v : c.vertex) {
      if (!v.on_axis || v.radius == 0) continue;
      ++points;
      EXPECT_NEAR(v.radius, test::boundary_distance(run.solid, run.points, v.position),
                  1e-9 * run.diagonal);
      EXPECT_LT(test::plain_distance_to_axis(run.solid, run.points, v.position),
                1e-6 * run.diagonal);
    }
  }
  EXPECT_GT(points, 1000u);
}

TEST(Placement, Points_StayInTheirLeaves) {
  for (const auto& scene : scenes()) {
    SCOPED_TRACE(scene.name);
    const PlacedRun run(scene.mesh, 0, 0.05);
    const CellComplex& c = run.placement->mesh().complex;
    for (const ComplexTriangle& t : c.triangle) {
      Box3 box = run.placement->sides()[t.cone]->box();
      for (int k = 0; k < 3; ++k) {
        box.lo[k] -= 1e-15;
        box.hi[k] += 1e-15;
      }
      for (const auto v : corners(c, t))
        EXPECT_TRUE(contains(box, run.solid.frame.to_working(c.vertex[v].position)));
    }
  }
}

TEST(Placement, CubeCentre_IsAJunctionOfSixFaces) {
  const PlacedRun run(shapes::cuboid(1, 1, 1), 0);
  const auto& vertex = run.placement->mesh().complex.vertex;
  const auto at_centre = [](const ComplexVertex& v) {
    return v.on_axis && distance_between(v.position, {0.5, 0.5, 0.5}) < 1e-9;
  };
  const auto it = std::find_if(vertex.begin(), vertex.end(), at_centre);
  ASSERT_NE(it, vertex.end());
  EXPECT_NEAR(it->radius, 0.5, 1e-9);
  std::set<std::uint32_t> facets;
  const SiteIndex index(run.solid);
  for (const SiteId s : it->governors) facets.insert(run.solid.triangle[index.element(s)].facet);
  EXPECT_EQ(facets.size(), 6u);
}

TEST(Placement, UnconvergedPoints_AreCounted) {
  for (const auto& scene : scenes()) {
    SCOPED_TRACE(scene.name);
    const PlacedRun run(scene.mesh, 0.08);
    const auto& vertex = run.placement->mesh().complex.vertex;
    const auto off = std::count_if(vertex.begin(), vertex.end(),
                                   [](const ComplexVertex& v) { return !v.on_axis; });
    EXPECT_EQ(run.placement->report().unconverged, static_cast<std::size_t>(off));
    EXPECT_LT(20 * static_cast<std::size_t>(off), vertex.size());
  }
}

TEST(Placement, SameForAnyNumberOfThreads) {
  const Solid solid = test::solid_of(shapes::lbracket());
  std::vector<Point3> first;
  for (const int threads : {1, 3}) {
    AxisPlacement placement(solid, {0.1, 0});
    MedialOptions options = test::seeded(1);
    options.threads = threads;
    ASSERT_TRUE(compute_medial_axis(solid, options, {}, {}, placement.review()));
    std::vector<Point3> points;
    for (const auto& v : placement.mesh().complex.vertex) points.push_back(v.position);
    if (first.empty()) first = points;
    EXPECT_EQ(points, first);
  }
}

TEST(Placement, Stopped_PointsStay) {
  const Solid solid = test::solid_of(shapes::lpocket());
  const AxisReview review = [&](const AssembledAxis& axis) {
    ConeSides sides;
    for (const ComplexCone& c : axis.complex.cone)
      sides.push_back(
          std::make_shared<const LeafSides>(axis.geometry, axis.subdivision.leaf[c.leaf]));
    const auto place = [&](CellComplex& complex, bool stop) {
      const std::atomic<bool> flag = stop;
      return place_points(axis.geometry, axis.engines.inside(), axis.parts, sides, complex,
                          {.stop = &flag});
    };
    const auto positions = [](const CellComplex& complex) {
      std::vector<Point3> points;
      for (const auto& v : complex.vertex) points.push_back(v.position);
      return points;
    };
    CellComplex stopped = axis.complex, placed = axis.complex;
    const PlacedPoints none = place(stopped, true), some = place(placed, false);
    EXPECT_EQ(none.moved + none.on_part, 0u);
    EXPECT_GT(some.moved + some.on_part, 0u);
    EXPECT_GT(none.unconverged, some.unconverged);
    EXPECT_EQ(positions(stopped), positions(axis.complex));
    EXPECT_NE(positions(placed), positions(axis.complex));
    const std::atomic<bool> flag = true;
    EXPECT_FALSE(mesh_of(axis.geometry, axis.engines.inside(), axis.complex, axis.parts, sides,
                         {.edge_length = 0.01, .stop = &flag})
                     .complete);
    return ReviewVerdict{};
  };
  ASSERT_TRUE(compute_medial_axis(solid, test::seeded(1), {}, {}, review));
}

TEST(Placement, WithEpsilon_BettiNumbersStay_AndThreadsDoNotMatter) {
  for (const auto& scene :
       {test::Scene{"lpocket", shapes::lpocket()}, test::Scene{"plate", shapes::plate(2, 6)},
        test::Scene{"voids", shapes::nested_voids(1)}}) {
    SCOPED_TRACE(scene.name);
    const Solid solid = test::solid_of(scene.mesh);
    const auto plain = compute_medial_axis(solid, test::seeded(1));
    ASSERT_TRUE(plain);
    std::vector<Point3> first;
    double bound = 0;
    for (const int threads : {1, 2}) {
      AxisPlacement placement(solid, {0.05 * test::extent(test::model_points(solid)), 0});
      MedialOptions options = test::seeded(1);
      options.threads = threads;
      const auto axis = compute_medial_axis(solid, options, {}, {}, placement.review());
      ASSERT_TRUE(axis);
      EXPECT_TRUE(placement.report().reached);
      EXPECT_GT(axis.value().leaves, plain.value().leaves);
      EXPECT_EQ(axis.value().betti, plain.value().betti);
      EXPECT_EQ(placement.realized(axis.value()).betti, solid.betti());
      std::vector<Point3> points;
      for (const auto& v : placement.mesh().complex.vertex) points.push_back(v.position);
      if (threads == 1) {
        first = points;
        bound = placement.report().bound;
      }
      EXPECT_EQ(points, first);
      EXPECT_EQ(placement.report().bound, bound);
    }
  }
}

TEST(AxisMesh, EdgesAreShort_AndTheSpaceIsTheSame) {
  for (const auto& scene : scenes()) {
    SCOPED_TRACE(scene.name);
    const PlacedRun run(scene.mesh, 0, 0.08);
    const AxisMesh& mesh = run.placement->mesh();
    for (const ComplexEdge& e : mesh.complex.edge)
      EXPECT_LE(distance_between(mesh.complex.vertex[e.vertex[0]].position,
                                 mesh.complex.vertex[e.vertex[1]].position),
                0.08 * run.diagonal * (1 + 1e-9));
    const MedialResult drawn = run.placement->realized(run.result);  // checks Betti numbers
    EXPECT_EQ(drawn.betti, run.result.betti);
    // Every triangle is bounded by its three edges.
    for (const ComplexTriangle& t : mesh.complex.triangle) {
      const auto [a, b, c] = corners(mesh.complex, t);
      const auto joins = [&](std::uint32_t e, std::uint32_t p, std::uint32_t q) {
        const auto& v = mesh.complex.edge[e].vertex;
        return (v[0] == p && v[1] == q) || (v[0] == q && v[1] == p);
      };
      EXPECT_TRUE(joins(t.edge[0], a, b) && joins(t.edge[1], a, c) && joins(t.edge[2], b, c));
    }
    // Seams are as long as before or, curved, longer, but for what placement moved: same parts.
    EXPECT_EQ(drawn.parts.seams, run.result.parts.seams);
    std::set<std::uint32_t> before, after;
    for (const auto s : run.result.parts.edge_seam) before.insert(s);
    for (const auto s : drawn.parts.edge_seam) after.insert(s);
    EXPECT_EQ(before, after);
  }
}

TEST(SheetFeet, FeetAreOnTheBoundary_AtTheRadius) {
  std::size_t feet_of_axis = 0, others = 0;
  for (const auto& scene : scenes()) {
    SCOPED_TRACE(scene.name);
    const PlacedRun run(scene.mesh, 0.1);
    const SheetFeet feet = sheet_feet(*run.placement, run.result.parts);
    const CellComplex& c = run.placement->mesh().complex;
    ASSERT_EQ(feet.patch.size(), 2 * c.triangle.size());
    EXPECT_EQ(feet.one_sided, 0u);
    for (const auto& patch : feet.patch)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& foot = feet.foot[patch.foot[k]];
        ASSERT_EQ(foot.axis_point, corners(c, c.triangle[patch.triangle])[k]);
        const ComplexVertex& v = c.vertex[foot.axis_point];
        EXPECT_LT(test::boundary_distance(run.solid, run.points, foot.position),
                  1e-12 * run.diagonal);
        // In coarse leaves a point can be off some of the sheets that meet in it.
        if (foot.is_foot) {
          ++feet_of_axis;
          EXPECT_NEAR(distance_between(foot.position, v.position), v.radius, 1e-9 * run.diagonal);
        }
        others += v.on_axis && !foot.is_foot ? 1 : 0;
      }
  }
  EXPECT_GT(feet_of_axis, 50 * others);
}

TEST(SheetFeet, SidesOfASheet_DoNotMix) {
  // Between floor and roof of a flat box the middle sheet has one side each.
  const PlacedRun run(shapes::cuboid(8, 6, 1), 0.02);
  const SheetFeet feet = sheet_feet(*run.placement, run.result.parts);
  std::map<std::uint32_t, std::array<std::set<double>, 2>> heights;  // of feet, by sheet and side
  for (const auto& patch : feet.patch) {
    const auto sheet =
        run.result.parts.triangle_sheet[run.placement->mesh().triangle[patch.triangle]];
    for (const auto f : patch.foot)
      heights[sheet][patch.side].insert(std::round(feet.foot[f].position.z * 1e6) / 1e6);
  }
  std::size_t middle = 0;
  for (const auto& [sheet, side] : heights)
    middle += side[0].size() == 1 && side[1].size() == 1 && side[0] != side[1] ? 1 : 0;
  EXPECT_EQ(middle, 1u);
}

TEST(Smooth, SeamsAndRimsStay_AndTheLargestMoveIsReported) {
  for (const auto& scene : scenes()) {
    SCOPED_TRACE(scene.name);
    const PlacedRun run(scene.mesh, 0, 0.05);
    const MedialResult drawn = run.placement->realized(run.result);
    MedialResult smooth = drawn;
    const SmoothReport report = smooth_sheets(smooth, run.solid, {});
    EXPECT_TRUE(smooth.smoothed);
    EXPECT_GT(report.sheets, 0u);
    double most = 0;
    for (std::size_t v = 0; v < smooth.complex.vertex.size(); ++v)
      most = std::max(most, distance_between(smooth.complex.vertex[v].position,
                                             drawn.complex.vertex[v].position));
    EXPECT_EQ(most, report.largest_displacement);
    std::vector<int> triangles(drawn.complex.edge.size(), 0);
    for (const auto& t : drawn.complex.triangle)
      for (const auto e : t.edge) ++triangles[e];
    for (std::size_t e = 0; e < triangles.size(); ++e) {
      if (triangles[e] == 2 && drawn.parts.edge_seam[e] == Parts::kNoSeam) continue;
      for (const auto v : drawn.complex.edge[e].vertex)
        EXPECT_EQ(smooth.complex.vertex[v].position, drawn.complex.vertex[v].position);
    }
  }
}

TEST(Smooth, RoughSheet_BecomesSmoother) {
  const PlacedRun run(shapes::cuboid(8, 6, 1), 0, 0.04);
  MedialResult drawn = run.placement->realized(run.result);
  std::mt19937 random(3);
  std::vector<std::size_t> rough;
  for (std::size_t v = 0; v < drawn.complex.vertex.size(); ++v) {
    ComplexVertex& x = drawn.complex.vertex[v];
    if (x.governors.size() != 2 || std::abs(x.position.z - 0.5) > 1e-9) continue;
    x.position.z += std::uniform_real_distribution(-0.02, 0.02)(random);
    rough.push_back(v);
  }
  ASSERT_GT(rough.size(), 50u);
  const auto roughness = [&] {
    double sum = 0;
    for (const auto v : rough) sum += std::pow(drawn.complex.vertex[v].position.z - 0.5, 2);
    return sum;
  };
  const double before = roughness();
  smooth_sheets(drawn, run.solid, {});
  EXPECT_LT(roughness(), 0.5 * before);
}

TEST(Reconstruction, BoundHoldsAtSamples_AndFinerIsNearer) {
  std::mt19937 random(5);
  for (const auto& scene : {test::Scene{"cuboid", shapes::cuboid(3, 2, 1)},
                            test::Scene{"lbracket", shapes::lbracket()}}) {
    SCOPED_TRACE(scene.name);
    double last = std::numeric_limits<double>::infinity();
    for (const double edge : {0.2, 0.05}) {
      const PlacedRun run(scene.mesh, 0.2, edge);
      const CellComplex& c = run.placement->mesh().complex;
      const ReconstructionError error = reconstruction_error(run.solid, c, {0.005, 5'000, 5'000});
      EXPECT_LE(error.boundary_to_union_lo, error.boundary_to_union_hi);
      EXPECT_LT(error.boundary_to_union_hi, last);
      last = error.boundary_to_union_hi;
      EXPECT_GT(error.border_samples, 0u);
      for (int trial = 0; trial < 200; ++trial) {
        const auto t =
            std::uniform_int_distribution<std::size_t>(0, run.solid.triangle.size() - 1)(random);
        double a = std::uniform_real_distribution(0.0, 1.0)(random),
               b = std::uniform_real_distribution(0.0, 1.0)(random);
        if (a + b > 1) a = 1 - a, b = 1 - b;
        const auto& v = run.solid.triangle[t].vertex;
        const Point3 x =
            (1 - a - b) * run.points[v[0]] + a * run.points[v[1]] + b * run.points[v[2]];
        double least = std::numeric_limits<double>::infinity();
        for (const ComplexVertex& ball : c.vertex)
          least = std::min(least, distance_between(x, ball.position) - ball.radius);
        EXPECT_LE(least, error.boundary_to_union_hi);
      }
    }
  }
}

}  // namespace
}  // namespace blum
