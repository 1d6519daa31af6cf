// Rectangles with a common edge share its diagram; what is adopted is not computed again.

#include "blum/subdivision/local_diagrams.hpp"

#include <gtest/gtest.h>

#include "blum/subdivision/cell_test.hpp"
#include "subdivision/solid_scenes.hpp"

namespace blum {
namespace {

struct Fixture {
  Fixture()
      : solid(test::solid_of(shapes::cuboid(1, 1.25, 2))),
        geometry(solid),
        watch({}),
        engines(geometry, {}, watch),
        candidates(geometry.candidates().begin(), geometry.candidates().end()) {
    for (std::uint32_t t = 0; t < solid.triangle.size(); ++t) triangles.push_back(t);
    for (int k = 0; k < 3; ++k) {
      box.lo[k] = solid.point[0][k] + 0.0101 + 0.001 * k;
      box.hi[k] = box.lo[k] + 0.1003 + 0.003 * k;
    }
  }
  [[nodiscard]] LocalDiagrams diagrams() {
    return {engines.diagrams(), solid, candidates, triangles};
  }
  const Solid solid;
  const SiteGeometry geometry;
  RunWatch watch;
  EngineSet engines;
  std::vector<SiteId> candidates;
  std::vector<std::uint32_t> triangles;
  Box3 box;
};

TEST(LocalDiagrams, FacesOfACell_ShareTwelveEdges) {
  Fixture f;
  LocalDiagrams local = f.diagrams();
  std::set<const SegmentDiagram*> edges;
  for (int face = 0; face < 6; ++face) {
    const auto d = local.face(box_face(f.box, face));
    ASSERT_EQ(d->status, FaceStatus::kDecided) << d->reason;
    for (const auto& s : d->side) edges.insert(s.get());
  }
  EXPECT_EQ(edges.size(), 12u);
  EXPECT_EQ(local.faces_computed(), 6u);
}

TEST(LocalDiagrams, AdoptedFace_IsGivenBackWithItsSides) {
  Fixture f;
  const auto adopted = f.diagrams().face(box_face(f.box, 0));
  ASSERT_EQ(adopted->status, FaceStatus::kDecided);
  LocalDiagrams local = f.diagrams();
  local.adopt(adopted);
  EXPECT_EQ(local.face(box_face(f.box, 0)), adopted);
  for (int s = 0; s < 4; ++s)
    EXPECT_EQ(local.segment(side_segment(adopted->rect, s)).diagram, adopted->side[s]);
  EXPECT_EQ(local.faces_computed(), 0u);
}

}  // namespace
}  // namespace blum
