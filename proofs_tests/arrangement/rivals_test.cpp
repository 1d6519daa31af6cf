// Two sites said never to govern a point of a range both: against points that both govern, and
// against points where their carriers tie, in 256 bits.
#include "../../arrangement/src/rivals.hpp"

#include <gtest/gtest.h>

#include <iostream>

#include "../../arrangement/src/local_form.hpp"
#include "../../arrangement/src/slope.hpp"

#include "blum/kernel/mesh.hpp"
#include "precise_sites.hpp"

namespace blum {
namespace {

using test::Precise;
using test::PrecisePoint;
using test::PreciseSites;
using test::PreciseTie;
using test::Random;
using test::Scene;
using test::uniform;

struct Counts {
  long ties = 0, exact = 0, ranges = 0, pairs = 0;
  long outside = 0, behind = 0;  // pairs told apart by domains, triples by a third site
  long outside_with_tie = 0, behind_with_tie = 0;  // of them checked at ties of the carriers
  long checked = 0;

  void print(const char* what) const {
    std::cout << what << ": " << ties << " ties (" << exact << " exact), " << ranges << " ranges, "
              << pairs << " pairs; apart by domains " << outside << " (" << outside_with_tie
              << " with ties), behind a third " << behind << " (" << behind_with_tie
              << " with ties); " << checked << " ties of carriers\n";
  }
};

/// Points of the range, on its border as often as not, where the carriers tie.
std::vector<PrecisePoint> carrier_ties(Random& random, const PreciseSites& sites, SiteId a,
                                       SiteId c, const Range& range) {
  Point3 p, q;
  for (int k = 0; k < 3; ++k) {
    const double r = range.half[static_cast<std::size_t>(k)] * (1 - 0x1p-40);
    const auto end = [&] { return range.center[k] + r * uniform(random, -1, 1); };
    p[k] = end();
    q[k] = end();
    if (random() % 3 == 0) p[k] = q[k] = range.center[k] + (random() % 2 == 0 ? r : -r);
  }
  std::vector<PrecisePoint> found;
  const PrecisePoint from = test::precise(p), to = test::precise(q);
  for (const Precise& s : sites.ties(a, c, from, to))
    if (s >= 0 && s <= 1) found.push_back(test::on_line(from, to, s));
  return found;
}

class Check {
 public:
  Check(Random& random, const Scene& scene, Counts& counts)
      : random_(random),
        scene_(scene),
        sites_(*scene.geometry),
        context_(*scene.geometry, *scene.inside, 1),
        counts_(counts) {}

  void ties(int rounds) {
    for (int k = 0; k < rounds && !testing::Test::HasFatalFailure(); ++k) {
      const auto tie = k % 2 == 0 ? test::random_tie(random_, scene_, sites_, context_.predicates)
                                  : test::random_exact_tie(random_, scene_, context_.predicates);
      if (!tie) continue;
      ++counts_.ties;
      counts_.exact += std::ranges::count(tie->exact, true) == 3;
      for (int i = 0; i < 4; ++i) in_range(*tie, test::range_with(random_, *tie, scene_.extent()));
    }
  }

