// The last stage of the face engine: a part that interval bounds cannot decide, by exact algebra.
#include <algorithm>

#include "blum/arrangement/brute_engine.hpp"
#include "face_engine.hpp"

namespace blum {
namespace {

/// Exact algebra on more candidates takes seconds.
constexpr std::size_t kMaxExactCandidates = 12;

/// The node's box rounded outwards may leave the part that holds the node.
FaceNode within(FaceNode node, const Rect& part) {
  node.u0 = std::max(node.u0, part.u0);
  node.u1 = std::min(node.u1, part.u1);
  node.v0 = std::max(node.v0, part.v0);
  node.v1 = std::min(node.v1, part.v1);
  return node;
}

}  // namespace

bool FaceEngine::accept_exact(const Box& box, std::span<const LocalForm> forms,
                              const Border& border) {
  const bool interior = wholly_inside(border);
  if (forms.size() > kMaxExactCandidates || !(interior || context_.exact_affordable()))
    return false;
  std::vector<SiteId> sites;
  for (const LocalForm& f : forms) sites.push_back(f.site);
  std::sort(sites.begin(), sites.end());
  FaceProblem part = problem_;
  part.rect = {problem_.rect.axis, problem_.rect.level, box.u0, box.u1, box.v0, box.v1};
  part.candidates = sites;
  part.triangles = interior ? std::span<const std::uint32_t>{} : box.triangles;
  part.interior = interior;
  part.kind = context_.geometry.kind();
  const FaceDiagram d = brute_face(part);
  if (d.status != FaceStatus::kDecided) return false;
  ++context_.counts.exact_parts;

  // Its sides are the sides of the part: the same breakpoints in the same order.
  constexpr auto kNone = Breakpoint::kNone;
  std::vector<std::uint32_t> element(d.region.size(), kNone);
  for (int s = 0; s < 4; ++s) {
    const Line& line = box.side[s];
    const auto& exact = d.side[s]->breakpoint;
    if (exact.size() != line.brk.size()) return false;
    for (std::size_t k = 0; k < exact.size(); ++k)
      if (exact[k].kind != line.brk[k].point.kind ||
          (exact[k].kind == Breakpoint::Kind::kBoundary &&
           exact[k].triangle != line.brk[k].point.triangle))
        return false;
    for (std::size_t k = 0; k < line.piece.size(); ++k)
      if (line.piece[k].inside != (d.side_region[s][k] != FaceDiagram::kOutside)) return false;
  }
  std::vector<std::uint32_t> degree(d.node.size(), 0);
  for (const FaceArc& a : d.arc) {
    ++degree[a.from];
    ++degree[a.to];
    if (a.region[0] == FaceArc::kUnknown || a.region[1] == FaceArc::kUnknown) return false;
  }
  // A point where a sheet touches the plane: the plane has to be moved.
  if (std::find(degree.begin(), degree.end(), 0u) != degree.end()) return false;

  for (int s = 0; s < 4; ++s)
    for (std::size_t k = 0; k < box.side[s].piece.size(); ++k) {
      const auto r = d.side_region[s][k];
      if (r == FaceDiagram::kOutside) continue;
      const auto e = box.side[s].piece[k].element;
      if (element[r] == kNone) element[r] = e;
      region_.unite(element[r], e);
    }
  std::vector<std::uint32_t> of_piece(d.piece.size(), kNone);
  for (std::size_t r = 0; r < d.region.size(); ++r) {
    if (element[r] == kNone) element[r] = new_element();
    auto& first = of_piece[d.region[r].piece];
    if (first == kNone) first = element[r];
    component_.unite(first, element[r]);
    label_element(element[r], d.region[r].labels);
  }
  for (int s = 0; s < 4; ++s)  // all intervals of a region are in its piece
    for (std::size_t k = 0; k < box.side[s].piece.size(); ++k)
      if (d.side_region[s][k] != FaceDiagram::kOutside)
        component_.unite(element[d.side_region[s][k]], box.side[s].piece[k].element);
  for (const FaceTrace& t : d.trace) {
    const auto e = trace_element(t.triangle);
    region_.unite(element[t.region], e);
    component_.unite(element[t.region], e);
  }
  std::vector<std::uint32_t> node(d.node.size());
  for (std::size_t n = 0; n < d.node.size(); ++n) {
    const FaceNode& exact = d.node[n];
    switch (exact.kind) {
      case FaceNode::Kind::kSide:
        node[n] = box.side[exact.side].brk[exact.breakpoint].id;
        break;
      case FaceNode::Kind::kConvexEdge:
        node[n] = convex_node(exact.boundary_edge);
        break;
      case FaceNode::Kind::kEvent:
      case FaceNode::Kind::kRim:
        node[n] = new_node(exact.kind, box);
        nodes_[node[n]].node = within(exact, part.rect);
        break;
    }
    nodes_[node[n]].element = of_piece[exact.piece];
  }
  for (const FaceArc& a : d.arc)
    add_arc(node[a.from], node[a.to], a.left, a.right,
            {element[a.region[0]], element[a.region[1]]});
  note(PartRecord::Kind::kExact, forms);
  return true;
}

}  // namespace blum
