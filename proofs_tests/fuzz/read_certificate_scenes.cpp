#include <cstdlib>
#include <fstream>
#include <string>

#include "certificate_scenes.hpp"
#include "fuzz_target.hpp"

namespace blum::fuzz {
namespace {

std::vector<CertificateScene> read() {
  const char* name = std::getenv("BLUM_CERTIFICATE_SCENES");
  if (name == nullptr) fail("BLUM_CERTIFICATE_SCENES names no file of write_certificate_scenes");
  std::ifstream in(name);
  std::vector<CertificateScene> list;
  for (std::string line; std::getline(in, line);) {
    const nlohmann::json read = nlohmann::json::parse(line);
    CertificateScene& scene = list.emplace_back();
    for (const nlohmann::json& p : read.at("point")) scene.point.push_back({p[0], p[1], p[2]});
    read.at("triangle").get_to(scene.triangle);
    read.at("betti").get_to(scene.betti);
    read.at("record").get_to(scene.record);
  }
  if (list.empty()) fail(std::string("no scenes in ") + name);
  return list;
}

}  // namespace

const std::vector<CertificateScene>& certificate_scenes() {
  static const std::vector<CertificateScene> list = read();
  return list;
}

}  // namespace blum::fuzz
