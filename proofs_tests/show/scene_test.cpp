// Files of a medial axis read back, whole and broken; which cells are seen.

#include "blum/show/scene.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "blum/medial/io.hpp"
#include "blum/medial/simplify.hpp"
#include "blum/show/visible.hpp"
#include "blum/show/vtp_file.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

namespace fs = std::filesystem;

class SceneTest : public testing::Test {
 protected:
  SceneTest() {
    folder_ =
        fs::temp_directory_path() / ("blum_scene_" + std::to_string(getpid()) + "_" +
                                     testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  ~SceneTest() override { fs::remove_all(folder_); }

  MedialResult write(const PolygonMesh& mesh) {
    const Solid solid = test::solid_of(mesh);
    AngleOptions angles;
    angles.wanted = true;
    MedialResult axis = compute_medial_axis(solid, test::seeded(1), angles).value();
    EXPECT_FALSE(write_medial(axis, solid, prefix()).has_value());
    return axis;
  }
  [[nodiscard]] fs::path prefix() const { return folder_ / "x"; }
  [[nodiscard]] fs::path vtp() const { return folder_ / "x.vtp"; }
  [[nodiscard]] std::string text() const {
    std::ifstream in(vtp(), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void put(const std::string& text) const { std::ofstream(vtp(), std::ios::binary) << text; }

 private:
  fs::path folder_;
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
  // The by name: the file itself serves as well.
  EXPECT_TRUE(read_scene(vtp()).ok());
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

TEST_F(SceneTest, AbsentOrForeign_SaysSo) {
  EXPECT_EQ(read_scene(prefix()).error().code, ErrorCode::kFileNotFound);
  put("<VTKFile type=\"ImageData\"/>");
  EXPECT_EQ(read_scene(prefix()).error().code, ErrorCode::kMalformedFile);
  put("no xml");
  EXPECT_EQ(read_scene(prefix()).error().code, ErrorCode::kMalformedFile);
}

}  // namespace
}  // namespace blum
