// The Voronoi diagram of all sites in a box: certificate, Euler's formula, criteria, graph.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>

#include "arrangement/cube_minus_octant.hpp"
#include "blum/kernel/shapes.hpp"
#include "blum/medial/graph.hpp"
#include "blum/medial/medial_axis.hpp"
#include "blum/medial/summary.hpp"
#include "medial/axis_tools.hpp"

namespace blum {
namespace {

PolygonMesh tetrahedron() {
  return {{{0, 0, 0}, {3, 0, 1}, {1, 3, 0}, {1, 1, 3}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

struct Case {
  const char* name;
  PolygonMesh mesh;
  std::size_t sites;
};

/// Solids that take well under a second.
std::vector<Case> quick() {
  return {{"cuboid", shapes::cuboid(2, 3, 1), 32},
          {"lbracket", shapes::lbracket(), 48},
          {"prism", shapes::prism(6), 50},
          {"tetrahedron", tetrahedron(), 14},
          {"void", shapes::nested_voids(1), 64}};
}

Solid solid_of(const PolygonMesh& mesh) { return build_solid(mesh).value(); }

MedialResult diagram(const Solid& solid, std::uint64_t seed,
                     Criterion criterion = Criterion::kRelaxed,
                     Engine engine = Engine::kProduction) {
  MedialOptions o;
  o.seed = seed;
  o.criterion = criterion;
  o.engine = engine;
  o.threads = 2;
  return test::voronoi_of(solid, o);
}

void expect_certified(const MedialResult& r) {
  EXPECT_TRUE(r.certified) << r.undecided.size() << " undecided";
  ASSERT_TRUE(r.voronoi.has_value());
  EXPECT_TRUE(r.voronoi->decided);
  // Euler's formula in the box, and the Euler characteristic by homology.
  EXPECT_EQ(r.voronoi->euler, 1 + static_cast<long>(r.voronoi->regions) - r.voronoi->pieces_euler);
  EXPECT_EQ(r.betti[0] - r.betti[1] + r.betti[2], r.voronoi->euler);
  EXPECT_EQ(r.betti[0], 1);  // every bounded region's border meets another's
}

TEST(Voronoi, QuickSolids_AreCertifiedAndEulersFormulaHolds) {
  for (const Case& c : quick())
    for (const std::uint64_t seed : {1, 2}) {
      SCOPED_TRACE(std::string(c.name) + ", seed " + std::to_string(seed));
      const MedialResult r = diagram(solid_of(c.mesh), seed);
      expect_certified(r);
      EXPECT_EQ(r.voronoi->regions, c.sites);
    }
}

TEST(Voronoi, EdgesFlatButForRounding_AreCertified) {
  for (const auto& mesh : {shapes::rotate_rounded(shapes::cuboid(2, 3, 1), 1),
                           shapes::rotate_rounded(shapes::prism(6), 2)})
    expect_certified(diagram(solid_of(mesh), 1));
}

TEST(Voronoi, EveryCriterion_GivesTheSameHomology) {
  for (const PolygonMesh& mesh : {tetrahedron(), shapes::cuboid(2, 3, 1), shapes::lbracket()}) {
    const Solid solid = solid_of(mesh);
    const MedialResult relaxed = diagram(solid, 3), disks = diagram(solid, 3, Criterion::kDisks);
    expect_certified(disks);
    EXPECT_EQ(relaxed.betti, disks.betti);
    EXPECT_LE(relaxed.leaves, disks.leaves);
  }
}

TEST(Voronoi, StrictCriterion_GivesTheSameHomologyWithFarMoreLeaves) {
  const Solid solid = solid_of(tetrahedron());
  const MedialResult strict = diagram(solid, 1, Criterion::kStrict), relaxed = diagram(solid, 1);
  expect_certified(strict);
  EXPECT_EQ(strict.betti, relaxed.betti);
  EXPECT_GT(strict.leaves, 100 * relaxed.leaves);
}

TEST(Voronoi, ExactEngine_GivesTheSameHomology) {
  const Solid solid = solid_of(tetrahedron());
  const MedialResult exact = diagram(solid, 1, Criterion::kRelaxed, Engine::kBrute);
  expect_certified(exact);
  EXPECT_EQ(exact.betti, diagram(solid, 1).betti);
}

TEST(Voronoi, AnyNumberOfThreads_GivesTheSameComplex) {
  const Solid solid = solid_of(shapes::lbracket());
  MedialOptions o;
  o.threads = 1;
  const auto one = compute_voronoi_diagram(solid, o);
  o.threads = 3;
  const auto three = compute_voronoi_diagram(solid, o);
  ASSERT_TRUE(one && three);
  EXPECT_EQ(test::difference(one.value().complex, three.value().complex), "");
}

TEST(Voronoi, VerticesOnTheDiagram_AreAtTheSameDistanceFromTwoSites) {
  const Solid solid = solid_of(shapes::lbracket());
  const MedialResult r = diagram(solid, 1);
  std::size_t on = 0;
  for (const ComplexVertex& v : r.complex.vertex) {
    if (!v.on_axis) continue;
    ++on;
    EXPECT_GE(v.governors.size(), 2u);
  }
  EXPECT_GT(2 * on, r.complex.vertex.size());
}

TEST(Voronoi, SheetsOfTheGraph_HaveTwoGovernorsAndSeamsMore) {
  const Solid solid = solid_of(shapes::lbracket());
  const MedialResult r = diagram(solid, 1);
  const DiagramGraph graph = read_graph(r);
  std::vector<int> degree(graph.node.size(), 0);
  for (const auto& [a, b] : graph.arc) {
    EXPECT_NE(graph.node[a].kind, graph.node[b].kind);
    ++degree[a];
    ++degree[b];
  }
  std::map<GraphNode::Kind, std::size_t> count;
  for (std::size_t n = 0; n < graph.node.size(); ++n) {
    const GraphNode& node = graph.node[n];
    ++count[node.kind];
    if (node.kind == GraphNode::Kind::kFace) {
      EXPECT_EQ(node.governors.size(), 2u);
    } else {
      EXPECT_GE(node.governors.size(), 3u);
      EXPECT_GE(degree[n], 3);
    }
    EXPECT_EQ(node.position.has_value(),
              node.kind == GraphNode::Kind::kVertex || node.kind == GraphNode::Kind::kSubgraph);
  }
  EXPECT_EQ(count[GraphNode::Kind::kFace], r.parts.sheets);
  EXPECT_EQ(count[GraphNode::Kind::kEdge], r.parts.seams);
  const auto json = nlohmann::json::parse(graph_json(graph, solid));
  EXPECT_EQ(json["nodes"].size(), graph.node.size());
  EXPECT_EQ(json["arcs"].size(), graph.arc.size());
  const std::string xml = graph_graphml(graph, solid);
  std::size_t edges = 0;
  for (std::size_t at = xml.find("<edge "); at != std::string::npos;
       at = xml.find("<edge ", at + 1))
    ++edges;
  EXPECT_EQ(edges, graph.arc.size());
}

TEST(Voronoi, Summary_HoldsWhatChecksTheFormula) {
  const Solid solid = solid_of(tetrahedron());
  const MedialResult r = diagram(solid, 1);
  SummaryInput input;
  input.solid = &solid;
  input.result = &r;
  const auto json = nlohmann::json::parse(summary_json(input));
  EXPECT_EQ(json["result"]["mode"], "voronoi");
  EXPECT_EQ(json["voronoi"]["regions"], 14);
  EXPECT_EQ(json["voronoi"]["euler"].get<long>(),
            1 + 14 - json["voronoi"]["pieces_euler"].get<long>());
}

TEST(Voronoi, MarginThatIsNotPositive_IsRefused) {
  MedialOptions o;
  o.margin = 0;
  const auto r = compute_voronoi_diagram(solid_of(tetrahedron()), o);
  ASSERT_FALSE(r);
  EXPECT_EQ(r.error().code, ErrorCode::kBadArgument);
}

TEST(Voronoi, EngineOfMedialAxesOnly_IsRefused) {
  MedialOptions o;
  o.engine = Engine::kCgal;
  const auto r = compute_voronoi_diagram(solid_of(tetrahedron()), o);
  ASSERT_FALSE(r);
  EXPECT_EQ(r.error().code, ErrorCode::kBadArgument);
}

void sweep(const PolygonMesh& mesh) {
  const Solid solid = solid_of(mesh);
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_certified(diagram(solid, seed));
  }
}

TEST(SweepVoronoi, QuickSolids_AreCertified) {
  for (const Case& c : quick()) {
    SCOPED_TRACE(c.name);
    sweep(c.mesh);
  }
}
TEST(SweepVoronoi, CubeMinusOctant_IsCertified) { sweep(test::cube_minus_octant()); }
TEST(SweepVoronoi, Plate_IsCertified) { sweep(shapes::plate(2, 6)); }
TEST(SweepVoronoi, Torus_IsCertified) { sweep(shapes::planar_torus(8, 4, 2, 0.75)); }
TEST(SweepVoronoi, RoundedTorus_IsCertified) { sweep(shapes::torus(8, 4, 2, 0.75)); }
TEST(SweepVoronoi, TurnedSolids_AreCertified) {
  for (const auto& mesh : {shapes::cuboid(2, 3, 1), shapes::prism(6), shapes::nested_voids(1)})
    for (const std::uint64_t turn : {1, 2, 3}) sweep(shapes::rotate_rounded(mesh, turn));
}
TEST(SweepVoronoi, TurnedBracket_IsCertified) {
  sweep(shapes::rotate_rounded(shapes::lbracket(), 3));
}
TEST(SweepVoronoi, Spoon_IsCertified) { sweep(shapes::spoon()); }

}  // namespace
}  // namespace blum
