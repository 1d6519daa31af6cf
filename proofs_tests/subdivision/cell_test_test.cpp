// test_cell on boxes chosen by hand: every verdict occurs, for the reason it stands for.

#include "blum/subdivision/cell_test.hpp"

#include <gtest/gtest.h>

#include "blum/kernel/closest_point.hpp"
#include "blum/kernel/predicates.hpp"
#include "blum/subdivision/local_diagrams.hpp"
#include "subdivision/graph_components.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

using Faces = std::array<std::shared_ptr<const FaceDiagram>, 6>;

/// A solid with an engine; cells are given in model units.
struct Bench {
  explicit Bench(const PolygonMesh& mesh)
      : solid(test::solid_of(mesh)), geometry(solid), watch({}), engines(geometry, {}, watch) {
    for (std::uint32_t t = 0; t < solid.triangle.size(); ++t) triangles.push_back(t);
  }
  Bench(const Bench&) = delete;

  [[nodiscard]] Point3 to_working(const Point3& p) const { return solid.frame.to_working(p); }

  Faces faces(const Box3& box, std::vector<SiteId>& candidates) {
    candidates = engines.production().prune(geometry.candidates(), box.lo, box.hi);
    LocalDiagrams diagrams(engines.diagrams(), solid, candidates, triangles);
    Faces face;
    for (int f = 0; f < 6; ++f) {
      const auto k = static_cast<std::size_t>(f);
      face[k] = diagrams.face(box_face(box, f));
      if (face[k]->status != FaceStatus::kDecided)
        throw std::runtime_error("face in bad position: " + face[k]->reason);
    }
    return face;
  }

  /// planes: Theorem E may cut the cell.
  CellAnswer test(const Point3& lo, const Point3& hi, bool resolve = false, bool connected = true,
                  bool planes = false) {
    asked.clear();
    // Round numbers are in bad position.
    const Box3 box{to_working({lo.x - 1.1e-5, lo.y - 2.3e-5, lo.z - 3.7e-5}),
                   to_working({hi.x + 4.1e-5, hi.y + 5.9e-5, hi.z + 7.3e-5})};
    std::vector<SiteId> candidates;
    const Faces face = faces(box, candidates);
    CellOracles oracles;
    Predicates predicates(geometry);
    std::map<std::uint32_t, std::optional<Predicates::AxisAtVertex>> known;
    oracles.axis_at = [&](std::uint32_t v) -> const Predicates::AxisAtVertex* {
      asked.insert(v);
      const auto [it, fresh] = known.try_emplace(v);
      if (fresh) it->second = predicates.axis_at(v);
      return connected && it->second ? &*it->second : nullptr;
    };
    if (planes)
      oracles.section = [&](const CutPlane& plane) {
        return section_misses_axis(geometry, engines.production(), engines.inside(), plane, box,
                                   candidates, triangles);
      };
    return test_cell(geometry, box, candidates, triangles, face, oracles, resolve);
  }
  CellAnswer test_with_planes(const Point3& lo, const Point3& hi) {
    return test(lo, hi, false, true, true);
  }

  /// Of the axis on a small box about a vertex.
  std::size_t components_about(std::uint32_t vertex, double size) {
    return graph_about(vertex, size).count;
  }
  test::GraphComponents graph_about(std::uint32_t vertex, double size) {
    const Point3& p = solid.point[vertex];
    const double s = std::ldexp(size, -solid.frame.exponent);
    std::vector<SiteId> candidates;
    return test::graph_components(faces({{p.x - 0.97 * s, p.y - 1.01 * s, p.z - 1.04 * s},
                                         {p.x + 1.03 * s, p.y + 0.96 * s, p.z + 0.99 * s}},
                                        candidates));
  }

  std::uint32_t vertex_at(const Point3& model) const {
    for (std::uint32_t v = 0; v < solid.point.size(); ++v)
      if (solid.point[v] == to_working(model)) return v;
    throw std::runtime_error("no such vertex");
  }

  const Solid solid;
  const SiteGeometry geometry;
  RunWatch watch;
  EngineSet engines;
  std::vector<std::uint32_t> triangles;
  std::set<std::uint32_t> asked;  // vertices that the last test asked about
};

