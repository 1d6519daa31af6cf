#include "part_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <span>

namespace blum {
namespace {

/// Bisections stop at boxes of this size (working units): Newton's method and the exact tests at
/// points have done all they can long before.
constexpr double kSmallest = 1e-9;
constexpr int kMeetingRounds = 16;  // bisections along each axis
constexpr std::size_t kMostMeetingBoxes = 256;
constexpr double kSmall = 1e-3;  // a box that should tell, as part of its leaf
constexpr double kTiny = 1e-4;   // one that tells that its leaf is too coarse
constexpr int kShrinkings = 20;  // of a box about a vertex
/// Boxes are not cut in the middle, where symmetric models have their symmetries.
constexpr double kCut = 0.4878;
constexpr int kPatience = 12;  // boxes without a better witness after which it is seldom looked for
constexpr int kHope = 400;     // the same where nothing but a witness can help

constexpr double kLength = 1.0 / 32;  // so slim may boxes be

BoxChange largest_change(const SiteGeometry& geometry, const AngleBox& box) {
  std::array<double, 3> square;  // of the change, by the box's length
  square.fill(kLength * kLength);
  for (const SiteId s : box.candidates) {
    const SiteKind kind = geometry.index().kind(s);
    for (int k = 0; k < 3; ++k) {
      const double u = kind == SiteKind::kVertex ? 0 : geometry.unit(s)[k].mid;
      square[k] = std::max(square[k], kind == SiteKind::kFace ? u * u : 1 - u * u);
    }
  }
  BoxChange largest;
  for (int k = 0; k < 3; ++k) {
    const double change = std::sqrt(square[k]) * (box.box.hi[k] - box.box.lo[k]);
    if (change > largest.most) largest = {k, change};
  }
  return largest;
}

/// The facets of a box that do not hold v.
std::vector<Box3> facets_away_from(const Box3& box, const Point3& v) {
  std::vector<Box3> facets;
  for (int k = 0; k < 3; ++k) {
    if (box.lo[k] == box.hi[k]) continue;
    for (const double level : {box.lo[k], box.hi[k]}) {
      if (level == v[k]) continue;
      facets.push_back(box);
      facets.back().lo[k] = facets.back().hi[k] = level;
    }
  }
  return facets;
}

/// The vertex of the boundary that lies in the box and that all candidates have, if there is one:
/// the axis in the box is then a cone about it (Theorem B), and so are the angles.
std::optional<std::uint32_t> common_vertex(const SiteGeometry& geometry, const AngleBox& box) {
  if (box.candidates.empty()) return std::nullopt;
  int count = 0;
  const auto corner = geometry.corners(box.candidates.front(), count);
  for (int k = 0; k < count; ++k) {
    const auto v = corner[static_cast<std::size_t>(k)];
    const Point3& p = geometry.solid().point[v];
    bool good = true;
    for (int i = 0; i < 3; ++i) good &= p[i] >= box.box.lo[i] && p[i] <= box.box.hi[i];
    for (const SiteId s : box.candidates) good = good && geometry.has_corner(s, v);
    if (good) return v;
  }
  return std::nullopt;
}

double cut_of(const Box3& box, int axis) {
  return box.lo[axis] + kCut * (box.hi[axis] - box.lo[axis]);
}

}  // namespace

void PartBound::add(std::uint32_t task, Box3 box, const std::vector<SiteId>& candidates) {
  ++boxes_;
  Item item;
  item.task = task;
  item.box.box = box;
  if (!stop_) item.box.candidates = tools_.engine.prune(candidates, box.lo, box.hi);
  item.change = largest_change(geometry_, item.box);
  const AngleTask& t = tasks_[task];
  item.bound = stop_ ? AngleBound{kPi, {}, {}}
                     : bound_in_box(geometry_, tools_.pairs, leaves_[t.leaf], t.role, item.box);
  if (!(item.bound.hi > lo_)) return;
  heap_.push_back(std::move(item));
  std::push_heap(heap_.begin(), heap_.end());
}

void PartBound::add_root(std::uint32_t task) {
  const LeafParts& parts = leaves_[tasks_[task].leaf];
  const Leaf& leaf = subdivision_.leaf[parts.leaf];
  if (!parts.conical) {
    add(task, leaf.box, leaf.candidates);
    return;
  }
  // A cone: every angle in the leaf is one on its surface.
  for (const Box3& facet :
       facets_away_from(leaf.box, geometry_.solid().point[leaf.boundary_vertex]))
    add(task, facet, leaf.candidates);
}

bool PartBound::settles(const Item& item, bool can_be_cut) {
  if (!can_be_cut) {
    stuck_ = std::max(stuck_, item.bound.hi);
    return true;
  }
  if (for_coarse_ && size(item) < kTiny) is_coarse_[item.task] = true;
  return is_coarse_[item.task];
}

bool PartBound::is_open() const {
  return top() > lo_ + tolerance_ && (top() > stuck_ || idle_ < kHope);
}

void PartBound::divide(const Item& item) {
  const Box3& box = item.box.box;
  bool solid_box = true;
  for (int k = 0; k < 3; ++k) solid_box &= box.hi[k] > box.lo[k];
  if (solid_box)
    if (const auto v = common_vertex(geometry_, item.box)) {
      for (const Box3& facet : facets_away_from(box, geometry_.solid().point[*v]))
        add(item.task, facet, item.box.candidates);
      return;
    }
  const int axis = item.change.axis;
  const double cut = cut_of(box, axis);
  if (settles(item, cut > box.lo[axis] && cut < box.hi[axis] &&
                        box.hi[axis] - box.lo[axis] >= kSmallest)) {
    settled_.push_back(item);
    return;
  }
  Box3 low = box, high = box;
  low.hi[axis] = high.lo[axis] = cut;
  add(item.task, low, item.box.candidates);
  add(item.task, high, item.box.candidates);
}

void PartBound::seek(std::uint32_t task, const AngleBox& within, const Box3& search,
                     const AngleBound& top) {
  const AngleTask& t = tasks_[task];
  const LeafParts& parts = leaves_[t.leaf];
  std::optional<double> found;
  const auto on_sheet = [&](const AngleRole& role) {
    found = tools_.witness.on_sheet(parts, role, within, center_of(search), top.a, top.b);
  };
  if (t.role.kind == AngleRole::Kind::kArc) {
    on_sheet(t.role);
  } else if (t.role.kind == AngleRole::Kind::kSeam) {
    const GroupSet g = parts.groups.of(top.a), h = parts.groups.of(top.b);
    if (seam_counts_pair(parts, t.role, g, h)) on_sheet({AngleRole::Kind::kArc, g, h});
    if (!found) found = tools_.witness.on_seam(parts, t.role, within, search);
  }
  if (found && *found > lo_) {
    lo_ = *found;
    idle_ = 0;
  }
}

/// In the boxes there is a point with feet in `count` of the groups, in all of `must`: it is in one
/// of the parts that may hold such points, of which few are left when they are small.
void PartBound::find_meeting(const AngleTask& task, std::vector<AngleBox> boxes, GroupSet groups,
                             GroupSet must, int count) {
  const LeafParts& parts = leaves_[task.leaf];
  for (int round = 0; round < 3 * kMeetingRounds && !stop_; ++round) {
    std::vector<AngleBox> halves;
    double least = kPi, most = 0;
    for (const AngleBox& b : boxes) {
      const int axis = largest_change(geometry_, b).axis;
      const double cut = cut_of(b.box, axis);
      for (const bool high : {false, true}) {
        AngleBox half = b;
        (high ? half.box.lo : half.box.hi)[axis] = cut;
        half.candidates = tools_.engine.prune(b.candidates, half.box.lo, half.box.hi);
        ++boxes_;
        const auto at_least = least_where_groups_meet(geometry_, parts, half, groups, must, count);
        if (!at_least) continue;
        least = std::min(least, *at_least);
        most = std::max(most, bound_in_box(geometry_, tools_.pairs, parts, task.role, half).hi);
        halves.push_back(std::move(half));
      }
    }
    if (halves.empty() || halves.size() > kMostMeetingBoxes) return;
    boxes = std::move(halves);
    lo_ = std::max(lo_, least);
    if (most <= lo_ + 0.5 * tolerance_) return;
  }
}

/// In a leaf with the shape of a junction there is a point with feet in all four groups: the closed
/// pieces of the leaf cover it, and on its surface they lie as the stars of a tetrahedron's corners
/// do, so they have a common point (the lemma of Knaster, Kuratowski and Mazurkiewicz).
void PartBound::find_junction() {
  if (tasks_.size() != 1 || !leaves_[tasks_[0].leaf].junction) return;
  if (tasks_[0].role.kind != AngleRole::Kind::kRest) return;
  const LeafParts& parts = leaves_[tasks_[0].leaf];
  const Leaf& leaf = subdivision_.leaf[parts.leaf];
  find_meeting(tasks_[0], {{leaf.box, leaf.candidates}}, parts.groups.all(), 0, 4);
}

/// The surface of a box about a vertex of the solid, so small that all candidates have it: there
/// the axis is a cone about it (Theorem B). Empty: none was found.
std::vector<AngleBox> PartBound::around(std::uint32_t vertex, const Leaf& leaf) {
  const Point3& v = geometry_.solid().point[vertex];
  double reach = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k)
    reach = std::min({reach, 0.5 * (v[k] - leaf.box.lo[k]), 0.5 * (leaf.box.hi[k] - v[k])});
  for (int round = 0; round < kShrinkings; ++round, reach *= 0.5) {
    Box3 box;
    for (int k = 0; k < 3; ++k) {
      box.lo[k] = v[k] - reach;
      box.hi[k] = v[k] + reach;
    }
    const auto near = tools_.engine.prune(leaf.candidates, box.lo, box.hi);
    if (!std::ranges::all_of(near, [&](SiteId s) { return geometry_.has_corner(s, vertex); }))
      continue;
    std::vector<AngleBox> surface;
    for (const Box3& facet : facets_away_from(box, v)) surface.push_back({facet, near});
    return surface;
  }
  return {};
}

