// The complex does not depend on the number of threads.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <thread>

#include "blum/subdivision/run_watch.hpp"
#include "medial/axis_tools.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

using test::Scene;

MedialResult axis(const Solid& solid, const MedialOptions& options) {
  auto r = compute_medial_axis(solid, options);
  if (!r) throw std::runtime_error(r.error().message);
  return std::move(r).value();
}

void expect_same(const Solid& solid, MedialOptions o, std::initializer_list<int> threads) {
  o.threads = 1;
  const MedialResult one = axis(solid, o);
  EXPECT_TRUE(one.certified);
  for (const int n : threads) {
    o.threads = n;
    const MedialResult many = axis(solid, o);
    EXPECT_EQ(many.threads, n);
    EXPECT_EQ(test::difference(one.complex, many.complex), "") << n << " threads";
    EXPECT_EQ(one.leaves, many.leaves);
    EXPECT_EQ(one.hausdorff_bound, many.hausdorff_bound);
  }
}

std::vector<Scene> solids() {
  return {{"cuboid", shapes::cuboid(1, 1.25, 2)},
          {"lbracket", shapes::lbracket()},
          {"plate with two holes", shapes::plate(2, 6)},
          {"torus", shapes::torus(16, 8, 2, 0.75)},
          {"nested voids", shapes::nested_voids(2)},
          {"star void", test::star_void(3)},
          {"rotated lbracket", test::rotated(shapes::lbracket())}};
}

TEST(Threads, AnyNumber_GivesTheSameComplex) {
  for (const Scene& s : solids()) {
    SCOPED_TRACE(s.name);
    expect_same(test::solid_of(s.mesh), test::seeded(1), {2, 3, 8});
  }
}

TEST(Threads, AnyNumber_GivesTheSameComplexResolvedToo) {
  for (const Scene& s : solids()) {
    SCOPED_TRACE(s.name);
    MedialOptions o = test::seeded(2);
    o.resolve = s.name != "torus";  // takes minutes there
    expect_same(test::solid_of(s.mesh), o, {2, 3, 8});
  }
}

TEST(Threads, AnyNumber_GivesTheSameFineComplexWithAndWithoutHints) {
  for (const Scene& s : solids()) {
    SCOPED_TRACE(s.name);
    const Solid solid = test::solid_of(s.mesh);
    MedialOptions o = test::seeded(3, 0.3 * test::extent(s.mesh.points));
    const MedialResult plain = axis(solid, o);
    o.distance_hint = test::true_distance_hint(solid, 3);
    expect_same(solid, o, {3});
    o.threads = 2;
    EXPECT_EQ(test::difference(plain.complex, axis(solid, o).complex), "");
  }
}

TEST(Threads, ShuffledMeshes_GiveTheSameComplexEach) {
  for (const std::uint64_t seed : {1, 2}) {
    const PolygonMesh mesh = shapes::shuffle(test::rotated(shapes::plate(1, 6)), seed);
    expect_same(test::solid_of(mesh), test::seeded(seed), {3});
  }
}

TEST(SweepThreads, LargerModels_GiveTheSameComplex) {
  std::vector<Scene> models{{"torus 32 16", shapes::torus(32, 16, 2, 0.75)}};
  for (const char* const name : {"joint", "plate_holes"})
    if (const auto mesh =
            read_mesh(std::filesystem::path(BLUM_MODELS_DIR) / (std::string(name) + ".off")))
      models.push_back({name, mesh.value()});
  for (const Scene& s : models) {
    SCOPED_TRACE(s.name);
    expect_same(test::solid_of(s.mesh), test::seeded(1), {2, 4});
  }
}

// Limits --------------------------------------------------------------------------------------

/// Takes minutes.
MedialOptions fine() { return test::seeded(1, 0.01); }

TEST(TimeLimit, LongRun_EndsInTime) {
  const Solid solid = test::solid_of(shapes::torus(16, 8, 2, 0.75));
  for (const int threads : {1, 3}) {
    MedialOptions o = fine();
    o.threads = threads;
    o.time_limit_s = 1;
    const auto start = std::chrono::steady_clock::now();
    const MedialResult r = axis(solid, o);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    EXPECT_FALSE(r.certified);
    EXPECT_GT(time.count(), 0.9);
    EXPECT_LT(time.count(), 2.5);  // 2, but for machines that do several things at once
    ASSERT_FALSE(r.undecided.empty());
    for (const UndecidedCell& c : r.undecided) EXPECT_EQ(c.reason, UndecidedReason::kTime);
  }
}

TEST(MemoryLimit, LongRun_StaysBelow) {
  const Solid solid = test::solid_of(shapes::torus(16, 8, 2, 0.75));
  MedialOptions o = fine();
  o.threads = 2;
  o.max_memory_bytes = resident_memory_bytes() + (16u << 20);
  const MedialResult r = axis(solid, o);
  EXPECT_LT(resident_memory_bytes(), o.max_memory_bytes + (64u << 20));
  EXPECT_FALSE(r.certified);
  EXPECT_TRUE(r.complex.vertex.empty());
  ASSERT_FALSE(r.undecided.empty());
  for (const UndecidedCell& c : r.undecided) {
    EXPECT_EQ(c.reason, UndecidedReason::kMemory);
    EXPECT_GE(c.depth, 0);
  }
}

TEST(Interruption, Progress_IsAskedByOneThreadAtATime) {
  std::atomic<int> inside{0};
  int calls = 0;
  MedialOptions o = fine();
  o.threads = 3;
  o.on_progress = [&](const Progress&) {
    EXPECT_EQ(++inside, 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    --inside;
    return ++calls < 50;
  };
  const auto r = compute_medial_axis(test::solid_of(shapes::torus(16, 8, 2, 0.75)), o);
  ASSERT_FALSE(r.ok());
  EXPECT_EQ(r.error().code, ErrorCode::kInterrupted);
  EXPECT_EQ(calls, 50);
}

TEST(Interruption, ExceptionsOfTheCaller_ComeBack) {
  for (const int threads : {1, 3}) {
    MedialOptions o = test::seeded(1, 0.3);
    o.threads = threads;
    o.on_progress = [](const Progress&) -> bool { throw std::runtime_error("from outside"); };
    const Solid solid = test::solid_of(shapes::torus(8, 4, 2, 0.75));
    EXPECT_THROW((void)compute_medial_axis(solid, o), std::runtime_error);
    o.on_progress = {};
    o.distance_hint = [](const Point3&) -> double { throw std::runtime_error("from outside"); };
    EXPECT_THROW((void)compute_medial_axis(solid, o), std::runtime_error);
  }
}

}  // namespace
}  // namespace blum
