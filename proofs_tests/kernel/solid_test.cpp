// What build_solid fills in, and the exactness of it.
#include "blum/kernel/solid.hpp"

#include <limits>
#include <map>
#include <set>

#include "mesh_test_tools.hpp"

namespace blum {
namespace {

using test::box_mesh;
using test::prism;
using test::solid_of;

double up(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }

std::map<EdgeKind, int> edge_kinds(const Solid& s) {
  std::map<EdgeKind, int> n;
  for (const SolidEdge& e : s.edge) ++n[e.kind];
  return n;
}

/// All that solid.hpp promises and that can be checked from the solid alone.
void expect_consistent(const Solid& s) {
  for (std::uint32_t e = 0; e < s.edge.size(); ++e) {
    const SolidEdge& edge = s.edge[e];
    for (int side = 0; side < 2; ++side) {
      const SolidTriangle& t = s.triangle[edge.triangle[side]];
      int found = 0;
      for (int k = 0; k < 3; ++k) {
        if (t.edge[k] != e) continue;
        ++found;
        EXPECT_EQ(t.vertex[k], edge.vertex[side]);
        EXPECT_EQ(t.vertex[(k + 1) % 3], edge.vertex[1 - side]);
      }
      EXPECT_EQ(found, 1);
    }
    const bool one_facet = s.triangle[edge.triangle[0]].facet == s.triangle[edge.triangle[1]].facet;
    EXPECT_TRUE(one_facet || edge.kind != EdgeKind::kFlat);
    EXPECT_EQ(s.triangle[edge.triangle[0]].shell, s.triangle[edge.triangle[1]].shell);
  }
  std::set<std::uint32_t> facets;
  for (const SolidTriangle& t : s.triangle) facets.insert(t.facet);
  EXPECT_EQ(facets.size(), s.facets);
  EXPECT_EQ(*facets.rbegin() + 1, s.facets);
  ASSERT_EQ(s.vertex_edge_begin.size(), s.point.size() + 1);
  EXPECT_EQ(s.vertex_edge.size(), 2 * s.edge.size());
  EXPECT_EQ(s.vertex_triangle.size(), 3 * s.triangle.size());
  for (std::uint32_t v = 0; v < s.point.size(); ++v) {
    EXPECT_EQ(s.edges_at(v).size(), s.triangles_at(v).size());
    for (const auto e : s.edges_at(v)) {
      EXPECT_TRUE(s.edge[e].vertex[0] == v || s.edge[e].vertex[1] == v);
    }
    for (const auto t : s.triangles_at(v)) {
      EXPECT_NE(std::find(s.triangle[t].vertex.begin(), s.triangle[t].vertex.end(), v),
                s.triangle[t].vertex.end());
    }
  }
  double largest = 0;
  for (const Point3& p : s.point) {
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  EXPECT_GT(largest, 0.5);
  EXPECT_LE(largest, 1.0);
}

/// An L in the plane, counter-clockwise.
std::vector<std::pair<double, double>> ell() {
  return {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
}

TEST(BuildSolid, Cube_HasItsFields) {
  const Solid s = solid_of(box_mesh());
  expect_consistent(s);
  EXPECT_EQ(s.point.size(), 8u);
  EXPECT_EQ(s.triangle.size(), 12u);
  EXPECT_EQ(s.edge.size(), 18u);
  EXPECT_EQ(s.facets, 6u);
  EXPECT_EQ(s.betti(), (std::array<long, 3>{1, 0, 0}));
  auto kinds = edge_kinds(s);
  EXPECT_EQ(kinds[EdgeKind::kConvex], 12);
  EXPECT_EQ(kinds[EdgeKind::kFlat], 6);
  EXPECT_EQ(std::count(s.vertex_degenerate.begin(), s.vertex_degenerate.end(), true), 0);
  EXPECT_TRUE(s.warnings.empty());
}

TEST(BuildSolid, LShape_HasOneReflexEdgeWithDegenerateEnds) {
  const Solid s = solid_of(prism(ell()));
  expect_consistent(s);
  EXPECT_EQ(edge_kinds(s)[EdgeKind::kReflex], 1);
  EXPECT_EQ(s.facets, 8u);
  // At the ends of the reflex edge the edges leave no room for a polar cone: (1,0), (0,1) in the
  // plane, diagonals between them on the far side, and the reflex edge itself.
  for (std::uint32_t v = 0; v < s.point.size(); ++v) {
    const Point3 p = s.frame.to_model(s.point[v]);
    int diagonals = 0;
    for (const auto e : s.edges_at(v)) diagonals += s.edge[e].kind == EdgeKind::kFlat;
    const bool at_notch = p.x == 1 && p.y == 1;
    EXPECT_TRUE(s.vertex_degenerate[v] || !at_notch || diagonals == 0);
    EXPECT_FALSE(s.vertex_degenerate[v] && !at_notch);
  }
}

TEST(BuildSolid, Torus_HasTheDegenerateVerticesThatTheTheoryCounts) {
  const Solid s = solid_of(test::torus(8, 4, 2, 0.5));
  expect_consistent(s);
  EXPECT_EQ(s.betti(), (std::array<long, 3>{1, 1, 0}));
  EXPECT_EQ(s.shell[0].genus, 1);
  EXPECT_EQ(std::count(s.vertex_degenerate.begin(), s.vertex_degenerate.end(), true), 8);
}

TEST(BuildSolid, EdgeKindAcrossAQuad_ChangesWithOneUlp) {
  // The fifth point lies on the roof, over its middle, and one ulp beside.
  const auto kind = [](double z) {
    PolygonMesh m = test::triangulated(box_mesh({-1, -1, 0}, {1, 1, 1}));
    std::erase_if(m.faces, [&](const auto& f) {
      return std::all_of(f.begin(), f.end(), [&](auto v) { return m.points[v].z == 1; });
    });
    m.points.push_back({0.25, 0.125, z});
    for (const auto& [a, b] : {std::pair{4u, 5u}, {5u, 7u}, {7u, 6u}, {6u, 4u}}) {
      m.faces.push_back({a, b, 8});
    }
    const Solid s = solid_of(m);
    std::set<EdgeKind> kinds;
    for (const auto e : s.edges_at(8)) kinds.insert(s.edge[e].kind);
    EXPECT_EQ(kinds.size(), 1u);
    const bool degenerate = s.vertex_degenerate[8];
    EXPECT_EQ(degenerate, z == 1);
    return *kinds.begin();
  };
  EXPECT_EQ(kind(1), EdgeKind::kFlat);
  EXPECT_EQ(kind(up(1)), EdgeKind::kConvex);
  EXPECT_EQ(kind(std::nextafter(1, 0)), EdgeKind::kReflex);
}

TEST(BuildSolid, InvalidMesh_NamesAllDefectsAndTheFirstElement) {
  PolygonMesh m = box_mesh();
  m.faces.pop_back();
  m.points.push_back({0.5, 0.5, 0.5});
  m.faces.push_back({8, 8, 0});
  const auto s = build_solid(m);
  ASSERT_FALSE(s.ok());
  EXPECT_EQ(s.error().code, ErrorCode::kInvalidSolid);
  EXPECT_NE(s.error().message.find("1 degenerate_face"), std::string::npos) << s.error().message;
  EXPECT_NE(s.error().message.find("4 boundary_edge"), std::string::npos) << s.error().message;
  EXPECT_EQ(s.error().element, std::optional<std::size_t>(5));
  EXPECT_EQ(build_solid({}).error().code, ErrorCode::kNoFaces);
  m.points[0].x = std::numeric_limits<double>::infinity();
  EXPECT_EQ(build_solid(m).error().code, ErrorCode::kNonFiniteCoordinate);
}

TEST(BuildSolid, SameMeshTwice_GivesTheSameSolid) {
  const Solid a = solid_of(prism(ell())), b = solid_of(prism(ell()));
  EXPECT_EQ(a.point, b.point);
  ASSERT_EQ(a.edge.size(), b.edge.size());
  for (std::size_t e = 0; e < a.edge.size(); ++e) {
    EXPECT_EQ(a.edge[e].vertex, b.edge[e].vertex);
    EXPECT_EQ(a.edge[e].triangle, b.edge[e].triangle);
  }
}

TEST(BuildSolid, ShuffledMesh_GivesTheSameInvariants) {
  const PolygonMesh m = test::torus(9, 5, 2, 0.7);
  const Solid a = solid_of(m);
  for (unsigned seed = 0; seed < 4; ++seed) {
    const Solid b = solid_of(test::shuffled(m, seed));
    expect_consistent(b);
    EXPECT_EQ(edge_kinds(a), edge_kinds(b));
    EXPECT_EQ(a.facets, b.facets);
    EXPECT_EQ(std::count(a.vertex_degenerate.begin(), a.vertex_degenerate.end(), true),
              std::count(b.vertex_degenerate.begin(), b.vertex_degenerate.end(), true));
  }
}

// ---- Polygons

TEST(Polygon, NonConvexWithCollinearVertices_IsTriangulatedWithoutZeroArea) {
  // A comb with extra vertices on straight sides.
  const std::vector<std::pair<double, double>> comb = {
      {0, 0},   {1, 0}, {2, 0}, {3, 0},   {4, 0}, {4, 3}, {3, 3}, {3, 1},
      {2.5, 1}, {2, 1}, {2, 3}, {1.5, 3}, {1, 3}, {1, 2}, {1, 1}, {0, 1}};
  const PolygonMesh m = prism(comb);
  for (unsigned seed = 0; seed < 8; ++seed) {
    const PolygonMesh shuffled = test::shuffled(m, seed);
    EXPECT_EQ(test::defects_of(shuffled), "");
    const Solid s = solid_of(shuffled);
    expect_consistent(s);
    EXPECT_EQ(s.triangle.size(), 2 * (comb.size() - 2) + 2 * comb.size());
    EXPECT_EQ(s.facets, 2u + 10u);
    EXPECT_TRUE(s.warnings.empty());
  }
}

TEST(Polygon, RegularPrisms_AreAcceptedAtAnySize) {
  for (int n = 3; n <= 40; ++n) {
    std::vector<std::pair<double, double>> p;
    for (int k = 0; k < n; ++k) {
      const double a = 2 * std::numbers::pi * k / n;
      p.emplace_back(std::cos(a), std::sin(a));
    }
    const PolygonMesh m = prism(p);
    expect_consistent(solid_of(m));
  }
}

TEST(Polygon, StartOfTheFace_DoesNotMatter) {
  PolygonMesh m = prism(ell());
  const Solid a = solid_of(m);
  for (auto& f : m.faces) std::rotate(f.begin(), f.begin() + 2, f.end());
  const Solid b = solid_of(m);
  for (std::size_t t = 0; t < a.triangle.size(); ++t) {
    EXPECT_EQ(a.triangle[t].vertex, b.triangle[t].vertex);
  }
}

TEST(Polygon, NotPlanar_IsTriangulatedWithAWarningAndACount) {
  PolygonMesh m = box_mesh();
  m.points[7].z = up(1);
  EXPECT_EQ(test::defects_of(m), "non_planar_polygon:1");
  const Solid s = solid_of(m);
  ASSERT_EQ(s.warnings.size(), 1u);
  EXPECT_NE(s.warnings[0].find("1 polygon is not exactly planar"), std::string::npos);
  EXPECT_EQ(s.facets, 7u);
  // The faces x = 1 and y = 1 stay planar; lifting a corner sideways bends three.
  m.points[7] = {1.5, 1.25, 1.125};
  EXPECT_EQ(test::count_of(m, DefectKind::kNonPlanarPolygon), 3u);
}

TEST(Polygon, BadPolygons_AreNamed) {
  PolygonMesh bow_tie = box_mesh();
  std::swap(bow_tie.faces[1][0], bow_tie.faces[1][1]);
  EXPECT_EQ(test::count_of(bow_tie, DefectKind::kNonSimplePolygon), 1u);
  PolygonMesh repeated = box_mesh();
  repeated.faces[1].push_back(repeated.faces[1][1]);
  EXPECT_EQ(test::count_of(repeated, DefectKind::kDegenerateFace), 1u);
  PolygonMesh line;
  line.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  line.faces = {{0, 1, 2, 3}};
  EXPECT_EQ(test::count_of(line, DefectKind::kDegenerateFace), 1u);
  PolygonMesh spike;  // goes back along its own side
  spike.points = {{0, 0, 0}, {4, 0, 0}, {2, 0, 0}, {2, 2, 0}};
  spike.faces = {{0, 1, 2, 3}};
  EXPECT_EQ(test::count_of(spike, DefectKind::kNonSimplePolygon), 1u);
  PolygonMesh touch;  // a vertex on a side
  touch.points = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 0, 0}, {0, 4, 0}};
  touch.faces = {{0, 1, 2, 3, 4}};
  EXPECT_EQ(test::count_of(touch, DefectKind::kNonSimplePolygon), 1u);
  touch.points[3].y = 5e-324;
  EXPECT_EQ(test::count_of(touch, DefectKind::kNonSimplePolygon), 0u);
}

TEST(Polygon, DiagonalsThatCoincide_AreNonManifold) {
  // Two bent quads back to back over the same four corners, split along the same diagonal.
  PolygonMesh m;
  m.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}};
  m.faces = {{0, 1, 2, 3}, {3, 2, 1, 0}};
  EXPECT_FALSE(validate_mesh(m).valid());
  EXPECT_EQ(test::count_of(m, DefectKind::kDuplicateFace), 1u);
  EXPECT_EQ(test::count_of(m, DefectKind::kNonManifoldEdge), 1u);
}

