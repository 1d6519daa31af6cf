// The checker of certificates on anything: bytes that say which parts of a right certificate to
// change, or the text itself. Whatever it is given, it answers; and where it says "verified", the
// Betti numbers are the solid's.
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "blum/verify/verify.hpp"
#include "certificate_scenes.hpp"
#include "fuzz_target.hpp"

namespace blum::fuzz {
namespace {

using Json = nlohmann::json;

/// A part of the records, by way of a record and of children: a record's whole content first.
Json& place(Choices& choices, std::vector<Json>& records) {
  const std::size_t line = static_cast<std::size_t>(choices.below(256)) * 256 +
                           static_cast<std::size_t>(choices.below(256));
  Json* at = &records[line % records.size()];
  for (int depth = choices.below(10); depth > 0 && at->is_structured() && !at->empty(); --depth) {
    auto child = at->begin();
    std::advance(child, choices.below(static_cast<int>(std::min<std::size_t>(at->size(), 256))));
    at = &*child;
  }
  return *at;
}

Json odd_value(Choices& choices) {
  switch (choices.below(16)) {
    case 0:
      return nullptr;
    case 1:
      return Json::array();
    case 2:
      return Json::object();
    case 3:
      return "";
    case 4:
      return true;
    case 5:
      return -1;
    case 6:
      return std::numeric_limits<std::uint32_t>::max();
    case 7:
      return std::numeric_limits<std::uint64_t>::max();
    case 8:
      return 1e308;
    case 9:
      return 5e-324;
    case 10:
      return -0.0;
    case 11:
      return Json::array({0, 0});
    default:
      return choices.below(256);
  }
}

void change(Choices& choices, std::vector<Json>& records) {
  Json& at = place(choices, records);
  switch (choices.below(8)) {
    case 0:
      at = odd_value(choices);
      return;
    case 1: {
      const Json other = place(choices, records);  // a copy: it may hold `at`, or be in it
      at = other;
      return;
    }
    case 2:
      if (at.is_structured() && !at.empty()) at.erase(at.begin());
      return;
    case 3:
      if (at.is_array() && !at.empty()) at.push_back(Json(at.front()));
      return;
    case 4:
      if (at.is_number_float())
        at = std::nextafter(at.get<double>(), choices.coin() ? 1e9 : -1e9);
      else if (at.is_number())
        at = at.get<std::int64_t>() + choices.between(-2, 2);
      return;
    case 5:
      if (at.is_array() && at.size() > 1)
        std::swap(at[0], at[static_cast<std::size_t>(choices.below(
                             static_cast<int>(std::min<std::size_t>(at.size(), 256))))]);
      return;
    case 6:
      if (records.size() > 1)
        records.erase(records.begin() + choices.below(256) % std::ssize(records));
      return;
    default:
      std::swap(records[static_cast<std::size_t>(choices.below(256)) % records.size()],
                records[static_cast<std::size_t>(choices.below(256)) % records.size()]);
  }
}

void check(const CertificateScene& scene, const std::string& text) {
  std::istringstream in(text);
  try {
    const verify::Answer answer = verify::verify({scene.point, scene.triangle}, in);
    if (answer.outcome == verify::Answer::Outcome::kVerified && answer.betti != scene.betti)
      fail("verified, with other Betti numbers than the solid's\n" + text);
    if (answer.outcome != verify::Answer::Outcome::kVerified && answer.statement.empty())
      fail("refused without a word\n" + text);
  } catch (const std::exception& error) {
    fail(std::string("the checker throws: ") + error.what() + "\n" + text);
  }
}

}  // namespace
}  // namespace blum::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace blum::fuzz;
  if (size == 0) return 0;
  Choices choices(data, size);
  const int kind = choices.below(8);
  const std::vector<CertificateScene>& scenes = certificate_scenes();
  const CertificateScene& scene = scenes[static_cast<std::size_t>(kind) % scenes.size()];
  if (kind >= 6) {
    check(scene, std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
    return 0;
  }
  std::vector<Json> records = scene.record;
  for (int changes = choices.between(1, 4); changes > 0; --changes) change(choices, records);
  std::string text;
  for (const Json& r : records) text += r.dump() + "\n";
  check(scene, text);
  return 0;
}
