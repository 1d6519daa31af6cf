#include "cell_work.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "blum/arrangement/common_point.hpp"
#include "blum/kernel/point_algebra.hpp"
#include "blum/subdivision/voronoi_cell_test.hpp"
#include "meeting.hpp"
#include "sided_cell.hpp"

namespace blum {
namespace {

/// A cell with more candidates than asked for is split untested, but after so many bisections that
/// lost none it is tested: they may all meet in a point.
constexpr int kPatience = 4;
constexpr int kPlaneAttempts = 8;
constexpr std::size_t kIsolated = 16;
/// Resolving stops at cells of this fraction of the box: what is left is a degenerate junction or
/// one that cannot be told from it by sight.
constexpr double kResolveFraction = 0x1p-20;

static_assert(std::tuple_size_v<decltype(SubdivisionStats::rejected)> ==
              static_cast<std::size_t>(CellVerdict::kCount));

double jitter(std::uint64_t seed, double lo, double hi, int axis, int attempt) {
  std::uint64_t h = seed * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(axis);
  for (const std::uint64_t x : {std::bit_cast<std::uint64_t>(lo), std::bit_cast<std::uint64_t>(hi),
                                static_cast<std::uint64_t>(attempt)}) {
    h ^= x;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    h ^= h >> 31;
  }
  return static_cast<double>(h >> 11) * 0x1p-53;
}

Leaf undecided(UndecidedReason reason) {
  Leaf leaf;
  leaf.reason = reason;
  return leaf;
}

int longest_axis(const Box3& box) {
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (box.hi[k] - box.lo[k] > box.hi[axis] - box.lo[axis]) axis = k;
  return axis;
}

}  // namespace

Box3 root_box(const SiteGeometry& geometry, const SubdivisionOptions& options) {
  const Solid& solid = geometry.solid();
  const std::uint64_t seed = options.seed;
  Box3 b = bounds_of(solid.point);
  double size = 0;
  for (int k = 0; k < 3; ++k) size = std::max(size, b.hi[k] - b.lo[k]);
  const Box3 tight = b;
  for (int k = 0; k < 3; ++k) {
    if (geometry.kind() == DiagramKind::kVoronoi) {
      const double half = 0.5 * options.margin * (tight.hi[k] - tight.lo[k]);
      b.lo[k] = tight.lo[k] - half * (1 + 0.1 * jitter(seed, tight.lo[k], size, k, -1));
      b.hi[k] = tight.hi[k] + half * (1 + 0.1 * jitter(seed, tight.hi[k], size, k, -2));
      continue;
    }
    // Random margins of 2 to 6 % put the box itself, and so all its planes, in general position.
    b.lo[k] = tight.lo[k] - size * (0.02 + 0.04 * jitter(seed, tight.lo[k], size, k, -1));
    b.hi[k] = tight.hi[k] + size * (0.02 + 0.04 * jitter(seed, tight.hi[k], size, k, -2));
  }
  return b;
}

CellOutcome CellWorker::work(Cell& cell) {
  if (medial_ || one_sided_)
    cell.triangles = triangles_meeting(geometry_, cell.triangles, cell.box);
  Leaf leaf;
  if (is_beyond(cell)) {
    leaf.theorem = LeafTheorem::kOutside;
    return leaf;
  }
  const auto before = cell.candidates.size();
  stats_.site_pairs += cell.candidates.size();
  cell.candidates =
      production_.prune(cell.candidates, cell.box.lo, cell.box.hi, options_.distance_hint);
  cell.stuck = cell.candidates.size() < before ? 0 : cell.stuck + 1;
  if (options_.own_faces && cell.stuck == 0) cell.face.fill(nullptr);
  const bool small = options_.max_candidates == 0 ||
                     cell.candidates.size() <= options_.max_candidates ||
                     cell.stuck % kPatience == kPatience - 1;
  if (small && !cell.to_divide) {
    LocalDiagrams diagrams = diagrams_of(cell);
    const CellVerdict verdict = test(cell, diagrams, leaf);
    stats_.faces_computed += diagrams.faces_computed();
    if (verdict == CellVerdict::kAccepted && (!leaf.has_axis || fine_enough(cell))) {
      leaf.candidates = std::move(cell.candidates);
      leaf.triangles = std::move(cell.triangles);
      leaf.face = std::move(cell.face);
      return leaf;
    }
  }
  if (!small) take_halves(cell);
  return divide(cell, small);
}

/// Refers to the cell's lists; knows what the cell has from its parent.
LocalDiagrams CellWorker::diagrams_of(const Cell& cell) {
  LocalDiagrams diagrams(diagrams_, solid_, cell.candidates, border(cell));
  for (const auto& inherited : cell.face)
    if (inherited) diagrams.adopt(inherited);
  for (const auto& whole : cell.whole)
    if (whole) diagrams.inherit(whole);
  return diagrams;
}

/// For the sake of the cell's parts.
void CellWorker::take_halves(Cell& cell) {
  LocalDiagrams diagrams = diagrams_of(cell);
  for (int f = 0; f < 6; ++f) {
    if (!cell.whole[f] || cell.face[f]) continue;
    auto face = diagrams.face(box_face(cell.box, f));
    if (face->status == FaceStatus::kDecided) cell.face[f] = std::move(face);
  }
  stats_.faces_computed += diagrams.faces_computed();
}

/// Is the cell known to lie on the side of the boundary that is not wanted?
bool CellWorker::is_beyond(const Cell& cell) const {
  if (!(medial_ || one_sided_) || !cell.triangles.empty()) return false;
  const bool inside = work_.engines.inside().locate(cell.box.lo) == InsideOracle::Where::kInside;
  return inside == (one_sided_ && options_.side == VoronoiSide::kOutside);
}

/// Fills in the faces of the cell, and what the answer says of the leaf.
CellVerdict CellWorker::test(Cell& cell, LocalDiagrams& diagrams, Leaf& leaf) {
  const auto verdict = [&](CellVerdict v) {
    ++stats_.rejected[static_cast<int>(v)];
    return v;
  };
  ++stats_.cells_tested;
  for (int f = 0; f < 6; ++f) {
    auto face = diagrams.face(box_face(cell.box, f));
    if (face->status != FaceStatus::kDecided) return verdict(CellVerdict::kFace);
    cell.face[f] = std::move(face);
  }
  double diameter = 0;
  for (int k = 0; k < 3; ++k) diameter = std::max(diameter, cell.box.hi[k] - cell.box.lo[k]);
  const bool resolve = options_.resolve && diameter > kResolveFraction * work_.root_diameter;
  CellOracles oracles;
  oracles.axis_at = [this](std::uint32_t v) { return axis_at(v); };
  if (options_.cuts && fine_enough(cell))
    oracles.section = [&](const CutPlane& plane) {
      return section_misses_axis(geometry_, production_, work_.engines.inside(), plane, cell.box,
                                 cell.candidates, cell.triangles);
    };
  CellAnswer a = medial_
                     ? test_cell(geometry_, cell.box, cell.candidates, cell.triangles, cell.face,
                                 oracles, resolve)
                     : test_voronoi_cell(production_.predicates(), cell.box, cell.candidates,
                                         cell.face, options_.criterion, resolve,
                                         options_.tubes && (!one_sided_ || cell.triangles.empty()));
  stats_.planes_tried += static_cast<std::size_t>(a.planes_tried);
  leaf.theorem = !medial_    ? LeafTheorem::kVoronoi
                 : a.conical ? LeafTheorem::kConical
                             : LeafTheorem::kBoundary;
  leaf.boundary_vertex = a.vertex;
  leaf.has_axis = a.has_axis;
  leaf.cut = std::move(a.cut);
  leaf.tube = std::move(a.tube);
  // A cluster that is one degenerate junction cannot be refined away.
  if (a.verdict == CellVerdict::kCluster && one_junction(cell, cell.face))
    a.verdict = CellVerdict::kAccepted;
  if (one_sided_ && a.verdict == CellVerdict::kAccepted && !cell.triangles.empty()) {
    const SidedAnswer sided = test_sided_cell(production_.predicates(), work_.engines.inside(),
                                              cell.box, cell.triangles, cell.face, options_.side);
    if (!sided.accepted) return verdict(CellVerdict::kSides);
    leaf.has_axis = sided.has_diagram;
  }
  return verdict(a.verdict);
}

bool CellWorker::fine_enough(const Cell& cell) const {
  const double length = diameter(cell.box);
  return length <= cell.largest_diameter &&
         (options_.max_leaf_diameter <= 0 ||
          solid_.frame.length_to_model(length) <= options_.max_leaf_diameter);
}

CellOutcome CellWorker::divide(Cell& cell, bool tested) {
  if (cell.depth >= options_.max_depth) return undecided(UndecidedReason::kDepth);
  if (work_.nodes.fetch_add(2) + 2 > options_.max_cells) {
    work_.nodes -= 2;
    return undecided(UndecidedReason::kCells);
  }
  if (auto halves = split(cell, tested)) return *std::move(halves);
  // No plane here could be decided: smaller cells keep the trouble to where it is, until little
  // else is left in them.
  if (cell.candidates.size() > kIsolated)
    if (auto halves = split(cell, false)) return *std::move(halves);
  work_.nodes -= 2;
  return undecided(UndecidedReason::kFaceUndecided);
}

std::optional<Split> CellWorker::split(Cell& cell, bool validate) {
  const int axis = longest_axis(cell.box);
  const double lo = cell.box.lo[axis], hi = cell.box.hi[axis];
  for (int attempt = 0; attempt < kPlaneAttempts; ++attempt) {
    const double m = lo + (hi - lo) * (0.42 + 0.16 * jitter(options_.seed, lo, hi, axis, attempt));
    if (!(m > lo && m < hi)) return std::nullopt;
    std::shared_ptr<const FaceDiagram> section;
    if (validate) {
      Rect r = box_face(cell.box, 2 * axis);
      r.level = m;
      LocalDiagrams diagrams(diagrams_, solid_, cell.candidates, border(cell));
      section = diagrams.face(r);
      stats_.faces_computed += diagrams.faces_computed();
      if (section->status != FaceStatus::kDecided) {
        ++stats_.planes_moved;
        continue;
      }
    }
    const auto low_face = static_cast<std::size_t>(2 * axis), high_face = low_face + 1;
    Split s;
    s.axis = axis;
    s.cut = m;
    for (Cell* half : {&s.low, &s.high}) {
      half->box = cell.box;
      half->depth = cell.depth + 1;
      half->stuck = cell.stuck;
      half->largest_diameter = cell.largest_diameter;
      half->whole = cell.face;
      half->whole[low_face] = half->whole[high_face] = nullptr;
    }
    s.low.box.hi[axis] = s.high.box.lo[axis] = m;
    s.low.face[low_face] = cell.face[low_face];
    s.low.face[high_face] = s.high.face[low_face] = section;
    s.high.face[high_face] = cell.face[high_face];
    s.high.candidates = cell.candidates;
    s.high.triangles = cell.triangles;
    s.low.candidates = std::move(cell.candidates);
    s.low.triangles = std::move(cell.triangles);
    return s;
  }
  return std::nullopt;
}

bool CellWorker::one_junction(const Cell& cell, const Faces& face) {
  std::vector<SiteId> labels;
  for (const auto& d : face)
    for (const FaceRegion& r : d->region)
      labels.insert(labels.end(), r.labels.begin(), r.labels.end());
  for (const auto t : border(cell)) labels.push_back(geometry_.index().face(t));
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  const Box3& box = cell.box;
  const auto groups = production_.tie_groups(labels, box.lo, box.hi);
  if (groups.size() < 4) return false;
  const CommonPoint c = common_point(geometry_, groups, box.lo, box.hi);
  // Four feet that span space: an ordinary junction, and the cell holds something beside it.
  return c.gap <= kCommonTolerance && (groups.size() > 4 || !feet_span(geometry_, groups, c.point));
}

const Predicates::AxisAtVertex* CellWorker::axis_at(std::uint32_t vertex) {
  const auto [it, fresh] = axis_at_.try_emplace(vertex);
  if (fresh) it->second = production_.predicates().axis_at(vertex);
  if (!it->second || (it->second->trees > 1 && !options_.split_vertices)) return nullptr;
  return &*it->second;
}

}  // namespace blum
