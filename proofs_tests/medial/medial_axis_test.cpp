// From a solid to its axis in one call: budgets, hints, engines.

#include "blum/medial/medial_axis.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "medial/axis_tools.hpp"
#include "patience.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

using test::difference;
using test::Scene;
using test::true_distance_hint;

MedialOptions seeded(std::uint64_t seed, double max_leaf_diameter = 0) {
  MedialOptions o;
  o.seed = seed;
  o.max_leaf_diameter = max_leaf_diameter;
  return o;
}

MedialResult axis(const PolygonMesh& mesh, const MedialOptions& options) {
  auto r = compute_medial_axis(test::solid_of(mesh), options);
  if (!r) throw std::runtime_error(r.error().message);
  return std::move(r).value();
}

std::array<std::uint32_t, 3> counts(const MedialResult& r) {
  return {r.parts.sheets, r.parts.seams, r.parts.junctions + r.parts.clusters};
}

void expect_certified(const MedialResult& r) {
  EXPECT_TRUE(r.certified);
  EXPECT_TRUE(r.undecided.empty());
  EXPECT_EQ(r.betti, r.solid_betti);
}

TEST(MedialAxis, AnySolid_IsCertifiedWithItsBettiNumbers) {
  for (const Scene& scene : test::scenes())
    for (const std::uint64_t seed : {1, 2, 3}) {
      SCOPED_TRACE(scene.name + ", seed " + std::to_string(seed));
      expect_certified(axis(scene.mesh, seeded(seed)));
    }
}

TEST(MedialAxis, SameSeed_GivesTheSameComplex) {
  for (const Scene& scene : test::scenes()) {
    const double d = 0.3 * test::extent(scene.mesh.points);
    EXPECT_EQ(
        difference(axis(scene.mesh, seeded(4, d)).complex, axis(scene.mesh, seeded(4, d)).complex),
        "")
        << scene.name;
  }
}

TEST(MedialAxis, LeafDiameterAskedFor_BoundsTheHausdorffDistance) {
  for (const Scene& scene : test::scenes()) {
    const double d = 0.3 * test::extent(scene.mesh.points);
    const MedialResult r = axis(scene.mesh, seeded(4, d));
    SCOPED_TRACE(scene.name);
    expect_certified(r);
    EXPECT_LE(r.hausdorff_bound, d * (1 + 1e-14));
    EXPECT_GT(r.hausdorff_bound, 0);
  }
}

TEST(DistanceHints, ValidBounds_ChangeNothing) {
  for (const Scene& scene : test::scenes())
    for (const bool resolve : {false, true}) {
      SCOPED_TRACE(scene.name + (resolve ? ", resolved" : ""));
      const Solid solid = test::solid_of(scene.mesh);
      MedialOptions o = seeded(2, resolve ? 0 : 0.6 * test::extent(scene.mesh.points));
      o.resolve = resolve;
      const auto plain = compute_medial_axis(solid, o);
      ASSERT_TRUE(plain.ok());
      for (const double spread : {0.0, 3.0}) {
        o.distance_hint = true_distance_hint(solid, spread);
        const auto hinted = compute_medial_axis(solid, o);
        ASSERT_TRUE(hinted.ok());
        EXPECT_TRUE(hinted.value().certified);
        EXPECT_EQ(difference(plain.value().complex, hinted.value().complex), "")
            << "spread " << spread;
      }
    }
}

TEST(DistanceHints, NothingKnown_ChangesNothing) {
  const PolygonMesh mesh = shapes::lbracket();
  MedialOptions o = seeded(1, 0.5);
  const MedialResult plain = axis(mesh, o);
  o.distance_hint = [](const Point3&) { return std::numeric_limits<double>::infinity(); };
  EXPECT_EQ(difference(plain.complex, axis(mesh, o).complex), "");
}

