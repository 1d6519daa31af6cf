// The production engine on segments against the exact oracle.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <map>

#include "arrangement/face_scenes.hpp"
#include "blum/arrangement/brute_engine.hpp"

namespace blum {
namespace {

using test::Random;
using test::Scene;

struct Tally {
  int problems = 0, same = 0, both_bad = 0, gives_up = 0, brute_bad = 0, ties = 0, crossings = 0;
  std::map<std::string, int> reason;
  void print(const char* what) const {
    std::cout << what << ": " << problems << " problems, " << same << " same (" << ties << " ties, "
              << crossings << " crossings), " << both_bad << " bad for both, " << gives_up
              << " undecided by production alone, " << brute_bad << " bad for brute alone\n";
    for (const auto& [r, n] : reason) std::cout << "    " << n << " x " << r << '\n';
  }
};

/// Is s an exact governor of the point at t (an end of a breakpoint that is a double)?
bool governs(Predicates& predicates, const Scene& scene, const Segment& s, double t, SiteId site) {
  const Point3 x = point_on(s.axis, t, s.u, s.v);
  std::vector<SiteId> governors;
  predicates.governors(x, scene.geometry->candidates(), governors);
  return std::binary_search(governors.begin(), governors.end(), site);
}

void compare(const Scene& scene, const Segment& s, bool wide, Tally& tally) {
  const auto near = scene.near(s);
  if (near.size() > 40 || scene.curved(near) > 12) return;
  ++tally.problems;
  const auto triangles = scene.all_triangles();
  const auto all = scene.all_candidates();
  ProductionEngine engine = scene.engine();
  SegmentAnswer p;
  std::optional<SegmentDiagram> b;
  try {
    p = engine.segment(s, wide ? all : near, triangles);
    b = brute_segment(*scene.solid, s, near, triangles);
  } catch (const std::exception& e) {
    ADD_FAILURE() << e.what() << "\n" << test::describe(scene, s);
    return;
  }
  if (p.status != FaceStatus::kDecided || !b) {
    ++(!b ? p.status == FaceStatus::kDecided ? tally.brute_bad : tally.both_bad : tally.gives_up);
    if (!b && p.diagram && std::getenv("BLUM_TRACE") != nullptr) {
      std::cout << "brute alone: " << test::describe(scene, s) << ":";
      for (const Breakpoint& x : p.diagram->breakpoint)
        std::cout << ' ' << static_cast<int>(x.kind) << ' ' << x.lo << ".." << x.hi << ' '
                  << x.below.value << '/' << x.above.value << ' ' << x.triangle << ';';
      std::cout << '\n';
    }
    ++tally.reason[std::string(b ? "alone: " : p.diagram ? "brute alone" : "both: ") + p.reason];
    return;
  }
  const SegmentDiagram& d = *p.diagram;
  SCOPED_TRACE(test::describe(scene, s));
  ASSERT_EQ(d.breakpoint.size(), b->breakpoint.size());
  ASSERT_EQ(d.interval.size(), b->interval.size());
  ASSERT_EQ(d.segment, s);
  Predicates predicates(*scene.geometry);
  double last = s.t0;
  for (std::size_t k = 0; k < d.breakpoint.size(); ++k) {
    const Breakpoint &x = d.breakpoint[k], &y = b->breakpoint[k];
    ASSERT_EQ(x.kind, y.kind);
    EXPECT_LE(x.lo, y.hi);
    EXPECT_LE(y.lo, x.hi);
    EXPECT_LE(x.lo, x.hi);
    EXPECT_GE(x.hi, last);
    last = x.lo;
    if (x.kind == Breakpoint::Kind::kBoundary) {
      EXPECT_EQ(x.triangle, y.triangle);
      ++tally.crossings;
      continue;
    }
    ++tally.ties;
    EXPECT_FALSE(predicates.redundant(x.below, x.above));
    EXPECT_FALSE(predicates.never_essential(x.below, x.above));
    if (x.lo_triangle == Breakpoint::kNone) {
      EXPECT_TRUE(governs(predicates, scene, s, x.lo, x.below));
    } else {
      EXPECT_EQ(x.below, scene.geometry->index().face(x.lo_triangle));
    }
    if (x.hi_triangle == Breakpoint::kNone) {
      EXPECT_TRUE(governs(predicates, scene, s, x.hi, x.above));
    } else {
      EXPECT_EQ(x.above, scene.geometry->index().face(x.hi_triangle));
    }
  }
  for (std::size_t k = 0; k < d.interval.size(); ++k)
    ASSERT_EQ(d.interval[k].inside, b->interval[k].inside);
  ++tally.same;
}

Segment random_segment(Random& random, const Scene& scene, bool special) {
  const Rect r = special ? test::special_rect(random, scene)
                         : test::random_rect(random, scene, test::uniform(random, 0.05, 1.2));
  return side_segment(r, static_cast<int>(random() % 4));
}

void run(std::uint64_t seed, int rounds, int segments, bool special, Tally& tally) {
  Random random(seed);
  for (int round = 0; round < rounds; ++round)
    for (const Scene& scene : test::catalogue(random))
      for (int k = 0; k < segments; ++k)
        compare(scene, random_segment(random, scene, special), random() % 2 == 0, tally);
}

TEST(ProductionSegment, RandomSegments_GiveTheDiagramOfTheOracle) {
  Tally tally;
  run(1, 1, 4, false, tally);
  tally.print("random");
  EXPECT_GE(tally.same, 100);
  EXPECT_EQ(tally.gives_up + tally.both_bad + tally.brute_bad, 0);
}

TEST(ProductionSegment, SpecialSegments_NeverContradictTheOracle) {
  Tally tally;
  run(2, 1, 4, true, tally);
  tally.print("special");
  EXPECT_GE(tally.same, 50);
}

TEST(SweepProductionSegment, RandomSegments_GiveTheDiagramOfTheOracle) {
  Tally tally;
  run(3, 20, 6, false, tally);
  tally.print("random");
  EXPECT_GE(tally.same, 2000);
  EXPECT_EQ(tally.gives_up + tally.both_bad + tally.brute_bad, 0);
}

TEST(SweepProductionSegment, SpecialSegments_NeverContradictTheOracle) {
  Tally tally;
  run(4, 20, 6, true, tally);
  tally.print("special");
  EXPECT_GE(tally.same, 1000);
}

TEST(ProductionSegment, EndsOnATie_AreBadAndTheirNeighboursAreNot) {
  const Scene s("cuboid", shapes::cuboid(4, 3, 2));
  const auto all = s.all_candidates();
  const auto triangles = s.all_triangles();
  ProductionEngine engine = s.engine();
  // On x = y the walls x = 0 and y = 0 tie.
  const auto ask = [&](double t0) {
    return engine.segment({0, s.working(1, 0.25), s.working(2, 0.75), t0, s.working(0, 1)}, all,
                          triangles);
  };
  const double tie = s.working(0, 0.25);
  EXPECT_EQ(ask(tie).status, FaceStatus::kBadPosition);
  for (const double e : {0x1p-52, 1e-12, 1e-6}) {
    const auto before = ask(tie - e), after = ask(tie + e);
    ASSERT_EQ(before.status, FaceStatus::kDecided) << e;
    ASSERT_EQ(after.status, FaceStatus::kDecided) << e;
    EXPECT_EQ(before.diagram->breakpoint.size(), after.diagram->breakpoint.size() + 1);
  }
}

}  // namespace
}  // namespace blum
