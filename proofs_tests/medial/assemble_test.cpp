// The assembled complex: how its cells hang together, where they lie, and its homology.

#include "../../medial/src/assemble.hpp"

#include <gtest/gtest.h>

#include "blum/medial/parts.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

using test::Scene;
using test::seeded;
using test::Subdivided;
using Kind = ComplexVertex::Kind;

/// Triangles at each edge of the complex.
std::vector<std::vector<std::uint32_t>> triangles_at_edges(const CellComplex& c) {
  std::vector<std::vector<std::uint32_t>> at(c.edge.size());
  for (std::uint32_t t = 0; t < c.triangle.size(); ++t)
    for (const auto e : c.triangle[t].edge) at[e].push_back(t);
  return at;
}

void check_incidences(const CellComplex& c, bool whole) {
  for (const ComplexEdge& e : c.edge)
    for (const auto v : e.vertex) ASSERT_LT(v, c.vertex.size());
  for (const ComplexTriangle& t : c.triangle) {
    for (const auto e : t.edge) ASSERT_LT(e, c.edge.size());
    ASSERT_LT(t.cone, c.cone.size());
    const auto &base = c.edge[t.edge[0]], &first = c.edge[t.edge[1]], &second = c.edge[t.edge[2]];
    EXPECT_NE(base.kind, ComplexEdge::Kind::kCone);
    EXPECT_EQ(first.kind, ComplexEdge::Kind::kCone);
    EXPECT_EQ(second.kind, ComplexEdge::Kind::kCone);
    EXPECT_EQ(first.leaf, t.cone);
    EXPECT_EQ(second.leaf, t.cone);
    // The boundary closes: base a-b, spokes a-apex and b-apex.
    const auto apex = c.cone[t.cone].apex;
    EXPECT_EQ(first.vertex, (std::array<std::uint32_t, 2>{base.vertex[0], apex}));
    EXPECT_EQ(second.vertex, (std::array<std::uint32_t, 2>{base.vertex[1], apex}));
  }
  const auto at = triangles_at_edges(c);
  for (std::uint32_t e = 0; e < c.edge.size(); ++e) {
    const auto& t = at[e];
    switch (c.edge[e].kind) {
      case ComplexEdge::Kind::kArc:
        if (whole) EXPECT_EQ(t.size(), 2u);
        EXPECT_GE(t.size(), 1u);
        EXPECT_LE(t.size(), 2u);
        if (t.size() == 2) {
          EXPECT_NE(c.cone[c.triangle[t[0]].cone].leaf, c.cone[c.triangle[t[1]].cone].leaf);
        }
        break;
      case ComplexEdge::Kind::kConvexEdge:
        EXPECT_EQ(t.size(), 1u);
        break;
      case ComplexEdge::Kind::kCone:
        EXPECT_GE(t.size(), 1u);
        for (const auto k : t) EXPECT_EQ(c.triangle[k].cone, c.edge[e].leaf);
        break;
    }
  }
  std::vector<int> apex(c.vertex.size(), 0);
  for (const ComplexCone& cone : c.cone) ++apex[cone.apex];
  for (std::uint32_t v = 0; v < c.vertex.size(); ++v)
    EXPECT_EQ(apex[v], c.vertex[v].kind == Kind::kCone ? 1 : 0);
}

void check_homology(const Solid& solid, const CellComplex& c) {
  const auto betti = betti_numbers(c);
  EXPECT_EQ(betti, solid.betti());
  EXPECT_EQ(std::ssize(c.vertex) - std::ssize(c.edge) + std::ssize(c.triangle),
            betti[0] - betti[1] + betti[2]);
}

