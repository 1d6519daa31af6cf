/// The solids whose certificates the target `certificate` changes. They are made here and now
/// (make_certificate_scenes.cpp), or read from a file that another build has made of them
/// (read_certificate_scenes.cpp): a build without the engine then has them too.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "blum/kernel/point.hpp"

namespace blum::fuzz {

struct CertificateScene {
  std::vector<Point3> point;
  std::vector<std::array<std::uint32_t, 3>> triangle;
  std::array<long, 3> betti{};
  std::vector<nlohmann::json> record;  // the right certificate, a line each
};

/// Never empty; the same in every build.
const std::vector<CertificateScene>& certificate_scenes();

}  // namespace blum::fuzz
