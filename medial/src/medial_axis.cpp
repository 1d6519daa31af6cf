#include "blum/medial/medial_axis.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "assemble.hpp"
#include "blum/arrangement/cgal_engine.hpp"
#include "blum/kernel/check.hpp"
#include "blum/kernel/point_algebra.hpp"
#include "blum/kernel/site_geometry.hpp"
#include "blum/medial/review.hpp"
#include "blum/subdivision/cell_test.hpp"
#include "blum/subdivision/engine_set.hpp"
#include "blum/subdivision/refine.hpp"
#include "blum/subdivision/sided_face.hpp"
#include "blum/subdivision/voronoi_surface.hpp"
#include "certificate.hpp"
#include "part_angles.hpp"

namespace blum {
namespace {

// What is added to the time limit for the assembly: a part of it, at least so many seconds.
constexpr double kExtension = 0.05, kLeastExtension = 0.5;
// What a reviewed run keeps of its time for the end (Betti numbers, files): times what the assembly
// took, but at most this part of what is left.
constexpr double kFinish = 2, kMostFinish = 0.1;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
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
  result.leaves_cut = subdivision.stats.leaves_cut;
  result.planes_tried = subdivision.stats.planes_tried;
  result.tubes = subdivision.stats.tubes;
  result.site_pairs = subdivision.stats.site_pairs;
  result.max_depth = subdivision.stats.max_depth;
}

/// Of the complex: V - E + F.
long euler_of(const CellComplex& c) {
  return static_cast<long>(c.vertex.size()) - static_cast<long>(c.edge.size()) +
         static_cast<long>(c.triangle.size());
}

VoronoiCheck check_voronoi(const SiteGeometry& geometry, const SubdivisionOptions& options,
                           const Subdivision& subdivision, const CellComplex& complex,
                           EngineSet& engines) {
  VoronoiCheck check;
  check.side = options.side;
  check.regions = geometry.candidates().size();
  const auto betti = geometry.solid().betti();
  check.solid_euler = betti[0] - betti[1] + betti[2];
  for (const SiteId s : geometry.candidates())
    if (geometry.index().kind(s) != SiteKind::kFace)
      ++(region_is_inside(engines.production().predicates(), s) ? check.regions_inside
                                                                : check.regions_outside);
  check.euler = euler_of(complex);
  for (const auto& d : subdivision.surface)
    if (!d) return check;
  check.decided = true;
  check.pieces_euler = VoronoiSurface(subdivision.surface).pieces_euler();
  return check;
}

bool any_undecided(const Subdivision& subdivision) {
  return std::any_of(subdivision.leaf.begin(), subdivision.leaf.end(),
                     [](const Leaf& leaf) { return leaf.theorem == LeafTheorem::kUndecided; });
}

/// Leaves that a review finds too coarse are divided into halves, as are parts of them that are not
/// fine enough; later reviews find few, and rounds cost more than leaves: into parts of so much of
/// their size.
constexpr std::array<double, 3> kPartOfLeaf = {0.9, 0.55, 0.3};
constexpr double kPartOfPart = 0.9;
/// What assembly and review of a finer subdivision may take, times what the last ones took:
/// dividing ends early enough for both. But it gets this part of the time at least: the review of
/// few large leaves says little of the next, and one that does not end spoils nothing.
constexpr double kReserve = 2, kLeastShare = 0.4;

/// Divides leaves until the review is content or the budget is out; a step that would leave
/// something undecided is undone. Returns what the last review said.
ReviewVerdict review_and_refine(const SiteGeometry& geometry, const SubdivisionOptions& options,
                                EngineSet& engines, const AxisReview& review, double assemble_s,
                                Subdivision& subdivision, Assembly& assembly) {
  using Clock = std::chrono::steady_clock;
  const bool undecided = any_undecided(subdivision) || !assembly.undecided.empty();
  RunWatch& watch = engines.watch();
  StepTimes time{0, assemble_s};
  std::optional<std::pair<Subdivision, Assembly>> before;
  for (std::size_t round = 0;; ++round) {
    const auto begin = Clock::now();
    const Parts parts = read_parts(assembly.complex);
    ReviewVerdict verdict =
        review({geometry, subdivision, engines, assembly.complex, parts, undecided, time});
    const double review_s = seconds_since(begin);
    if (verdict.go_back) {
      BLUM_CHECK(before);
      std::tie(subdivision, assembly) = std::move(*before);
      return verdict;
    }
    before.reset();
    const double remaining = watch.remaining_s();
    const double left =
        std::max(remaining - kReserve * (time.assemble_s + review_s), kLeastShare * remaining);
    if (verdict.divide.empty() || undecided || !(left > 0) || watch.look() != Stop::kNone)
      return verdict;
    const auto middle = Clock::now();
    Refinement refinement{verdict.divide, kPartOfLeaf[std::min(round, kPartOfLeaf.size() - 1)],
                          verdict.fine_enough, kPartOfPart};
    if (std::isfinite(left))
      refinement.deadline =
          middle + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(left));
    Result<Refined> finer = refine(geometry, options, engines, subdivision, refinement);
    if (!finer || finer.value().divided == 0 || watch.look() != Stop::kNone) return verdict;
    time.refine_s = seconds_since(middle);
    const auto late = Clock::now();
    Assembly next = assemble(geometry, finer.value().subdivision, engines);
    if (next.stopped || !next.undecided.empty()) return verdict;
    time.assemble_s = seconds_since(late);
    before.emplace(std::move(subdivision), std::move(assembly));
    subdivision = std::move(finer.value().subdivision);
    assembly = std::move(next);
  }
}