TEST(MedialAxis, BudgetSpent_IsNotCertifiedAndSaysWhere) {
  const PolygonMesh mesh = shapes::torus(8, 4, 2, 0.75);
  MedialOptions depth = seeded(1, 0.5), cells = depth, time = depth, memory = depth;
  depth.max_depth = 3;
  cells.max_cells = 10;
  time.time_limit_s = 1e-12;
  memory.max_memory_bytes = 1;
  for (const auto& [o, reason] :
       {std::pair{depth, UndecidedReason::kDepth}, std::pair{cells, UndecidedReason::kCells},
        std::pair{time, UndecidedReason::kTime}, std::pair{memory, UndecidedReason::kMemory}}) {
    const MedialResult r = axis(mesh, o);
    EXPECT_FALSE(r.certified);
    ASSERT_FALSE(r.undecided.empty());
    for (const UndecidedCell& c : r.undecided) {
      EXPECT_EQ(c.reason, reason);
      for (int k = 0; k < 3; ++k) EXPECT_LT(c.box.lo[k], c.box.hi[k]);
    }
  }
}

TEST(MedialAxis, ProgressRefused_IsInterrupted) {
  MedialOptions o = seeded(1, 0.2);
  o.on_progress = [](const Progress&) { return false; };
  const auto r = compute_medial_axis(test::solid_of(shapes::lbracket()), o);
  ASSERT_FALSE(r.ok());
  EXPECT_EQ(r.error().code, ErrorCode::kInterrupted);
}

TEST(MedialAxis, ArgumentsOutOfRange_AreRefused) {
  const Solid solid = test::solid_of(shapes::cuboid(1, 1, 2));
  std::vector<MedialOptions> bad(5);
  bad[0].max_depth = -1;
  bad[1].threads = 0;
  bad[2].time_limit_s = -1;
  bad[3].max_leaf_diameter = -1;
  bad[4].time_limit_s = std::numeric_limits<double>::quiet_NaN();
  for (const MedialOptions& o : bad) {
    const auto r = compute_medial_axis(solid, o);
    ASSERT_FALSE(r.ok());
    EXPECT_EQ(r.error().code, ErrorCode::kBadArgument);
  }
}

// Engines -------------------------------------------------------------------------------------

void compare_engines(const PolygonMesh& mesh, std::uint64_t seed,
                     std::initializer_list<bool> resolves = {false, true}) {
  for (const bool resolve : resolves) {
    SCOPED_TRACE(resolve ? "resolved" : "not resolved");
    MedialOptions o = seeded(seed);
    o.resolve = resolve;
    const MedialResult production = axis(mesh, o);
    o.engine = Engine::kBrute;
    o.time_limit_s = test::patience_s(300);
    const MedialResult brute = axis(mesh, o);
    expect_certified(production);
    expect_certified(brute);
    if (resolve) EXPECT_EQ(counts(production), counts(brute));
  }
}

TEST(Engines, Cuboid_GiveTheSameAnswer) { compare_engines(shapes::cuboid(1, 1.25, 2), 1); }
TEST(Engines, Prism_GiveTheSameAnswer) { compare_engines(shapes::prism(3), 1); }
TEST(Engines, LBracket_GiveTheSameAnswer) { compare_engines(shapes::lbracket(), 1); }

TEST(SweepEngines, MoreSolidsAndSeeds_GiveTheSameAnswer) {
  std::vector<Scene> solids{
      {"cuboid", shapes::cuboid(1, 1.25, 2)}, {"square bar", shapes::cuboid(1, 1, 2)},
      {"cube", shapes::cuboid(1, 1, 1)},      {"prism 3", shapes::prism(3)},
      {"prism 5", shapes::prism(5)},          {"lbracket", shapes::lbracket()},
      {"voids 1", shapes::nested_voids(1)}};
  const std::filesystem::path p = BLUM_MODELS_DIR "/P_polygons.off";
  if (const auto mesh = read_mesh(p)) solids.push_back({"P_polygons", mesh.value()});
  for (const Scene& s : solids)
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(s.name + ", seed " + std::to_string(seed));
      compare_engines(s.mesh, seed);
    }
  // Resolved, its counts vary with the seed (seams and junctions as near as facets are flat), and
  // the brute engine takes more than 300 s.
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    compare_engines(test::rotated(shapes::lbracket()), seed, {false});
}

}  // namespace
}  // namespace blum
