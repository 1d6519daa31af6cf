// Flattening: facets exact afterwards, no vertex too far from home, never a broken solid.
#include "blum/kernel/flatten.hpp"

#include <cstring>
#include <limits>

#include "blum/kernel/shapes.hpp"
#include "mesh_test_tools.hpp"

namespace blum {
namespace {

using test::box_mesh;

constexpr double kTolerance = 1e-6;

PolygonMesh model(const std::string& name) {
  const Result<PolygonMesh> mesh = read_mesh(std::string(BLUM_MODELS_DIR) + "/" + name);
  EXPECT_TRUE(mesh.ok()) << mesh.error().message;
  return mesh.ok() ? mesh.value() : PolygonMesh{};
}

Flattened flattened(const PolygonMesh& mesh, double tolerance = kTolerance) {
  Result<Flattened> result = flatten_facets(mesh, tolerance);
  EXPECT_TRUE(result.ok()) << result.error().message;
  return result.ok() ? std::move(result).value() : Flattened{};
}

Error error_of(const PolygonMesh& mesh, double tolerance) {
  const Result<Flattened> result = flatten_facets(mesh, tolerance);
  EXPECT_FALSE(result.ok());
  return result.ok() ? Error{} : result.error();
}

/// Every coordinate moved by at most `size`.
PolygonMesh noisy(const PolygonMesh& mesh, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-size, size);
  return test::mapped(mesh, [&](Point3 p) {
    return Point3{p.x + noise(random), p.y + noise(random), p.z + noise(random)};
  });
}

bool same_bytes(const PolygonMesh& a, const PolygonMesh& b) {
  return a.faces == b.faces && a.points.size() == b.points.size() &&
         std::memcmp(a.points.data(), b.points.data(), a.points.size() * sizeof(Point3)) == 0;
}

long double distance_squared(const Point3& a, const Point3& b) {
  long double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const long double d = static_cast<long double>(a[axis]) - b[axis];
    sum += d * d;
  }
  return sum;
}

/// The documented bound, in more digits than the program computes with.
void expect_bounded(const PolygonMesh& before, const Flattened& after) {
  Point3 lo = before.points[0], hi = lo;
  for (const Point3& p : before.points) {
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = std::min(lo[axis], p[axis]);
      hi[axis] = std::max(hi[axis], p[axis]);
    }
  }
  const long double tolerance = after.report.tolerance;
  ASSERT_EQ(before.points.size(), after.mesh.points.size());
  std::size_t moved = 0;
  for (std::size_t v = 0; v < before.points.size(); ++v) {
    const long double squared = distance_squared(before.points[v], after.mesh.points[v]);
    EXPECT_LE(squared, tolerance * tolerance * distance_squared(lo, hi));
    EXPECT_LE(std::sqrt(squared), after.report.largest_displacement * (1 + 1e-15));
    moved += squared > 0;
  }
  EXPECT_EQ(moved, after.report.vertices_moved);
}

TEST(Flatten, ToleranceZero_ChangesNothing) {
  PolygonMesh zeros = box_mesh({-0.0, -0.0, -0.0}, {1, 1, 1});
  for (const PolygonMesh& mesh :
       {zeros, noisy(box_mesh(), 1e-9, 1), model("joint.off"), model("cube_minus_octant.off")}) {
    const Flattened result = flattened(mesh, 0);
    EXPECT_TRUE(same_bytes(mesh, result.mesh));
    EXPECT_EQ(result.report.vertices_moved, 0u);
    EXPECT_EQ(result.report.after.nearly_flat, 0u);
  }
  EXPECT_TRUE(same_bytes(zeros, flattened(zeros).mesh));
}

TEST(Flatten, NoisyBoxes_BecomeExact) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const PolygonMesh box =
        shapes::triangulate_facets(shapes::split_edges(shapes::cuboid(1, 2, 3), seed), seed);
    const PolygonMesh mesh = noisy(box, 1e-6, seed);
    const Flattened result = flattened(mesh);
    EXPECT_EQ(result.solid.facets, 6u) << seed;
    EXPECT_EQ(result.report.after.nearly_flat, 0u) << seed;
    EXPECT_GT(result.report.before.nearly_flat, 0u) << seed;
    expect_bounded(mesh, result);
  }
}

