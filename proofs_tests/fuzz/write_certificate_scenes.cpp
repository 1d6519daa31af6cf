// Writes the scenes of the target `certificate`, as read_certificate_scenes.cpp reads them:
// write_certificate_scenes FILE
#include <fstream>
#include <iostream>

#include "certificate_scenes.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "write_certificate_scenes FILE\n";
    return 2;
  }
  std::ofstream out(argv[1]);
  for (const blum::fuzz::CertificateScene& scene : blum::fuzz::certificate_scenes()) {
    nlohmann::json line;
    for (const blum::Point3& p : scene.point) line["point"].push_back({p.x, p.y, p.z});
    line["triangle"] = scene.triangle;
    line["betti"] = scene.betti;
    line["record"] = scene.record;
    out << line << '\n';
  }
  out.close();
  if (out) return 0;
  std::cerr << "write_certificate_scenes: cannot write " << argv[1] << '\n';
  return 1;
}
