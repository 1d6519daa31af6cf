#include "blum/medial/medial_axis.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "assemble.hpp"
#include "certificate.hpp"
#include "blum/kernel/check.hpp"
#include "blum/kernel/site_geometry.hpp"
#include "blum/subdivision/engine_set.hpp"

namespace blum {
namespace {

// What is added to the time limit for the assembly: a part of it, at least so many seconds.
constexpr double kExtension = 0.05, kLeastExtension = 0.5;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double diameter(const Box3& b) {
  return std::hypot(b.hi.x - b.lo.x, b.hi.y - b.lo.y, b.hi.z - b.lo.z);
}

UndecidedReason reason_of(Stop stop) {
  return stop == Stop::kMemory ? UndecidedReason::kMemory : UndecidedReason::kTime;
}

/// What is said of the leaves, and why those of the assembly are undecided.
void report_leaves(const Frame& frame, const Subdivision& subdivision, const Assembly& assembly,
                   Stop stop, MedialResult& result) {
  std::vector<bool> dropped(subdivision.leaf.size(), false);
  for (const auto l : assembly.undecided) dropped[l] = true;
  double bound = 0;
  for (const CellNode& node : subdivision.node) {
    if (node.axis >= 0) continue;
    const Leaf& leaf = subdivision.leaf[node.leaf];
    const auto undecided = [&](UndecidedReason reason) {
      result.undecided.push_back(
          {{frame.to_model(leaf.box.lo), frame.to_model(leaf.box.hi)}, reason, node.depth});
    };
    if (leaf.theorem == LeafTheorem::kUndecided)
      undecided(leaf.reason);
    else if (dropped[node.leaf])
      undecided(UndecidedReason::kFaceUndecided);
    else if (assembly.stopped && leaf.has_axis)
      undecided(reason_of(stop));
    if (leaf.has_axis) bound = std::max(bound, diameter(leaf.box));
  }
  result.hausdorff_bound = frame.length_to_model(bound);
  result.leaves = subdivision.leaf.size();
  result.max_depth = subdivision.stats.max_depth;
}

}  // namespace

Result<MedialResult> compute_medial_axis(const Solid& solid, const MedialOptions& options,
                                         const CertificateSink& certificate) {
  if (options.max_depth < 0 || options.threads < 1 || !(options.time_limit_s >= 0) ||
      !(options.max_leaf_diameter >= 0))
    return Error{ErrorCode::kBadArgument,
                 "max_depth, threads, time_limit_s or max_leaf_diameter out of range",
                 "",
                 {}};
  MedialResult result;
  result.solid_betti = solid.betti();
  result.seed = options.seed;

  const auto start = std::chrono::steady_clock::now();
  RunWatch watch(options);
  const SiteGeometry geometry(solid);
  EngineSet engines(geometry, options, watch);
  result.threads = engines.threads();
  Result<Subdivision> subdivided = subdivide(geometry, options, engines);
  if (!subdivided) return subdivided.error();
  result.time.subdivide_s = seconds_since(start);

  const auto middle = std::chrono::steady_clock::now();
  watch.extend(std::max(kLeastExtension, kExtension * options.time_limit_s));
  Assembly assembly = assemble(geometry, subdivided.value(), engines);
  watch.rethrow();
  const Stop stop = watch.look();
  if (stop == Stop::kInterrupted)
    return Error{ErrorCode::kInterrupted, "interrupted during assembly", "", {}};
  report_leaves(solid.frame, subdivided.value(), assembly, stop, result);
  result.complex = std::move(assembly.complex);
  result.parts = read_parts(result.complex);
  result.certified = result.undecided.empty() && !assembly.stopped;
  if (result.certified) {
    result.betti = betti_numbers(result.complex);
    // M ≃ O: a disagreement would be a defect of this program, and must not leave it as an answer.
    BLUM_CHECK(result.betti == result.solid_betti);
  }
  if (certificate)
    write_certificate(geometry, subdivided.value(), assembly, result, options, engines, certificate);
  result.stages = engines.stages();
  result.time.assemble_s = seconds_since(middle);
  return result;
}

}  // namespace blum
