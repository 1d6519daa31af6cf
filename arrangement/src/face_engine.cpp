#include "face_engine.hpp"

#include <algorithm>

#include "blum/arrangement/common_point.hpp"

namespace blum {
namespace {

constexpr int kMaxDepth = 90;
/// A part that lost no candidate in so many bisections is asked of exact algebra, once: an event in
/// general position has passed long before.
constexpr int kStuck = 44;
/// A part of very many groups is compared pair by pair only every so many bisections that lost none
/// of its candidates.
constexpr int kPatience = 4;
constexpr std::size_t kMaxStuck = 512;
/// Most parts that bounds decide at all are decided before they lost no candidate so often.
constexpr int kHardened = 16;
constexpr std::uint32_t kMaxExactParts = 64;
/// A face in general position needs some ten boxes an event: this many say that a seam runs along
/// the plane so near that moving the plane is better.
constexpr std::uint32_t kMaxBoxes = 50'000;

}  // namespace

Range FaceEngine::range_of(const Box& box) const {
  const Rect& r = problem_.rect;
  return Range::of(point_on(r.axis, r.level, box.u0, box.v0),
                   point_on(r.axis, r.level, box.u1, box.v1));
}

FaceEngine::Line FaceEngine::make_line(const SegmentDiagram& diagram) {
  Line line;
  line.segment = diagram.segment;
  for (const Breakpoint& b : diagram.breakpoint) line.brk.push_back({b, 0});
  for (const auto& i : diagram.interval) {
    line.piece.push_back({i.inside, i.witness, new_element()});
  }
  return line;
}

std::uint32_t FaceEngine::new_element() {
  component_.add();
  element_label_.emplace_back();
  return region_.add();
}

std::uint32_t FaceEngine::trace_element(std::uint32_t triangle) {
  const auto [it, fresh] = trace_element_.try_emplace(triangle, 0u);
  if (fresh) it->second = new_element();
  return it->second;
}

std::uint32_t FaceEngine::new_node(FaceNode::Kind kind, const Box& box) {
  Node n;
  n.node.kind = kind;
  n.node.u0 = box.u0;
  n.node.u1 = box.u1;
  n.node.v0 = box.v0;
  n.node.v1 = box.v1;
  nodes_.push_back(std::move(n));
  return static_cast<std::uint32_t>(nodes_.size() - 1);
}

std::uint32_t FaceEngine::convex_node(std::uint32_t edge) {
  const auto [it, fresh] = convex_node_.try_emplace(edge, 0u);
  if (fresh) {
    for (const TracePoint& p : trace_point_)
      if (p.edge == edge)
        it->second = new_node(FaceNode::Kind::kConvexEdge,
                              Box{p.u.low(), p.u.high(), p.v.low(), p.v.high(), {}, {}, {}, 0});
    FaceNode& n = nodes_[it->second].node;
    n.boundary_edge = edge;
    for (const auto t : context_.geometry.solid().edge[edge].triangle)
      n.governors.push_back(context_.geometry.index().face(t));
    std::sort(n.governors.begin(), n.governors.end());
  }
  return it->second;
}

void FaceEngine::add_arc(std::uint32_t from, std::uint32_t to, SiteId left, SiteId right,
                         std::array<std::uint32_t, 2> beside) {
  const auto id = static_cast<std::uint32_t>(arcs_.size());
  arcs_.push_back({from, to, left, right, beside});
  nodes_[from].arc.push_back(id);
  nodes_[to].arc.push_back(id);
}

void FaceEngine::label_element(std::uint32_t element, std::span<const SiteId> labels) {
  auto& l = element_label_[element];
  l.insert(l.end(), labels.begin(), labels.end());
}

bool FaceEngine::accept(const Box& box, std::span<const LocalForm> forms, const Border& border) {
  if (!border.loop.empty()) return false;
  if (border.circle.empty()) {  // outside the solid
    note(PartRecord::Kind::kOutside, forms);
    return true;
  }
  const Groups ties = Groups::by_ties(context_, forms);
  const std::size_t max_groups = box.stuck % kPatience == kPatience - 1 ? kMaxStuck : kMaxGroups;
  if (ties.cliques && ties.count > max_groups) return false;
  const Range range = range_of(box);
  const Groups feet = Groups::by_feet(context_, forms, range);
  if (context_.slices_first && !context_.voronoi() && accept_slice(box, forms, feet, border))
    return true;
  if (context_.links_first && !context_.voronoi() && accept_cone(box, forms, feet, border))
    return true;
  Rivals rivals(context_, forms, range);
  if (ties.cliques && accept_star(box, forms, ties, feet, border, rivals)) return true;
  if (feet.cliques && feet.count <= max_groups && feet != ties &&
      accept_star(box, forms, feet, feet, border, rivals))
    return true;
  if (context_.voronoi())
    return accept_convex(box, forms, ties, border) || accept_vertex_link(box, forms, ties, border);
  return accept_cone(box, forms, feet, border) || accept_rim(box, forms, feet, border) ||
         (!context_.plain && box.stuck >= kHardened && accept_slice(box, forms, feet, border));
}

bool FaceEngine::accept_star(const Box& box, std::span<const LocalForm> forms, const Groups& groups,
                             const Groups& feet, const Border& border, Rivals& rivals) {
  std::vector<std::vector<std::uint32_t>> runs;
  bool repeated = false;
  for (const Circle& circle : border.circle) {
    auto run = runs_of(circle, forms, groups);
    if (!run) return false;
    std::vector<bool> seen(groups.count, false);
    for (const auto g : *run) {
      repeated |= seen[g];
      seen[g] = true;
    }
    runs.push_back(std::move(*run));
  }
  // A certificate tells events by their boxes: one a part.
  if (context_.plain &&
      std::count_if(runs.begin(), runs.end(), [](const auto& run) { return run.size() > 2; }) > 1)
    return false;
  Directions directions;
  if (!repeated && (groups.count == 1 || directions_exist(forms, groups, rivals, directions))) {
    for (std::size_t c = 0; c < border.circle.size(); ++c)
      if (runs[c].size() >= 4 && !may_be_cluster(box, forms, groups, border.circle[c]))
        return false;
    for (std::size_t c = 0; c < border.circle.size(); ++c)
      record(border.circle[c], forms, feet, box);
    note(&groups == &feet ? PartRecord::Kind::kFeet : PartRecord::Kind::kStar, forms, groups,
         directions);
    return true;
  }
  return accept_chords(box, border, runs, forms, groups, feet, rivals);
}

bool FaceEngine::may_be_cluster(const Box& box, std::span<const LocalForm> forms,
                                const Groups& groups, const Circle& circle) {
  return !context_.part_clusters || range_of(box).radius() <= ProductionEngine::kSmallestCluster ||
         meet_in_one_point(box, forms, groups, circle);
}

bool FaceEngine::meet_in_one_point(const Box& box, std::span<const LocalForm> forms,
                                   const Groups& groups, const Circle& circle) {
  std::vector<std::vector<SiteId>> sites(groups.count);
  for (const Step& s : circle)
    if (s.kind == Step::Kind::kInterval || s.kind == Step::Kind::kTrace) {
      const auto g = groups.find(forms, s.label);
      if (sites[g].empty()) sites[g] = groups.members(forms, g);
    }
  std::erase_if(sites, [](const auto& g) { return g.empty(); });
  const Rect& r = problem_.rect;
  return common_point(context_.geometry, sites, point_on(r.axis, r.level, box.u0, box.v0),
                      point_on(r.axis, r.level, box.u1, box.v1))
             .gap <= kCommonTolerance;
}

Trouble FaceEngine::refine(Box box) {
  ++context_.counts.boxes;
  if (context_.stopped()) return {FaceStatus::kUndecided, "stopped"};
  if (++boxes_ > kMaxBoxes) return {FaceStatus::kUndecided, "face: boxes spent"};
  std::vector<LocalForm> forms;
  prune(context_.geometry, box.candidates, range_of(box), forms, &context_);
  Border border = border_of(box);
  if (accept(box, forms, border)) return {};
  box.stuck = forms.size() < box.candidates.size() ? 0 : box.stuck + 1;
  if (box.stuck == kStuck) {
    if (++exact_parts_ > kMaxExactParts) return {FaceStatus::kUndecided, "face: exact parts spent"};
    if (accept_exact(box, forms, border)) return {};
  }
  if (box.depth >= kMaxDepth) return {FaceStatus::kUndecided, "face: depth spent"};
  box.candidates.clear();
  for (const LocalForm& f : forms) box.candidates.push_back(f.site);
  Box low, high;
  if (const Trouble t = split(box, low, high)) return t;
  if (context_.parts != nullptr) {
    const bool along_u = low.u1 < box.u1;
    note(along_u ? PartRecord::Kind::kCutU : PartRecord::Kind::kCutV, {});
    context_.parts->back().cut = along_u ? low.u1 : low.v1;
  }
  // A triangle stays with a part if its trace meets it: an end inside, or a crossing on its sides.
  for (Box* part : {&low, &high}) {
    part->candidates = box.candidates;
    part->stuck = box.stuck;
    for (const auto t : box.triangles) {
      const auto& ends = trace_.at(t);
      bool keep = in_box(trace_point_[ends[0]], *part) || in_box(trace_point_[ends[1]], *part);
      for (int s = 0; s < 4 && !keep; ++s)
        for (const Break& b : part->side[s].brk)
          keep |= b.point.kind == Breakpoint::Kind::kBoundary && b.point.triangle == t;
      if (keep) part->triangles.push_back(t);
    }
  }
  box = Box{};
  if (const Trouble t = refine(std::move(low))) return t;
  return refine(std::move(high));
}

FaceDiagram FaceEngine::solve(const std::array<std::shared_ptr<const SegmentDiagram>, 4>& side) {
  ++context_.counts.faces;
  const Rect& r = problem_.rect;
  u_ = u_axis(r.axis);
  v_ = v_axis(r.axis);
  Box root{r.u0, r.u1, r.v0, r.v1, {}, {}, {}, 0};
  root.candidates.assign(problem_.candidates.begin(), problem_.candidates.end());
  if (const Trouble t = find_traces(root)) {
    FaceDiagram d;
    d.status = t.status;
    d.reason = t.reason;
    d.rect = r;
    d.side = side;
    return d;
  }
  for (std::uint8_t s = 0; s < 4; ++s) {
    root.side[s] = make_line(*side[s]);
    for (std::uint32_t k = 0; k < root.side[s].brk.size(); ++k) {
      Break& b = root.side[s].brk[k];
      if (b.point.kind == Breakpoint::Kind::kBoundary) {
        b.id = crossings_++;
        continue;
      }
      Box where = Box{r.u0, r.u1, r.v0, r.v1, {}, {}, {}, 0};
      const bool along_u = s == kLowV || s == kHighV;
      const double fixed = s == kLowV ? r.v0 : s == kHighV ? r.v1 : s == kLowU ? r.u0 : r.u1;
      (along_u ? where.v0 : where.u0) = (along_u ? where.v1 : where.u1) = fixed;
      (along_u ? where.u0 : where.v0) = b.point.lo;
      (along_u ? where.u1 : where.v1) = b.point.hi;
      b.id = new_node(FaceNode::Kind::kSide, where);
      FaceNode& n = nodes_[b.id].node;
      n.side = s;
      n.breakpoint = k;
      n.governors = {std::min(b.point.below, b.point.above),
                     std::max(b.point.below, b.point.above)};
    }
  }
  // Triangles whose trace misses the rectangle only cost time.
  std::erase_if(root.triangles, [&](std::uint32_t t) {
    const auto& ends = trace_.at(t);
    if (in_box(trace_point_[ends[0]], root) || in_box(trace_point_[ends[1]], root)) return false;
    for (int s = 0; s < 4; ++s)
      for (const Break& b : root.side[s].brk)
        if (b.point.kind == Breakpoint::Kind::kBoundary && b.point.triangle == t) return false;
    return true;
  });
  Trouble trouble;
  if (problem_.whole == nullptr || !take_half(root)) trouble = refine(root);
  FaceDiagram d;
  if (trouble) {
    d.status = trouble.status;
    d.reason = trouble.reason;
    d.rect = r;
  } else {
    d = assemble(root);
  }
  d.side = side;
  return d;
}

}  // namespace blum
