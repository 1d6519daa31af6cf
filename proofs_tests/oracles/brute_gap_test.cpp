// Two critical abscissae of the oracle's sweep whose first disjoint enclosures are wider than what
// is between them: no number was found there, and the rectangle undecided.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "blum/arrangement/brute_engine.hpp"
#include "blum/kernel/shapes.hpp"

namespace blum {
namespace {

TEST(BruteGap, EnclosuresWiderThanWhatIsBetweenThem_Decided) {
  // blum make lpocket --split-edges 3 --triangulate 3 --rotate 2
  const auto solid = build_solid(shapes::rotate_rounded(
      shapes::triangulate_facets(shapes::split_edges(shapes::lpocket(), 3), 3), 2));
  ASSERT_TRUE(solid.ok());
  const Solid& s = solid.value();
  // As certificates number them: edges as they first appear in the triangles.
  std::map<std::uint32_t, std::uint32_t> edge;
  for (const SolidTriangle& t : s.triangle)
    for (const auto e : t.edge) edge.try_emplace(e, static_cast<std::uint32_t>(edge.size()));
  const SiteIndex index(s);
  std::vector<SiteId> sites;
  for (const std::uint32_t n : {48u, 54u, 57u})
    for (const auto& [e, number] : edge)
      if (s.point.size() + number == n) sites.push_back(index.edge(e));
  for (const std::uint32_t n : {142u, 143u, 145u, 147u}) sites.push_back({n});
  std::ranges::sort(sites);
  ASSERT_EQ(sites.size(), 7u);
  const FaceDiagram d =
      brute_face({&s,
                  {0, 0.037674722918508076, 0.001211795501963107, 0.0012117995727252719,
                   0.40954393498336727, 0.40954394082478751},
                  sites,
                  {},
                  true});
  EXPECT_EQ(d.status, FaceStatus::kDecided) << d.reason;
}

}  // namespace
}  // namespace blum
