// The CGAL engine's helper: what is done about one that dies, hangs or answers nonsense, and that
// answers survive the way through JSON.
#include <unistd.h>

#include <fstream>

#include "cgal_tally.hpp"

namespace blum {
namespace {

using test::Scene;

struct Example {
  Scene scene{"cuboid", shapes::cuboid(4, 3, 2)};
  std::vector<SiteId> candidates = scene.all_candidates();
  std::vector<std::uint32_t> triangles = scene.all_triangles();
  Rect rect = scene.rect(2, 0.75, 0.5, 3.6875, 0.4375, 2.625);
  [[nodiscard]] FaceProblem problem() const {
    return {scene.solid.get(), rect, candidates, triangles};
  }
  [[nodiscard]] FaceStatus ask(CgalEngine& engine) const {
    return engine.face(problem(), {}).status;
  }
};

/// An executable shell script that is removed in the end.
class Script {
 public:
  explicit Script(const std::string& text) {
    int file = mkstemp(name_);
    close(file);
    std::ofstream(name_) << "#!/bin/sh\n" << text << '\n';
    chmod_executable();
  }
  ~Script() { unlink(name_); }
  [[nodiscard]] const char* path() const { return name_; }

 private:
  void chmod_executable() {
    std::filesystem::permissions(name_, std::filesystem::perms::owner_all);
  }
  char name_[32] = "/tmp/blum-helper-XXXXXX";
};

TEST(CgalHelper, OneThatIsNotThereOrDies_IsUndecided) {
  const Example e;
  const Script dies("read x; exit 1");
  for (const char* path : {"/nowhere/blum-cgal-engine", "/bin/false", dies.path()}) {
    CgalEngine engine(*e.scene.solid, path);
    EXPECT_EQ(e.ask(engine), FaceStatus::kUndecided);
    EXPECT_EQ(e.ask(engine), FaceStatus::kUndecided);
    EXPECT_EQ(engine.counts().crashes, 2u);
    EXPECT_EQ(engine.counts().started, 2u);
    EXPECT_EQ(engine.segment(side_segment(e.rect, 0), e.candidates, e.triangles).status,
              FaceStatus::kUndecided);
  }
}

TEST(CgalHelper, OneThatHangs_IsKilledInTime) {
  const Example e;
  const Script hangs("while read x; do sleep 100; done");
  CgalLimits limits;
  limits.wall_s = 0.1;
  CgalEngine engine(*e.scene.solid, hangs.path(), CgalMethod::kAlgebraic, limits);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(e.ask(engine), FaceStatus::kUndecided);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  EXPECT_EQ(engine.counts().timeouts, 1u);
}

TEST(CgalHelper, OneThatAnswersNonsense_IsNotBelieved) {
  const Example e;
  const FaceDiagram right = brute_face(e.problem());
  ASSERT_EQ(right.status, FaceStatus::kDecided);
  FaceDiagram other_rect = right, foreign_site = right, no_label = right;
  other_rect.rect.level += 0.125;
  foreign_site.region[0].labels = {SiteId{1u << 30}};
  no_label.region[0].labels.clear();
  for (const std::string& answer :
       {std::string("nonsense"), std::string("{\"status\": 0}"), std::string("{\"status\": 7}"),
        face_answer(other_rect), face_answer(foreign_site), face_answer(no_label)}) {
    const Script lies("while read x; do cat <<'END'\n" + answer + "\nEND\ndone");
    CgalEngine engine(*e.scene.solid, lies.path());
    EXPECT_EQ(e.ask(engine), FaceStatus::kUndecided) << answer;
    EXPECT_EQ(engine.counts().malformed, 1u);
  }
  const Script honest("while read x; do cat <<'END'\n" + face_answer(right) + "\nEND\ndone");
  CgalEngine engine(*e.scene.solid, honest.path());
  EXPECT_EQ(e.ask(engine), FaceStatus::kDecided);
}

TEST(CgalHelper, AStop_EndsTheWait) {
  const Example e;
  const Script hangs("while read x; do sleep 100; done");
  CgalEngine engine(*e.scene.solid, hangs.path());
  const std::atomic<bool> stop{true};
  engine.stop_on(&stop);
  EXPECT_EQ(e.ask(engine), FaceStatus::kUndecided);
  EXPECT_EQ(engine.counts().timeouts, 0u);
}

TEST(CgalHelper, ARestart_ChangesNothing) {
  const auto helper = find_cgal_helper();
  if (!helper) GTEST_SKIP() << "no blum-cgal-engine: built without BLUM_CGAL_ORACLES";
  const Example e;
  CgalLimits limits;
  limits.requests = 2;
  CgalEngine engine(*e.scene.solid, *helper, CgalMethod::kAlgebraic, limits);
  const FaceDiagram first = engine.face(e.problem(), {});
  ASSERT_EQ(first.status, FaceStatus::kDecided) << first.reason;
  for (int k = 0; k < 3; ++k)
    EXPECT_EQ(face_answer(engine.face(e.problem(), {})), face_answer(first));
  EXPECT_EQ(engine.counts().started, 2u);
  EXPECT_EQ(engine.counts().crashes + engine.counts().timeouts + engine.counts().malformed, 0u);
}

TEST(CgalHelper, TooLittleMemory_IsUndecided) {
  const auto helper = find_cgal_helper();
  if (!helper) GTEST_SKIP() << "no blum-cgal-engine: built without BLUM_CGAL_ORACLES";
  const Example e;
  CgalLimits limits;
  limits.memory_bytes = 1 << 20;
  CgalEngine engine(*e.scene.solid, *helper, CgalMethod::kAlgebraic, limits);
  EXPECT_EQ(e.ask(engine), FaceStatus::kUndecided);
  EXPECT_EQ(engine.counts().crashes, 1u);
}

TEST(EngineJson, DiagramsAndRequests_SurviveTheWay) {
  test::Random random(51);
  int decided = 0;
  for (const Scene& s : test::catalogue(random)) {
    const Rect r = test::random_rect(random, s, 0.2);
    const auto near = s.near(r);
    const auto triangles = s.all_triangles();
    if (near.size() > 10 || s.curved(near) > 3) continue;
    const FaceProblem problem{s.solid.get(), r, near, triangles};
    const auto request = read_request(face_request(problem));
    ASSERT_TRUE(request.ok());
    EXPECT_EQ(request.value().rect, r);
    EXPECT_EQ(request.value().candidates, near);
    EXPECT_EQ(request.value().triangles, triangles);
    const auto solid = read_request(solid_request(*s.solid));
    ASSERT_TRUE(solid.ok());
    EXPECT_EQ(solid.value().solid.point, s.solid->point);
    EXPECT_EQ(solid_request(solid.value().solid), solid_request(*s.solid));
    const FaceDiagram d = brute_face(problem);
    if (d.status != FaceStatus::kDecided) continue;
    ++decided;
    const auto back = read_face_answer(face_answer(d));
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(face_answer(back.value()), face_answer(d));
    EXPECT_EQ(test::exact_difference(d, back.value()), "");
    const auto side = read_segment_answer(segment_answer(*d.side[0]));
    ASSERT_TRUE(side.ok());
    EXPECT_EQ(segment_answer(*side.value().diagram), segment_answer(*d.side[0]));
  }
  EXPECT_GE(decided, 10);
}

TEST(EngineJson, IndicesOutOfRange_AreErrors) {
  for (const char* text :
       {"", "{", "[]", "{\"rect\": [3,0,0,1,0,1]}", "{\"rect\": [0,0,0,1]}",
        "{\"solid\": {\"points\": [[0,0,0]], \"edges\": [[0,1,0,0,0]], \"triangles\": [],"
        " \"degenerate_vertices\": []}}",
        "{\"solid\": {\"points\": [[0,0,0]], \"edges\": [], \"triangles\": [],"
        " \"degenerate_vertices\": [1]}}"})
    EXPECT_FALSE(read_request(text).ok()) << text;
  for (const char* text : {"", "{}", "{\"status\": 3}", "{\"status\": 0}", "{\"status\": 1}"}) {
    EXPECT_FALSE(read_face_answer(text).ok()) << text;
    EXPECT_FALSE(read_segment_answer(text).ok()) << text;
  }
}

}  // namespace
}  // namespace blum
