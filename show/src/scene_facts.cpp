#include "scene_facts.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "vtp_arrays.hpp"

namespace blum::detail {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Six digits are enough of a length, counts are whole.
std::string shortest(double value) {
  const bool whole = std::abs(value) < 0x1p53 && value == std::trunc(value);
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), whole ? "%.0f" : "%.6g", value);
  return text.data();
}

/// The one number of an array of one, if it is there.
std::optional<double> single(const VtpFile& file, const char* name) {
  const VtpArray* array = find(file.field_data, name, 1);
  if (array == nullptr || array->value.size() != 1) return std::nullopt;
  return array->value[0];
}

}  // namespace

Facts facts_of(const VtpFile& file, const Scene& scene) {
  Facts fact;
  if (const auto certified = single(file, "certified")) {
    const bool part = single(file, "pruned").value_or(0) != 0;
    const char* yes = part ? "from a certified axis" : "yes";
    fact.push_back({"certified", *certified != 0 ? yes : "no"});
  }
  if (!scene.undecided.empty()) {
    fact.push_back({"undecided cells", std::to_string(scene.undecided.size())});
  }
  if (const VtpArray* betti = find(file.field_data, "betti", 3);
      betti != nullptr && betti->value.size() == 3) {
    const std::vector<double>& b = betti->value;
    fact.push_back({"Betti numbers", shortest(b[0]) + ' ' + shortest(b[1]) + ' ' + shortest(b[2])});
  }
  for (const auto& [name, title] :
       {std::pair("sheets", "sheets"), std::pair("seams", "seams"),
        std::pair("junctions", "junctions"), std::pair("clusters", "clusters"),
        std::pair("hausdorff_bound", "Hausdorff bound")}) {
    if (const auto value = single(file, name)) fact.push_back({title, shortest(*value)});
  }
  return fact;
}

std::optional<std::string> title_of(const VtpFile& file, const Scene& scene,
                                    const fs::path& summary_file) {
  std::ifstream stream(summary_file, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(stream)), {});
  const Json summary = Json::parse(text, nullptr, false);
  // Any file may have that name: values are looked at where they are, for copying deep ones recurs.
  const auto member = [](const Json* object, const char* key) -> const Json* {
    if (object == nullptr || !object->is_object()) return nullptr;
    const auto found = object->find(key);
    return found == object->end() ? nullptr : &*found;
  };
  const auto is = [](const Json* value, double number) {
    return value != nullptr && value->is_number_integer() && value->get<double>() == number;
  };
  const VtpArray* seed = find(file.field_data, "seed", 1);
  if (seed == nullptr || seed->value.size() != 1) return std::nullopt;
  if (!is(member(&summary, "seed"), seed->value[0])) return std::nullopt;
  if (!is(member(member(&summary, "sites"), "faces"), scene.site_counts[2])) return std::nullopt;
  const Json* model = member(&summary, "model");
  if (model == nullptr || !model->is_string()) return std::nullopt;
  return fs::path(model->get_ref<const std::string&>()).filename().string();
}

}  // namespace blum::detail
