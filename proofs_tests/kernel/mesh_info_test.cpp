// What `blum info` prints.
#include "blum/kernel/info.hpp"

#include "mesh_test_tools.hpp"

namespace blum {
namespace {

TEST(MeshInfo, Cube_IsCounted) {
  const MeshInfo info = mesh_info(test::box_mesh({0, 0, 0}, {1, 2, 3}));
  EXPECT_EQ(info.vertices, 8u);
  EXPECT_EQ(info.faces, 6u);
  EXPECT_EQ(info.polygon_faces, 6u);
  EXPECT_EQ(info.edges, 12u);
  EXPECT_EQ(info.triangles, 12u);
  ASSERT_TRUE(info.bounding_box.has_value());
  EXPECT_EQ(info.bounding_box->hi, (Point3{1, 2, 3}));
  ASSERT_TRUE(info.solid.has_value());
  EXPECT_EQ(info.solid->triangle_edges, 18u);
  EXPECT_EQ(info.solid->facets, 6u);
  EXPECT_EQ(info.solid->coplanar_pairs, 0u);  // the diagonals are ours, not the mesh's
  EXPECT_EQ(info.solid->convex_edges, 12u);
  EXPECT_DOUBLE_EQ(info.solid->volume, 6);
  EXPECT_NEAR(info.solid->min_dihedral_deg, 90, 1e-12);
  EXPECT_NEAR(info.solid->max_dihedral_deg, 90, 1e-12);
  EXPECT_EQ(mesh_info(test::triangulated(test::box_mesh())).solid->coplanar_pairs, 6u);
}

TEST(MeshInfo, BadMesh_StillTellsWhatItCan) {
  PolygonMesh m = test::box_mesh();
  m.faces.pop_back();
  m.points.push_back({NAN, 0, 0});
  const MeshInfo info = mesh_info(m);
  EXPECT_FALSE(info.solid.has_value());
  EXPECT_FALSE(info.validation.valid());
  EXPECT_EQ(info.edges, 12u);
  EXPECT_EQ(info.bounding_box->hi, (Point3{1, 1, 1}));
  EXPECT_NO_THROW((void)mesh_info({}));
}

TEST(MeshInfo, NearlyCoplanarAndShortEdges_AreCounted) {
  PolygonMesh m = test::triangulated(test::box_mesh());
  m.points[7].z = std::nextafter(1.0, 2.0);
  const MeshInfo info = mesh_info(m);
  ASSERT_TRUE(info.solid.has_value());
  EXPECT_EQ(info.solid->coplanar_pairs, 5u);
  EXPECT_EQ(info.solid->nearly_coplanar_pairs, 6u);
  EXPECT_EQ(info.short_edges, 0u);
  EXPECT_EQ(mesh_info(test::box_mesh({0, 0, 0}, {1, 1, 1e-9})).short_edges, 4u);
}

TEST(MeshInfo, VoidsComponentsAndGenus_AreTold) {
  PolygonMesh m = test::torus(12, 6, 4, 2);
  m = test::merged(m, test::reversed(test::torus(12, 6, 4, 0.5)));
  m = test::merged(m, test::box_mesh({10, 0, 0}, {11, 1, 1}));
  const MeshInfo info = mesh_info(m);
  ASSERT_TRUE(info.solid.has_value());
  EXPECT_EQ(info.solid->components, 2u);
  EXPECT_EQ(info.solid->shells, 3u);
  EXPECT_EQ(info.solid->voids, 1u);
  EXPECT_EQ(info.solid->genus_per_shell, (std::vector<int>{1, 1, 0}));
  EXPECT_EQ(info.solid->betti, (std::array<long, 3>{2, 2, 1}));
}

}  // namespace
}  // namespace blum
