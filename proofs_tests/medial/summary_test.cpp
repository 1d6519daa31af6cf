// The summary: exactly the published schema, and text that says what matters.

#include "blum/medial/summary.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace blum {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> names;
  for (const auto& [name, value] : object.items()) names.push_back(name);
  return names;
}

struct Sample {
  Sample() {
    result.certified = true;
    result.betti = {1, 2, 0};
    result.solid_betti = {1, 2, 0};
    result.parts.sheets = 13;
    result.parts.seams = 12;
    result.parts.junctions = 4;
    result.leaves = 39;
    result.leaves_cut = 5;
    result.planes_tried = 8;
    result.max_depth = 11;
    result.hausdorff_bound = 0.125;
    result.stages = {980, 15, 5};
    result.time = {0.5, 0.25};
    result.seed = 18446744073709551615u;
    result.threads = 2;
  }
  [[nodiscard]] SummaryInput input() const {
    return {"part.off", &solid, &result, 0.125, 0.0625, 1.5, 123456789, "0.1.0", nullptr};
  }
  Solid solid;
  MedialResult result;
};

TEST(SummaryJson, CertifiedRun_HasExactlyTheSchema) {
  const Sample sample;
  const Json j = Json::parse(summary_json(sample.input()));
  using Keys = std::vector<std::string>;
  EXPECT_EQ(keys(j), (Keys{"model", "sites", "solid", "result", "cuts", "stages", "time_s",
                           "peak_memory_bytes", "seed", "threads", "version"}));
  EXPECT_EQ(keys(j["sites"]), (Keys{"vertices", "edges", "faces"}));
  EXPECT_EQ(keys(j["solid"]), (Keys{"betti"}));
  EXPECT_EQ(keys(j["result"]),
            (Keys{"mode", "certified", "betti", "sheets", "seams", "junctions", "clusters",
                  "leaves", "max_depth", "undecided_cells", "hausdorff_bound"}));
  EXPECT_EQ(j["cuts"], (Json{{"leaves", 5}, {"planes_tried", 8}}));
  EXPECT_EQ(keys(j["stages"]), (Keys{"filter", "extended", "exact"}));
  EXPECT_EQ(keys(j["time_s"]), (Keys{"read", "sites", "subdivide", "assemble", "total"}));
  EXPECT_EQ(j["model"], "part.off");
  EXPECT_EQ(j["result"]["mode"], "medial");
  EXPECT_EQ(j["result"]["certified"], true);
  EXPECT_EQ(j["result"]["betti"], Json({1, 2, 0}));
  EXPECT_EQ(j["result"]["sheets"], 13);
  EXPECT_EQ(j["result"]["undecided_cells"], 0);
  EXPECT_EQ(j["result"]["hausdorff_bound"], 0.125);
  EXPECT_EQ(j["stages"]["filter"], 980);
  EXPECT_EQ(j["time_s"]["subdivide"], 0.5);
  EXPECT_EQ(j["time_s"]["total"], 1.5);
  EXPECT_EQ(j["peak_memory_bytes"], 123456789);
  EXPECT_EQ(j["seed"], 18446744073709551615u);
  EXPECT_EQ(j["version"], "0.1.0");
}

TEST(SummaryJson, UncertifiedRun_HasNoBettiNumbersAndSaysWhereAndWhy) {
  Sample sample;
  sample.result.certified = false;
  sample.result.undecided.assign(1500, {{{0, 0, 0}, {1, 2, 3}}, UndecidedReason::kDepth, 96});
  sample.result.hausdorff_bound = std::numeric_limits<double>::infinity();
  const Json j = Json::parse(summary_json(sample.input()));
  EXPECT_EQ(j["result"]["certified"], false);
  EXPECT_TRUE(j["result"]["betti"].is_null());
  EXPECT_TRUE(j["result"]["hausdorff_bound"].is_null());
  EXPECT_EQ(j["solid"]["betti"], Json({1, 2, 0}));
  EXPECT_EQ(j["result"]["undecided_cells"], 1500);
  EXPECT_EQ(j["undecided_by_reason"], (Json{{"depth", 1500}}));
  ASSERT_EQ(j["undecided"].size(), 1000u);
  EXPECT_EQ(j["undecided"][0]["depth"], 96);
  EXPECT_EQ(j["undecided"][0]["reason"], undecided_reason_name(UndecidedReason::kDepth));
  EXPECT_EQ(j["undecided"][0]["hi"], Json({1.0, 2.0, 3.0}));
}

TEST(SummaryJson, FileNameThatIsNotUtf8_IsNoReasonToFail) {
  const Sample sample;
  SummaryInput input = sample.input();
  input.model = "caf\xe9.off";
  EXPECT_EQ(Json::parse(summary_json(input))["model"], "caf\xef\xbf\xbd.off");
}

TEST(SummaryText, SaysWhetherTheResultIsCertified) {
  Sample sample;
  const std::string good = summary_text(sample.input());
  EXPECT_NE(good.find("certified, Betti numbers 1 2 0"), std::string::npos) << good;
  EXPECT_NE(good.find("13 sheets, 12 seams, 4 junctions, 0 clusters"), std::string::npos) << good;
  EXPECT_NE(good.find("39 leaf cells, deepest 11 bisections; 5 cut by planes, 8 tried\n"),
            std::string::npos)
      << good;
  EXPECT_EQ(good.back(), '\n');
  sample.result.certified = false;
  sample.result.undecided.assign(7, {{{0, 0, 0}, {1, 2, 3}}, UndecidedReason::kDepth, 96});
  sample.result.undecided[6].reason = UndecidedReason::kTime;
  const std::string bad = summary_text(sample.input());
  EXPECT_NE(bad.find("NOT certified, 7 cells undecided (6 depth, 1 time)"), std::string::npos)
      << bad;
  EXPECT_NE(bad.find("(0, 0, 0) to (1, 2, 3)"), std::string::npos) << bad;
  EXPECT_NE(bad.find("and 2 more"), std::string::npos) << bad;
}

TEST(Summary, FlattenedSolid_SaysWhatWasChanged) {
  const Sample sample;
  FlattenReport report{1e-6, 12, 1.25e-6, 1, {7, 8}, {15, 2}};
  SummaryInput input = sample.input();
  input.flattened = &report;
  EXPECT_EQ(Json::parse(summary_json(input))["coplanar"], Json({{"tolerance", 1e-6},
                                                                {"vertices_moved", 12},
                                                                {"largest_displacement", 1.25e-6},
                                                                {"slivers_dropped", 1},
                                                                {"flat_edges_before", 7},
                                                                {"flat_edges_after", 15},
                                                                {"nearly_flat_edges_before", 8},
                                                                {"nearly_flat_edges_left", 2}}));
  const std::string text = summary_text(input);
  EXPECT_NE(text.find("12 vertices moved by at most 1.25e-06, 1 sliver dropped"), std::string::npos)
      << text;
  report.vertices_moved = 0;
  EXPECT_NE(summary_text(input).find("changed    nothing (--coplanar-tolerance 1e-06)"),
            std::string::npos);
}

TEST(PeakMemory, IsPlausible) {
  EXPECT_GT(peak_memory_bytes(), 100'000u);
  EXPECT_LT(peak_memory_bytes(), 1'000'000'000'000u);
}

}  // namespace
}  // namespace blum
