// The shared models and the generated solids of the list, turned into general position.

#include <gtest/gtest.h>

#include <filesystem>

#include "blum/medial/medial_axis.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

const char* const kModels[] = {"cube",           "cross",
                               "P_polygons",     "cube_minus_octant",
                               "cray_left_void", "derived_cube_sphere_void"};

void expect_certified(const PolygonMesh& mesh, std::uint64_t seed) {
  MedialOptions o;
  o.seed = seed;
  const auto r = compute_medial_axis(test::solid_of(mesh), o);
  ASSERT_TRUE(r.ok()) << r.error().message;
  EXPECT_TRUE(r.value().certified);
  EXPECT_EQ(r.value().betti, r.value().solid_betti);
}

void check_models(std::span<const char* const> names, std::initializer_list<std::uint64_t> seeds,
                  std::initializer_list<std::uint64_t> rotations) {
  for (const char* const name : names) {
    const auto path = std::filesystem::path(BLUM_MODELS_DIR) / (std::string(name) + ".off");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no model: " << path;
    const auto mesh = read_mesh(path);
    ASSERT_TRUE(mesh.ok());
    for (const auto seed : seeds)
      for (const auto rotation : rotations) {
        SCOPED_TRACE(std::string(name) + ", seed " + std::to_string(seed) + ", rotation " +
                     std::to_string(rotation));
        expect_certified(
            rotation == 0 ? mesh.value() : shapes::rotate_rounded(mesh.value(), rotation), seed);
      }
  }
}

TEST(SharedModels, Rotated_AreCertified) { check_models(kModels, {1}, {1}); }
TEST(SweepSharedModels, SeveralSeedsAndRotations_AreCertified) {
  check_models(kModels, {1, 2, 3, 4, 5}, {0, 1, 2, 3});
}
std::vector<test::Scene> generated() {
  std::vector<test::Scene> all{{"cuboid", shapes::cuboid(2, 2, 3)},
                               {"lbracket", shapes::lbracket()},
                               {"plate 1", shapes::plate(1, 6)},
                               {"plate 2", shapes::plate(2, 6)},
                               {"torus 8x4", shapes::torus(8, 4, 2, 0.75)},
                               {"torus 16x8", shapes::torus(16, 8, 2, 0.75)}};
  for (int n = 3; n <= 16; ++n)
    for (const shapes::Move& move : {shapes::Move{}, {1e-6, 0}, {1e-12, 0}, {0, 1}})
      all.push_back({"prism " + std::to_string(n) + " moved by " + std::to_string(move.amount) +
                         " and " + std::to_string(move.ulps) + " ulps",
                     shapes::prism(n, 1, 1, move)});
  return all;
}

std::vector<test::Scene> with_inner_corners() {
  return {{"lpocket", shapes::lpocket()},
          {"voids 1", shapes::nested_voids(1)},
          {"voids 2", shapes::nested_voids(2)},
          {"voids 3", shapes::nested_voids(3)}};
}

void check_rotated(const std::vector<test::Scene>& solids,
                   std::initializer_list<std::uint64_t> seeds,
                   std::initializer_list<std::uint64_t> rotations) {
  for (const test::Scene& s : solids)
    for (const auto seed : seeds)
      for (const auto rotation : rotations) {
        SCOPED_TRACE(s.name + ", seed " + std::to_string(seed) + ", rotation " +
                     std::to_string(rotation));
        expect_certified(shapes::rotate_rounded(s.mesh, rotation), seed);
      }
}

TEST(GeneratedSolids, Rotated_AreCertified) { check_rotated(generated(), {1}, {1}); }
TEST(GeneratedSolids, WithInnerCornersRotated_AreCertified) {
  check_rotated(with_inner_corners(), {1}, {1});
}
TEST(SweepGeneratedSolids, SeveralSeedsAndRotations_AreCertified) {
  check_rotated(generated(), {1, 2, 3}, {1, 2, 3});
}

}  // namespace
}  // namespace blum