TEST(Flatten, NoisyPolygons_BecomePlanar) {
  const PolygonMesh mesh = noisy(shapes::lpocket(), 1e-7, 3);
  EXPECT_FALSE(test::solid_of(mesh).warnings.empty());
  const Flattened result = flattened(mesh);
  EXPECT_TRUE(result.solid.warnings.empty());
  EXPECT_EQ(result.solid.facets, test::solid_of(shapes::lpocket()).facets);
}

TEST(Flatten, UprightEdges_MakeWallsInAnyDirectionExact) {
  const PolygonMesh prism = test::triangulated(shapes::prism(7));
  PolygonMesh mesh = prism;
  for (std::size_t v = 0; v < mesh.points.size() / 2; ++v) mesh.points[v].x += 1e-8 * (1. + v);
  EXPECT_GT(test::solid_of(mesh).facets, 9u);
  EXPECT_EQ(flattened(mesh).solid.facets, 9u);
}

TEST(Flatten, TheShortestDecimalIsWhatWasMeant) {
  PolygonMesh mesh = box_mesh({0, 0, 0}, {20, 20, 20});
  mesh.points[1].x = mesh.points[3].x = mesh.points[5].x = 19.999998092651367;
  const Flattened result = flattened(mesh);
  for (const std::size_t v : {1u, 3u, 5u, 7u}) EXPECT_EQ(result.mesh.points[v].x, 20);
  EXPECT_EQ(result.report.vertices_moved, 3u);
  EXPECT_EQ(result.report.largest_displacement, 20 - 19.999998092651367);
}

TEST(Flatten, CubeMinusOctant_IsExactAndLosesItsSliver) {
  const PolygonMesh mesh = model("cube_minus_octant.off");
  const Flattened result = flattened(mesh);
  EXPECT_EQ(result.solid.facets, 9u);
  EXPECT_EQ(result.report.before.flat, 7u);
  EXPECT_EQ(result.report.before.nearly_flat, 8u);
  EXPECT_EQ(result.report.after.flat, 15u);
  EXPECT_EQ(result.report.after.nearly_flat, 0u);
  EXPECT_EQ(result.report.slivers_dropped, 1u);
  EXPECT_EQ(result.solid.betti(), (std::array<long, 3>{1, 0, 0}));
  expect_bounded(mesh, result);
}

TEST(Flatten, Joint_IsFlatterAndSaysWhatIsLeft) {
  const PolygonMesh mesh = model("joint.off");
  const Flattened result = flattened(mesh);
  EXPECT_EQ(result.report.before.flat, 321u);
  EXPECT_EQ(result.report.before.nearly_flat, 22u);
  EXPECT_EQ(result.report.after.flat, 341u);
  EXPECT_EQ(result.report.after.nearly_flat, 2u);
  EXPECT_EQ(result.solid.betti(), (std::array<long, 3>{1, 2, 0}));
  expect_bounded(mesh, result);
}

TEST(Flatten, SliversBesideSlivers_AreDroppedOneAfterTheOther) {
  // The side from 0 to 3 is bent outwards by noise, and the top is cut from corner 0.
  const PolygonMesh mesh = test::triangulated(
      test::prism({{0, 0}, {1, -2e-7}, {2, -1e-7}, {3, 0}, {3, 3}, {0, 3}}, 0, 1));
  const Flattened result = flattened(mesh);
  EXPECT_EQ(result.report.slivers_dropped, 2u);
  EXPECT_EQ(result.solid.facets, 6u);
  EXPECT_EQ(result.report.after.nearly_flat, 0u);
}