TEST(CellTest, CellInsideWithoutAxis_IsAccepted) {
  Bench b(shapes::cuboid(1, 1.25, 2));
  const CellAnswer a = b.test({0.02, 0.51, 0.9}, {0.21, 0.7, 1.1});
  EXPECT_EQ(a.verdict, CellVerdict::kAccepted);
  EXPECT_FALSE(a.has_axis);
  EXPECT_FALSE(a.conical);
}

TEST(CellTest, CellAcrossSheetOrSeamOrJunction_IsAcceptedResolvedToo) {
  Bench b(shapes::cuboid(1, 1.25, 2));
  for (const auto& [lo, hi] : {std::pair{Point3{0.4, 0.55, 0.9}, Point3{0.61, 0.7, 1.1}},
                               {{0.4, 0.41, 0.9}, {0.61, 0.56, 1.1}},
                               {{0.4, 0.41, 0.41}, {0.61, 0.56, 0.61}}}) {
    const CellAnswer a = b.test(lo, hi, true);
    EXPECT_EQ(a.verdict, CellVerdict::kAccepted);
    EXPECT_TRUE(a.has_axis);
  }
}

TEST(CellTest, CellAcrossThinWall_IsAccepted) {
  // The part of the solid in the cell is a slab between two boundary faces.
  Bench b(shapes::cuboid(1, 1.25, 0x1p-6));
  const CellAnswer a = b.test({0.3, 0.4, -0.21}, {0.6, 0.69, 0.22}, true);
  EXPECT_EQ(a.verdict, CellVerdict::kAccepted);
  EXPECT_TRUE(a.has_axis);
}

TEST(CellTest, CellAcrossBothArmsOfAPocket_TakesComponentsOneByOne) {
  Bench b(shapes::lpocket());
  const CellAnswer a = b.test({-0.13, 1.2, 1.61}, {4.12, 1.4, 1.8});
  EXPECT_EQ(a.verdict, CellVerdict::kAccepted);
  EXPECT_TRUE(a.has_axis);
}

TEST(CellTest, CellAboutConvexCorner_IsConical) {
  Bench b(shapes::cuboid(1, 1.25, 2));
  const CellAnswer a = b.test({-0.21, -0.18, -0.22}, {0.2, 0.23, 0.19});
  EXPECT_EQ(a.verdict, CellVerdict::kAccepted);
  EXPECT_TRUE(a.conical);
  EXPECT_EQ(a.vertex, b.vertex_at({0, 0, 0}));
  EXPECT_TRUE(a.has_axis);
  EXPECT_TRUE(b.asked.empty());
}

TEST(CellTest, TwoSheetsThatMeetBesideTheCell_AreJoinedByACurvedCut) {
  Bench b(shapes::cuboid(1, 1.25, 2));
  const CellAnswer a = b.test({-0.0466, 0.41626, -0.017334}, {0.25415, 0.9729, 2.0686});
  EXPECT_EQ(a.verdict, CellVerdict::kAccepted);
  EXPECT_TRUE(a.curved_cut);
}

TEST(CellTest, CellAroundWholeSolid_HasShellInside) {
  for (const PolygonMesh& mesh : {shapes::cuboid(1, 1.25, 2), shapes::prism(5)}) {
    Bench b(mesh);
    EXPECT_EQ(b.test({-1.51, -1.52, -0.53}, {1.54, 1.55, 2.56}).verdict, CellVerdict::kShellInside);
  }
}

TEST(CellTest, CellAroundVoid_HasShellInside) {
  Bench b(test::thin_walled_box(8, 8, 8, 3));
  EXPECT_EQ(b.test({1.1, 1.2, 1.15}, {6.8, 6.9, 6.85}).verdict, CellVerdict::kShellInside);
}

TEST(CellTest, CellAroundTunnel_IsNoBall) {
  Bench b(shapes::plate(1, 6));
  // Within the plate's thickness, across it, and with a part of its outer walls.
  EXPECT_EQ(b.test({0.25, 0.26, 0.11}, {1.76, 1.73, 0.39}).verdict, CellVerdict::kEuler);
  EXPECT_EQ(b.test({0.25, 0.26, -0.11}, {1.76, 1.73, 0.61}).verdict, CellVerdict::kEuler);
  EXPECT_EQ(b.test({-0.11, -0.12, 0.11}, {2.13, 2.14, 0.39}).verdict, CellVerdict::kEuler);
  EXPECT_EQ(b.test({-0.11, -0.12, -0.11}, {2.13, 2.14, 0.39}).verdict, CellVerdict::kEuler);
}