/// Boxes for each leaf of a part that say whether the leaf is too coarse.
constexpr std::size_t kFirstLook = 400;

AngleLook angle_look(const AngleOptions& options, bool for_coarse_leaves) {
  return {options.tolerance_deg,
          for_coarse_leaves ? std::min(options.boxes_per_leaf, kFirstLook) : options.boxes_per_leaf,
          for_coarse_leaves};
}

/// Content with leaves where the review is and separation angles are within their tolerance.
struct AngleReview {
  const AxisReview& review;
  const AngleOptions& options;
  int rounds = 0;
  AngleMemo memo{};
  std::optional<PartAngles> last{};  ///< of the axis seen last
  bool whole = false;                ///< and not only a first look
  double seconds = 0;

  ReviewVerdict operator()(const AssembledAxis& axis) {
    last.reset();
    ReviewVerdict verdict = review ? review(axis) : ReviewVerdict{};
    if (!options.wanted || verdict.go_back || !verdict.divide.empty() || axis.undecided)
      return verdict;
    const auto begin = std::chrono::steady_clock::now();
    const auto look = [&](bool for_coarse_leaves) {
      last = part_angles(axis.geometry, axis.subdivision, axis.engines, axis.complex, axis.parts,
                         angle_look(options, for_coarse_leaves), memo);
      whole = !for_coarse_leaves || last->wide == 0;
    };
    const bool may_divide = rounds++ < options.refinements;
    if (may_divide) look(true);
    if (!may_divide || (!whole && last->coarse_leaves.empty())) look(false);
    if (may_divide) verdict.divide = last->coarse_leaves;
    seconds += seconds_since(begin);
    verdict.fine_enough = {};
    return verdict;
  }
};

