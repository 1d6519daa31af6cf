// The model collection against its manifest: every model that is a solid is accepted with the
// numbers the manifest gives, and every defect it lists is named.
#include <map>

#include "blum/kernel/info.hpp"
#include "mesh_test_tools.hpp"

namespace blum {
namespace {

using Row = std::map<std::string, std::string>;

std::vector<std::string> split_csv(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else if (c != '\r')
      cells.back() += c;
  }
  return cells;
}

std::vector<Row> manifest() {
  std::ifstream in(BLUM_MODELS_DIR "/MANIFEST.csv");
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> names = split_csv(line);
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = split_csv(line);
    Row row;
    for (std::size_t k = 0; k < names.size() && k < cells.size(); ++k) row[names[k]] = cells[k];
    rows.push_back(std::move(row));
  }
  return rows;
}

std::size_t number(const Row& row, const std::string& column) {
  return static_cast<std::size_t>(std::stoull(row.at(column)));
}

void check_model(const Row& row) {
  const std::string file = row.at("file");
  SCOPED_TRACE(file);
  const auto mesh = read_mesh(std::filesystem::path(BLUM_MODELS_DIR) / file);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  const MeshInfo info = mesh_info(mesh.value());
  EXPECT_EQ(info.vertices, number(row, "vertices"));
  EXPECT_EQ(info.faces, number(row, "faces"));
  EXPECT_EQ(info.edges, number(row, "edges"));
  EXPECT_EQ(info.polygon_faces, number(row, "polygon_faces"));
  const std::pair<const char*, DefectKind> columns[] = {
      {"boundary_edges", DefectKind::kBoundaryEdge},
      {"nonmanifold_edges", DefectKind::kNonManifoldEdge},
      {"nonmanifold_vertices", DefectKind::kNonManifoldVertex},
      {"inconsistent_edges", DefectKind::kInconsistentOrientation},
      {"self_intersecting_pairs", DefectKind::kSelfIntersection},
      {"duplicate_vertices", DefectKind::kDuplicateVertex},
      {"duplicate_faces", DefectKind::kDuplicateFace},
      {"degenerate_faces", DefectKind::kDegenerateFace},
      {"isolated_vertices", DefectKind::kIsolatedVertex}};
  for (const auto& [column, kind] : columns) {
    const Defect* d = info.validation.find(kind);
    EXPECT_EQ(d == nullptr ? 0 : d->count, number(row, column)) << column;
  }
  if (row.at("valid_solid") != "yes") {
    EXPECT_FALSE(info.solid.has_value());
    const auto solid = build_solid(mesh.value());
    ASSERT_FALSE(solid.ok());
    EXPECT_EQ(solid.error().code, ErrorCode::kInvalidSolid);
    return;
  }
  ASSERT_TRUE(info.solid.has_value()) << info.validation.summary(Severity::kError);
  EXPECT_TRUE(info.warnings.empty());
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(info.solid->betti[k], std::stol(row.at("beta" + std::to_string(k))));
  }
  EXPECT_EQ(info.solid->coplanar_pairs, number(row, "coplanar_adjacent_pairs_exact"));
  EXPECT_EQ(info.solid->nearly_coplanar_pairs, number(row, "coplanar_adjacent_pairs_1e-4deg"));
  EXPECT_EQ(info.solid->reflex_edges, number(row, "reflex_edges"));
  EXPECT_NEAR(info.solid->min_dihedral_deg, std::stod(row.at("min_dihedral_deg")), 1e-3);
  EXPECT_NEAR(info.solid->max_dihedral_deg, std::stod(row.at("max_dihedral_deg")), 1e-3);
  EXPECT_NEAR(info.shortest_edge_over_diagonal, std::stod(row.at("min_edge_over_bbox_diag")),
              5e-3 * std::stod(row.at("min_edge_over_bbox_diag")));
  EXPECT_NEAR(info.solid->volume, std::stod(row.at("volume")), 1e-5 * std::stod(row.at("volume")));
}

void check_models(bool large) {
  std::size_t checked = 0;
  for (const Row& row : manifest()) {
    if ((number(row, "faces") > 20000) != large) continue;
    check_model(row);
    ++checked;
  }
  EXPECT_GT(checked, 0u);
}

TEST(Models, UpTo20000Faces_AgreeWithTheManifest) {
  BLUM_NEED_MODELS();
  check_models(false);
}

TEST(SweepModels, Over20000Faces_AgreeWithTheManifest) {
  BLUM_NEED_MODELS();
  check_models(true);
}

TEST(Models, RoundTripThroughOff_GivesTheSameMesh) {
  BLUM_NEED_MODELS();
  const test::Folder folder;
  const auto mesh = read_mesh(BLUM_MODELS_DIR "/tray_bottom.off");
  ASSERT_TRUE(mesh.ok());
  ASSERT_FALSE(write_off(mesh.value(), folder.path() / "copy.off").has_value());
  const auto copy = read_mesh(folder.path() / "copy.off");
  ASSERT_TRUE(copy.ok());
  EXPECT_EQ(copy.value().points, mesh.value().points);
  EXPECT_EQ(copy.value().faces, mesh.value().faces);
}

TEST(Models, TruncatedAnywhere_AreRefused) {
  BLUM_NEED_MODELS();
  const test::Folder folder;
  const std::string bytes = test::bytes_of(BLUM_MODELS_DIR "/joint.off");
  ASSERT_GT(bytes.size(), 1000u);
  for (std::size_t n = 1; n + 30 < bytes.size(); n += bytes.size() / 40) {
    EXPECT_FALSE(read_mesh(folder.write("cut.off", bytes.substr(0, n))).ok()) << n;
  }
}

}  // namespace
}  // namespace blum