TEST(Polygon, LargePolygon_IsFastEnough) {
  std::vector<std::pair<double, double>> star;
  for (int k = 0; k < 2000; ++k) {
    const double r = k % 2 ? 1 : 2, a = std::numbers::pi * k / 1000;
    star.emplace_back(r * std::cos(a), r * std::sin(a));
  }
  EXPECT_TRUE(build_solid(prism(star)).ok());
}

// ---- Frame

TEST(Frame, WorkingCoordinates_AreExactlyTheModels) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int round = 0; round < 200; ++round) {
    const double scale = std::ldexp(unit(random), static_cast<int>(random() % 300) - 150);
    const Point3 shift{unit(random) * scale * 100, unit(random), 0};
    const PolygonMesh m = test::mapped(test::tetrahedron(), [&](Point3 p) {
      return Point3{p.x * scale + shift.x, p.y * scale + shift.y, p.z * scale};
    });
    const auto s = build_solid(m);
    if (!s.ok()) continue;  // squashed by rounding
    expect_consistent(s.value());
    for (std::size_t v = 0; v < 4; ++v) {
      EXPECT_EQ(s.value().frame.to_model(s.value().point[v]), m.points[v]);
    }
  }
}

TEST(Frame, FarFromTheOrigin_IsTranslatedOnlyWhenExact) {
  const Solid far = solid_of(box_mesh({1000, 0, -1e6}, {1001, 1, -1e6 + 1}));
  EXPECT_NE(far.frame.origin.x, 0);
  EXPECT_EQ(far.frame.origin.y, 0);
  EXPECT_NE(far.frame.origin.z, 0);
  EXPECT_LE(far.frame.exponent, 1);
  const Solid near = solid_of(box_mesh({1, 0, 0}, {2, 1, 1}));
  EXPECT_EQ(near.frame.origin, (Point3{0, 0, 0}));
}