void check_places(Subdivided& run, const CellComplex& c) {
  for (const ComplexTriangle& t : c.triangle) {
    const Leaf& leaf = run.tree().leaf[c.cone[t.cone].leaf];
    for (const auto e : t.edge)
      for (const auto v : c.edge[e].vertex) {
        const Point3 p = run.solid.frame.to_working(c.vertex[v].position);
        for (int k = 0; k < 3; ++k) {
          EXPECT_GE(p[k], leaf.box.lo[k] - 1e-14) << v;
          EXPECT_LE(p[k], leaf.box.hi[k] + 1e-14) << v;
        }
      }
  }
  const auto points = test::model_points(run.solid);
  const double tolerance = 1e-11 * test::extent(points);
  const InsideOracle& inside = run.engines.inside();
  for (std::uint32_t i = 0; i < c.vertex.size(); ++i) {
    const ComplexVertex& v = c.vertex[i];
    // Apexes and clusters off the axis can lie outside the solid: see the disabled test below.
    if (v.on_axis ||
        inside.locate(run.solid.frame.to_working(v.position)) == InsideOracle::Where::kInside)
      EXPECT_NEAR(v.radius, test::boundary_distance(run.solid, points, v.position), tolerance)
          << "vertex " << i << " of kind " << static_cast<int>(v.kind);
    EXPECT_FALSE(v.governors.empty());
    EXPECT_TRUE(std::is_sorted(v.governors.begin(), v.governors.end()) ||
                v.kind == Kind::kConvexEdge);
    switch (v.kind) {
      case Kind::kConvexEdge:
      case Kind::kBoundary:
        EXPECT_EQ(v.radius, 0);
        EXPECT_TRUE(v.on_axis);
        break;
      case Kind::kArcPoint:
        EXPECT_TRUE(v.on_axis);
        EXPECT_GE(v.governors.size(), 2u);
        EXPECT_GT(v.radius, 0);
        break;
      case Kind::kEvent:
        EXPECT_TRUE(!v.on_axis || v.governors.size() >= 3u);
        EXPECT_GT(v.radius, 0);
        break;
      case Kind::kRim:
        EXPECT_TRUE(v.on_axis);
        EXPECT_GT(v.radius, 0);
        break;
      case Kind::kCone:
        break;
      case Kind::kMesh:
        ADD_FAILURE() << "a point of a finer mesh";
    }
  }
}

void check_scene(const Scene& scene, const SubdivisionOptions& options) {
  SCOPED_TRACE(scene.name + ", seed " + std::to_string(options.seed) + ", leaf diameter " +
               std::to_string(options.max_leaf_diameter) + (options.resolve ? ", resolved" : ""));
  Subdivided run(scene.mesh, options);
  ASSERT_TRUE(run.result.ok());
  for (const Leaf& l : run.tree().leaf) ASSERT_NE(l.theorem, LeafTheorem::kUndecided);
  const CellComplex c = assemble(run.geometry, run.tree(), run.engines).complex;
  check_incidences(c, true);
  check_homology(run.solid, c);
  check_places(run, c);
}

void check_scene(const Scene& scene, std::uint64_t seed, double fineness, bool resolve) {
  SubdivisionOptions o = seeded(seed, fineness * test::extent(scene.mesh.points));
  o.resolve = resolve;
  check_scene(scene, o);
}

TEST(AssembledComplex, AnySolid_HangsTogether) {
  for (const Scene& scene : test::scenes()) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) check_scene(scene, seed, 0, false);
    check_scene(scene, 4, 0.25, false);
    check_scene(scene, 5, 0, true);
  }
}

TEST(SweepAssembledComplex, ManySeedsAndFineLeaves_HangTogether) {
  for (const Scene& scene : test::scenes())
    for (std::uint64_t seed = 10; seed < 30; ++seed)
      check_scene(scene, seed, seed % 3 == 0 ? 0.1 : 0, seed % 2 == 0);
}

TEST(AssembledComplex, LeavesUndecided_AreLeftOutAndTheRestHangsTogether) {
  for (const Scene& scene : test::scenes())
    for (const int depth : {3, 8}) {
      SCOPED_TRACE(scene.name);
      SubdivisionOptions o = seeded(2, 0.1 * test::extent(scene.mesh.points));
      o.max_depth = depth;
      Subdivided run(scene.mesh, o);
      ASSERT_TRUE(run.result.ok());
      const CellComplex c = assemble(run.geometry, run.tree(), run.engines).complex;
      check_incidences(c, false);
      check_places(run, c);
      for (const ComplexCone& cone : c.cone)
        EXPECT_NE(run.tree().leaf[cone.leaf].theorem, LeafTheorem::kUndecided);
    }
}

