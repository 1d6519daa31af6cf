// Larger and real parts, as they are, turned, moved and scaled.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>

#include "blum/medial/medial_axis.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

struct Change {
  std::string name;
  std::function<PolygonMesh(const PolygonMesh&)> of;
};

PolygonMesh with_points(PolygonMesh mesh, const std::function<Point3(const Point3&)>& map) {
  for (Point3& p : mesh.points) p = map(p);
  return mesh;
}

Change as_it_is() {
  return {"as it is", [](const PolygonMesh& m) { return m; }};
}

Change turned(std::uint64_t seed) {
  return {"turned at random " + std::to_string(seed),
          [seed](const PolygonMesh& m) { return shapes::rotate_rounded(m, seed); }};
}

/// A rational rotation times its denominator: exact where coordinates have few digits.
Change pythagorean(int a, int b, int c, int d) {
  return {
      "turned by the quaternion " + std::to_string(a) + " " + std::to_string(b) + " " +
          std::to_string(c) + " " + std::to_string(d),
      [=](const PolygonMesh& m) {
        const double r[3][3] = {
            {1.0 * a * a + b * b - c * c - d * d, 2.0 * (b * c - a * d), 2.0 * (b * d + a * c)},
            {2.0 * (b * c + a * d), 1.0 * a * a - b * b + c * c - d * d, 2.0 * (c * d - a * b)},
            {2.0 * (b * d - a * c), 2.0 * (c * d + a * b), 1.0 * a * a - b * b - c * c + d * d}};
        return with_points(m, [&](const Point3& p) {
          Point3 q;
          for (int k = 0; k < 3; ++k) q[k] = r[k][0] * p.x + r[k][1] * p.y + r[k][2] * p.z;
          return q;
        });
      }};
}

Change far_away() {
  return {"moved by a million diagonals", [](const PolygonMesh& m) {
            const double far = 1e6 * test::extent(m.points);
            return with_points(m, [far](const Point3& p) {
              return Point3{p.x + far, p.y - far, p.z + far};
            });
          }};
}

Change scaled(int exponent) {
  return {"scaled by 2^" + std::to_string(exponent), [exponent](const PolygonMesh& m) {
            return with_points(m, [exponent](const Point3& p) {
              return Point3{std::ldexp(p.x, exponent), std::ldexp(p.y, exponent),
                            std::ldexp(p.z, exponent)};
            });
          }};
}

std::vector<Change> all_changes() {
  std::vector<Change> changes{
      as_it_is(),  pythagorean(1, 2, 3, 4), pythagorean(5, 1, -2, 2), far_away(), scaled(100),
      scaled(-100)};
  for (std::uint64_t seed = 1; seed <= 5; ++seed) changes.push_back(turned(seed));
  return changes;
}

void expect_certified(const test::Scene& scene, const Change& change, std::uint64_t seed) {
  SCOPED_TRACE(scene.name + ", " + change.name + ", seed " + std::to_string(seed));
  MedialOptions o;
  o.seed = seed;
  o.threads = 2;
  const auto r = compute_medial_axis(test::solid_of(change.of(scene.mesh)), o);
  ASSERT_TRUE(r.ok()) << r.error().message;
  EXPECT_TRUE(r.value().certified) << r.value().undecided.size() << " cells undecided";
  if (r.value().certified) EXPECT_EQ(r.value().betti, r.value().solid_betti);
}

std::vector<test::Scene> generated() {
  std::vector<test::Scene> scenes{{"torus 32x16", shapes::torus(32, 16, 2, 0.75)}};
  for (int n = 3; n <= 32; ++n) scenes.push_back({"prism " + std::to_string(n), shapes::prism(n)});
  for (int n = 1; n <= 16; ++n)
    scenes.push_back({"plate " + std::to_string(n), shapes::plate(n, 6)});
  for (int n = 1; n <= 5; ++n)
    scenes.push_back({"voids " + std::to_string(n), shapes::nested_voids(n)});
  return scenes;
}

TEST(CadParts, SampleOfChanges_AreCertified) {
  const std::vector<test::Scene> scenes{{"prism 32", shapes::prism(32)},
                                        {"voids 5", shapes::nested_voids(5)},
                                        {"plate 4", shapes::plate(4, 6)}};
  for (const Change& change : {as_it_is(), turned(1), far_away(), scaled(100), scaled(-100)})
    for (const test::Scene& scene : scenes) expect_certified(scene, change, 1);
  for (std::size_t k = 0; k < 2; ++k) expect_certified(scenes[k], pythagorean(1, 2, 3, 4), 1);
}

// The facets with holes are triangulated with slivers 1e-16 wide between faces that do not meet.
TEST(CadParts, PlateTurnedExactly_IsCertified) {
  expect_certified({"plate 3", shapes::plate(3, 6)}, pythagorean(1, 2, 3, 4), 1);
}

TEST(SweepCadParts, PlateTurnedExactly_IsCertified) {
  expect_certified({"plate 4", shapes::plate(4, 6)}, pythagorean(1, 2, 3, 4), 1);
}

TEST(SweepCadParts, Generated_AreCertifiedHoweverChanged) {
  for (const test::Scene& scene : generated())
    for (const Change& change : all_changes())
      for (std::uint64_t seed = 1; seed <= 5; ++seed) expect_certified(scene, change, seed);
}

test::Scene shared_model(const std::string& name) {
  const auto path = std::filesystem::path(BLUM_MODELS_DIR) / (name + ".off");
  if (!std::filesystem::exists(path)) return {"", {}};
  auto mesh = read_mesh(path);
  if (!mesh) throw std::runtime_error(mesh.error().message);
  return {name, std::move(mesh).value()};
}

TEST(CadParts, Joint_IsCertified) {
  const test::Scene scene = shared_model("joint");
  if (scene.name.empty()) GTEST_SKIP() << "no shared models in " << BLUM_MODELS_DIR;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) expect_certified(scene, as_it_is(), seed);
}

// Eight nearly coplanar faces meet in a vertex: their sheets meet within 1e-16 of a line.
TEST(CadParts, JointTurned_IsCertified) {
  const test::Scene scene = shared_model("joint");
  if (scene.name.empty()) GTEST_SKIP() << "no shared models in " << BLUM_MODELS_DIR;
  expect_certified(scene, turned(4), 1);
}

TEST(SweepCadParts, JointTurned_IsCertified) {
  const test::Scene scene = shared_model("joint");
  if (scene.name.empty()) GTEST_SKIP() << "no shared models in " << BLUM_MODELS_DIR;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) expect_certified(scene, turned(seed), 1);
}

TEST(SweepCadParts, SharedModels_AreCertifiedHoweverChanged) {
  for (const char* const name : {"joint", "plate_holes", "knot"}) {
    const test::Scene scene = shared_model(name);
    if (scene.name.empty()) GTEST_SKIP() << "no shared models in " << BLUM_MODELS_DIR;
    for (const Change& change : all_changes())
      for (std::uint64_t seed = 1; seed <= 5; ++seed) expect_certified(scene, change, seed);
  }
}

TEST(SweepCadParts, LargeSharedModels_AreCertified) {
  for (const char* const name :
       {"tray_bottom", "couplingdown", "thingi_88566_panels", "rotor_small", "spinal_implant",
        "triceratops", "bunny", "goathead"}) {
    const test::Scene scene = shared_model(name);
    if (scene.name.empty()) GTEST_SKIP() << "no shared models in " << BLUM_MODELS_DIR;
    expect_certified(scene, as_it_is(), 1);
  }
}

}  // namespace
}  // namespace blum