/// Where seams cross a face of their leaf, or begin at a vertex of the solid: the node stands for a
/// tree whose ends are its arcs, so each arc ends in a point with feet on both of its sides and in
/// a third group. About a vertex: the arc that begins on a convex edge cannot end on another, which
/// would be between the same two groups.
void PartBound::find_nodes() {
  for (const AngleTask& t : tasks_) {
    if (t.role.kind != AngleRole::Kind::kSeam || !t.role.distinct) continue;
    const Leaf& leaf = subdivision_.leaf[leaves_[t.leaf].leaf];
    for (const LeafParts::Node& node : leaves_[t.leaf].node) {
      if ((node.groups & ~t.role.a) != 0 || !(top() > lo_ + tolerance_)) continue;
      const std::vector<AngleBox> boxes = node.vertex == LeafParts::kNone
                                              ? std::vector<AngleBox>{{node.box, leaf.candidates}}
                                              : around(node.vertex, leaf);
      for (const GroupSet sides : node.arc)
        if (top() > lo_ + tolerance_) find_meeting(t, boxes, node.groups, sides, 3);
    }
  }
}

AngleInterval PartBound::run(const std::vector<AngleStart>& starts) {
  for (std::uint32_t t = 0; t < tasks_.size(); ++t) add_root(t);
  for (const AngleStart& s : starts) {
    if (top() <= lo_ + tolerance_ || stop_) break;
    const AngleTask& t = tasks_[s.task];
    const Leaf& leaf = subdivision_.leaf[leaves_[t.leaf].leaf];
    Box3 search = leaf.box;
    for (int k = 0; k < 3; ++k) {
      search.lo[k] = std::clamp(s.x[k] - s.reach, leaf.box.lo[k], leaf.box.hi[k]);
      search.hi[k] = std::clamp(s.x[k] + s.reach, leaf.box.lo[k], leaf.box.hi[k]);
    }
    seek(s.task, {leaf.box, leaf.candidates}, search, {0, s.a, s.b});
  }
  find_junction();
  find_nodes();
  while (is_open() && boxes_ < budget_ && !stop_) {
    std::pop_heap(heap_.begin(), heap_.end());
    const Item item = std::move(heap_.back());
    heap_.pop_back();
    if (!(item.bound.hi > lo_)) continue;
    ++idle_;
    if (idle_ < kPatience || idle_ % kPatience == 0)
      seek(item.task, item.box, item.box.box, item.bound);
    divide(item);
  }
  double hi = top();
  for (const Item& item : settled_) hi = std::max(hi, item.bound.hi);
  // The conversion errs by less than 4 ulp of 180.
  return {std::max(0.0, lo_ * kDegreesARadian - 1e-12),
          std::min(180.0, hi * kDegreesARadian + 1e-12)};
}

std::vector<std::uint32_t> PartBound::coarse_tasks() const {
  std::set<std::uint32_t> tasks;
  const auto add = [&](std::span<const Item> items) {
    for (const Item& item : items)
      if (item.bound.hi > lo_ + tolerance_ && size(item) < kSmall) tasks.insert(item.task);
  };
  add(settled_);
  // Of a whole look boxes are left where bounds come slowly, too, and finer leaves are no help.
  if (for_coarse_) add(heap_);
  return {tasks.begin(), tasks.end()};
}

}  // namespace blum
