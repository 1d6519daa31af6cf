// Every solid of the list, as it is, turned, moved and scaled: certified, with its known Betti
// numbers. One test a solid, so that a failure names it; all seeds and changes in the sweep.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "blum/medial/medial_axis.hpp"
#include "medial/mesh_changes.hpp"

namespace blum {
namespace {

using test::Change;
using Betti = std::array<long, 3>;

struct Entry {
  std::string name;
  Betti betti{};
  std::function<PolygonMesh()> mesh;  // no points: the model is missing
  double time_limit_s = 600;          // of one run
};

std::ostream& operator<<(std::ostream& out, const Entry& e) { return out << e.name; }

PolygonMesh shared_model(const std::string& name) {
  const auto path = std::filesystem::path(BLUM_MODELS_DIR) / (name + ".off");
  if (!std::filesystem::exists(path)) return {};
  auto mesh = read_mesh(path);
  if (!mesh) throw std::runtime_error(mesh.error().message);
  return std::move(mesh).value();
}

/// Keeps the mesh of a failure in a file and returns its name.
std::string kept(const PolygonMesh& mesh, const std::string& what) {
  static int count = 0;
  const auto file = std::filesystem::temp_directory_path() /
                    ("blum_" + what + "_" + std::to_string(++count) + ".off");
  std::ofstream(file) << test::as_off(mesh);
  return file.string();
}

void expect_certified(const Entry& entry, const PolygonMesh& mesh, const Change& change,
                      std::uint64_t seed) {
  MedialOptions o;
  o.seed = seed;
  o.threads = 2;
  o.time_limit_s = entry.time_limit_s;
  const auto fault = [&]() -> std::string {
    try {
      const auto r = compute_medial_axis(test::solid_of(mesh), o);
      if (!r) return r.error().message;
      if (r.value().solid_betti != entry.betti) return "Betti numbers of the solid";
      if (!r.value().certified)
        return std::to_string(r.value().undecided.size()) + " cells undecided, the first by " +
               undecided_reason_name(r.value().undecided.front().reason);
      if (r.value().betti != entry.betti) return "Betti numbers of the axis";
    } catch (const std::exception& e) {
      return e.what();
    }
    return "";
  }();
  if (fault.empty()) return;
  ADD_FAILURE() << entry.name << ", " << change.name << ", seed " << seed << ": " << fault
                << "; mesh kept in " << kept(mesh, entry.name);
}

void expect_certified(const Entry& entry, const std::vector<Change>& changes,
                      std::initializer_list<std::uint64_t> seeds) {
  const PolygonMesh mesh = entry.mesh();
  if (mesh.points.empty()) GTEST_SKIP() << "no shared models in " << BLUM_MODELS_DIR;
  for (const Change& change : changes) {
    const PolygonMesh changed = change.of(mesh);
    for (const std::uint64_t seed : seeds) expect_certified(entry, changed, change, seed);
  }
}

// The list ------------------------------------------------------------------------------------

Entry prism(int n, const std::string& move_name, shapes::Move move) {
  return {"prism_" + std::to_string(n) + move_name, {1, 0, 0}, [n, move] {
            return shapes::prism(n, 1, 1, move);
          }};
}

Entry plate(int holes) {
  return {
      "plate_" + std::to_string(holes), {1, holes, 0}, [holes] { return shapes::plate(holes, 6); }};
}

Entry voids(int n) {
  return {"voids_" + std::to_string(n), {n, 0, n}, [n] { return shapes::nested_voids(n); }};
}

Entry torus(int n, int m) {
  return {"torus_" + std::to_string(n) + "x" + std::to_string(m), {1, 1, 0}, [n, m] {
            return shapes::torus(n, m, 2, 0.75);
          }};
}

Entry model(const std::string& name, Betti betti) {
  return {name, betti, [name] { return shared_model(name); }};
}

/// Up to a few hundred triangles: under a second each, whatever the change.
std::vector<Entry> first_solids() {
  std::vector<Entry> list{{"cuboid", {1, 0, 0}, [] { return shapes::cuboid(2, 2, 3); }},
                          {"generic_cuboid", {1, 0, 0}, [] { return shapes::cuboid(1, 1.25, 2); }},
                          {"lbracket", {1, 0, 0}, [] { return shapes::lbracket(); }},
                          {"lpocket", {1, 0, 0}, [] { return shapes::lpocket(); }},
                          torus(8, 4),
                          torus(16, 8),
                          model("cube", {1, 0, 0}),
                          model("cube_minus_octant", {1, 0, 0}),
                          model("cross", {1, 0, 0}),
                          model("P_polygons", {1, 1, 0})};
  for (int n = 3; n <= 16; ++n) {
    list.push_back(prism(n, "", {}));
    list.push_back(prism(n, "_moved_1e6", {1e-6, 0}));
    list.push_back(prism(n, "_moved_1e12", {1e-12, 0}));
    list.push_back(prism(n, "_moved_1_ulp", {0, 1}));
  }
  for (int n = 1; n <= 3; ++n) list.push_back(voids(n));
  return list;
}

std::vector<Entry> more_solids() {
  std::vector<Entry> list;
  for (int n = 17; n <= 32; ++n) list.push_back(prism(n, "", {}));
  for (int n = 4; n <= 5; ++n) list.push_back(voids(n));
  return list;
}

std::vector<Entry> plates() {
  std::vector<Entry> list;
  for (int n = 1; n <= 16; ++n) list.push_back(plate(n));
  return list;
}

/// Run as they are, with one seed: minutes each.
std::vector<Entry> large_models() {
  std::vector<Entry> list{model("tray_bottom", {1, 23, 0}),
                          model("couplingdown", {1, 9, 0}),
                          model("thingi_88566_panels", {8, 32, 0}),
                          model("rotor_small", {1, 1, 0}),
                          model("spinal_implant", {1, 10, 0}),
                          model("triceratops", {1, 0, 0}),
                          model("bunny", {1, 0, 0}),
                          model("goathead", {1, 0, 0}),
                          model("hand_closed", {1, 0, 0})};
  for (Entry& e : list) e.time_limit_s = 1200;
  return list;
}

std::vector<Entry> larger_solids() {
  return {torus(32, 16),
          {"generated_knot", {1, 1, 0}, [] { return shapes::knot(); }},
          model("cray_left_void", {1, 0, 1}),
          model("derived_cube_sphere_void", {1, 0, 1}),
          model("plate_holes", {1, 5, 0}),
          model("knot", {1, 1, 0})};
}

class MustHold : public testing::TestWithParam<Entry> {};

TEST_P(MustHold, HoweverChanged_IsCertified) {
  expect_certified(GetParam(), test::all_changes(), {1, 2, 3, 4, 5});
}

const auto entry_name = [](const auto& info) { return info.param.name; };

INSTANTIATE_TEST_SUITE_P(SweepFirst, MustHold, testing::ValuesIn(first_solids()), entry_name);
INSTANTIATE_TEST_SUITE_P(SweepMore, MustHold, testing::ValuesIn(more_solids()), entry_name);
INSTANTIATE_TEST_SUITE_P(SweepPlates, MustHold, testing::ValuesIn(plates()), entry_name);
INSTANTIATE_TEST_SUITE_P(SweepLarger, MustHold, testing::ValuesIn(larger_solids()), entry_name);

class LargeModels : public testing::TestWithParam<Entry> {};

TEST_P(LargeModels, AsTheyAre_AreCertified) {
  expect_certified(GetParam(), {test::as_it_is()}, {1});
}

INSTANTIATE_TEST_SUITE_P(Sweep, LargeModels, testing::ValuesIn(large_models()), entry_name);

// Polygons that rounding makes non-planar; those with holes get triangles about 1e-16 wide.
class RoundedFacets : public testing::TestWithParam<Entry> {};

TEST_P(RoundedFacets, Turned_IsCertified) {
  expect_certified(
      GetParam(), {test::turned_and_rounded({1, 2, 3, 4}), test::turned_and_rounded({5, 1, -2, 2})},
      {1, 2});
}

INSTANTIATE_TEST_SUITE_P(SweepFirst, RoundedFacets, testing::ValuesIn(first_solids()), entry_name);
INSTANTIATE_TEST_SUITE_P(SweepMore, RoundedFacets, testing::ValuesIn(more_solids()), entry_name);
INSTANTIATE_TEST_SUITE_P(SweepPlates, RoundedFacets, testing::ValuesIn(plates()), entry_name);

// Sheets of faces coplanar to 1e-14 meet within 1e-16 of the ray of points whose foot is vertex
// 134.
TEST(SweepJoint, Turned_IsCertified) {
  std::vector<Change> turns;
  for (std::uint64_t k = 1; k <= 5; ++k) turns.push_back(test::turned(k));
  expect_certified(model("joint", {1, 2, 0}), turns, {1, 2, 3, 4, 5});
}

TEST(SweepJoint, OtherwiseChanged_IsCertified) {
  std::vector<Change> changes = test::all_changes();
  changes.resize(changes.size() - 5);  // the random rotations come last
  expect_certified(model("joint", {1, 2, 0}), changes, {1, 2, 3, 4, 5});
}

// The sample -----------------------------------------------------------------------------------

TEST(MustHoldSample, SolidsTurned_AreCertified) {
  std::vector<Entry> list = first_solids();
  for (int holes = 1; holes <= 2; ++holes) list.push_back(plate(holes));
  for (const Entry& e : list) expect_certified(e, {test::turned(1)}, {1});
}

TEST(MustHoldSample, FewSolidsHoweverChanged_AreCertified) {
  const std::set<std::string> names{"lbracket", "lpocket", "prism_5_moved_1_ulp",
                                    "plate_1",  "voids_1", "P_polygons"};
  for (const Entry& e : first_solids())
    if (names.count(e.name) != 0) expect_certified(e, test::all_changes(), {1});
  expect_certified(plate(1), test::all_changes(), {1});
}

TEST(MustHoldSample, LargestPrismAndVoids_AreCertified) {
  for (const Entry& e : {prism(32, "", {}), voids(5), plate(4)})
    expect_certified(e, {test::as_it_is(), test::far_away(), test::turned_exactly({1, 2, 3, 4})},
                     {1});
}

TEST(MustHoldSample, ModelsWithVoidsTurned_AreCertified) {
  for (const char* const name : {"cray_left_void", "derived_cube_sphere_void"})
    expect_certified(model(name, {1, 0, 1}), {test::turned(1)}, {1});
}

TEST(MustHoldSample, Joint_IsCertified) {
  expect_certified(model("joint", {1, 2, 0}), {test::as_it_is()}, {1, 2, 3});
}

TEST(MustHoldSample, NearlyCoplanarFaces_AreCertified) {
  expect_certified(model("joint", {1, 2, 0}), {test::turned(4)}, {1});
}

// Facets with holes get triangles 1e-16 wide between faces that do not meet.
TEST(MustHoldSample, PlateTurnedExactly_IsCertified) {
  expect_certified(plate(3), {test::turned_and_rounded({1, 2, 3, 4})}, {1});
}

}  // namespace
}  // namespace blum
