// Thin plates, walls and needles: certified, and the number of leaves hardly knows the aspect.

#include <gtest/gtest.h>

#include "blum/medial/medial_axis.hpp"
#include "patience.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

struct ThinSolid {
  std::string name;
  std::function<PolygonMesh(double)> of;  // of the thickness; the other sides are 1 to 5
};

std::vector<ThinSolid> thin_solids() {
  std::vector<ThinSolid> straight{
      {"plate", [](double t) { return shapes::cuboid(1, 1.5, t); }},
      {"needle", [](double t) { return shapes::cuboid(t, 1.5 * t, 1); }},
      {"lwall", [](double t) { return shapes::lbracket(4, 3, t, 2); }},
      {"square lwall", [](double t) { return shapes::lbracket(1, 1, t, 1); }},
      {"plate with a hole", [](double t) { return shapes::plate(1, 6, 2, t); }},
      {"plate with two holes", [](double t) { return shapes::plate(2, 8, 2, t); }},
      {"thin-walled box", [](double t) { return test::thin_walled_box(3, 4, 5, t); }}};
  std::vector<ThinSolid> all = straight;
  for (const ThinSolid& s : straight)
    all.push_back({"rotated " + s.name, [s](double t) { return test::rotated(s.of(t)); }});
  return all;
}

/// The most leaves of any of the seeds.
std::size_t leaves(const ThinSolid& thin, double thickness, std::uint64_t seeds) {
  const Solid solid = test::solid_of(thin.of(thickness));
  std::size_t most = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(thin.name + ", thickness " + std::to_string(thickness) + ", seed " +
                 std::to_string(seed));
    MedialOptions o;
    o.seed = seed;
    o.time_limit_s = test::patience_s(60);
    const auto r = compute_medial_axis(solid, o);
    if (!r) {
      ADD_FAILURE() << r.error().message;
      continue;
    }
    EXPECT_TRUE(r.value().certified) << r.value().undecided.size() << " cells undecided";
    EXPECT_EQ(r.value().betti, r.value().solid_betti);
    most = std::max(most, r.value().leaves);
  }
  return most;
}

// The few leaves of a thick solid are no measure (2 or 3 of some, 40 of others at the same aspect),
// hence the plain bound; the aspect grows by a thousand.
void check_growth(std::uint64_t seeds) {
  for (const ThinSolid& thin : thin_solids()) {
    const std::size_t thousand = std::max(leaves(thin, 1e-3, seeds), leaves(thin, 0x1p-10, seeds));
    const std::size_t million = std::max(leaves(thin, 1e-6, seeds), leaves(thin, 0x1p-20, seeds));
    EXPECT_LT(thousand, 500u) << thin.name;
    EXPECT_LT(million, 500u) << thin.name;
    EXPECT_LT(million, 100 * thousand) << thin.name;
  }
}

TEST(ThinSolids, AspectOfAThousandAndAMillion_TakeFewLeaves) { check_growth(1); }
TEST(SweepThinSolids, AspectOfAThousandAndAMillion_TakeFewLeaves) { check_growth(20); }

}  // namespace
}  // namespace blum
