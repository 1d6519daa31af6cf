#include "blum/medial/medial_axis.hpp"

#include <chrono>
#include <cmath>

#include "assemble.hpp"
#include "blum/kernel/check.hpp"
#include "blum/kernel/site_geometry.hpp"
#include "blum/subdivision/engine_set.hpp"

namespace blum {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double diameter(const Box3& b) {
  return std::hypot(b.hi.x - b.lo.x, b.hi.y - b.lo.y, b.hi.z - b.lo.z);
}

}  // namespace

Result<MedialResult> compute_medial_axis(const Solid& solid, const MedialOptions& options) {
  if (options.max_depth < 0 || options.threads < 1 || options.time_limit_s < 0 ||
      options.max_leaf_diameter < 0)
    return Error{ErrorCode::kBadArgument,
                 "max_depth, threads, time_limit_s or max_leaf_diameter out of range",
                 "",
                 {}};
  MedialResult result;
  result.solid_betti = solid.betti();
  result.seed = options.seed;
  result.threads = 1;

  const auto start = std::chrono::steady_clock::now();
  const SiteGeometry geometry(solid);
  EngineSet engines(geometry, options.engine, options.seed, options.resolve);
  Result<Subdivision> subdivided = subdivide(geometry, options, engines);
  if (!subdivided) return subdivided.error();
  const Subdivision& subdivision = subdivided.value();
  result.time.subdivide_s = seconds_since(start);

  const auto middle = std::chrono::steady_clock::now();
  double bound = 0;
  for (const Leaf& leaf : subdivision.leaf) {
    if (leaf.theorem == LeafTheorem::kUndecided)
      result.undecided.push_back(
          {{solid.frame.to_model(leaf.box.lo), solid.frame.to_model(leaf.box.hi)}, leaf.reason});
    if (leaf.has_axis) bound = std::max(bound, diameter(leaf.box));
  }
  result.hausdorff_bound = solid.frame.length_to_model(bound);
  result.leaves = subdivision.leaf.size();
  result.max_depth = subdivision.stats.max_depth;
  Assembly assembly = assemble(geometry, subdivision, engines);
  result.complex = std::move(assembly.complex);
  for (const auto l : assembly.undecided) {
    const Box3& box = subdivision.leaf[l].box;
    result.undecided.push_back({{solid.frame.to_model(box.lo), solid.frame.to_model(box.hi)},
                                UndecidedReason::kFaceUndecided});
  }
  result.parts = read_parts(result.complex);
  result.certified = result.undecided.empty();
  if (result.certified) {
    result.betti = betti_numbers(result.complex);
    // M ≃ O: a disagreement would be a defect of this program, and must not leave it as an answer.
    BLUM_CHECK(result.betti == result.solid_betti);
  }
  result.stages = engines.production().predicates().stages();
  result.time.assemble_s = seconds_since(middle);
  return result;
}

}  // namespace blum