TEST(CellTest, VertexWhereTheAxisMayFallApart_IsRefusedUnlessConnectedThere) {
  Bench b(shapes::lbracket());
  const Point3 lo{0.55, 0.6, -0.31}, hi{1.41, 1.52, 0.52};
  EXPECT_EQ(b.test(lo, hi, false, true).verdict, CellVerdict::kAccepted);
  EXPECT_EQ(b.asked, (std::set<std::uint32_t>{b.vertex_at({1, 1, 0})}));
  EXPECT_EQ(b.test(lo, hi, false, false).verdict, CellVerdict::kVertex);
}

TEST(CellTest, PlateWithHole_AsksAboutItsMixedVerticesOnly) {
  Bench b(shapes::plate(1, 6));
  const Point3 lo{-0.0642, -0.029, 0.12915}, hi{2.055, 2.16626, 0.513916};
  EXPECT_EQ(b.test(lo, hi, false, true).verdict, CellVerdict::kEuler);
  EXPECT_EQ(b.asked.size(), 6u);
  EXPECT_EQ(b.test(lo, hi, false, false).verdict, CellVerdict::kVertex);
  EXPECT_EQ(b.asked.size(), 6u);
}

TEST(CellTest, GraphInPieces_IsRefused) {
  Bench pocket(shapes::lpocket()), voids(shapes::nested_voids(1));
  EXPECT_EQ(pocket.test({0.98877, 0.324707, 0.941895}, {1.55908, 3.58643, 2.67627}).verdict,
            CellVerdict::kGraph);
  EXPECT_EQ(voids.test({-1.75342, -2.21826, -2.4917}, {2.10596, 1.93018, 1.11768}).verdict,
            CellVerdict::kGraph);
}

/// Refused for its graph, unless planes may cut it.
CellAnswer cut_only_by_planes(Bench& b, const Point3& lo, const Point3& hi) {
  const CellAnswer without = b.test(lo, hi);
  EXPECT_EQ(without.verdict, CellVerdict::kGraph);
  EXPECT_TRUE(without.cut.empty());
  EXPECT_EQ(without.planes_tried, 0);
  const CellAnswer with = b.test_with_planes(lo, hi);
  EXPECT_EQ(with.verdict, CellVerdict::kAccepted);
  EXPECT_FALSE(with.cut.empty());
  EXPECT_FALSE(with.curved_cut);
  return with;
}

TEST(CellTest, SheetsApartInsideTheSolid_ArePartedByAPlane) {
  // Under the floor of the pocket; the cell meets no boundary.
  Bench b(shapes::lpocket());
  cut_only_by_planes(b, {0.684, 0.464, 0.822}, {2.051, 2.97, 0.822});
  cut_only_by_planes(b, {1.212, 1.254, 0.688}, {3.932, 2.291, 0.69});
}

TEST(CellTest, SheetsApartInABoundaryCell_ArePartedByAPlane) {
  Bench pocket(shapes::lpocket()), voids(shapes::nested_voids(1));
  cut_only_by_planes(pocket, {0.495, 1.161, 0.777}, {3.764, 3.174, 1.939});
  cut_only_by_planes(voids, {-1.697, -0.496, -2.421}, {1.913, 1.811, 0.26});
}

TEST(CellTest, SheetsApartAcrossTheRegionOfAReflexEdge_AreJoinedByTheFlow) {
  // All directions from feet on the edge point out of one side of the cell.
  Bench plate(shapes::plate(1, 6));
  const CellAnswer a = plate.test({0.402, 0.818, 0.173}, {1.481, 1.38, 0.546});
  EXPECT_EQ(a.verdict, CellVerdict::kAccepted);
  EXPECT_TRUE(a.curved_cut);
}

TEST(CellTest, SitesThatGovernTwoParts_AreNotCutByPlanes) {
  // A tube of one region goes through the cell: every plane between its ends meets its wall.
  Bench box(shapes::cuboid(1, 1.25, 2));
  const CellAnswer a =
      box.test_with_planes({0.506104, 0.275635, 0.045166}, {1.08032, 1.28931, 1.93579});
  EXPECT_EQ(a.verdict, CellVerdict::kLabel);
  EXPECT_EQ(a.planes_tried, 0);
}

