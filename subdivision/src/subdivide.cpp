#include "blum/subdivision/subdivision.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <unordered_map>

#include "blum/arrangement/common_point.hpp"
#include "blum/kernel/check.hpp"
#include "blum/kernel/closest_point.hpp"
#include "blum/subdivision/cell_test.hpp"
#include "blum/subdivision/engine_set.hpp"

namespace blum {

const char* undecided_reason_name(UndecidedReason reason) {
  switch (reason) {
    case UndecidedReason::kDepth:
      return "depth";
    case UndecidedReason::kCells:
      return "cells";
    case UndecidedReason::kTime:
      return "time";
    case UndecidedReason::kFaceUndecided:
      return "face_undecided";
  }
  return "unknown";
}

namespace {

/// A cell with more candidates is split untested: its test would cost more than its children's.
constexpr std::size_t kMaxCandidates = 96;
constexpr int kPlaneAttempts = 8;
constexpr std::size_t kIsolated = 16;
/// Resolving stops at cells of this fraction of the box: what is left is a degenerate junction or
/// one that cannot be told from it by sight.
constexpr double kResolveFraction = 0x1p-20;

class Subdivider {
 public:
  Subdivider(const SiteGeometry& geometry, const SubdivisionOptions& options, EngineSet& engines)
      : geometry_(geometry), solid_(geometry.solid()), options_(options), engines_(engines) {}

  Result<Subdivision> run();

 private:
  struct Cell {
    std::uint32_t node;
    std::vector<SiteId> candidates;
    std::vector<std::uint32_t> triangles;
    std::shared_ptr<const FaceDiagram> section;  // kept alive for both children
  };

  [[nodiscard]] Box3 root_box() const;
  [[nodiscard]] std::vector<std::uint32_t> meeting(std::span<const std::uint32_t> triangles,
                                                   const Box3& box) const;
  [[nodiscard]] std::optional<CellAnswer> test(const Cell& cell);
  [[nodiscard]] bool split(Cell& cell, bool validate);
  [[nodiscard]] bool connected_at(std::uint32_t vertex);
  [[nodiscard]] bool one_junction(const Cell& cell,
                                  const std::array<std::shared_ptr<const FaceDiagram>, 6>& face);
  void close(const Cell& cell, Leaf leaf);
  [[nodiscard]] double jitter(double lo, double hi, int axis, int attempt) const;

