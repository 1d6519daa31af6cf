/// Certificates to verify and to spoil.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "blum/kernel/shapes.hpp"
#include "blum/medial/medial_axis.hpp"
#include "blum/verify/verify.hpp"

namespace blum::test {

using Json = nlohmann::json;
using Random = std::mt19937_64;

inline std::size_t below(Random& random, std::size_t n) { return random() % n; }

/// A solid, its axis' certificate record by record, and the boxes of its leaves.
struct Certified {
  std::string name;
  std::vector<Point3> point;
  std::vector<std::array<std::uint32_t, 3>> triangle;
  std::array<long, 3> betti{};
  std::vector<Json> record;

  /// With theta: pruned by it.
  Certified(std::string title, const PolygonMesh& mesh, MedialOptions options = {},
            std::optional<double> theta = {})
      : name(std::move(title)) {
    const Result<Solid> solid = build_solid(mesh);
    point = solid.value().point;
    for (const SolidTriangle& t : solid.value().triangle) triangle.push_back(t.vertex);
    AngleOptions angles;
    angles.wanted = theta.has_value();
    angles.certified_theta_deg = theta;
    const auto result =
        compute_medial_axis(solid.value(), options, angles, [&](const std::string& line) {
          record.push_back(Json::parse(line));
          return true;
        });
    betti = result.value().solid_betti;
    EXPECT_TRUE(result.value().certified) << name;
  }
  [[nodiscard]] verify::Model model() const { return {point, triangle}; }
};

inline std::string text_of(const std::vector<Json>& records) {
  std::string text;
  for (const Json& r : records) text += r.dump() + "\n";
  return text;
}

inline verify::Answer check(const Certified& of, const std::string& text) {
  std::istringstream in(text);
  return verify::verify(of.model(), in);
}
inline verify::Answer check(const Certified& of, const std::vector<Json>& records) {
  return check(of, text_of(records));
}

/// The box of each record that is a node or a leaf (in the order of the records).
inline std::vector<Box3> boxes_of(const std::vector<Json>& records) {
  std::vector<Box3> boxes(records.size()), open;
  const Json& root = records.front()["header"]["box"];
  Box3 box;
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = root["low"][static_cast<std::size_t>(k)];
    box.hi[k] = root["high"][static_cast<std::size_t>(k)];
  }
  open.push_back(box);
  for (std::size_t i = 1; i < records.size() && !open.empty(); ++i) {
    boxes[i] = open.back();
    open.pop_back();
    if (!records[i].contains("node")) continue;
    const Json& node = records[i]["node"];
    Box3 low = boxes[i], high = boxes[i];
    const int axis = node["axis"];
    low.hi[axis] = high.lo[axis] = node["cut"];
    open.push_back(high);
    open.push_back(low);
  }
  return boxes;
}

/// Indices of the records of a name.
inline std::vector<std::size_t> all(const std::vector<Json>& records, const char* name) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < records.size(); ++i)
    if (records[i].contains(name)) found.push_back(i);
  return found;
}

/// What is claimed of a part, or proposed for one that the program decided otherwise.
inline Json& claim_of(Json& part) { return part[0] == "exact" ? part[1] : part; }

/// Leaves with a part of the axis on their surface; and their faces with arcs.
struct FaceRef {
  std::size_t record, face;
};
inline std::vector<FaceRef> faces_with_arcs(const std::vector<Json>& records) {
  std::vector<FaceRef> found;
  for (const auto i : all(records, "leaf")) {
    const Json& leaf = records[i]["leaf"];
    if (!leaf.contains("faces")) continue;
    for (std::size_t f = 0; f < 6; ++f)
      if (!leaf["faces"][f]["graph"]["arcs"].empty()) found.push_back({i, f});
  }
  return found;
}

}  // namespace blum::test