TEST(CellTest, SiteOnBothSidesOfAHiddenPart_IsRefused) {
  Bench box(shapes::cuboid(1, 1.25, 2)), cube(shapes::cuboid(1, 1, 1));
  EXPECT_EQ(box.test({0.506104, 0.275635, 0.045166}, {1.08032, 1.28931, 1.93579}).verdict,
            CellVerdict::kLabel);
  EXPECT_EQ(cube.test({0.506958, 0.220825, 0.022583}, {1.08118, 1.03235, 0.967896}).verdict,
            CellVerdict::kLabel);
}

TEST(CellTest, VertexWhereTheAxisFallsApart_IsSplit) {
  // About the upper apex of the void, and across the sheet half way to the outer wall.
  const Point3 lo{-0.75, -0.625, 4}, hi{1, 1.125, 8.5};
  for (const int points : {3, 4, 5}) {
    Bench b(test::star_void(points));
    EXPECT_EQ(b.test(lo, hi, false, false).verdict, CellVerdict::kVertex);
    const CellAnswer a = b.test(lo, hi);
    // The sheets do not meet in the cell; with four of them paths that the flow never meets join
    // all.
    EXPECT_EQ(a.verdict, points == 4 ? CellVerdict::kAccepted : CellVerdict::kGraph) << points;
    EXPECT_FALSE(a.conical);
    EXPECT_TRUE(b.asked.contains(b.vertex_at({0.125, 0.25, 4.5})));
  }
}

TEST(CellTest, DegenerateJunction_IsAClusterOnlyWhenResolving) {
  Bench cube(shapes::cuboid(1, 1, 1));
  const Point3 lo{0.39, 0.42, 0.37}, hi{0.63, 0.6, 0.61};
  EXPECT_EQ(cube.test(lo, hi, false).verdict, CellVerdict::kAccepted);
  EXPECT_EQ(cube.test(lo, hi, true).verdict, CellVerdict::kCluster);
}

TEST(CellTest, TwoJunctionsInACell_AreAClusterOnlyWhenResolving) {
  Bench box(shapes::cuboid(1, 1.25, 2));
  const Point3 lo{0.3, 0.31, 0.32}, hi{0.7, 0.93, 0.69};
  EXPECT_EQ(box.test(lo, hi, false).verdict, CellVerdict::kAccepted);
  EXPECT_EQ(box.test(lo, hi, true).verdict, CellVerdict::kCluster);
}

TEST(CellTest, WholeRuns_MeetEveryVerdictButFace) {
  std::array<std::size_t, 8> met{};
  for (const test::Scene& scene : test::scenes()) {
    SubdivisionOptions o = test::seeded(1, 0.25 * test::extent(scene.mesh.points));
    o.resolve = true;
    o.split_vertices = false;  // else hardly a vertex is refused
    const test::Subdivided run(scene.mesh, o);
    ASSERT_TRUE(run.result.ok());
    std::size_t tested = 0;
    for (std::size_t k = 0; k < met.size(); ++k) {
      met[k] += run.tree().stats.rejected[k];
      tested += run.tree().stats.rejected[k];
    }
    EXPECT_EQ(tested, run.tree().stats.cells_tested);
  }
  for (std::size_t k = 0; k < met.size(); ++k)
    if (k != static_cast<std::size_t>(CellVerdict::kFace)) EXPECT_GT(met[k], 0u) << k;
}

TEST(AxisAtVertex, StarApex_FallsApartIntoOneSheetPerConvexEdge) {
  for (const int points : {3, 4, 5}) {
    Bench b(test::star_void(points));
    for (const double z : {4.5, -3.5}) {
      const auto v = b.vertex_at({0.125, 0.25, z});
      EXPECT_FALSE(b.solid.vertex_degenerate[v]);
      EXPECT_EQ(b.components_about(v, 0.05), static_cast<std::size_t>(points));
    }
  }
}

