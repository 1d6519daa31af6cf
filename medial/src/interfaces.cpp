#include "interfaces.hpp"

#include <algorithm>

#include "blum/kernel/parallel.hpp"
#include "blum/subdivision/cell_test.hpp"

namespace blum {
namespace {

Placed place(Locator& locator, const Rect& rect, const FaceNode& node,
             std::span<const SiteId> candidates) {
  switch (node.kind) {
    case FaceNode::Kind::kSide:
      break;  // a tie on an edge, which other interfaces have too
    case FaceNode::Kind::kEvent:
      return locator.event(rect, node, candidates);
    case FaceNode::Kind::kRim:
      return locator.rim(rect, node, candidates);
    case FaceNode::Kind::kConvexEdge:
      return locator.convex_edge(rect, node);
  }
  return {};
}

}  // namespace

bool is_accepted(const Leaf& leaf) {
  return leaf.theorem == LeafTheorem::kConical || leaf.theorem == LeafTheorem::kBoundary ||
         leaf.theorem == LeafTheorem::kVoronoi;
}

void Interfaces::solve() {
  dropped_.assign(in_.subdivision.leaf.size(), false);
  for (const auto step : {&Interfaces::pair_cells, &Interfaces::solve_diagrams,
                          &Interfaces::cut_lines, &Interfaces::solve_ties})
    if (!in_.stopped()) (this->*step)();
}

LocalDiagrams Interfaces::diagrams_in(const Leaf& leaf, int thread) const {
  // In a Voronoi diagram the boundary is no border.
  const auto triangles = in_.medial() ? std::span<const std::uint32_t>(leaf.triangles)
                                      : std::span<const std::uint32_t>();
  return {in_.engines.diagrams(in_.first_thread + thread), in_.solid(), leaf.candidates, triangles};
}

const Leaf& Interfaces::donor(const Interface& i) const {
  if (i.low == Interface::kNone || i.high == Interface::kNone)
    return in_.leaf(std::min(i.low, i.high));
  // Candidates of either side are complete on the common face; the shorter list is cheaper.
  const Leaf &a = in_.leaf(i.low), &b = in_.leaf(i.high);
  return a.candidates.size() <= b.candidates.size() ? a : b;
}

void Interfaces::pair_cells() {
  std::vector<std::uint32_t> stack{0};
  while (!stack.empty() && !in_.stopped()) {
    const CellNode& node = in_.subdivision.node[stack.back()];
    stack.pop_back();
    if (node.axis < 0) continue;
    const int a = node.axis, u = u_axis(a), v = v_axis(a);
    pair_faces(node.child, node.child + 1,
               {a, node.cut, node.box.lo[u], node.box.hi[u], node.box.lo[v], node.box.hi[v]});
    stack.push_back(node.child);
    stack.push_back(node.child + 1);
  }
  // Sheets of a Voronoi diagram end on the box around all, outside the solid.
  if (in_.alone || (!in_.medial() && !(in_.one_sided() && in_.inside_wanted())))
    for (int f = 0; f < 6; ++f) border_faces(0, f);
}

void Interfaces::border_faces(std::uint32_t index, int face) {
  const CellNode& node = in_.subdivision.node[index];
  if (node.axis >= 0) {
    const bool low = face % 2 == 0, along = node.axis == face / 2;
    if (!along || low) border_faces(node.child, face);
    if (!along || !low) border_faces(node.child + 1, face);
    return;
  }
  if (!is_accepted(in_.leaf(node.leaf))) return;
  const Rect rect = box_face(node.box, face);
  interface_.push_back(face % 2 == 0 ? Interface{Interface::kNone, node.leaf, rect}
                                     : Interface{node.leaf, Interface::kNone, rect});
}

void Interfaces::pair_faces(std::uint32_t low, std::uint32_t high, const Rect& rect) {
  const CellNode &l = in_.subdivision.node[low], &h = in_.subdivision.node[high];
  if (l.axis < 0 && h.axis < 0) {
    if (is_accepted(in_.leaf(l.leaf)) && is_accepted(in_.leaf(h.leaf)))
      interface_.push_back({l.leaf, h.leaf, rect});
    return;
  }
  const bool split_low = l.axis >= 0;
  const CellNode& node = split_low ? l : h;
  const auto recurse = [&](std::uint32_t child, const Rect& part) {
    if (split_low)
      pair_faces(child, high, part);
    else
      pair_faces(low, child, part);
  };
  if (node.axis == rect.axis) {
    recurse(split_low ? node.child + 1 : node.child, rect);
    return;
  }
  const bool along_u = node.axis == u_axis(rect.axis);
  Rect first = rect, second = rect;
  (along_u ? first.u1 : first.v1) = std::min(along_u ? rect.u1 : rect.v1, node.cut);
  (along_u ? second.u0 : second.v0) = std::max(along_u ? rect.u0 : rect.v0, node.cut);
  if (first.u0 < first.u1 && first.v0 < first.v1) recurse(node.child, first);
  if (second.u0 < second.u1 && second.v0 < second.v1) recurse(node.child + 1, second);
}

void Interfaces::solve_diagrams() {
  for_each_in_parallel(in_.threads, interface_.size(), [this](int thread, std::size_t k) {
    Interface& i = interface_[k];
    if (!in_.stopped()) solve_diagram(i, thread);
  });
  for (const Interface& i : interface_)
    if (!i.decided()) drop(i);
}

void Interfaces::solve_diagram(Interface& i, int thread) {
  // Nearly every interface is a face of one of its leaves.
  const auto side = static_cast<std::size_t>(2 * i.rect.axis);
  const auto face_of = [&](std::uint32_t leaf, std::size_t f) {
    return leaf == Interface::kNone ? nullptr : in_.leaf(leaf).face[f];
  };
  const auto low = face_of(i.low, side + 1), high = face_of(i.high, side);
  if (low && low->rect == i.rect) {
    i.diagram = low;
  } else if (high && high->rect == i.rect) {
    i.diagram = high;
  } else {
    const Leaf& leaf = donor(i);
    LocalDiagrams diagrams = diagrams_in(leaf, thread);
    // The other leaf's reaches beyond what the candidates are complete on.
    if (const auto& whole = i.low != Interface::kNone && &leaf == &in_.leaf(i.low) ? low : high)
      diagrams.inherit(whole);
    i.diagram = diagrams.face(i.rect);
  }
  if (!i.decided()) return;
  Locator locator = in_.locator(thread);
  for (const FaceNode& node : i.diagram->node)
    i.placed.push_back(place(locator, i.rect, node, donor(i).candidates));
  if (in_.one_sided()) tell_sides(i, thread);
}

void Interfaces::tell_sides(Interface& i, int thread) {
  bool crossed = true;  // by the boundary, perhaps
  i.for_each_leaf([&](std::uint32_t leaf) { crossed &= !in_.leaf(leaf).triangles.empty(); });
  if (!crossed) {
    i.sides.inside.assign(i.diagram->arc.size(), {in_.inside_wanted(), in_.inside_wanted()});
    return;
  }
  i.sides = sided_face(in_.engines.production(in_.first_thread + thread).predicates(),
                       in_.engines.inside(), *i.diagram, donor(i).triangles);
  i.told = i.sides.decided;
  if (!i.told) return;
  const Locator locator = in_.locator(thread);
  for (const SidedFace::Crossing& c : i.sides.crossing) {
    FaceNode node;
    node.boundary_edge = c.edge;
    if (c.node != SidedFace::kNone)
      node.governors = i.diagram->node[c.node].governors;
    else
      for (const auto t : in_.solid().edge[c.edge].triangle)
        node.governors.push_back(in_.geometry.index().face(t));
    std::ranges::sort(node.governors);
    i.crossing.push_back(locator.convex_edge(i.rect, node));
  }
}

void Interfaces::drop(const Interface& interface) {
  interface.for_each_leaf([&](std::uint32_t leaf) { dropped_[leaf] = true; });
}

void Interfaces::cut_lines() {
  for (const Interface& i : interface_) {
    if (in_.stopped()) return;
    for (int s = 0; s < 4; ++s) {
      const Segment e = side_segment(i.rect, s);
      auto& points = line_[{e.axis, e.u, e.v}];
      points.push_back(e.t0);
      points.push_back(e.t1);
    }
  }
  for (auto& [key, points] : line_) {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
  }
}

void Interfaces::solve_ties() {
  for (const Interface& i : interface_)
    if (i.decided())
      for_each_part(i, [&](int, const Segment& part) {
        const auto [slot, fresh] =
            tie_of_.try_emplace(key_of(part), static_cast<std::uint32_t>(tie_.size()));
        if (fresh) tie_.push_back({part, &i, false, {}});
      });
  for_each_in_parallel(in_.threads, tie_.size(), [this](int thread, std::size_t k) {
    if (!in_.stopped()) solve_ties_on(tie_[k], thread);
  });
  // What is dropped changes no other interface, so one pass is enough.
  for (const Interface& i : interface_)
    if (i.decided())
      for_each_part(i, [&](int, const Segment& part) {
        if (!tie_[number_of(part)].decided) drop(i);
      });
}

void Interfaces::solve_ties_on(EdgeTies& ties, int thread) {
  const Leaf& leaf = donor(*ties.asker);
  LocalDiagrams diagrams = diagrams_in(leaf, thread);
  diagrams.adopt(ties.asker->diagram);
  const SegmentAnswer a = diagrams.segment(ties.part);
  ties.decided = a.status == FaceStatus::kDecided;
  if (!ties.decided) return;
  Locator locator = in_.locator(thread);
  for (const Breakpoint& b : a.diagram->breakpoint)
    if (b.kind == Breakpoint::Kind::kTie)
      ties.placed.push_back(locator.tie(ties.part, b, leaf.candidates));
}

}  // namespace blum
