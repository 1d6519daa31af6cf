// Each class of defect by the smallest mesh that has it, and what must not be taken for one.
#include "blum/kernel/validate.hpp"

#include <limits>
#include <map>
#include <set>

#include "mesh_test_tools.hpp"

namespace blum {
namespace {

using test::box_mesh;
using test::count_of;
using test::defects_of;
using test::merged;
using test::reversed;
using test::tetrahedron;

double up(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }

TEST(DefectKind, Names_AreDistinctAndStable) {
  std::set<std::string> names;
  for (int k = 0; k <= static_cast<int>(DefectKind::kInvertedSolid); ++k) {
    names.insert(defect_kind_name(static_cast<DefectKind>(k)));
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(DefectKind::kInvertedSolid) + 1);
  EXPECT_EQ(names.count("unknown"), 0u);
  EXPECT_EQ(names.count("self_intersection"), 1u);
}

TEST(ValidateMesh, GoodSolids_HaveNoDefects) {
  EXPECT_EQ(defects_of(box_mesh()), "");
  EXPECT_EQ(defects_of(test::triangulated(box_mesh())), "");
  EXPECT_EQ(defects_of(tetrahedron()), "");
  EXPECT_EQ(defects_of(test::torus(8, 4, 2, 0.5)), "");
  EXPECT_EQ(defects_of(merged(box_mesh(), box_mesh({3, 0, 0}, {4, 1, 1}))), "");
}

TEST(ValidateMesh, NoFaces_IsNamed) {
  EXPECT_EQ(defects_of({}), "no_faces:1");
  EXPECT_FALSE(validate_mesh({}).valid());
}

TEST(ValidateMesh, BadNumbersAndIndices_AreNamedTogetherWithTheRest) {
  PolygonMesh m = tetrahedron();
  m.points[1].x = std::numeric_limits<double>::quiet_NaN();
  m.points[2].y = 1e308;
  m.faces.push_back({0, 1, 9});
  m.faces.push_back({3, 3, 3});
  const std::string defects = defects_of(m);
  for (const char* kind : {"non_finite_coordinate:1", "coordinate_out_of_range:1",
                           "index_out_of_range:1", "degenerate_face:1"}) {
    EXPECT_NE(defects.find(kind), std::string::npos) << defects;
  }
}

TEST(ValidateMesh, DegenerateFaces_AreNamed) {
  PolygonMesh repeated = tetrahedron();
  repeated.faces.push_back({0, 1, 1});
  EXPECT_EQ(defects_of(repeated), "degenerate_face:1");
  // A vertex on an edge: a cap of zero area closes the surface combinatorially.
  PolygonMesh cap = tetrahedron();
  cap.points.push_back({0.5, 0, 0});
  cap.faces[0] = {0, 2, 4};
  cap.faces.push_back({4, 2, 1});
  cap.faces.push_back({0, 4, 1});
  EXPECT_EQ(count_of(cap, DefectKind::kDegenerateFace), 1u);
  EXPECT_EQ(count_of(cap, DefectKind::kBoundaryEdge), 0u);
  cap.points[4].z = 5e-324;  // no longer degenerate, by the least number there is
  EXPECT_EQ(count_of(cap, DefectKind::kDegenerateFace), 0u);
}

TEST(ValidateMesh, TJunction_IsAnOpenTouchingSurface) {
  PolygonMesh m = tetrahedron();
  m.points.push_back({0.5, 0, 0});
  m.faces[0] = {0, 2, 4};
  m.faces.push_back({4, 2, 1});  // the other side of the edge 0-1 is not split
  EXPECT_EQ(count_of(m, DefectKind::kBoundaryEdge), 3u);
  EXPECT_GT(count_of(m, DefectKind::kSelfIntersection), 0u);
}

TEST(ValidateMesh, DuplicateFace_IsNamedWithItsTwin) {
  PolygonMesh m = tetrahedron();
  m.faces.push_back({3, 2, 1});
  const ValidationReport report = validate_mesh(m);
  const Defect* d = report.find(DefectKind::kDuplicateFace);
  ASSERT_NE(d, nullptr);
  EXPECT_EQ(d->count, 1u);
  EXPECT_EQ(d->examples[0].elements, (std::vector<std::size_t>{4, 3}));
  EXPECT_EQ(count_of(m, DefectKind::kNonManifoldEdge), 3u);
}

TEST(ValidateMesh, DuplicateAndIsolatedVertices_AreOnlyWarnings) {
  PolygonMesh m = box_mesh();
  m.points.push_back({5, 5, 5});
  m.points.push_back(m.points[3]);
  EXPECT_EQ(defects_of(m), "duplicate_vertex:1 isolated_vertex:2");
  EXPECT_TRUE(validate_mesh(m).valid());
  const Solid s = test::solid_of(m);
  EXPECT_EQ(s.point.size(), 8u);
  EXPECT_EQ(s.warnings.size(), 1u);
}

TEST(ValidateMesh, UnweldedVertices_ShowAsHolesAndTouches) {
  PolygonMesh m = tetrahedron();
  m.points.push_back(m.points[3]);
  m.faces[3][2] = 4;
  EXPECT_EQ(count_of(m, DefectKind::kDuplicateVertex), 1u);
  EXPECT_EQ(count_of(m, DefectKind::kBoundaryEdge), 4u);
  EXPECT_GT(count_of(m, DefectKind::kSelfIntersection), 0u);
}

TEST(ValidateMesh, MissingFace_HasABoundary) {
  PolygonMesh m = box_mesh();
  m.faces.pop_back();
  EXPECT_EQ(defects_of(m), "boundary_edge:4");
}

TEST(ValidateMesh, BoxesOnOneEdge_AreNonManifold) {
  PolygonMesh a = box_mesh(), b = box_mesh({1, 1, 0}, {2, 2, 1});
  EXPECT_GT(count_of(merged(a, b), DefectKind::kSelfIntersection), 0u);  // touching
  PolygonMesh m = merged(a, b);  // now with the edge x = y = 1 in common
  for (auto& f : m.faces) {
    for (auto& v : f) v = v == 8 ? 3 : v == 12 ? 7 : v;
  }
  EXPECT_EQ(count_of(m, DefectKind::kNonManifoldEdge), 1u);
  EXPECT_EQ(count_of(m, DefectKind::kSelfIntersection), 0u);
}

TEST(ValidateMesh, BoxesAtOneVertex_ArePinched) {
  PolygonMesh m = merged(box_mesh(), box_mesh({1, 1, 1}, {2, 2, 2}));
  for (auto& f : m.faces) {
    for (auto& v : f) v = v == 8 ? 7 : v;
  }
  EXPECT_EQ(defects_of(m), "duplicate_vertex:1 isolated_vertex:1 nonmanifold_vertex:1");
  EXPECT_FALSE(build_solid(m).ok());
}

TEST(ValidateMesh, OneFaceTurned_IsInconsistent) {
  PolygonMesh m = box_mesh();
  std::reverse(m.faces[2].begin(), m.faces[2].end());
  EXPECT_EQ(defects_of(m), "inconsistent_orientation:4");
}

TEST(ValidateMesh, CrossingTouchingAndNearlyTouchingSolids_AreToldApart) {
  const PolygonMesh a = box_mesh();
  EXPECT_GT(
      count_of(merged(a, box_mesh({0.5, 0.5, 0.5}, {2, 2, 2})), DefectKind::kSelfIntersection), 0u);
  // Faces touch.
  EXPECT_GT(count_of(merged(a, box_mesh({1, 0.25, 0.25}, {2, 0.75, 0.75})),
                     DefectKind::kSelfIntersection),
            0u);
  // A vertex touches a face, and is one ulp before it.
  EXPECT_GT(count_of(merged(a, tetrahedron({1, 0.5, 0.5})), DefectKind::kSelfIntersection), 0u);
  EXPECT_EQ(defects_of(merged(a, tetrahedron({up(1), 0.5, 0.5}))), "");
}

TEST(ValidateMesh, Examples_AreTheFirstFiveWithCoordinates) {
  PolygonMesh m = box_mesh();
  for (int i = 0; i < 9; ++i) m.points.push_back({double(i), 7, 7});
  const ValidationReport report = validate_mesh(m);
  const Defect* d = report.find(DefectKind::kIsolatedVertex);
  ASSERT_NE(d, nullptr);
  EXPECT_EQ(d->count, 9u);
  ASSERT_EQ(d->examples.size(), 5u);
  EXPECT_EQ(d->examples[4].elements, std::vector<std::size_t>{12});
  EXPECT_EQ(d->examples[4].points, std::vector<Point3>{(Point3{4, 7, 7})});
  EXPECT_EQ(report.summary(Severity::kWarning), "9 isolated_vertex (vertex 8 at (0, 7, 7))");
  EXPECT_EQ(report.summary(Severity::kError), "");
}

TEST(ValidateMesh, ManyCoincidentFaces_StopAtAMillionPairs) {
  PolygonMesh m;
  for (int i = 0; i < 3000; ++i) m = merged(std::move(m), tetrahedron());
  const ValidationReport report = validate_mesh(m);
  const Defect* d = report.find(DefectKind::kSelfIntersection);
  ASSERT_NE(d, nullptr);
  EXPECT_TRUE(d->count_is_lower_bound);
  EXPECT_NE(report.summary(Severity::kError).find("at least"), std::string::npos);
}

TEST(ValidateMesh, Defects_DoNotDependOnOrderScaleOrPlace) {
  PolygonMesh m = merged(box_mesh(), box_mesh({0.5, 0.5, 0.5}, {2, 2, 2}));
  m.faces.pop_back();
  const std::string expected = defects_of(m);
  EXPECT_NE(expected, "");
  for (unsigned seed = 0; seed < 5; ++seed) {
    EXPECT_EQ(defects_of(test::shuffled(m, seed)), expected);
  }
  for (const double scale : {0x1p-1000, 0x1p-60, 0x1p190}) {
    EXPECT_EQ(defects_of(test::mapped(m,
                                      [&](Point3 p) {
                                        return Point3{p.x * scale, p.y * scale, p.z * scale};
                                      })),
              expected);
  }
  EXPECT_EQ(defects_of(test::mapped(m,
                                    [](Point3 p) {
                                      return Point3{p.x + 1024, p.y - 4096, p.z + 2};
                                    })),
            expected);
}

TEST(ValidateShells, VoidsAndIslands_AreAccepted) {
  const PolygonMesh outer = box_mesh({-8, -8, -8}, {8, 8, 8});
  const PolygonMesh hollow = reversed(box_mesh({-4, -4, -4}, {4, 4, 4}));
  const PolygonMesh island = box_mesh({-2, -2, -2}, {2, 2, 2});
  EXPECT_EQ(defects_of(merged(outer, hollow)), "");
  const Solid s = test::solid_of(merged(merged(island, hollow), outer));
  ASSERT_EQ(s.shell.size(), 3u);
  EXPECT_FALSE(s.shell[0].is_void);
  EXPECT_TRUE(s.shell[1].is_void);
  EXPECT_FALSE(s.shell[2].is_void);
  EXPECT_EQ(s.components, 2u);
  EXPECT_NE(s.shell[0].component, s.shell[2].component);
  EXPECT_EQ(s.shell[1].component, s.shell[2].component);
  EXPECT_EQ(s.betti(), (std::array<long, 3>{2, 0, 1}));
}

TEST(ValidateShells, VoidOfWrongOrientation_IsNamed) {
  const PolygonMesh outer = box_mesh({-8, -8, -8}, {8, 8, 8});
  const PolygonMesh inner = box_mesh({-4, -4, -4}, {4, 4, 4});
  EXPECT_EQ(defects_of(merged(outer, inner)), "shell_nesting:1");
  const PolygonMesh beside = reversed(box_mesh({10, 0, 0}, {11, 1, 1}));
  EXPECT_EQ(defects_of(merged(outer, beside)), "shell_nesting:1");
}

TEST(ValidateShells, WholeFileInverted_IsTurnedRoundWithAWarning) {
  const PolygonMesh good =
      merged(box_mesh({-8, -8, -8}, {8, 8, 8}), reversed(box_mesh({-4, -4, -4}, {4, 4, 4})));
  EXPECT_EQ(defects_of(reversed(good)), "inverted_solid:2");
  const Solid a = test::solid_of(good), b = test::solid_of(reversed(good));
  ASSERT_EQ(b.warnings.size(), 1u);
  EXPECT_NE(b.warnings[0].find("turned round"), std::string::npos);
  EXPECT_EQ(a.betti(), b.betti());
  EXPECT_EQ(a.edge.size(), b.edge.size());
  for (std::size_t s = 0; s < 2; ++s) EXPECT_EQ(a.shell[s].is_void, b.shell[s].is_void);
}

TEST(ValidateShells, RaysThroughVerticesAndEdges_NestRightly) {
  // Concentric and aligned: every ray from a corner of the inner shells runs through edges or
  // corners of the others.
  PolygonMesh m;
  for (int k = 1; k <= 6; ++k) {
    const double r = k;
    const PolygonMesh b = box_mesh({-r, -r, -r}, {r, r, r});
    m = merged(std::move(m), k % 2 == 0 ? b : reversed(b));
  }
  const Solid s = test::solid_of(m);
  EXPECT_EQ(s.betti(), (std::array<long, 3>{3, 0, 3}));
  // An octahedron whose apex is straight above the corner of an island below it.
  PolygonMesh o;
  o.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  o.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
             {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  EXPECT_EQ(defects_of(o), "");
  EXPECT_EQ(defects_of(merged(o, tetrahedron({0, 0, -3}))), "");
  EXPECT_EQ(defects_of(merged(o, reversed(tetrahedron({0, 0, 0}, 0.25)))), "");
  EXPECT_EQ(defects_of(merged(o, tetrahedron({0, 0, 0}, 0.25))), "shell_nesting:1");
}

}  // namespace
}  // namespace blum