TEST(Flatten, OrderOfVerticesAndFaces_DoesNotMatter) {
  for (const PolygonMesh& mesh : {model("joint.off"), model("cube_minus_octant.off"),
                                  noisy(test::triangulated(shapes::cuboid(1, 2, 3)), 1e-6, 4)}) {
    const Flattened result = flattened(mesh);
    for (unsigned seed = 1; seed <= 10; ++seed) {
      const Flattened other = flattened(test::shuffled(mesh, seed));
      EXPECT_EQ(other.mesh.points, test::shuffled(result.mesh, seed).points);
      EXPECT_EQ(other.mesh.faces.size(), result.mesh.faces.size());
      EXPECT_EQ(other.report.largest_displacement, result.report.largest_displacement);
      EXPECT_EQ(other.report.after.flat, result.report.after.flat);
    }
  }
}

TEST(Flatten, Again_ChangesNothing) {
  std::vector<PolygonMesh> meshes = {model("joint.off"), model("cube_minus_octant.off"),
                                     model("couplingdown.off"), model("thingi_88566_panels.off")};
  for (unsigned seed = 1; seed <= 20; ++seed) {
    meshes.push_back(noisy(test::triangulated(shapes::cuboid(1, 2, 3)), 1e-6, seed));
  }
  for (const PolygonMesh& mesh : meshes) {
    const Flattened once = flattened(mesh);
    const Flattened twice = flattened(once.mesh);
    EXPECT_TRUE(same_bytes(once.mesh, twice.mesh));
    EXPECT_EQ(twice.report.vertices_moved, 0u);
    EXPECT_EQ(twice.report.slivers_dropped, 0u);
    EXPECT_EQ(twice.report.before.flat, once.report.after.flat);
    EXPECT_EQ(twice.report.before.nearly_flat, once.report.after.nearly_flat);
  }
}

TEST(Flatten, AnExactSolid_StaysAsItIs) {
  for (const PolygonMesh& mesh : {shapes::lbracket(), shapes::lpocket(), shapes::plate(2, 6),
                                  shapes::nested_voids(2), shapes::torus(8, 5, 2, 1)}) {
    EXPECT_TRUE(same_bytes(mesh, flattened(mesh).mesh));
  }
}

TEST(Flatten, WallsThinnerThanTheTolerance_AreAnErrorThatSaysWhere) {
  for (const PolygonMesh& mesh :
       {box_mesh({0, 0, 0}, {1, 1, 1e-7}), shapes::lbracket(4, 3, 1e-6, 2)}) {
    const Error error = error_of(mesh, kTolerance);
    EXPECT_EQ(error.code, ErrorCode::kInvalidSolid);
    EXPECT_NE(error.message.find("tolerance is too large"), std::string::npos) << error.message;
    EXPECT_NE(error.message.find("at ("), std::string::npos) << error.message;
    EXPECT_EQ(flattened(mesh, 1e-9).report.vertices_moved, 0u);
  }
  EXPECT_EQ(error_of(shapes::nested_voids(1), 0.5).code, ErrorCode::kInvalidSolid);
}

TEST(Flatten, AnyTolerance_GivesABoundedSolidOrAnError) {
  for (const char* name : {"joint.off", "cube_minus_octant.off", "cross.off", "P_polygons.off"}) {
    const PolygonMesh mesh = model(name);
    const auto betti = test::solid_of(mesh).betti();
    for (double tolerance = 1e-9; tolerance < 1; tolerance *= 3) {
      const Result<Flattened> result = flatten_facets(mesh, tolerance);
      if (!result) {
        EXPECT_EQ(result.error().code, ErrorCode::kInvalidSolid);
        continue;
      }
      expect_bounded(mesh, result.value());
      EXPECT_TRUE(validate_mesh(result.value().mesh).valid());
      EXPECT_EQ(result.value().solid.betti(), betti);
    }
  }
}

TEST(Flatten, BadArgumentsAndInvalidMeshes_AreErrors) {
  for (const double tolerance : {-1.0, 1.5, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(error_of(box_mesh(), tolerance).code, ErrorCode::kBadArgument);
  }
  PolygonMesh open = box_mesh();
  open.faces.pop_back();
  EXPECT_EQ(error_of(open, kTolerance).code, ErrorCode::kInvalidSolid);
  EXPECT_EQ(error_of({}, kTolerance).code, ErrorCode::kNoFaces);
}

}  // namespace
}  // namespace blum