  const SiteGeometry& geometry_;
  const Solid& solid_;
  const SubdivisionOptions& options_;
  EngineSet& engines_;
  Subdivision result_;
  std::vector<Cell> stack_;
  std::unordered_map<std::uint32_t, bool> connected_;  // boundary vertex -> connected_at
  double root_volume_ = 1, root_diameter_ = 1, done_ = 0;
};

double Subdivider::jitter(double lo, double hi, int axis, int attempt) const {
  std::uint64_t h = options_.seed * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(axis);
  for (const std::uint64_t x : {std::bit_cast<std::uint64_t>(lo), std::bit_cast<std::uint64_t>(hi),
                                static_cast<std::uint64_t>(attempt)}) {
    h ^= x;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    h ^= h >> 31;
  }
  return static_cast<double>(h >> 11) * 0x1p-53;
}

Box3 Subdivider::root_box() const {
  Box3 b{solid_.point.front(), solid_.point.front()};
  for (const Point3& p : solid_.point)
    for (int k = 0; k < 3; ++k) {
      b.lo[k] = std::min(b.lo[k], p[k]);
      b.hi[k] = std::max(b.hi[k], p[k]);
    }
  double size = 0;
  for (int k = 0; k < 3; ++k) size = std::max(size, b.hi[k] - b.lo[k]);
  const Box3 tight = b;
  for (int k = 0; k < 3; ++k) {
    // Random margins of 2 to 6 % put the box itself, and so all its planes, in general position.
    b.lo[k] = tight.lo[k] - size * (0.02 + 0.04 * jitter(tight.lo[k], size, k, -1));
    b.hi[k] = tight.hi[k] + size * (0.02 + 0.04 * jitter(tight.hi[k], size, k, -2));
  }
  return b;
}

std::vector<std::uint32_t> Subdivider::meeting(std::span<const std::uint32_t> triangles,
                                               const Box3& box) const {
  std::vector<std::uint32_t> kept;
  for (const auto t : triangles) {
    const auto& v = solid_.triangle[t].vertex;
    bool apart = false;
    for (int k = 0; k < 3 && !apart; ++k) {
      const double a = solid_.point[v[0]][k], b = solid_.point[v[1]][k], c = solid_.point[v[2]][k];
      apart = std::min({a, b, c}) > box.hi[k] || std::max({a, b, c}) < box.lo[k];
    }
    if (apart) continue;
    // Outside the triangle's plane, or of its prism on one side.
    const SiteId face = geometry_.index().face(t);
    const auto beyond = [&](const BallVector& w, const Point3& base, bool both) {
      Point3 c;
      double reach = 0;
      for (int k = 0; k < 3; ++k) {
        c[k] = 0.5 * (box.lo[k] + box.hi[k]);
        reach += w[k].magnitude() * std::max(box.hi[k] - c[k], c[k] - box.lo[k]);
      }
      reach *= 1 + 0x1p-40;
      const Ball h = dot(w, difference(c, base));
      return h.low() > reach || (both && h.high() < -reach);
    };
    apart = beyond(geometry_.unit(face), geometry_.base(face), true);
    const auto domain = geometry_.domain(face);
    for (int k = 0; k < 3 && !apart; ++k)
      apart = beyond(domain[k].w, solid_.point[domain[k].base], false);
    if (apart) continue;
    kept.push_back(t);
  }
  return kept;
}

std::optional<CellAnswer> Subdivider::test(const Cell& cell) {
  const Box3& box = result_.node[cell.node].box;
  std::array<std::shared_ptr<const FaceDiagram>, 6> face;
  ++result_.stats.cells_tested;
  for (int f = 0; f < 6; ++f) {
    face[f] = engines_.cache().face(solid_, box_face(box, f), cell.candidates, cell.triangles);
    if (face[f]->status != FaceStatus::kDecided) {
      ++result_.stats.rejected[static_cast<int>(CellVerdict::kFace)];
      return std::nullopt;
    }
  }
  double diameter = 0;
  for (int k = 0; k < 3; ++k) diameter = std::max(diameter, box.hi[k] - box.lo[k]);
  const bool resolve = options_.resolve && diameter > kResolveFraction * root_diameter_;
  CellAnswer a = test_cell(
      geometry_, box, cell.candidates, cell.triangles, face,
      [this](std::uint32_t v) { return connected_at(v); }, resolve);
  // A cluster that is one degenerate junction cannot be refined away.
  if (a.verdict == CellVerdict::kCluster && one_junction(cell, face))
    a.verdict = CellVerdict::kAccepted;
  ++result_.stats.rejected[static_cast<int>(a.verdict)];
  if (a.verdict == CellVerdict::kAccepted)
    result_.held.insert(result_.held.end(), face.begin(), face.end());
  return a;
}

bool Subdivider::one_junction(const Cell& cell,
                              const std::array<std::shared_ptr<const FaceDiagram>, 6>& face) {
  std::vector<SiteId> labels;
  for (const auto& d : face)
    for (const FaceRegion& r : d->region)
      labels.insert(labels.end(), r.labels.begin(), r.labels.end());
  for (const auto t : cell.triangles) labels.push_back(geometry_.index().face(t));
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  const Box3& box = result_.node[cell.node].box;
  const auto groups = engines_.production().tie_groups(labels, box.lo, box.hi);
  if (groups.size() < 4) return false;
  const CommonPoint c = common_point(geometry_, groups, box.lo, box.hi);
  // Four feet that span space: an ordinary junction, and the cell holds something beside it.
  return c.gap <= kCommonTolerance && (groups.size() > 4 || !feet_span(geometry_, groups, c.point));
}

bool Subdivider::connected_at(std::uint32_t vertex) {
  const auto [it, fresh] = connected_.try_emplace(vertex, false);
  if (!fresh) return it->second;
  // A cell about the vertex, so small that Theorem B holds in it (which is checked below: all
  // candidates and triangles that meet it are incident to the vertex): there the axis is a cone.
  const Point3& p = solid_.point[vertex];
  double reach = root_diameter_;
  for (std::uint32_t t = 0; t < solid_.triangle.size(); ++t) {
    const auto& tv = solid_.triangle[t].vertex;
    const auto at = std::find(tv.begin(), tv.end(), vertex);
    if (at == tv.end()) {
      reach = std::min(reach, distance_estimate(geometry_, geometry_.index().face(t), p));
      continue;
    }
    const auto opposite =
        solid_.triangle[t].edge[(static_cast<std::size_t>(at - tv.begin()) + 1) % 3];
    reach = std::min(reach, distance_estimate(geometry_, geometry_.index().edge(opposite), p));
  }
  const auto incident = [&](SiteId s) {
    int count = 0;
    const auto corner = geometry_.corners(s, count);
    return std::find(corner.begin(), corner.begin() + count, vertex) != corner.begin() + count;
  };
  const auto at_vertex = solid_.triangles_at(vertex);
  std::vector<std::uint32_t> all(solid_.triangle.size());
  for (std::uint32_t t = 0; t < all.size(); ++t) all[t] = t;
  for (int attempt = 0; attempt < kPlaneAttempts; ++attempt, reach *= 0.25) {
    Box3 box;
    for (int k = 0; k < 3; ++k) {
      box.lo[k] = p[k] - reach * (0.25 + 0.25 * jitter(p[k], reach, k, 100 + attempt));
      box.hi[k] = p[k] + reach * (0.25 + 0.25 * jitter(p[k], reach, k, 200 + attempt));
      if (!(box.lo[k] < p[k] && p[k] < box.hi[k])) return false;  // beyond double resolution
    }
    const auto triangles = meeting(all, box);
    if (!std::ranges::all_of(triangles, [&](std::uint32_t t) {
          return std::find(at_vertex.begin(), at_vertex.end(), t) != at_vertex.end();
        }))
      continue;
    const auto star = engines_.production().prune(geometry_.candidates(), box.lo, box.hi);
    if (!std::ranges::all_of(star, incident)) continue;
    std::array<std::shared_ptr<const FaceDiagram>, 6> face;
    bool decided = true;
    for (int f = 0; f < 6 && decided; ++f) {
      face[f] = engines_.cache().face(solid_, box_face(box, f), star, triangles);
      decided = face[f]->status == FaceStatus::kDecided;
    }
    if (!decided) continue;
    it->second = graph_components(face) <= 1;
    return it->second;
  }
  return false;
}

void Subdivider::close(const Cell& cell, Leaf leaf) {
  CellNode& node = result_.node[cell.node];
  leaf.box = node.box;
  node.leaf = static_cast<std::uint32_t>(result_.leaf.size());
  double volume = 1;
  for (int k = 0; k < 3; ++k) volume *= node.box.hi[k] - node.box.lo[k];
  done_ += volume / root_volume_;
  result_.stats.max_depth = std::max(result_.stats.max_depth, static_cast<int>(node.depth));
  result_.leaf.push_back(std::move(leaf));
}

bool Subdivider::split(Cell& cell, bool validate) {
  const CellNode node = result_.node[cell.node];
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (node.box.hi[k] - node.box.lo[k] > node.box.hi[axis] - node.box.lo[axis]) axis = k;
  const double lo = node.box.lo[axis], hi = node.box.hi[axis];
  std::shared_ptr<const FaceDiagram> section;
  for (int attempt = 0; attempt < kPlaneAttempts; ++attempt) {
    const double m = lo + (hi - lo) * (0.42 + 0.16 * jitter(lo, hi, axis, attempt));
    if (!(m > lo && m < hi)) return false;
    if (validate) {
      Rect r = box_face(node.box, 2 * axis);
      r.level = m;
      section = engines_.cache().face(solid_, r, cell.candidates, cell.triangles);
      if (section->status != FaceStatus::kDecided) {
        ++result_.stats.planes_moved;
        continue;
      }
    }
    const auto child = static_cast<std::uint32_t>(result_.node.size());
    result_.node[cell.node].axis = static_cast<std::int8_t>(axis);
    result_.node[cell.node].cut = m;
    result_.node[cell.node].child = child;
    for (int c = 0; c < 2; ++c) {
      CellNode n;
      n.box = node.box;
      (c == 0 ? n.box.hi : n.box.lo)[axis] = m;
      n.depth = static_cast<std::uint16_t>(node.depth + 1);
      result_.node.push_back(n);
    }
    // The high child is pushed first, so the low one is worked on first.
    stack_.push_back({child + 1, cell.candidates, cell.triangles, section});
    stack_.push_back({child, std::move(cell.candidates), std::move(cell.triangles), section});
    return true;
  }
  return false;
}

Result<Subdivision> Subdivider::run() {
  const auto start = std::chrono::steady_clock::now();
  CellNode root;
  root.box = root_box();
  root_volume_ = 1;
  root_diameter_ = 0;
  for (int k = 0; k < 3; ++k) {
    root_volume_ *= root.box.hi[k] - root.box.lo[k];
    root_diameter_ = std::max(root_diameter_, root.box.hi[k] - root.box.lo[k]);
  }
  result_.node.push_back(root);
  std::vector<std::uint32_t> all(solid_.triangle.size());
  for (std::uint32_t t = 0; t < all.size(); ++t) all[t] = t;
  stack_.push_back({0, {geometry_.candidates().begin(), geometry_.candidates().end()}, all, {}});

  std::size_t steps = 0;
  while (!stack_.empty()) {
    Cell cell = std::move(stack_.back());
    stack_.pop_back();
    const CellNode node = result_.node[cell.node];
    const auto undecided = [&](UndecidedReason reason) {
      Leaf leaf;
      leaf.theorem = LeafTheorem::kUndecided;
      leaf.reason = reason;
      close(cell, std::move(leaf));
    };
    if ((++steps & 7u) == 0 || options_.time_limit_s > 0) {
      const double elapsed =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      if (options_.on_progress && !options_.on_progress({result_.leaf.size(), done_}))
        return Error{ErrorCode::kInterrupted, "interrupted during subdivision", "", {}};
      if (options_.time_limit_s > 0 && elapsed > options_.time_limit_s) {
        undecided(UndecidedReason::kTime);
        for (const Cell& c : stack_) {
          Leaf leaf;
          leaf.reason = UndecidedReason::kTime;
          close(c, std::move(leaf));
        }
        stack_.clear();
        break;
      }
    }
    cell.triangles = meeting(cell.triangles, node.box);
    if (cell.triangles.empty() &&
        engines_.inside().locate(node.box.lo) == InsideOracle::Where::kOutside) {
      Leaf leaf;
      leaf.theorem = LeafTheorem::kOutside;
      close(cell, std::move(leaf));
      continue;
    }
    cell.candidates = engines_.production().prune(cell.candidates, node.box.lo, node.box.hi,
                                                  options_.distance_hint);
    const bool small = cell.candidates.size() <= kMaxCandidates;
    if (small) {
      const auto answer = test(cell);
      const Box3 model{solid_.frame.to_model(node.box.lo), solid_.frame.to_model(node.box.hi)};
      const bool fine = options_.max_leaf_diameter <= 0 || !answer || !answer->has_axis ||
                        std::hypot(model.hi.x - model.lo.x, model.hi.y - model.lo.y,
                                   model.hi.z - model.lo.z) <= options_.max_leaf_diameter;
      if (fine && answer && answer->verdict == CellVerdict::kAccepted) {
        Leaf leaf;
        leaf.theorem = answer->conical ? LeafTheorem::kConical : LeafTheorem::kBoundary;
        leaf.boundary_vertex = answer->vertex;
        leaf.has_axis = answer->has_axis;
        leaf.candidates = cell.candidates;
        leaf.triangles = cell.triangles;
        close(cell, std::move(leaf));
        continue;
      }
    }
    if (node.depth >= options_.max_depth) {
      undecided(UndecidedReason::kDepth);
      continue;
    }
    if (result_.node.size() + 2 > options_.max_cells) {
      undecided(UndecidedReason::kCells);
      continue;
    }
    if (split(cell, small)) continue;
    // No plane here could be decided: smaller cells keep the trouble to where it is, until little
    // else is left in them.
    if (cell.candidates.size() > kIsolated && split(cell, false)) continue;
    undecided(UndecidedReason::kFaceUndecided);
  }
  result_.stats.stages = engines_.production().predicates().stages();
  result_.stats.faces_computed = engines_.cache().faces_computed();
  return std::move(result_);
}

}  // namespace

Result<Subdivision> subdivide(const SiteGeometry& geometry, const SubdivisionOptions& options,
                              EngineSet& engines) {
  return Subdivider(geometry, options, engines).run();
}

}  // namespace blum
