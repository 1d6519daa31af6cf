// The diagram of half a rectangle taken from that of the whole: the map of the half alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <set>

#include "arrangement/coarse_map.hpp"
#include "arrangement/face_scenes.hpp"
#include "blum/arrangement/brute_engine.hpp"
#include "oracles/voronoi_scenes.hpp"

namespace blum {
namespace {

using test::Random;
using test::Scene;
using test::uniform;

struct Tally {
  int wholes = 0, cuts = 0, taken = 0, alone_undecided = 0, parted = 0, with_brute = 0;
};

std::string signature(const FaceDiagram& d) {
  const auto name = [](std::uint32_t i) { return std::to_string(i); };
  return test::coarse_signature(d, name, name);
}

/// How many sites that the arcs name label no region of the diagram computed alone: these govern
/// nothing there.
std::size_t false_names(const FaceDiagram& d, const FaceDiagram& alone) {
  std::set<SiteId> labels;
  for (const FaceRegion& r : alone.region) labels.insert(r.labels.begin(), r.labels.end());
  std::size_t n = 0;
  for (const FaceArc& a : d.arc) n += !labels.contains(a.left) + !labels.contains(a.right);
  return n;
}

/// In (lo, hi): anywhere, or beside what the diagram shows, or an ulp beside.
double cut_coordinate(Random& random, const FaceDiagram& d, bool along_u, double lo, double hi) {
  double x = uniform(random, lo, hi);
  if (!d.node.empty() && random() % 2 == 0) {
    const FaceNode& n = d.node[random() % d.node.size()];
    const double a = along_u ? n.u0 : n.v0, b = along_u ? n.u1 : n.v1;
    switch (random() % 5) {
      case 0:
        x = std::nextafter(a, -10);
        break;
      case 1:
        x = std::nextafter(b, 10);
        break;
      case 2:
        x = a + (b - a) * uniform(random, 0, 1);
        break;
      case 3:
        x = (random() % 2 == 0 ? a : b) + (hi - lo) * uniform(random, -1e-3, 1e-3);
        break;
      case 4:
        x = random() % 2 == 0 ? a : b;
    }
  }
  return x > lo && x < hi ? x : 0.5 * (lo + hi);
}

/// The same diagram, known less well: boxes of nodes are larger, and events joined by an arc are
/// one cluster.
void blur(Random& random, FaceDiagram& d) {
  for (int round = 0; round < 2 && !d.arc.empty(); ++round) {
    const auto a = static_cast<std::uint32_t>(random() % d.arc.size());
    const auto from = d.arc[a].from, to = d.arc[a].to;
    FaceNode &x = d.node[from], &y = d.node[to];
    if (from == to || x.kind != FaceNode::Kind::kEvent || y.kind != FaceNode::Kind::kEvent ||
        std::ranges::count_if(d.arc, [&](const FaceArc& b) {
          return (b.from == from && b.to == to) || (b.from == to && b.to == from);
        }) != 1)
      continue;
    // The arc between them may leave their boxes: the cluster's holds all of it.
    x.u0 = d.rect.u0, x.u1 = d.rect.u1, x.v0 = d.rect.v0, x.v1 = d.rect.v1;
    x.exact = false;
    x.governors.insert(x.governors.end(), y.governors.begin(), y.governors.end());
    std::ranges::sort(x.governors);
    x.governors.erase(std::unique(x.governors.begin(), x.governors.end()), x.governors.end());
    d.arc.erase(d.arc.begin() + a);
    const auto last = static_cast<std::uint32_t>(d.node.size() - 1);
    for (FaceArc& b : d.arc)
      for (auto* n : {&b.from, &b.to}) {
        if (*n == to) *n = from;
        if (*n == last && to != last) *n = to;
      }
    if (to != last) d.node[to] = d.node[last];
    d.node.pop_back();
  }
  for (FaceNode& n : d.node) {
    if ((n.kind != FaceNode::Kind::kEvent && n.kind != FaceNode::Kind::kRim) || random() % 2 == 0)
      continue;
    n.u0 = std::max(d.rect.u0, n.u0 - uniform(random, 0, 0.5) * (d.rect.u1 - d.rect.u0));
    n.u1 = std::min(d.rect.u1, n.u1 + uniform(random, 0, 0.5) * (d.rect.u1 - d.rect.u0));
    n.v0 = std::max(d.rect.v0, n.v0 - uniform(random, 0, 0.5) * (d.rect.v1 - d.rect.v0));
    n.v1 = std::min(d.rect.v1, n.v1 + uniform(random, 0, 0.5) * (d.rect.v1 - d.rect.v0));
  }
}

/// Halves of halves, each against the half alone; now and then against the exact engine.
void compare(Random& random, const Scene& scene, Rect rect, std::size_t most_for_brute,
             Tally& tally) {
  const bool voronoi = scene.geometry->kind() == DiagramKind::kVoronoi;
  const auto sites = scene.near(rect);
  const auto triangles = voronoi ? std::vector<std::uint32_t>{} : scene.all_triangles();
  const auto problem = [&](const Rect& r, std::span<const SiteId> candidates) {
    FaceProblem p{scene.solid.get(), r, candidates, triangles};
    p.interior = voronoi;
    p.kind = scene.geometry->kind();
    return p;
  };
  FaceDiagram whole = scene.engine().face(problem(rect, sites));
  if (whole.status != FaceStatus::kDecided) return;
  ++tally.wholes;
  const bool blurred = random() % 2 == 0;
  for (int depth = 0; depth < 5; ++depth) {
    const bool along_u = random() % 2 == 0, high = random() % 2 == 0;
    double &lo = along_u ? rect.u0 : rect.v0, &hi = along_u ? rect.u1 : rect.v1;
    (high ? lo : hi) = cut_coordinate(random, whole, along_u, lo, hi);
    if (!(lo < hi)) return;
    const auto near = scene.near(rect);
    FaceProblem from_whole = problem(rect, near);
    if (blurred) blur(random, whole);
    from_whole.whole = &whole;
    ProductionEngine engine = scene.engine(), other = scene.engine();
    FaceDiagram half = engine.face(from_whole);
    const FaceDiagram alone = other.face(problem(rect, near));
    ++tally.cuts;
    if (half.status != FaceStatus::kDecided) return;
    const auto taken = engine.counts().halves;
    tally.taken += static_cast<int>(taken);
    if (taken == 0) {
      whole = std::move(half);
      continue;
    }
    ASSERT_EQ(test::diagram_defect(half), "") << test::describe(scene, rect);
    if (alone.status != FaceStatus::kDecided) {
      ++tally.alone_undecided;
    } else {
      ASSERT_EQ(false_names(half, alone), 0u) << test::describe(scene, rect);
      ASSERT_EQ(signature(half), signature(alone)) << test::describe(scene, rect);
      tally.parted += half.region.size() > 2 && half.arc.size() < whole.arc.size();
    }
    if (near.size() <= most_for_brute && random() % 4 == 0) {
      const FaceDiagram brute = brute_face(problem(rect, near));
      if (brute.status == FaceStatus::kDecided) {
        ++tally.with_brute;
        ASSERT_EQ(test::coarse_map_difference(half, brute), "") << test::describe(scene, rect);
      }
    }
    for (const FaceArc& a : half.arc) ASSERT_NE(a.left, a.right) << test::describe(scene, rect);
    whole = std::move(half);
  }
}

void print(const Tally& t) {
  std::cout << t.wholes << " wholes, " << t.cuts << " cuts, " << t.taken
            << " taken from the whole, of which alone undecided " << t.alone_undecided
            << ", with parts of both halves " << t.parted << ", compared with brute "
            << t.with_brute << '\n';
}

Tally run_medial(std::uint64_t seed, int rounds, std::size_t most_for_brute) {
  Random random(seed);
  Tally tally;
  for (int round = 0; round < rounds; ++round)
    for (const Scene& scene : test::catalogue(random)) {
      const Rect r = random() % 3 == 0
                         ? test::special_rect(random, scene)
                         : test::random_rect(random, scene, uniform(random, 0.2, 1.2));
      compare(random, scene, r, most_for_brute, tally);
    }
  print(tally);
  return tally;
}

Tally run_voronoi(std::uint64_t seed, int rounds, std::size_t most_for_brute,
                  const std::vector<Scene>& scenes) {
  Random random(seed);
  Tally tally;
  for (int round = 0; round < rounds; ++round)
    for (const Scene& scene : scenes)
      compare(random, scene, test::voronoi_rect(random, scene), most_for_brute, tally);
  print(tally);
  return tally;
}

TEST(Halves, OfMedialDiagrams_AreTheMapOfTheHalfAlone) {
  const Tally t = run_medial(1, 6, 7);
  EXPECT_GE(t.taken, 150);
  EXPECT_GE(t.parted, 50);
  EXPECT_GE(t.with_brute, 10);
}

TEST(Halves, OfVoronoiDiagrams_AreTheMapOfTheHalfAlone) {
  const Tally t = run_voronoi(2, 16, 7, test::voronoi_scenes());
  EXPECT_GE(t.taken, 100);
  EXPECT_GE(t.parted, 30);
  EXPECT_GE(t.with_brute, 10);
}

TEST(Halves, BesideEdgesFlatButForRounding_AreTheMapOfTheHalfAlone) {
  const Tally t = run_voronoi(3, 6, 5, test::nearly_flat_voronoi_scenes());
  EXPECT_GE(t.taken, 40);
  EXPECT_GE(t.parted, 10);
}

// A site that the whole's diagram names beside an arc may govern nothing in the half, and bounds on
// distances may be too coarse to show that.
TEST(Halves, OfRegionsOfManySites_NameSitesThatGovernThere) {
  const Scene scene("plate",
                    shapes::rotate_rounded(shapes::triangulate_facets(shapes::plate(2, 16), 3), 2));
  const auto triangles = scene.all_triangles();
  const auto face = [&](const Rect& r, const FaceDiagram* whole) {
    ProductionEngine engine = scene.engine();
    const auto near =
        engine.prune(scene.geometry->candidates(), point_on(r.axis, r.level, r.u0, r.v0),
                     point_on(r.axis, r.level, r.u1, r.v1));
    FaceProblem p{scene.solid.get(), r, near, triangles};
    p.whole = whole;
    FaceDiagram d = engine.face(p);
    EXPECT_EQ(d.status, FaceStatus::kDecided);
    EXPECT_EQ(engine.counts().halves, whole != nullptr ? 1u : 0u);
    return d;
  };
  const auto names = [&](const Rect& r, double cut, double Rect::*side) {
    const FaceDiagram whole = face(r, nullptr);
    Rect half = r;
    half.*side = cut;
    EXPECT_EQ(false_names(face(half, &whole), face(half, nullptr)), 0u)
        << test::describe(scene, half);
  };
  names({1, 0x1.bb95fb53846e9p-2, 0x1.107b5419942ap-7, 0x1.63bfc52503b34p-1, 0x1.fed32050b02ep-5,
         0x1.8d14ff10c898p-1},
        0x1.4da36e186bb16p-1, &Rect::u0);
  names({1, 0x1.a8c0e45732763p-2, 0x1.4514208cc0c2dp-1, 0x1.672b6b7d20db8p+0, 0x1.2373ff7c1346p-4,
         0x1.176c001c44856p+0},
        0x1.76309c7ce3a96p-1, &Rect::u0);
  names({0, 0x1.e0b98b47b3baap-5, -0x1.29e2389bf247cp-3, 0x1.ab8a323b182e4p-2, 0x1.c0aa85111d2ap-6,
         0x1.b0794a817ebdfp-1},
        0x1.060a0b6dfe0fp-1, &Rect::v1);
}

TEST(SweepHalves, AreTheMapOfTheHalfAlone) {
  EXPECT_GE(run_medial(4, 60, 8).taken, 3000);
  EXPECT_GE(run_voronoi(5, 100, 8, test::voronoi_scenes()).taken, 2000);
  EXPECT_GE(run_voronoi(6, 100, 6, test::nearly_flat_voronoi_scenes()).taken, 1000);
}

}  // namespace
}  // namespace blum