/// Two blocks in a row, the roof of one of them steeper: at (1, 0, 1) two convex edges go straight
/// on, a reflex one goes down, and the polar cone is a sector of the plane between the blocks.
PolygonMesh steps() {
  PolygonMesh m;
  m.points = {{0, -1, 0},   {1, -1, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {0, -1, 0.5},
              {1, -1, 0.5}, {1, 0, 1},  {2, 0, 1}, {2, 1, 1}, {0, 1, 1}, {0, 0, 1}};
  m.faces = {{5, 4, 3, 2, 1, 0}, {0, 1, 7, 6},      {1, 2, 8, 7},  {2, 3, 9, 8},      {3, 4, 10, 9},
             {4, 5, 11, 10},     {5, 0, 6, 12, 11}, {6, 7, 8, 12}, {12, 8, 9, 10, 11}};
  return m;
}

TEST(AxisAtVertex, PlaneSectorOutsideTheSolid_HoldsNoFeet) {
  Bench b(steps());
  const auto v = b.vertex_at({1, 0, 1});
  Predicates predicates(b.geometry);
  EXPECT_TRUE(b.solid.vertex_degenerate[v]);
  EXPECT_EQ(predicates.foot_cone(v), Predicates::FootCone::kNone);
  ASSERT_TRUE(predicates.axis_at(v));
  EXPECT_EQ(predicates.axis_at(v)->trees, 1u);
  EXPECT_EQ(b.components_about(v, 0.02), 1u);
}

TEST(AxisAtVertex, PlaneSectorInsideTheSolid_MayHoldFeet) {
  PolygonMesh m = shapes::cuboid(5, 6, 7);
  for (Point3& p : m.points) p = {p.x - 1.5, p.y - 3, p.z - 3.25};
  const auto base = static_cast<std::uint32_t>(m.points.size());
  PolygonMesh hole = steps();
  m.points.insert(m.points.end(), hole.points.begin(), hole.points.end());
  for (auto f : hole.faces) {
    for (auto& p : f) p += base;
    m.faces.emplace_back(f.rbegin(), f.rend());
  }
  Bench b(m);
  const auto v = b.vertex_at({1, 0, 1});
  Predicates predicates(b.geometry);
  EXPECT_TRUE(b.solid.vertex_degenerate[v]);
  EXPECT_EQ(predicates.foot_cone(v), Predicates::FootCone::kWide);
  EXPECT_FALSE(predicates.axis_at(v));
  // Points straight above the vertex are as near to it as to anything.
  std::vector<SiteId> governors;
  predicates.governors(b.to_working({1, -0.0625, 1.25}), b.geometry.candidates(), governors);
  const Point3 x = b.to_working({1, -0.0625, 1.25}), &p = b.solid.point[v];
  const double square =
      (x.x - p.x) * (x.x - p.x) + (x.y - p.y) * (x.y - p.y) + (x.z - p.z) * (x.z - p.z);
  for (const SiteId s : governors) {
    const Point3 y = closest_point(b.geometry, s, x);
    EXPECT_NEAR(std::hypot(y.x - p.x, y.y - p.y, y.z - p.z), 0, 1e-12) << square;
  }
  EXPECT_FALSE(governors.empty());
}

TEST(AxisAtVertex, SaddleWithoutRoomBehindIt_IsConnected) {
  Bench b(test::saddle_roof());
  const auto v = b.vertex_at({0, 0, 3});
  std::map<EdgeKind, int> kinds;
  for (const auto e : b.solid.edges_at(v)) ++kinds[b.solid.edge[e].kind];
  EXPECT_GE(kinds[EdgeKind::kConvex], 2);
  EXPECT_GE(kinds[EdgeKind::kReflex], 2);
  EXPECT_TRUE(b.solid.vertex_degenerate[v]);
  EXPECT_EQ(b.components_about(v, 0.02), 1u);
}

TEST(AxisAtVertex, PocketFloorCorner_IsConnectedIfItHasOneSheetOnly) {
  Bench b(shapes::lpocket());
  // Reflex corner of the floor: one convex edge, so one sheet, whose rim runs down.
  EXPECT_EQ(b.components_about(b.vertex_at({2, 2, 1}), 0.02), 1u);
  // Ordinary corner of the floor: reflex edges only, no sheet.
  EXPECT_EQ(b.components_about(b.vertex_at({1, 1, 1}), 0.02), 0u);
}

/// A column with a random top: vertices with convex and reflex edges of all sorts.
PolygonMesh random_column(unsigned seed, std::uint32_t n) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> height(1, 2);
  PolygonMesh m;
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x)
      m.points.push_back({static_cast<double>(x), static_cast<double>(y), height(random)});
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x)
      m.points.push_back({static_cast<double>(x), static_cast<double>(y), -4});
  const auto top = [n](std::uint32_t x, std::uint32_t y) { return y * n + x; };
  const auto bottom = [n](std::uint32_t x, std::uint32_t y) { return n * n + y * n + x; };
  for (std::uint32_t y = 0; y + 1 < n; ++y)
    for (std::uint32_t x = 0; x + 1 < n; ++x) {
      const auto a = top(x, y), b = top(x + 1, y), c = top(x + 1, y + 1), d = top(x, y + 1);
      if (random() % 2 == 0) {
        m.faces.push_back({a, b, c});
        m.faces.push_back({a, c, d});
      } else {
        m.faces.push_back({a, b, d});
        m.faces.push_back({b, c, d});
      }
      m.faces.push_back({bottom(x, y), bottom(x, y + 1), bottom(x + 1, y + 1), bottom(x + 1, y)});
    }
  for (std::uint32_t k = 0; k + 1 < n; ++k) {
    const std::uint32_t e = n - 1;
    m.faces.push_back({top(k + 1, 0), top(k, 0), bottom(k, 0), bottom(k + 1, 0)});
    m.faces.push_back({top(k, e), top(k + 1, e), bottom(k + 1, e), bottom(k, e)});
    m.faces.push_back({top(0, k), top(0, k + 1), bottom(0, k + 1), bottom(0, k)});
    m.faces.push_back({top(e, k + 1), top(e, k), bottom(e, k), bottom(e, k + 1)});
  }
  return m;
}

