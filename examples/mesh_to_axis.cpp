// From a mesh in memory to its certified medial axis, in three calls.
#include <iostream>

#include "blum/kernel/mesh.hpp"
#include "blum/kernel/solid.hpp"
#include "blum/medial/io.hpp"
#include "blum/medial/medial_axis.hpp"

int main() {
  // A wedge: any closed polygon mesh will do, faces counter-clockwise seen from outside.
  // blum::read_mesh("part.stl") reads one from a file.
  const blum::PolygonMesh mesh{
      {{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {0, 2, 0}, {0, 0, 1}, {0, 2, 1}},
      {{3, 2, 1, 0}, {0, 1, 4}, {2, 3, 5}, {1, 2, 5, 4}, {3, 0, 4, 5}},
  };

  const blum::Result<blum::Solid> solid = blum::build_solid(mesh);
  if (!solid) {
    std::cerr << solid.error().message << '\n';  // names every defect of the mesh
    return 2;
  }

  blum::MedialOptions options;
  options.seed = 1;  // the same seed gives the same answer, on any number of threads
  const blum::Result<blum::MedialResult> axis = blum::compute_medial_axis(solid.value(), options);
  if (!axis) {
    std::cerr << axis.error().message << '\n';
    return 2;
  }

  const blum::MedialResult& result = axis.value();
  std::cout << (result.certified ? "certified" : "not certified") << ", "
            << result.complex.vertex.size() << " vertices, " << result.complex.triangle.size()
            << " triangles, " << result.parts.sheets << " sheets\n";
  if (const auto error = blum::write_medial(result, solid.value(), "wedge")) {
    std::cerr << error->message << '\n';
    return 5;
  }
  return result.certified ? 0 : 3;
}