std::map<Kind, std::size_t> kinds(const CellComplex& c) {
  std::map<Kind, std::size_t> n;
  for (const ComplexVertex& v : c.vertex) ++n[v.kind];
  return n;
}

CellComplex complex_of(const PolygonMesh& mesh, const SubdivisionOptions& options) {
  Subdivided run(mesh, options);
  return assemble(run.geometry, run.tree(), run.engines).complex;
}

TEST(AssembledComplex, PocketWithLShapedFloor_HasRimsOnTheRayOfTheTheory) {
  // Floor at z = 1, its reflex corner at (2, 2, 1): the rim runs down from there, z < 1.
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const CellComplex c = complex_of(shapes::lpocket(), seeded(seed, 0.4));
    std::size_t rims = 0;
    for (const ComplexVertex& v : c.vertex) {
      if (v.kind != Kind::kRim) continue;
      ++rims;
      EXPECT_NEAR(v.position.x, 2, 1e-13);
      EXPECT_NEAR(v.position.y, 2, 1e-13);
      EXPECT_LT(v.position.z, 1);
      EXPECT_NEAR(v.radius, 1 - v.position.z, 1e-13);
    }
    EXPECT_GE(rims, 1u);
  }
}

TEST(AssembledComplex, SolidWithoutReflexEdges_HasNoRims) {
  for (const PolygonMesh& mesh : {shapes::cuboid(1, 1.25, 2), shapes::prism(5)})
    EXPECT_EQ(kinds(complex_of(mesh, seeded(1, 0.5)))[Kind::kRim], 0u);
}

TEST(AssembledComplex, StarVoid_HasRimsAboutItsApexes) {
  for (const int points : {3, 4, 5})
    EXPECT_GE(kinds(complex_of(test::star_void(points), seeded(1, 2)))[Kind::kRim],
              static_cast<std::size_t>(2 * points));
}

TEST(AssembledComplex, Box_LiesOnTheKnownAxis) {
  // d = least of the distances to the six sides, and the vertex ties two of them.
  const Point3 side{1, 1.25, 2};
  const CellComplex c = complex_of(shapes::cuboid(side.x, side.y, side.z), seeded(1, 0.2));
  std::size_t checked = 0;
  for (const ComplexVertex& v : c.vertex) {
    std::vector<double> d;
    for (int k = 0; k < 3; ++k) {
      d.push_back(v.position[k]);
      d.push_back(side[k] - v.position[k]);
    }
    std::sort(d.begin(), d.end());
    if (!v.on_axis) continue;
    EXPECT_NEAR(v.radius, d[0], 1e-14);
    ++checked;
    EXPECT_NEAR(d[0], d[1], 1e-11);
    if (v.kind == Kind::kEvent) EXPECT_NEAR(d[0], d[2], 1e-11);
  }
  EXPECT_GT(checked, 100u);
}

TEST(AssembledComplex, VerticesOffTheAxis_LieInTheSolidWithTheirRadius) {
  for (const Scene& scene : test::scenes()) {
    SCOPED_TRACE(scene.name);
    Subdivided run(scene.mesh, seeded(4, 0.25 * test::extent(scene.mesh.points)));
    const CellComplex c = assemble(run.geometry, run.tree(), run.engines).complex;
    const auto points = test::model_points(run.solid);
    for (const ComplexVertex& v : c.vertex) {
      EXPECT_NEAR(v.radius, test::boundary_distance(run.solid, points, v.position),
                  1e-11 * test::extent(points));
      if (!v.on_axis)
        EXPECT_EQ(run.engines.inside().locate(run.solid.frame.to_working(v.position)),
                  InsideOracle::Where::kInside);
    }
  }
}

}  // namespace
}  // namespace blum