 private:
  void in_range(const PreciseTie& tie, const Range& range) {
    ++counts_.ranges;
    Point3 lo, hi;
    for (int k = 0; k < 3; ++k) {
      lo[k] = range.center[k] - range.half[static_cast<std::size_t>(k)];
      hi[k] = range.center[k] + range.half[static_cast<std::size_t>(k)];
    }
    std::vector<LocalForm> all, forms;
    for (const SiteId s : scene_.near(lo, hi)) {
      LocalForm f;
      if (local_form(*scene_.geometry, s, range, f)) all.push_back(f);
    }
    const auto place = [](std::span<const LocalForm> of, SiteId s) {
      return static_cast<std::size_t>(
          std::ranges::find(of, s, [](const LocalForm& f) { return f.site; }) - of.begin());
    };
    const std::size_t a = place(all, tie.a), c = place(all, tie.c);
    ASSERT_LT(std::max(a, c), all.size()) << describe(tie, range);
    // Both govern a point of the range: nothing may tell them apart.
    ASSERT_FALSE(tie_outside_domains(context_, all[a], all[c], range)) << describe(tie, range);
    ASSERT_FALSE(tie_outside_domains(context_, all[c], all[a], range)) << describe(tie, range);
    for (const LocalForm& b : all)
      ASSERT_FALSE(nearer_at_ties(context_, b, all[a], all[c], range))
          << b.site.value << " " << describe(tie, range);
    prune(*scene_.geometry, scene_.near(lo, hi), range, forms, &context_);
    Rivals rivals(context_, forms, range);
    const std::size_t i = place(forms, tie.a), j = place(forms, tie.c);
    ASSERT_LT(std::max(i, j), forms.size());
    if (!context_.never_essential(tie.a, tie.c)) {
      ASSERT_TRUE(rivals.meet(i, j)) << describe(tie, range);
      ASSERT_TRUE(rivals.meet(j, i));
    }
    // Others, with whatever ties of their carriers there are.
    for (int k = 0; k < 6 && all.size() > 2; ++k)
      others(all[random_() % all.size()], all[random_() % all.size()], all, range);
  }

  void others(const LocalForm& a, const LocalForm& c, std::span<const LocalForm> all,
              const Range& range) {
    if (a.site == c.site || context_.never_essential(a.site, c.site)) return;
    if (context_.voronoi() && context_.touch(a.site, c.site).kind == Touch::Kind::kNever) return;
    ++counts_.pairs;
    const bool outside = tie_outside_domains(context_, a, c, range);
    counts_.outside += outside;
    std::vector<const LocalForm*> nearer;
    for (const LocalForm& b : all)
      if (b.site != a.site && b.site != c.site && nearer_at_ties(context_, b, a, c, range))
        nearer.push_back(&b);
    counts_.behind += static_cast<long>(nearer.size());
    if (!outside && nearer.empty()) return;
    const bool touching =
        context_.voronoi() && context_.touch(a.site, c.site).kind != Touch::Kind::kOrdinary;
    long seen = 0;
    for (int k = 0; k < 3; ++k)
      for (const PrecisePoint& x : carrier_ties(random_, sites_, a.site, c.site, range)) {
        const bool in_both = sites_.in_domain(a.site, x) && sites_.in_domain(c.site, x);
        ++seen;
        ASSERT_FALSE(outside && in_both) << a.site.value << " " << c.site.value;
        // Of sites that touch, and of faces, less is said: the plane on which they tie, or their
        // heights over known sides, are not all ties of their carriers.
        if (!in_both && (touching || behind_side(a, x) || behind_side(c, x))) continue;
        for (const LocalForm* b : nearer) {
          ASSERT_TRUE(sites_.projects(b->site, x));
          ASSERT_LT(sites_.squared(b->site, x), sites_.squared(a.site, x));
        }
      }
    counts_.checked += seen;
    counts_.outside_with_tie += outside && seen > 0;
    if (seen > 0) counts_.behind_with_tie += static_cast<long>(nearer.size());
  }

  [[nodiscard]] bool behind_side(const LocalForm& f, const PrecisePoint& x) const {
    return f.side != 0 && sites_.height(f.site, x) * f.side < 0;
  }

  [[nodiscard]] std::string describe(const PreciseTie& tie, const Range& r) const {
    char text[300];
    std::snprintf(text, sizeof text, "%s: %u and %u at %.17g %.17g %.17g; %a %a %a +- %a %a %a",
                  scene_.name.c_str(), tie.a.value, tie.c.value, tie.x[0].get_d(), tie.x[1].get_d(),
                  tie.x[2].get_d(), r.center.x, r.center.y, r.center.z, r.half[0], r.half[1],
                  r.half[2]);
    return text;
  }

