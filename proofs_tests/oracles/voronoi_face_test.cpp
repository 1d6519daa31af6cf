// Voronoi diagrams on rectangles: the production engine against the exact oracle.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "arrangement/coarse_map.hpp"
#include "arrangement/face_scenes.hpp"
#include "blum/arrangement/brute_engine.hpp"

namespace blum {
namespace {

using test::Random;
using test::Scene;

struct Tally {
  int problems = 0, same = 0, both_bad = 0, gives_up = 0, brute_bad = 0, skipped = 0, events = 0;
};

std::vector<Scene> scenes() {
  constexpr auto kind = DiagramKind::kVoronoi;
  std::vector<Scene> out;
  out.emplace_back("cuboid", test::moved(shapes::cuboid(2, 3, 1)), kind);
  out.emplace_back("lbracket", test::moved(shapes::lbracket()), kind);
  out.emplace_back("tetrahedron",
                   test::moved({{{0, 0, 0}, {3, 0, 1}, {1, 3, 0}, {1, 1, 3}},
                                {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}}),
                   kind);
  out.emplace_back("cube_minus_octant", test::moved(test::cube_minus_octant()), kind);
  out.emplace_back("lpocket", test::moved(shapes::lpocket()), kind);
  out.emplace_back("prism", test::moved(shapes::prism(6)), kind);
  out.emplace_back("torus", test::moved(shapes::planar_torus(8, 4, 2, 0.75)), kind);
  out.emplace_back("void", test::moved(shapes::nested_voids(1)), kind);
  return out;
}

/// A rectangle about a point near the boundary or in the box around the solid.
Rect random_rect(Random& random, const Scene& scene) {
  const double size =
      scene.extent() * std::exp(test::uniform(random, std::log(0.02), std::log(0.6)));
  Point3 c;
  for (int k = 0; k < 3; ++k) {
    const double margin = 0.3 * (scene.bounds.hi[k] - scene.bounds.lo[k]);
    c[k] = test::uniform(random, scene.bounds.lo[k] - margin, scene.bounds.hi[k] + margin);
  }
  if (random() % 3 != 0) {  // about a point of an edge, or beyond it
    const auto& e = scene.solid->edge[random() % scene.solid->edge.size()];
    const Point3 &a = scene.solid->point[e.vertex[0]], &b = scene.solid->point[e.vertex[1]];
    const double s = test::uniform(random, -0.1, 1.1);
    for (int k = 0; k < 3; ++k)
      c[k] = a[k] + s * (b[k] - a[k]) + 0.4 * size * test::uniform(random, -1, 1);
  }
  Rect r;
  r.axis = static_cast<int>(random() % 3);
  r.level = c[r.axis];
  const int u = u_axis(r.axis), v = v_axis(r.axis);
  const double hu = size * test::uniform(random, 0.3, 1), hv = size * test::uniform(random, 0.3, 1);
  r.u0 = c[u] - hu;
  r.u1 = c[u] + hu;
  r.v0 = c[v] - hv;
  r.v1 = c[v] + hv;
  return r;
}

void compare(const Scene& scene, const Rect& r, bool wide, std::size_t most, Tally& tally) {
  const auto near = scene.near(r);
  if (near.size() > most) {
    ++tally.skipped;
    return;
  }
  ++tally.problems;
  const auto all = scene.all_candidates();
  const FaceProblem exact{scene.solid.get(), r, near, {}, true, DiagramKind::kVoronoi};
  FaceProblem fast = exact;
  if (wide) fast.candidates = all;
  ProductionEngine engine = scene.engine();
  const FaceDiagram p = engine.face(fast);
  const FaceDiagram b = brute_face(exact);
  const bool p_ok = p.status == FaceStatus::kDecided, b_ok = b.status == FaceStatus::kDecided;
  if (!p_ok || !b_ok) {
    ++(!p_ok && !b_ok ? tally.both_bad : p_ok ? tally.brute_bad : tally.gives_up);
    if (std::getenv("BLUM_TRACE") != nullptr)
      std::cout << (p_ok ? b.reason : p.reason) << ": " << test::describe(scene, r) << '\n';
    return;
  }
  const std::string difference = test::coarse_map_difference(p, b);
  EXPECT_EQ(difference, "") << test::describe(scene, r);
  if (difference.empty()) ++tally.same;
  for (const FaceNode& n : p.node) tally.events += n.kind == FaceNode::Kind::kEvent;
}

void print(const Tally& t) {
  std::cout << t.problems << " problems, " << t.same << " same, " << t.both_bad << " bad for both, "
            << t.gives_up << " undecided by production alone, " << t.brute_bad
            << " bad for brute alone, " << t.skipped << " skipped, " << t.events << " events\n";
}

Tally run(std::uint64_t seed, int rounds, std::size_t most, bool special) {
  Random random(seed);
  Tally tally;
  const auto all = scenes();
  for (int round = 0; round < rounds; ++round)
    for (const Scene& scene : all)
      compare(scene, special ? test::special_rect(random, scene) : random_rect(random, scene),
              random() % 2 == 0, most, tally);
  print(tally);
  return tally;
}

TEST(VoronoiFace, RandomRectangles_GiveTheMapOfTheOracle) {
  const Tally t = run(1, 12, 9, false);
  EXPECT_EQ(t.same, t.problems);
  EXPECT_GT(t.events, 20);
}

TEST(VoronoiFace, SpecialRectangles_GiveTheMapOfTheOracleOrNone) {
  const Tally t = run(2, 20, 9, true);
  EXPECT_LE(t.gives_up, t.problems / 10);  // planes within rounding of a bad position
  EXPECT_GT(t.same, t.problems / 2);
}

TEST(SweepVoronoiFace, ManyRandomRectangles_GiveTheMapOfTheOracle) {
  // In this many, some lie within rounding of a bad position; the maps of all others are the same.
  const Tally t = run(3, 200, 14, false);
  EXPECT_GE(t.same, t.problems - t.problems / 50);
}

TEST(SweepVoronoiFace, ManySpecialRectangles_GiveTheMapOfTheOracleOrNone) {
  const Tally t = run(4, 200, 12, true);
  EXPECT_LE(t.gives_up, t.problems / 10);
}

}  // namespace
}  // namespace blum