TEST(AxisAtVertex, SignsOnThePolarCone_AgreeWithTheGraphOnASmallBox) {
  std::vector<PolygonMesh> meshes = {shapes::lbracket(),
                                     shapes::lpocket(),
                                     test::saddle_roof(),
                                     shapes::torus(6, 5, 2, 0.7),
                                     shapes::plate(1, 5),
                                     test::star_void(3),
                                     test::star_void(4, 1),
                                     test::star_void(5, 8),
                                     shapes::rotate_rounded(shapes::lpocket(), 3)};
  for (unsigned seed = 0; seed < 12; ++seed) meshes.push_back(random_column(seed, 5));
  std::array<std::size_t, 2> met{};
  std::size_t compared = 0, skipped = 0;
  for (const PolygonMesh& mesh : meshes) {
    Bench b(mesh);
    Predicates predicates(b.geometry);
    for (std::uint32_t v = 0; v < b.solid.point.size(); ++v) {
      bool convex = false, reflex = false;
      for (const auto e : b.solid.edges_at(v)) {
        convex |= b.solid.edge[e].kind == EdgeKind::kConvex;
        reflex |= b.solid.edge[e].kind == EdgeKind::kReflex;
      }
      if (!convex || !reflex) continue;
      test::GraphComponents graph;
      try {
        graph = b.graph_about(v, 0.01);
      } catch (const std::runtime_error&) {
        ++skipped;  // bad position
        continue;
      }
      ++compared;
      ++met[graph.count > 1 ? 1 : 0];
      const auto axis = predicates.axis_at(v);
      if (!axis) continue;
      EXPECT_EQ(axis->trees, graph.count) << "vertex " << v;
      const auto edges = b.solid.edges_at(v);
      for (std::size_t k = 0; k < edges.size(); ++k)
        for (std::size_t l = 0; l < k; ++l)
          if (graph.of_edge.contains(edges[k]) && graph.of_edge.contains(edges[l]))
            EXPECT_EQ(axis->tree[k] == axis->tree[l],
                      graph.of_edge.at(edges[k]) == graph.of_edge.at(edges[l]))
                << "vertex " << v << ", edges " << edges[k] << " and " << edges[l];
    }
  }
  EXPECT_LT(20 * skipped, compared);
  EXPECT_GT(met[0], 100u);
  EXPECT_GT(met[1], 10u);
}

}  // namespace
}  // namespace blum
