// Files of a medial axis read back, whole and broken; which cells are seen.

#include "blum/show/scene.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "blum/medial/io.hpp"
#include "blum/medial/simplify.hpp"
#include "blum/show/visible.hpp"
#include "blum/show/vtp_file.hpp"
#include "subdivision/solid_scenes.hpp"
#include "test_folder.hpp"

namespace blum {
namespace {

namespace fs = std::filesystem;

class SceneTest : public testing::Test {
 protected:
  MedialResult write(const PolygonMesh& mesh) {
    const Solid solid = test::solid_of(mesh);
    AngleOptions angles;
    angles.wanted = true;
    MedialResult axis = compute_medial_axis(solid, test::seeded(1), angles).value();
    EXPECT_FALSE(write_medial(axis, solid, prefix()).has_value());
    return axis;
  }
  [[nodiscard]] fs::path prefix() const { return folder_.path() / "x"; }
  [[nodiscard]] fs::path vtp() const { return folder_.path() / "x.vtp"; }
  [[nodiscard]] std::string text() const { return test::bytes_of(vtp()); }
  /// The summary beside it; a foreign file may have its name.
  void put_json(const std::string& text) const {
    std::ofstream(folder_.path() / "x.json", std::ios::binary) << text;
  }
  void put(const std::string& text) const { std::ofstream(vtp(), std::ios::binary) << text; }