TEST(Frame, PowerOfTwoScaling_GivesTheSameWorkingCoordinates) {
  const PolygonMesh m = test::torus(6, 4, 2, 0.5);
  const Solid a = solid_of(m);
  for (const int k : {-200, -3, 5, 190}) {
    const Solid b = solid_of(test::mapped(m, [&](Point3 p) {
      return Point3{std::ldexp(p.x, k), std::ldexp(p.y, k), std::ldexp(p.z, k)};
    }));
    EXPECT_EQ(a.point, b.point);
    EXPECT_EQ(b.frame.exponent, a.frame.exponent + k);
    EXPECT_EQ(b.frame.length_to_model(1), std::ldexp(a.frame.length_to_model(1), k));
  }
}

TEST(Frame, LargestCoordinateAPowerOfTwo_BecomesOne) {
  const Solid s = solid_of(box_mesh({0, 0, 0}, {4, 1, 1}));
  EXPECT_EQ(s.frame.exponent, 2);
  EXPECT_EQ(s.point[1].x, 1.0);
}

TEST(Frame, CoordinateThatScalingWouldLose_IsAnError) {
  PolygonMesh m = test::tetrahedron({0, 0, 0}, 0x1p100);
  m.points[0].x = 3e-320;
  const auto s = build_solid(m);
  ASSERT_FALSE(s.ok());
  EXPECT_EQ(s.error().code, ErrorCode::kCoordinateOutOfRange);
  EXPECT_EQ(s.error().element, std::optional<std::size_t>(0));
}

}  // namespace
}  // namespace blum
