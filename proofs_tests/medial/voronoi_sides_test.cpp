// Voronoi diagrams inside and outside the solid: homology, and how the two make up the whole.
#include <gtest/gtest.h>

#include "arrangement/cube_minus_octant.hpp"
#include "blum/kernel/inside.hpp"
#include "blum/kernel/shapes.hpp"
#include "blum/medial/medial_axis.hpp"
#include "medial/axis_tools.hpp"

namespace blum {
namespace {

Solid solid_of(const PolygonMesh& mesh) { return build_solid(mesh).value(); }

PolygonMesh tetrahedron() {
  return {{{0, 0, 0}, {3, 0, 1}, {1, 3, 0}, {1, 1, 3}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

MedialResult diagram(const Solid& solid, VoronoiSide side, std::uint64_t seed = 1,
                     Engine engine = Engine::kProduction, int threads = 2) {
  MedialOptions o;
  o.side = side;
  o.seed = seed;
  o.engine = engine;
  o.threads = threads;
  return test::voronoi_of(solid, o);
}

long euler_of(const std::array<long, 3>& betti) { return betti[0] - betti[1] + betti[2]; }

/// Edges and vertices whose regions lie inside: counted by hand for the solids below.
void expect_sides(const PolygonMesh& mesh, std::uint64_t seed, long reflex) {
  const Solid solid = solid_of(mesh);
  const MedialResult in = diagram(solid, VoronoiSide::kInside, seed),
                     out = diagram(solid, VoronoiSide::kOutside, seed),
                     both = diagram(solid, VoronoiSide::kBoth, seed);
  for (const MedialResult* r : {&in, &out, &both}) {
    ASSERT_TRUE(r->certified) << r->undecided.size() << " undecided";
    EXPECT_EQ(euler_of(r->betti), r->voronoi->euler);
    EXPECT_TRUE(r->voronoi->holds());
  }
  // Inside: the solid with a void for every region of an edge or vertex there.
  const std::array<long, 3> expected{solid.betti()[0], solid.betti()[1], solid.betti()[2] + reflex};
  EXPECT_EQ(in.betti, expected);
  // The two have the edges of the triangulation in common.
  const long skeleton =
      static_cast<long>(solid.point.size()) - static_cast<long>(solid.edge.size());
  EXPECT_EQ(in.voronoi->euler + out.voronoi->euler - skeleton, both.voronoi->euler);
  // Shells that bound different components of the complement.
  EXPECT_EQ(out.betti[0], 1 + solid.betti()[2]);
}

struct Case {
  const char* name;
  PolygonMesh mesh;
  long reflex;  // regions inside: of reflex edges and of vertices with none but reflex edges
};

std::vector<Case> quick() {
  return {{"tetrahedron", tetrahedron(), 0},
          {"cuboid", shapes::cuboid(2, 3, 1), 0},
          {"lbracket", shapes::lbracket(), 1},
          {"prism", shapes::prism(6), 0},
          {"void", shapes::nested_voids(1), 20}};
}

TEST(VoronoiSides, QuickSolids_HaveTheHomologyOfTheSolidWithVoids) {
  for (const Case& c : quick()) {
    SCOPED_TRACE(c.name);
    expect_sides(c.mesh, 1, c.reflex);
  }
}

TEST(VoronoiSides, VerticesOfOneSide_LieOnIt) {
  const Solid solid = solid_of(shapes::lbracket());
  const InsideOracle inside(solid);
  for (const VoronoiSide side : {VoronoiSide::kInside, VoronoiSide::kOutside}) {
    const MedialResult r = diagram(solid, side, 2);
    std::size_t off = 0, on = 0;
    for (const ComplexVertex& v : r.complex.vertex) {
      if (!v.on_axis) continue;
      EXPECT_FALSE(v.governors.empty());
      if (v.radius < 1e-9) {
        ++on;  // on an edge of the solid
        continue;
      }
      const auto where = inside.locate(solid.frame.to_working(v.position));
      EXPECT_EQ(where, side == VoronoiSide::kInside ? InsideOracle::Where::kInside
                                                    : InsideOracle::Where::kOutside);
      ++off;
    }
    EXPECT_GT(off, 20u);
    EXPECT_GT(on, 5u);
  }
}

TEST(VoronoiSides, EveryCriterion_GivesTheSameHomology) {
  const Solid solid = solid_of(tetrahedron());
  for (const VoronoiSide side : {VoronoiSide::kInside, VoronoiSide::kOutside}) {
    const auto expected = diagram(solid, side).betti;
    for (const Criterion c : {Criterion::kDisks, Criterion::kStrict}) {
      MedialOptions o;
      o.side = side;
      o.criterion = c;
      o.threads = 2;
      const auto r = compute_voronoi_diagram(solid, o);
      ASSERT_TRUE(r && r.value().certified);
      EXPECT_EQ(r.value().betti, expected);
    }
  }
}

TEST(VoronoiSides, AnyNumberOfThreads_GivesTheSameComplex) {
  const Solid solid = solid_of(shapes::lbracket());
  const auto one = diagram(solid, VoronoiSide::kOutside, 1, Engine::kProduction, 1),
             three = diagram(solid, VoronoiSide::kOutside, 1, Engine::kProduction, 3);
  EXPECT_EQ(test::difference(one.complex, three.complex), "");
}

TEST(VoronoiSides, NoVertex_IsLeftWithoutAnEdge) {
  const MedialResult r = diagram(solid_of(tetrahedron()), VoronoiSide::kInside);
  std::vector<bool> used(r.complex.vertex.size(), false);
  for (const ComplexEdge& e : r.complex.edge)
    for (const auto v : e.vertex) used[v] = true;
  for (const bool u : used) EXPECT_TRUE(u);
}

void sweep(const PolygonMesh& mesh, long reflex) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_sides(mesh, seed, reflex);
  }
}

TEST(SweepVoronoiSides, QuickSolids_HaveTheHomologyOfTheSolidWithVoids) {
  for (const Case& c : quick()) {
    SCOPED_TRACE(c.name);
    sweep(c.mesh, c.reflex);
  }
}
TEST(SweepVoronoiSides, ExactEngine_GivesTheSameHomology) {
  const Solid solid = solid_of(tetrahedron());
  for (const VoronoiSide side : {VoronoiSide::kInside, VoronoiSide::kOutside}) {
    const MedialResult exact = diagram(solid, side, 1, Engine::kBrute);
    EXPECT_TRUE(exact.certified);
    EXPECT_EQ(exact.betti, diagram(solid, side).betti);
  }
}
TEST(SweepVoronoiSides, CubeMinusOctant_HasFourVoids) { sweep(test::cube_minus_octant(), 4); }
TEST(SweepVoronoiSides, Plate_HasAVoidForEveryReflexEdge) { sweep(shapes::plate(2, 6), 12); }
TEST(SweepVoronoiSides, Torus_HasAVoidForEveryReflexEdge) {
  sweep(shapes::planar_torus(8, 4, 2, 0.75), 16);
}

}  // namespace
}  // namespace blum