 private:
  test::Folder folder_;
};

TEST_F(SceneTest, FileOfAnAxis_ReadsBackAsItIs) {
  const MedialResult axis = write(shapes::plate(1, 6));
  const Result<Scene> read = read_scene(prefix());
  ASSERT_TRUE(read.ok()) << read.error().message;
  const Scene& scene = read.value();
  ASSERT_EQ(scene.point.size(), axis.complex.vertex.size());
  ASSERT_EQ(scene.triangle.size(), axis.complex.triangle.size());
  for (std::size_t i = 0; i < scene.point.size(); ++i) {
    EXPECT_EQ(scene.point[i], axis.complex.vertex[i].position);
    EXPECT_EQ(scene.radius[i], axis.complex.vertex[i].radius);
    const auto& own = axis.complex.vertex[i].governors;
    ASSERT_EQ(scene.governor_begin[i + 1] - scene.governor_begin[i], own.size());
    for (std::size_t k = 0; k < own.size(); ++k) {
      EXPECT_EQ(scene.governor[scene.governor_begin[i] + k], own[k].value);
    }
  }
  for (std::size_t t = 0; t < scene.triangle.size(); ++t) {
    EXPECT_EQ(scene.triangle_edge[t], axis.complex.triangle[t].edge);
    EXPECT_EQ(scene.triangle_theta[t], axis.filtration->value.triangle[t]);
    for (int k = 0; k < 2; ++k) {
      EXPECT_EQ(scene.triangle_governor[t][k], axis.complex.triangle[t].governors[k].value);
    }
  }
  // By its own name, too.
  EXPECT_TRUE(read_scene(vtp()).ok());
}

TEST_F(SceneTest, Facts_AreThoseOfTheFile) {
  const auto fact = [this](const std::string& name) {
    const Scene scene = read_scene(prefix()).value();
    for (const auto& [key, value] : scene.fact)
      if (key == name) return value;
    return std::string("none");
  };
  const Solid solid = test::solid_of(shapes::lbracket());
  MedialResult axis = write(shapes::lbracket());
  EXPECT_EQ(fact("certified"), "yes");
  EXPECT_EQ(fact("Betti numbers"), "1 0 0");
  EXPECT_EQ(fact("sheets"), std::to_string(axis.parts.sheets));
  EXPECT_EQ(fact("clusters"), std::to_string(axis.parts.clusters));
  EXPECT_NE(fact("Hausdorff bound"), "none");
  // A summary of the whole axis beside what is left of it.
  put_json(R"({"seed": 1, "sites": {"faces": )" + std::to_string(solid.triangle.size()) +
           R"(}, "model": "l.off", "result": {"betti": [7, 7, 7], "sheets": 77}})");
  for (const Simplify how : {Simplify::kHomotopy, Simplify::kSubset}) {
    const MedialResult part = simplified(axis, 100, how);
    ASSERT_LT(part.complex.triangle.size(), axis.complex.triangle.size());
    ASSERT_FALSE(write_medial(part, solid, prefix()).has_value());
    EXPECT_EQ(fact("certified"), "from a certified axis");
    EXPECT_EQ(fact("Betti numbers"), std::to_string(part.betti[0]) + ' ' +
                                         std::to_string(part.betti[1]) + ' ' +
                                         std::to_string(part.betti[2]));
    EXPECT_EQ(fact("sheets"), std::to_string(count_shapes(part.complex).sheets));
    EXPECT_EQ(fact("clusters"), "none");
    EXPECT_EQ(fact("Hausdorff bound"), "none");
  }
  // An angle that leaves out nothing.
  ASSERT_FALSE(write_medial(simplified(axis, 0, Simplify::kHomotopy), solid, prefix()).has_value());
  EXPECT_EQ(fact("certified"), "yes");
  EXPECT_NE(fact("Hausdorff bound"), "none");
  axis.smoothed = true;
  ASSERT_FALSE(write_medial(axis, solid, prefix()).has_value());
  EXPECT_EQ(fact("certified"), "no");
  EXPECT_EQ(fact("Hausdorff bound"), "none");
}

TEST_F(SceneTest, EveryTheta_SeenAreTheTrianglesOfTheSimplifiedAxis) {
  const MedialResult axis = write(shapes::lbracket());
  const Scene scene = read_scene(prefix()).value();
  std::size_t fewest = scene.triangle.size();
  for (const double theta : {0.0, 45.0, 89.0, 91.0, 120.0, 179.0}) {
    const VisibleCells visible = visible_cells(scene, theta);
    const MedialResult part = simplified(axis, theta, Simplify::kHomotopy);
    EXPECT_EQ(visible.triangle.size(), part.complex.triangle.size()) << theta;
    fewest = std::min(fewest, visible.triangle.size());
  }
  EXPECT_LT(fewest, scene.triangle.size());
}

TEST_F(SceneTest, CutAnywhere_IsAnErrorAndNothingElse) {
  write(shapes::cuboid(1, 2, 3));
  const std::string whole = text();
  for (std::size_t length = 0; length + 12 < whole.size(); length += 97) {
    put(whole.substr(0, length));
    EXPECT_FALSE(read_scene(prefix()).ok()) << length;
  }
}

TEST_F(SceneTest, BytesChangedAtRandom_NeverCrash) {
  write(shapes::cuboid(1, 2, 3));
  const std::string whole = text();
  std::mt19937 random(1);
  int refused = 0;
  for (int i = 0; i < 400; ++i) {
    std::string broken = whole;
    for (int k = 0; k < 3; ++k)
      broken[random() % broken.size()] = static_cast<char>(random() % 128);
    put(broken);
    const Result<Scene> read = read_scene(prefix());
    if (!read) ++refused;
    if (read) (void)visible_cells(read.value(), 60);
  }
  EXPECT_GT(refused, 25);
}

std::string nested(const std::string& open, const std::string& middle, const std::string& close) {
  std::string text;
  constexpr int kDeep = 200000;
  for (int i = 0; i < kDeep; ++i) text += open;
  text += middle;
  for (int i = 0; i < kDeep; ++i) text += close;
  return text;
}

TEST_F(SceneTest, SummaryOfTheRun_GivesTheModelsName) {
  const MedialResult axis = write(shapes::cuboid(1, 2, 3));
  const std::string faces = std::to_string(read_scene(prefix()).value().site_counts[2]);
  const std::string seed = std::to_string(axis.seed);
  EXPECT_EQ(read_scene(prefix()).value().title, "x");
  put_json(R"({"model": "some/box.off", "seed": )" + seed + R"(, "sites": {"faces": )" + faces +
           "}}");
  EXPECT_EQ(read_scene(prefix()).value().title, "box.off");
  put_json(R"({"model": "some/box.off", "seed": )" + seed + R"(, "sites": {"faces": 13}})");
  EXPECT_EQ(read_scene(prefix()).value().title, "x");
}

TEST_F(SceneTest, ForeignSummary_IsLeftAlone) {
  const MedialResult axis = write(shapes::cuboid(1, 2, 3));
  const std::string faces = std::to_string(read_scene(prefix()).value().site_counts[2]);
  const std::string head =
      "{\"seed\": " + std::to_string(axis.seed) + ", \"sites\": {\"faces\": " + faces + "}, ";
  const std::string deep = nested("[", "", "]"), deep_objects = nested("{\"a\":", "1", "}");
  for (const std::string& text :
       {std::string(), std::string("[]"), std::string("{\"seed\": \"1\"}"),
        std::string("{\"seed\": 1.5, \"sites\": 3}"), head + "\"model\": 3}",
        head + "\"model\": " + deep + "}",
        head + "\"result\": {\"betti\": [" + deep + "," + deep_objects + ",1]}}",
        head + "\"result\": {\"betti\": {\"b\": 1}, \"sheets\": [1]}}",
        "{\"seed\": " + deep + ", \"sites\": " + deep_objects + "}",
        "{\"seed\": 1, \"sites\": " + deep_objects + "}", deep, deep_objects, nested("[", "", ""),
        nested("{\"a\":", "", "")}) {
    put_json(text);
    const Result<Scene> read = read_scene(prefix());
    ASSERT_TRUE(read.ok()) << text.substr(0, 80);
    EXPECT_EQ(read.value().title, "x") << text.substr(0, 80);
  }
}

TEST_F(SceneTest, AbsentOrForeign_SaysSo) {
  EXPECT_EQ(read_scene(prefix()).error().code, ErrorCode::kFileNotFound);
  put("<VTKFile type=\"ImageData\"/>");
  EXPECT_EQ(read_scene(prefix()).error().code, ErrorCode::kMalformedFile);
  put("no xml");
  EXPECT_EQ(read_scene(prefix()).error().code, ErrorCode::kMalformedFile);
}

}  // namespace
}  // namespace blum
