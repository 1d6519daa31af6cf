/// Compares the production engine with the exact oracle on rectangles, and counts.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <map>

#include "arrangement/coarse_map.hpp"
#include "arrangement/face_scenes.hpp"
#include "blum/arrangement/brute_engine.hpp"

namespace blum::test {

struct Tally {
  int problems = 0, same = 0, both_bad = 0, production_gives_up = 0, brute_bad_only = 0,
      different = 0;
  int clusters = 0, rims = 0, events = 0, loops = 0, several_pieces = 0, skipped = 0, with_ties = 0;
  /// Where a tie and a crossing of the boundary may lie between the same two doubles.
  bool oracle_may_give_up = false;
  int brute_gives_up = 0;
  int slices = 0, links = 0;  // parts that production decided by Theorem S, by chains at a vertex
  int rounded = 0, rounded_gives_up = 0;  // in solids whose facets are flat up to rounding only
  double production_s = 0, brute_s = 0;
  LabelSizes sizes;
  std::map<std::string, int> reason;
  double worst_ratio = 0;

  void print(const char* what) const {
    std::cout << what << ": " << problems << " problems, " << same << " same, " << both_bad
              << " bad for both, " << production_gives_up << " undecided by production alone, "
              << rounded_gives_up << " more of " << rounded << " in rounded solids, "
              << brute_bad_only << " bad for brute alone, " << different << " DIFFERENT, "
              << skipped << " skipped, " << brute_gives_up << " undecided by brute; " << events
              << " events, " << clusters << " clusters, " << rims << " rims, " << several_pieces
              << " with several pieces, " << with_ties << " with ties; labels " << sizes.production
              << "/" << sizes.brute << " worst " << worst_ratio << "; production " << production_s
              << " s, brute " << brute_s << " s\n";
    for (const auto& [r, n] : reason) std::cout << "    " << n << " x " << r << '\n';
  }
};

inline double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

inline constexpr std::size_t kMostCandidates = 22, kMostCurved = 8;  // for the oracle's patience

/// What production asks first, wherever it may hold.
enum class First { kUsual, kSlices, kLinks };

/// Compares on one rectangle. `wide` gives production all candidates instead of the near ones.
inline void compare(const Scene& scene, const Rect& r, bool wide, Tally& tally,
                    First first = First::kUsual) {
  const auto near = scene.near(r);
  if (near.size() > kMostCandidates || scene.curved(near) > kMostCurved) {
    ++tally.skipped;
    return;
  }
  ++tally.problems;
  const auto triangles = scene.all_triangles();
  const auto all = scene.all_candidates();
  const FaceProblem exact{scene.solid.get(), r, near, triangles};
  const FaceProblem fast{scene.solid.get(), r, wide ? all : near, triangles};
  double t = seconds();
  ProductionEngine engine = scene.engine();
  if (first == First::kSlices) engine.prefer_slices();
  if (first == First::kLinks) engine.prefer_links();
  FaceDiagram p;
  try {
    p = engine.face(fast);
  } catch (const std::exception& e) {
    ++tally.different;
    ADD_FAILURE() << "production throws: " << e.what() << "\n" << describe(scene, r);
    return;
  }
  tally.production_s += seconds() - t;
  tally.slices += static_cast<int>(engine.counts().slices);
  tally.links += static_cast<int>(engine.counts().links);
  t = seconds();
  if (std::getenv("BLUM_TRACE2") != nullptr)
    std::cout << near.size() << " candidates: " << describe(scene, r) << std::endl;
  FaceDiagram b;
  try {
    b = brute_face(exact);
  } catch (const std::exception& e) {
    ++tally.different;
    ADD_FAILURE() << "brute throws: " << e.what() << "\n" << describe(scene, r);
    return;
  }
  tally.brute_s += seconds() - t;
  if (seconds() - t > 1 && std::getenv("BLUM_TRACE") != nullptr)
    std::cout << "slow " << seconds() - t << " s, " << near.size()
              << " candidates: " << describe(scene, r) << std::endl;
  if (tally.oracle_may_give_up && b.status == FaceStatus::kUndecided) {
    ++tally.brute_gives_up;
    return;
  }
  ASSERT_NE(b.status, FaceStatus::kUndecided);
  const bool rounded = scene.name.rfind("rotated", 0) == 0;
  tally.rounded += rounded;
  const bool p_ok = p.status == FaceStatus::kDecided, b_ok = b.status == FaceStatus::kDecided;
  if (!p_ok) {
    ++tally.reason[(b_ok ? "alone: " : "both: ") + p.reason];
    ++(!b_ok ? tally.both_bad : rounded ? tally.rounded_gives_up : tally.production_gives_up);
    if (b_ok && std::getenv("BLUM_TRACE") != nullptr)
      std::cout << "gives up: " << p.reason << ": " << describe(scene, r) << '\n';
    return;
  }
  if (!b_ok) {
    ++tally.brute_bad_only;
    ++tally.reason["brute alone: " + b.reason];
    if (std::getenv("BLUM_TRACE") != nullptr)
      std::cout << "brute bad: " << b.reason << ": " << describe(scene, r) << '\n';
    return;
  }
  LabelSizes sizes;
  const std::string difference = coarse_map_difference(p, b, &sizes);
  if (!difference.empty()) {
    ++tally.different;
    ADD_FAILURE() << difference << "\n" << describe(scene, r);
    return;
  }
  ++tally.same;
  tally.sizes.production += sizes.production;
  tally.sizes.brute += sizes.brute;
  if (sizes.brute > 0)
    tally.worst_ratio = std::max(tally.worst_ratio, static_cast<double>(sizes.production) /
                                                        static_cast<double>(sizes.brute));
  const CoarseMap map(p);
  for (std::uint32_t n = 0; n < p.node.size(); ++n) {
    tally.events += map.event(n);
    tally.rims += map.rim(n);
    tally.clusters += map.event(n) && !p.node[n].exact;
  }
  tally.with_ties += !p.arc.empty();
  tally.several_pieces += p.piece.size() > 1;
}

}  // namespace blum::test