  Random& random_;
  const Scene& scene_;
  PreciseSites sites_;
  EngineContext context_;
  Counts& counts_;
};

/// Slivers, faces nearly coplanar, edges nearly in line, vertices with three edges nearly in a
/// plane: what turning by a rotation and rounding to doubles makes of solids with flat edges.
std::vector<Scene> scenes(DiagramKind kind) {
  Random random(17);
  std::vector<Scene> out;
  const auto add = [&](std::string name, const PolygonMesh& mesh) {
    if (auto solid = build_solid(mesh); solid.ok())
      out.emplace_back(std::move(name), std::move(solid.value()), kind);
  };
  add("lbracket", shapes::lbracket());
  add("lpocket", shapes::lpocket());
  add("split octant", shapes::triangulate_facets(
                          shapes::split_edges(test::cube_minus_octant(), random()), random()));
  add("plate", shapes::plate(1, 4));
  add("void", test::moved(shapes::nested_voids(1)));
  add("torus", test::moved(shapes::torus(8, 4, 2, 0.75)));
  add("star", test::moved(test::star(random, 1)));
  add("pyramid", test::pyramid(random, 12, 2, 1e-12));
  add("rotated lpocket", shapes::rotate_rounded(shapes::lpocket(), random()));
  add("rotated octant", shapes::rotate_rounded(test::cube_minus_octant(), random()));
  add("rotated split octant",
      shapes::rotate_rounded(
          shapes::triangulate_facets(shapes::split_edges(test::cube_minus_octant(), random()),
                                     random()),
          random()));
  add("rotated plate", shapes::rotate_rounded(shapes::plate(1, 6), random()));
  for (const char* file : {"/sliver_riser.off", "/almost_orthogonal_faces.off"})
    if (const auto mesh = read_mesh(std::string(BLUM_FIXTURES_DIR) + file); mesh.ok())
      add(file, mesh.value());
  return out;
}

Counts run(DiagramKind kind, std::uint64_t seed, int rounds) {
  Random random(seed);
  Counts counts;
  for (const Scene& scene : scenes(kind)) {
    Check(random, scene, counts).ties(rounds);
    if (testing::Test::HasFatalFailure()) break;
  }
  counts.print(kind == DiagramKind::kMedial ? "medial" : "voronoi");
  return counts;
}

struct Pair {
  LocalForm a, c;
};
Pair forms_of(const Scene& scene, SiteId a, SiteId c, const Range& range) {
  Pair p;
  EXPECT_TRUE(local_form(*scene.geometry, a, range, p.a));
  EXPECT_TRUE(local_form(*scene.geometry, c, range, p.c));
  return p;
}

SiteId edge_between(const Scene& scene, std::uint32_t p, std::uint32_t q) {
  for (std::uint32_t e = 0; e < scene.solid->edge.size(); ++e) {
    const auto& v = scene.solid->edge[e].vertex;
    if ((v[0] == p && v[1] == q) || (v[0] == q && v[1] == p))
      return scene.geometry->index().edge(e);
  }
  ADD_FAILURE();
  return {};
}

/// A slab with a corner of almost 180 degrees, at its point 1: convex or reflex.
Scene blunt_slab(bool convex) {
  PolygonMesh m;
  for (const double z : {0.0, 1.0})
    for (const Point3 p :
         {Point3{0, 0, z}, {1, convex ? -0x1p-20 : 0x1p-20, z}, {2, 0, z}, {2, 2, z}, {0, 2, z}})
      m.points.push_back(p);
  m.faces = {{4, 3, 2, 1, 0}, {5, 6, 7, 8, 9}};
  for (std::uint32_t k = 0; k < 5; ++k) m.faces.push_back({k, (k + 1) % 5, (k + 1) % 5 + 5, k + 5});
  return {"blunt slab", m, DiagramKind::kVoronoi};
}

Range box_about(const Scene& scene, const Point3& model, double half) {
  Point3 lo, hi;
  for (int k = 0; k < 3; ++k) {
    lo[k] = scene.working(k, model[k] - half);
    hi[k] = scene.working(k, model[k] + half);
  }
  return Range::of(lo, hi);
}

TEST(Rivals, EdgesNearlyInLine_AreApartByOneConditionOfEachAtAConvexCorner) {
  for (const bool convex : {true, false}) {
    const Scene scene = blunt_slab(convex);
    EngineContext context(*scene.geometry, *scene.inside, 1);
    // At a convex corner the region of its vertex lies between theirs, 1e-6 wide; at a reflex one
    // they tie.
    const Range range = box_about(scene, {1, -0.5, -0.5}, 0.2);
    const auto [a, c] =
        forms_of(scene, edge_between(scene, 0, 1), edge_between(scene, 1, 2), range);
    EXPECT_EQ(tie_outside_domains(context, a, c, range), convex);
    EXPECT_EQ(tie_outside_domains(context, c, a, range), convex);
  }
}

/// By each rule, pair by pair.
struct ByRule {
  std::uint64_t outside = 0, behind = 0, neither = 0;
};

void compare_with_rules(EngineContext& context, std::span<const LocalForm> forms,
                        const Range& range, ByRule& counts) {
  Rivals rivals(context, forms, range);
  for (std::size_t i = 0; i < forms.size(); ++i)
    for (std::size_t j = i + 1; j < forms.size(); ++j) {
      const LocalForm &a = forms[i], &c = forms[j];
      const bool may = may_both_govern(context, a, c, range),
                 outside = may && tie_outside_domains(context, a, c, range),
                 behind = may && !outside && std::ranges::any_of(forms, [&](const LocalForm&b) {
                            return nearer_at_ties(context, b, a, c, range);
                          });
      counts.outside += outside;
      counts.behind += behind;
      counts.neither += may && !outside && !behind;
      EXPECT_EQ(rivals.meet(j, i), may && !outside && !behind);
      EXPECT_EQ(rivals.meet(i, j), rivals.meet(j, i));
    }
}

TEST(Rivals, EachRuleCounts_AndNoneForCertificates) {
  for (const DiagramKind kind : {DiagramKind::kMedial, DiagramKind::kVoronoi}) {
    Random random(5);
    ByRule counts;
    for (const Scene& scene : scenes(kind)) {
      EngineContext usual(*scene.geometry, *scene.inside, 1),
          plain(*scene.geometry, *scene.inside, 1);
      plain.plain = true;
      const ByRule before = counts;
      for (int k = 0; k < 40; ++k) {
        const Rect r = test::random_rect(random, scene, 0.2);
        const Range range =
            Range::of(point_on(r.axis, r.level, r.u0, r.v0), point_on(r.axis, r.level, r.u1, r.v1));
        std::vector<LocalForm> forms;
        prune(*scene.geometry, scene.near(r), range, forms, &plain);
        if (forms.size() > 16) continue;
        compare_with_rules(usual, forms, range, counts);
        Rivals without(plain, forms, range);
        for (std::size_t i = 0; i < forms.size(); ++i)
          for (std::size_t j = 0; j < i; ++j)
            EXPECT_EQ(without.meet(i, j), may_both_govern(plain, forms[j], forms[i], range));
      }
      EXPECT_EQ(usual.counts.rivals,
                counts.outside + counts.behind - before.outside - before.behind);
      EXPECT_EQ(plain.counts.rivals, 0u);
    }
    std::cout << counts.outside << " pairs apart by domains, " << counts.behind
              << " more behind a third, " << counts.neither << " not\n";
    EXPECT_GT(counts.outside, 100u);
    EXPECT_GT(counts.behind, 100u);
    EXPECT_GT(counts.neither, 100u);
  }
}

TEST(Rivals, SitesThatGovernAPointOfTheRange_AreNotApart_Medial) {
  const Counts c = run(DiagramKind::kMedial, 1, 8000);
  EXPECT_GT(c.ties, 3000);
  EXPECT_GT(c.exact, 300);
  EXPECT_GT(c.outside, 1400);
  EXPECT_GT(c.behind, 1400);
  EXPECT_GT(c.outside_with_tie, 300);
  EXPECT_GT(c.behind_with_tie, 200);
}

TEST(Rivals, SitesThatGovernAPointOfTheRange_AreNotApart_Voronoi) {
  const Counts c = run(DiagramKind::kVoronoi, 2, 3000);
  EXPECT_GT(c.ties, 5000);
  EXPECT_GT(c.exact, 700);
  EXPECT_GT(c.outside, 2500);
  EXPECT_GT(c.behind, 1600);
  EXPECT_GT(c.outside_with_tie, 600);
  EXPECT_GT(c.behind_with_tie, 300);
}

}  // namespace
}  // namespace blum
