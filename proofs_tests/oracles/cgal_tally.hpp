/// Compares the diagrams of the production, brute and CGAL engines on one rectangle as labelled
/// planar maps, and counts what came out.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <iostream>
#include <map>
#include <string>

#include "arrangement/coarse_map.hpp"
#include "arrangement/face_scenes.hpp"
#include "blum/arrangement/brute_engine.hpp"
#include "blum/arrangement/cgal_engine.hpp"
#include "blum/arrangement/engine_json.hpp"

namespace blum::test {

struct CgalTally {
  CgalMethod method = CgalMethod::kAlgebraic;
  /// Processor time is the limit; the clock's is far off, as machines may be busy.
  CgalLimits limits{.wall_s = 300};
  std::size_t most_candidates = 22, most_curved = 8;  // for the oracles' patience
  int problems = 0, skipped = 0;
  int same = 0;  ///< all three decide, and agree
  int bad = 0;   ///< an exact coincidence: both oracles say so, production does not decide
  int production_open = 0;  ///< undecided by production; the oracles agree
  int cgal_open = 0;        ///< no answer by CGAL
  int different = 0;
  int events = 0, rims = 0, clusters = 0, several_pieces = 0, with_ties = 0;
  double production_s = 0, brute_s = 0, cgal_s = 0, worst_s = 0;
  std::map<std::string, int> reason;

  void print(const char* what) const {
    std::cout << what << " (" << cgal_method_name(method) << "): " << problems << " problems, "
              << same << " same, " << bad << " in bad position, " << production_open
              << " undecided by production, " << cgal_open << " by CGAL, " << different
              << " DIFFERENT, " << skipped << " too large; " << with_ties << " with ties, "
              << several_pieces << " with several pieces, " << events << " events, " << clusters
              << " clusters, " << rims << " rims; production " << production_s << " s, brute "
              << brute_s << " s, CGAL " << cgal_s << " s, worst " << worst_s << " s\n";
    for (const auto& [r, n] : reason) std::cout << "    " << n << " x " << r << '\n';
  }
};

inline double timed(double& sum, const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  sum += s;
  return s;
}

/// Both exact: the same map, and the same labels.
inline std::string exact_difference(const FaceDiagram& a, const FaceDiagram& b) {
  std::string d = coarse_map_difference(a, b);
  return d.empty() ? coarse_map_difference(b, a) : d;
}

inline void compare_three(const Scene& scene, const Rect& r, CgalEngine& cgal, CgalTally& tally) {
  const auto near = scene.near(r);
  if (near.size() > tally.most_candidates || scene.curved(near) > tally.most_curved) {
    ++tally.skipped;
    return;
  }
  SCOPED_TRACE(describe(scene, r));
  ++tally.problems;
  constexpr int kProgress = 50;
  if (tally.problems % kProgress == 0)
    std::cout << tally.problems << " problems, " << tally.same << " same, " << tally.bad << " bad, "
              << tally.different << " different" << std::endl;
  const auto triangles = scene.all_triangles();
  const FaceProblem problem{scene.solid.get(), r, near, triangles};
  FaceDiagram p, b, c;
  timed(tally.production_s, [&] { p = scene.engine().face(problem); });
  timed(tally.brute_s, [&] { b = brute_face(problem); });
  tally.worst_s = std::max(tally.worst_s, timed(tally.cgal_s, [&] { c = cgal.face(problem, {}); }));
  const auto differ = [&](const std::string& what) {
    ++tally.different;
    ADD_FAILURE() << what;
  };
  if (b.status == FaceStatus::kUndecided) return differ("brute undecided: " + b.reason);
  if (c.status == FaceStatus::kUndecided) {
    ++tally.cgal_open;
    ++tally.reason["CGAL: " + c.reason + ": " + describe(scene, r)];
    return;
  }
  if (b.status != c.status)
    return differ("brute: " + (b.reason.empty() ? "decided" : b.reason) +
                  "; CGAL: " + (c.reason.empty() ? "decided" : c.reason));
  if (b.status == FaceStatus::kBadPosition) {
    if (p.status == FaceStatus::kDecided) {
      // Production may cone over what is degenerate but harmless; that is its own test's business.
      ++tally.reason["production decides what is in bad position: " + b.reason];
    }
    ++tally.bad;
    return;
  }
  if (const auto d = exact_difference(b, c); !d.empty()) return differ("brute and CGAL: " + d);
  if (p.status != FaceStatus::kDecided) {
    ++tally.production_open;
    ++tally.reason["production: " + p.reason];
    return;
  }
  if (const auto d = coarse_map_difference(p, c); !d.empty())
    return differ("production and CGAL: " + d);
  ++tally.same;
  const CoarseMap map(c);
  for (std::uint32_t n = 0; n < c.node.size(); ++n) {
    tally.events += map.event(n);
    tally.rims += map.rim(n);
  }
  for (const FaceNode& n : p.node) tally.clusters += !n.exact;
  tally.with_ties += !c.arc.empty();
  tally.several_pieces += c.piece.size() > 1;
}

}  // namespace blum::test
