#include "blum/kernel/shapes.hpp"
#include "blum/medial/medial_axis.hpp"
#include "certificate_scenes.hpp"

namespace blum::fuzz {
namespace {

CertificateScene scene_of(const PolygonMesh& mesh) {
  CertificateScene scene;
  const Result<Solid> solid = build_solid(mesh);
  scene.point = solid.value().point;
  for (const SolidTriangle& t : solid.value().triangle) scene.triangle.push_back(t.vertex);
  MedialOptions options;
  options.threads = 1;
  const auto result = compute_medial_axis(solid.value(), options, {}, [&](const std::string& l) {
    scene.record.push_back(nlohmann::json::parse(l));
    return true;
  });
  scene.betti = result.value().solid_betti;
  return scene;
}

}  // namespace

/// A block, one with a void (its axis has a sheet that is a sphere) and one with a curved sheet.
const std::vector<CertificateScene>& certificate_scenes() {
  static const std::vector<CertificateScene> list{
      scene_of(shapes::cuboid(1, 2, 3)), scene_of(shapes::nested_voids(1)),
      scene_of(shapes::lbracket(2, 2, 1, 1)), scene_of(shapes::prism(3, 1, 1))};
  return list;
}

}  // namespace blum::fuzz