Result<MedialResult> compute(const Solid& solid, const MedialOptions& options,
                             const AngleOptions& angles, const CertificateSink& certificate,
                             const AxisReview& review, DiagramKind kind) {
  if (!(angles.tolerance_deg >= 0) || (angles.certified_theta_deg && !angles.wanted) ||
      options.max_depth < 0 || options.threads < 1 || !(options.time_limit_s >= 0) ||
      !(options.max_leaf_diameter >= 0) || (kind == DiagramKind::kVoronoi && !(options.margin > 0)))
    return Error{ErrorCode::kBadArgument,
                 "max_depth, threads, time_limit_s, max_leaf_diameter, margin or tolerance_deg out "
                 "of range, "
                 "or certified_theta_deg without angles",
                 "",
                 {}};
  if (options.engine == Engine::kCgal && kind == DiagramKind::kVoronoi)
    return Error{ErrorCode::kBadArgument, "the CGAL engine knows medial axes only", "", {}};
  if (options.engine == Engine::kCgal && !find_cgal_helper()) {
    return Error{ErrorCode::kBadArgument,
                 "no blum-cgal-engine: this Blum was built without BLUM_CGAL_ORACLES",
                 {},
                 {}};
  }
  MedialResult result;
  result.kind = kind;
  result.criterion = options.criterion;
  result.margin = options.margin;
  result.solid_betti = solid.betti();
  result.seed = options.seed;

  const auto start = std::chrono::steady_clock::now();
  RunWatch watch(options);
  const SiteGeometry geometry(solid, kind);
  EngineSet engines(geometry, options, watch);
  result.threads = engines.threads();
  // What `blum verify` cannot follow yet is done without where that is possible.
  SubdivisionOptions used = options;
  if (certificate) {
    used.cuts = false;
    used.split_vertices = false;
    used.own_faces = true;
    engines.prefer_plain_reasons();
  }
  Result<Subdivision> subdivided = subdivide(geometry, used, engines);
  if (!subdivided) return subdivided.error();
  result.time.subdivide_s = seconds_since(start);

  const auto middle = std::chrono::steady_clock::now();
  const double extension = std::max(kLeastExtension, kExtension * options.time_limit_s);
  watch.extend(extension);
  Assembly assembly = assemble(geometry, subdivided.value(), engines);
  // What was not needed is taken back, unless the first review needs it.
  if (watch.remaining_s() > 2 * extension) watch.extend(-extension);
  result.time.assemble_s = seconds_since(middle);
  std::optional<ReviewVerdict> verdict;
  AngleReview bounded{review, angles};
  if ((review || angles.wanted) && !assembly.stopped) {
    const double finish = std::max(
        0.0, std::min(kFinish * result.time.assemble_s, kMostFinish * watch.remaining_s()));
    watch.extend(-finish);
    verdict = review_and_refine(geometry, used, engines, std::ref(bounded), result.time.assemble_s,
                                subdivided.value(), assembly);
    watch.extend(finish);
  }
  // Where the review has used up the time, what follows is about a complex that is there.
  if (watch.look() == Stop::kTime && !assembly.stopped) watch.extend(kLeastExtension);
  watch.rethrow();
  const Stop stop = watch.look();
  if (stop == Stop::kInterrupted)
    return Error{ErrorCode::kInterrupted, "interrupted during assembly", "", {}};
  const auto late = std::chrono::steady_clock::now();
  report_leaves(solid.frame, subdivided.value(), assembly, stop, result);
  if (verdict && review) result.hausdorff_bound = verdict->hausdorff_bound;
  result.complex = std::move(assembly.complex);
  result.parts = read_parts(result.complex);
  result.certified = result.undecided.empty() && !assembly.stopped;
  // Nothing is known of the axis in cells that are undecided.
  if (!result.certified) result.hausdorff_bound = std::numeric_limits<double>::infinity();
  if (result.certified) {
    result.betti = betti_numbers(result.complex);
    // M ≃ O: a disagreement would be a defect of this program, and must not leave it as an answer.
    if (kind == DiagramKind::kMedial) BLUM_CHECK(result.betti == result.solid_betti);
  }
  if (kind == DiagramKind::kVoronoi) {
    result.voronoi = check_voronoi(geometry, options, subdivided.value(), result.complex, engines);
    // The same holds for Euler's formula in the box.
    if (result.certified && result.voronoi->decided) BLUM_CHECK(result.voronoi->holds());
    if (result.certified && options.side == VoronoiSide::kInside) {
      auto expected = result.solid_betti;
      expected[2] += static_cast<long>(result.voronoi->regions_inside);
      BLUM_CHECK(result.betti == expected);
    }
    result.certified = result.certified && result.voronoi->holds();
  }
  result.time.assemble_s += seconds_since(late);
  if (angles.wanted) {
    const auto begin = std::chrono::steady_clock::now();
    result.angles = bounded.last && bounded.whole
                        ? std::move(*bounded.last)
                        : part_angles(geometry, subdivided.value(), engines, result.complex,
                                      result.parts, angle_look(angles, false), bounded.memo);
    result.filtration = filter(result.complex, result.parts,
                               cell_costs(result.complex, result.parts, *result.angles));
    result.time.angles_s = seconds_since(begin) + bounded.seconds;
    watch.rethrow();
    if (watch.look() == Stop::kInterrupted)
      return Error{ErrorCode::kInterrupted, "interrupted while bounding angles", "", {}};
  }
  if (certificate) {
    if (watch.look() == Stop::kTime)
      watch.extend(std::max(kLeastExtension, kExtension * options.time_limit_s));
    result.certificate_whole =
        write_certificate(geometry, subdivided.value(), assembly, result, options,
                          angles.certified_theta_deg, engines, certificate);
  }
  result.stages = engines.stages();
  return result;
}

}  // namespace

Result<MedialResult> compute_medial_axis(const Solid& solid, const MedialOptions& options,
                                         const AngleOptions& angles,
                                         const CertificateSink& certificate,
                                         const AxisReview& review) {
  return compute(solid, options, angles, certificate, review, DiagramKind::kMedial);
}

Result<MedialResult> compute_voronoi_diagram(const Solid& solid, const MedialOptions& options) {
  return compute(solid, options, {}, {}, {}, DiagramKind::kVoronoi);
}

}  // namespace blum
