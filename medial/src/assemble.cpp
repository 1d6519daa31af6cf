#include "assemble.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>

#include "blum/kernel/check.hpp"
#include "blum/kernel/parallel.hpp"
#include "blum/kernel/union_find.hpp"
#include "blum/medial/leaf_complex.hpp"
#include "blum/subdivision/cell_test.hpp"
#include "blum/subdivision/local_diagrams.hpp"
#include "blum/subdivision/sided_face.hpp"
#include "leaf_surface.hpp"
#include "locate.hpp"

namespace blum {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

bool is_accepted(const Leaf& leaf) {
  return leaf.theorem == LeafTheorem::kConical || leaf.theorem == LeafTheorem::kBoundary ||
         leaf.theorem == LeafTheorem::kVoronoi;
}

class Assembler {
 public:
  Assembler(const SiteGeometry& geometry, const Subdivision& subdivision, EngineSet& engines)
      : geometry_(geometry),
        solid_(geometry.solid()),
        medial_(geometry.kind() == DiagramKind::kMedial),
        one_sided_(subdivision.side != VoronoiSide::kBoth),
        inside_wanted_(subdivision.side == VoronoiSide::kInside),
        subdivision_(subdivision),
        engines_(engines) {}
  /// Of a subdivision that is one leaf: its whole surface, by one thread.
  Assembler(const SiteGeometry& geometry, const Subdivision& leaf, EngineSet& engines, int thread)
      : Assembler(geometry, leaf, engines) {
    alone_ = true;
    first_thread_ = thread;
    threads_ = 1;
  }

  Assembly run();

 private:
  /// The common rectangle of two neighbouring leaves; or, Voronoi, a leaf's face on the box around
  /// all, with kNone beyond.
  struct Interface {
    std::uint32_t low, high;  // leaves
    Rect rect;
    std::shared_ptr<const FaceDiagram> diagram;  // null: the run was stopped before
    std::vector<Placed> placed;                  // the diagram's nodes, but those on its sides
    SidedFace sides{};                           // of one-sided diagrams
    std::vector<Placed> crossing{};              // their crossings
    bool told = true;                            // what lies on which side
    std::uint32_t first_edge = 0;                // of its arcs

    [[nodiscard]] bool decided() const {
      return told && diagram && diagram->status == FaceStatus::kDecided;
    }
  };
  /// A part of a cell edge with no end of an interface's side in its interior.
  struct EdgeTies {
    Segment part;
    const Interface* asker;  // the first interface beside it
    bool decided;
    std::vector<Placed> placed;
    std::vector<std::uint32_t> vertex;  // complex vertices in order
  };
  using LineKey = std::tuple<int, double, double>;
  struct LeafGraph {
    std::vector<std::uint32_t> arc;                                 // complex edges
    std::vector<std::uint32_t> interface;                           // of leaves with a tube
    std::vector<std::pair<std::uint32_t, std::uint32_t>> crossing;  // (boundary edge, vertex)
  };

  // The steps; each ends early when the run is stopped.
  void pair_cells();
  void solve_interfaces();
  void cut_lines();
  void solve_ties();
  void add_interfaces();
  void add_leaves();

  [[nodiscard]] bool stopped() { return engines_.watch().flag(); }
  void border_faces(std::uint32_t node, int face);
  void pair_faces(std::uint32_t low, std::uint32_t high, const Rect& rect);
  void solve_interface(Interface& interface, int thread);
  void tell_sides(Interface& interface, int thread);
  /// What the engines are told of the boundary: in a Voronoi diagram it is no border.
  [[nodiscard]] std::span<const std::uint32_t> border(const Leaf& leaf) const {
    return medial_ ? std::span<const std::uint32_t>(leaf.triangles)
                   : std::span<const std::uint32_t>();
  }
  [[nodiscard]] static Placed place(Locator& locator, const Rect& rect, const FaceNode& node,
                                    std::span<const SiteId> candidates);
  /// visit(side, part) for the parts of the four sides, in order along each.
  template <class Visit>
  void for_each_part(const Interface& interface, Visit visit) const;
  void solve_ties_on(EdgeTies& ties, int thread);
  void drop(const Interface& interface);
  void add_interface(Interface& interface);
  void add_leaf(std::uint32_t leaf);
  [[nodiscard]] std::optional<std::vector<Crossing>> tube_of(std::uint32_t leaf) const;
  /// The sheets in a leaf with a tube run around it: into a ring of three vertices, the first of
  /// which is the apex of `cone`. Requires: spokes to it from all vertices.
  void add_tube(std::uint32_t leaf, std::uint32_t cone, std::span<const Crossing> crossing,
                const std::map<std::uint32_t, std::uint32_t>& spoke);
  void drop_unused_vertices();
  std::uint32_t add_vertex(const Placed& placed, ComplexVertex::Kind kind);
  [[nodiscard]] const Leaf& donor(const Interface& i) const;
  [[nodiscard]] Locator locator_of(int thread) {
    return {geometry_, engines_.production(first_thread_ + thread), engines_.inside()};
  }

  const SiteGeometry& geometry_;
  const Solid& solid_;
  const bool medial_, one_sided_, inside_wanted_;
  const Subdivision& subdivision_;
  EngineSet& engines_;
  bool alone_ = false;  // the tree is one leaf
  int first_thread_ = 0, threads_ = engines_.threads();
  std::vector<Interface> interface_;
  std::map<LineKey, std::vector<double>> line_;  // breakpoints of minimal interface edges
  using PartKey = std::tuple<LineKey, double>;   // a part, by its lower end
  [[nodiscard]] static PartKey key_of(const Segment& part) {
    return {{part.axis, part.u, part.v}, part.t0};
  }
  std::map<PartKey, std::uint32_t> tie_of_;
  std::vector<EdgeTies> tie_;
  std::vector<bool> dropped_;  // leaves with an undecided interface
  std::vector<LeafGraph> graph_;
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> boundary_vertex_;  // by vertex and tree
  CellComplex complex_;
  bool partial_ = false;               // some leaf is undecided
  std::vector<std::uint32_t> unread_;  // leaves with a tube that could not be read
};

const Leaf& Assembler::donor(const Interface& i) const {
  if (i.low == kNone || i.high == kNone) return subdivision_.leaf[std::min(i.low, i.high)];
  // Candidates of either side are complete on the common face; the shorter list is cheaper.
  const Leaf &a = subdivision_.leaf[i.low], &b = subdivision_.leaf[i.high];
  return a.candidates.size() <= b.candidates.size() ? a : b;
}

void Assembler::pair_cells() {
  std::vector<std::uint32_t> stack{0};
  while (!stack.empty() && !stopped()) {
    const CellNode& node = subdivision_.node[stack.back()];
    stack.pop_back();
    if (node.axis < 0) continue;
    const int a = node.axis, u = u_axis(a), v = v_axis(a);
    pair_faces(node.child, node.child + 1,
               {a, node.cut, node.box.lo[u], node.box.hi[u], node.box.lo[v], node.box.hi[v]});
    stack.push_back(node.child);
    stack.push_back(node.child + 1);
  }
  // Sheets of a Voronoi diagram end on the box around all, outside the solid.
  if (alone_ || (!medial_ && !(one_sided_ && inside_wanted_)))
    for (int f = 0; f < 6; ++f) border_faces(0, f);
}

void Assembler::border_faces(std::uint32_t index, int face) {
  const CellNode& node = subdivision_.node[index];
  if (node.axis >= 0) {
    const bool low = face % 2 == 0, along = node.axis == face / 2;
    if (!along || low) border_faces(node.child, face);
    if (!along || !low) border_faces(node.child + 1, face);
    return;
  }
  if (!is_accepted(subdivision_.leaf[node.leaf])) return;
  const Rect rect = box_face(node.box, face);
  interface_.push_back(face % 2 == 0 ? Interface{kNone, node.leaf, rect, nullptr, {}}
                                     : Interface{node.leaf, kNone, rect, nullptr, {}});
}

void Assembler::pair_faces(std::uint32_t low, std::uint32_t high, const Rect& rect) {
  const CellNode &l = subdivision_.node[low], &h = subdivision_.node[high];
  if (l.axis < 0 && h.axis < 0) {
    if (is_accepted(subdivision_.leaf[l.leaf]) && is_accepted(subdivision_.leaf[h.leaf]))
      interface_.push_back({l.leaf, h.leaf, rect, nullptr, {}});
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

void Assembler::solve_interfaces() {
  for_each_in_parallel(threads_, interface_.size(), [this](int thread, std::size_t k) {
    Interface& i = interface_[k];
    if (!stopped()) solve_interface(i, thread);
  });
  for (const Interface& i : interface_)
    if (!i.decided()) drop(i);
}

void Assembler::solve_interface(Interface& i, int thread) {
  // Nearly every interface is a face of one of its leaves.
  const auto side = static_cast<std::size_t>(2 * i.rect.axis);
  const auto face_of = [&](std::uint32_t leaf, std::size_t f) {
    return leaf == kNone ? nullptr : subdivision_.leaf[leaf].face[f];
  };
  const auto low = face_of(i.low, side + 1), high = face_of(i.high, side);
  if (low && low->rect == i.rect) {
    i.diagram = low;
  } else if (high && high->rect == i.rect) {
    i.diagram = high;
  } else {
    const Leaf& leaf = donor(i);
    LocalDiagrams diagrams(engines_.diagrams(first_thread_ + thread), solid_, leaf.candidates,
                           border(leaf));
    // The other leaf's reaches beyond what the candidates are complete on.
    if (const auto& whole = i.low != kNone && &leaf == &subdivision_.leaf[i.low] ? low : high)
      diagrams.inherit(whole);
    i.diagram = diagrams.face(i.rect);
  }
  if (!i.decided()) return;
  Locator locator = locator_of(thread);
  for (const FaceNode& node : i.diagram->node)
    i.placed.push_back(place(locator, i.rect, node, donor(i).candidates));
  if (one_sided_) tell_sides(i, thread);
}

void Assembler::tell_sides(Interface& i, int thread) {
  bool crossed = true;  // by the boundary, perhaps
  for (const auto leaf : {i.low, i.high})
    if (leaf != kNone) crossed = crossed && !subdivision_.leaf[leaf].triangles.empty();
  if (!crossed) {
    i.sides.inside.assign(i.diagram->arc.size(), {inside_wanted_, inside_wanted_});
    return;
  }
  i.sides = sided_face(engines_.production(first_thread_ + thread).predicates(), engines_.inside(),
                       *i.diagram, donor(i).triangles);
  i.told = i.sides.decided;
  if (!i.told) return;
  const Locator locator = locator_of(thread);
  for (const SidedFace::Crossing& c : i.sides.crossing) {
    FaceNode node;
    node.boundary_edge = c.edge;
    if (c.node != SidedFace::kNone)
      node.governors = i.diagram->node[c.node].governors;
    else
      for (const auto t : solid_.edge[c.edge].triangle)
        node.governors.push_back(geometry_.index().face(t));
    std::ranges::sort(node.governors);
    i.crossing.push_back(locator.convex_edge(i.rect, node));
  }
}

Placed Assembler::place(Locator& locator, const Rect& rect, const FaceNode& node,
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

void Assembler::drop(const Interface& interface) {
  for (const auto leaf : {interface.low, interface.high})
    if (leaf != kNone) dropped_[leaf] = true;
}

void Assembler::cut_lines() {
  for (const Interface& i : interface_) {
    if (stopped()) return;
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

template <class Visit>
void Assembler::for_each_part(const Interface& interface, Visit visit) const {
  for (int s = 0; s < 4; ++s) {
    const Segment e = side_segment(interface.rect, s);
    const auto& points = line_.at({e.axis, e.u, e.v});
    for (auto it = std::lower_bound(points.begin(), points.end(), e.t0); *it != e.t1; ++it)
      visit(s, Segment{e.axis, e.u, e.v, *it, *std::next(it)});
  }
}

void Assembler::solve_ties() {
  for (const Interface& i : interface_)
    if (i.decided())
      for_each_part(i, [&](int, const Segment& part) {
        const auto [slot, fresh] =
            tie_of_.try_emplace(key_of(part), static_cast<std::uint32_t>(tie_.size()));
        if (fresh) tie_.push_back({part, &i, false, {}, {}});
      });
  for_each_in_parallel(threads_, tie_.size(), [this](int thread, std::size_t k) {
    if (!stopped()) solve_ties_on(tie_[k], thread);
  });
  // What is dropped changes no other interface, so one pass is enough.
  for (const Interface& i : interface_)
    if (i.decided())
      for_each_part(i, [&](int, const Segment& part) {
        if (!tie_[tie_of_.at(key_of(part))].decided) drop(i);
      });
}

void Assembler::solve_ties_on(EdgeTies& ties, int thread) {
  const Leaf& leaf = donor(*ties.asker);
  LocalDiagrams diagrams(engines_.diagrams(first_thread_ + thread), solid_, leaf.candidates,
                         border(leaf));
  diagrams.adopt(ties.asker->diagram);
  const SegmentAnswer a = diagrams.segment(ties.part);
  ties.decided = a.status == FaceStatus::kDecided;
  if (!ties.decided) return;
  Locator locator = locator_of(thread);
  for (const Breakpoint& b : a.diagram->breakpoint)
    if (b.kind == Breakpoint::Kind::kTie)
      ties.placed.push_back(locator.tie(ties.part, b, leaf.candidates));
}

std::uint32_t Assembler::add_vertex(const Placed& placed, ComplexVertex::Kind kind) {
  ComplexVertex v;
  v.position = solid_.frame.to_model(placed.position);
  v.radius = solid_.frame.length_to_model(placed.radius);
  v.on_axis = placed.on_axis;
  v.kind = kind;
  v.governors = placed.governors;
  complex_.vertex.push_back(std::move(v));
  return static_cast<std::uint32_t>(complex_.vertex.size() - 1);
}

void Assembler::add_interface(Interface& interface) {
  const FaceDiagram& d = *interface.diagram;
  std::array<std::vector<std::uint32_t>, 4> ties;
  for_each_part(interface, [&](int s, const Segment& part) {
    const auto& v = tie_[tie_of_.at(key_of(part))].vertex;
    ties[s].insert(ties[s].end(), v.begin(), v.end());
  });
  // Ties of a side, by breakpoint index of the side's own diagram.
  std::array<std::map<std::uint32_t, std::uint32_t>, 4> tie;
  for (int s = 0; s < 4; ++s) {
    const auto& vertices = ties[s];
    std::size_t n = 0;
    for (std::uint32_t k = 0; k < d.side[s]->breakpoint.size(); ++k)
      if (d.side[s]->breakpoint[k].kind == Breakpoint::Kind::kTie) {
        BLUM_CHECK(n < vertices.size());
        tie[s][k] = vertices[n++];
      }
    BLUM_CHECK(n == vertices.size());
  }
  const auto each_leaf = [&](auto&& visit) {
    for (const auto leaf : {interface.low, interface.high})
      if (leaf != kNone) visit(graph_[leaf]);
  };
  // Where the diagram is cut: crossings of the boundary's edges, in nodes and arcs.
  std::vector<std::uint32_t> on_node(d.node.size(), kNone), on_arc(d.arc.size(), kNone);
  for (std::size_t k = 0; k < interface.crossing.size(); ++k) {
    const SidedFace::Crossing& c = interface.sides.crossing[k];
    const auto v = add_vertex(interface.crossing[k], ComplexVertex::Kind::kConvexEdge);
    (c.node != SidedFace::kNone ? on_node[c.node] : on_arc[c.arc]) = v;
    each_leaf([&](LeafGraph& g) { g.crossing.emplace_back(c.edge, v); });
  }
  std::vector<std::uint32_t> vertex(d.node.size());
  for (std::size_t n = 0; n < d.node.size(); ++n) {
    const FaceNode& node = d.node[n];
    if (on_node[n] != kNone) {
      vertex[n] = on_node[n];
      continue;
    }
    switch (node.kind) {
      case FaceNode::Kind::kSide:
        vertex[n] = tie[node.side].at(node.breakpoint);
        break;
      case FaceNode::Kind::kEvent:
        vertex[n] = add_vertex(interface.placed[n], ComplexVertex::Kind::kEvent);
        break;
      case FaceNode::Kind::kRim:
        vertex[n] = add_vertex(interface.placed[n], ComplexVertex::Kind::kRim);
        break;
      case FaceNode::Kind::kConvexEdge:
        vertex[n] = add_vertex(interface.placed[n], ComplexVertex::Kind::kConvexEdge);
        each_leaf([&](LeafGraph& g) { g.crossing.emplace_back(node.boundary_edge, vertex[n]); });
        break;
    }
  }
  interface.first_edge = static_cast<std::uint32_t>(complex_.edge.size());
  for (std::size_t k = 0; k < d.arc.size(); ++k) {
    const FaceArc& a = d.arc[k];
    ComplexEdge e;
    e.vertex = {vertex[a.from], vertex[a.to]};
    if (one_sided_) {
      const auto [from, to] = interface.sides.inside[k];
      if (from != inside_wanted_ && to != inside_wanted_) continue;
      if (from != to) e.vertex[from == inside_wanted_ ? 1 : 0] = on_arc[k];
    }
    e.kind = ComplexEdge::Kind::kArc;
    e.governors = {a.left, a.right};
    const auto id = static_cast<std::uint32_t>(complex_.edge.size());
    complex_.edge.push_back(e);
    each_leaf([&](LeafGraph& g) { g.arc.push_back(id); });
  }
  for (const auto leaf : {interface.low, interface.high})
    if (leaf != kNone && !subdivision_.leaf[leaf].tube.empty())
      graph_[leaf].interface.push_back(static_cast<std::uint32_t>(&interface - interface_.data()));
}

std::optional<std::vector<Crossing>> Assembler::tube_of(std::uint32_t leaf) const {
  LeafSurface surface;
  for (const auto k : graph_[leaf].interface) {
    const Interface& interface = interface_[k];
    surface.add(*interface.diagram);
    for (std::uint32_t a = 0; a < interface.diagram->arc.size(); ++a)
      surface.add_arc(interface.diagram->arc[a], complex_.edge[interface.first_edge + a].vertex);
    std::array<std::size_t, 4> passed{};
    for_each_part(interface, [&](int s, const Segment& part) {
      const auto ties = tie_[tie_of_.at(key_of(part))].vertex.size();
      surface.add_part(key_of(part), s, passed[s], ties);
      passed[s] += ties;
    });
  }
  return surface.tube(subdivision_.leaf[leaf].tube);
}

void Assembler::add_leaf(std::uint32_t index) {
  const Leaf& leaf = subdivision_.leaf[index];
  LeafGraph& graph = graph_[index];
  const bool conical = leaf.theorem == LeafTheorem::kConical;
  if ((medial_ && !conical) || one_sided_) {
    // The boundary edges inside the leaf that the diagram ends on belong to its graph.
    std::map<std::uint32_t, std::vector<std::uint32_t>> ends;
    for (const auto& [edge, vertex] : graph.crossing) ends[edge].push_back(vertex);
    std::set<std::uint32_t> seen;
    for (const auto t : leaf.triangles)
      for (const auto v : solid_.triangle[t].vertex) {
        const Point3& p = solid_.point[v];
        bool inside = true;
        for (int k = 0; k < 3; ++k) inside &= p[k] > leaf.box.lo[k] && p[k] < leaf.box.hi[k];
        if (!inside || !seen.insert(v).second) continue;
        const auto axis = medial_ ? engines_.production(0).predicates().axis_at(v) : std::nullopt;
        const auto edges = solid_.edges_at(v);
        for (std::size_t k = 0; k < edges.size(); ++k) {
          const auto e = edges[k];
          if (medial_ && solid_.edge[e].kind != EdgeKind::kConvex) continue;
          // Sheets that meet only on the boundary are not joined there.
          const std::uint32_t tree = axis && axis->trees > 1 ? axis->tree[k] : 0;
          const auto [it, fresh] = boundary_vertex_.try_emplace({v, tree}, kNone);
          if (fresh) {
            Placed placed;
            placed.position = p;
            placed.on_axis = true;
            placed.governors = {geometry_.index().vertex(v)};
            it->second = add_vertex(placed, ComplexVertex::Kind::kBoundary);
          }
          ends[e].push_back(it->second);
        }
      }
    for (const auto& [edge, list] : ends) {
      // Towards an undecided neighbour there is no interface, so an end may be missing.
      if (list.size() == 1 && partial_) continue;
      BLUM_CHECK(list.size() == 2);
      ComplexEdge e;
      e.vertex = {list[0], list[1]};
      e.kind = ComplexEdge::Kind::kConvexEdge;
      const auto& sides = solid_.edge[edge].triangle;
      e.governors = {geometry_.index().face(sides[0]), geometry_.index().face(sides[1])};
      graph.arc.push_back(static_cast<std::uint32_t>(complex_.edge.size()));
      complex_.edge.push_back(e);
    }
  }
  if (graph.arc.empty()) return;

  std::map<std::uint32_t, std::uint32_t> local;
  std::vector<std::uint32_t> vertices;
  UnionFind components;
  for (const auto e : graph.arc) {
    for (const auto v : complex_.edge[e].vertex)
      if (local.try_emplace(v, components.size()).second) {
        components.add();
        vertices.push_back(v);
      }
    components.unite(local.at(complex_.edge[e].vertex[0]), local.at(complex_.edge[e].vertex[1]));
  }
  std::map<std::uint32_t, std::uint32_t> cone_of;  // component -> cone
  std::map<std::uint32_t, std::pair<Point3, double>> center;
  for (const auto v : vertices) {
    auto& [sum, n] = center[components.find(local.at(v))];
    const Point3& p = complex_.vertex[v].position;
    sum = {sum.x + p.x, sum.y + p.y, sum.z + p.z};
    n += 1;
  }
  // Points of the solid, or of its outside where that is wanted.
  const auto is_wanted = [&](const Point3& x) {
    return engines_.inside().locate(x) == (one_sided_ && !inside_wanted_
                                               ? InsideOracle::Where::kOutside
                                               : InsideOracle::Where::kInside);
  };
  const auto nearest_base = [&](std::uint32_t component, const Point3& x) {
    Point3 best = x;
    double least = std::numeric_limits<double>::infinity();
    for (const auto v : vertices) {
      if (components.find(local.at(v)) != component || complex_.vertex[v].radius == 0) continue;
      const Point3 y = solid_.frame.to_working(complex_.vertex[v].position);
      const double d = std::hypot(y.x - x.x, y.y - x.y, y.z - x.z);
      if (d < least && is_wanted(y)) {
        least = d;
        best = y;
      }
    }
    return best;
  };
  for (const auto& [component, c] : center) {
    Placed placed;
    if (conical) {
      placed.position = solid_.point[leaf.boundary_vertex];
      placed.on_axis = true;
      placed.governors = {geometry_.index().vertex(leaf.boundary_vertex)};
    } else {
      Point3 x = solid_.frame.to_working(
          {c.first.x / c.second, c.first.y / c.second, c.first.z / c.second});
      for (int k = 0; k < 3; ++k) x[k] = std::clamp(x[k], leaf.box.lo[k], leaf.box.hi[k]);
      // A leaf that ∂O crosses need not be convex inside O: then the nearest base vertex serves.
      if ((medial_ || one_sided_) && !is_wanted(x)) x = nearest_base(component, x);
      placed = locator_of(0).anywhere(x, leaf.candidates);
    }
    ComplexCone cone;
    cone.leaf = index;
    cone.apex = add_vertex(placed, ComplexVertex::Kind::kCone);
    if (conical) cone.boundary_vertex = leaf.boundary_vertex;
    cone_of[component] = static_cast<std::uint32_t>(complex_.cone.size());
    complex_.cone.push_back(cone);
  }
  std::map<std::uint32_t, std::uint32_t> spoke;  // vertex -> cone edge
  std::map<std::uint32_t, std::array<SiteId, 2>> spoke_governors;
  for (const auto e : graph.arc)
    for (const auto v : complex_.edge[e].vertex)
      spoke_governors.try_emplace(v, complex_.edge[e].governors);
  for (const auto v : vertices) {
    ComplexEdge e;
    const auto cone = cone_of.at(components.find(local.at(v)));
    e.vertex = {v, complex_.cone[cone].apex};
    e.kind = ComplexEdge::Kind::kCone;
    e.leaf = cone;
    e.governors = spoke_governors.at(v);
    spoke[v] = static_cast<std::uint32_t>(complex_.edge.size());
    complex_.edge.push_back(e);
  }
  std::vector<Crossing> crossing;  // arcs by their place in graph.arc
  if (!leaf.tube.empty()) {
    if (auto found = tube_of(index))
      crossing = *std::move(found);
    else
      unread_.push_back(index);
  }
  std::vector<bool> crossed(graph.arc.size(), false);
  for (const Crossing& c : crossing) crossed[c.arc] = true;
  for (std::size_t k = 0; k < graph.arc.size(); ++k) {
    if (crossed[k]) continue;
    const auto e = graph.arc[k];
    const ComplexEdge base = complex_.edge[e];
    ComplexTriangle t;
    t.edge = {e, spoke.at(base.vertex[0]), spoke.at(base.vertex[1])};
    t.cone = cone_of.at(components.find(local.at(base.vertex[0])));
    t.governors = base.governors;
    complex_.triangle.push_back(t);
  }
  if (!crossing.empty()) add_tube(index, cone_of.begin()->second, crossing, spoke);
}

void Assembler::add_tube(std::uint32_t index, std::uint32_t first,
                         std::span<const Crossing> crossing,
                         const std::map<std::uint32_t, std::uint32_t>& spoke) {
  const Leaf& leaf = subdivision_.leaf[index];
  const std::vector<std::uint32_t>& arc = graph_[index].arc;
  const auto ends_of = [&](const Crossing& c) {
    auto [g, h] = complex_.edge[arc[c.arc]].vertex;
    return c.forward ? std::array{g, h} : std::array{h, g};
  };
  const std::uint32_t apex = complex_.cone[first].apex;
  // Halfway to the ends of the crossed arcs, on either side.
  std::array<std::uint32_t, 3> ring{apex, 0, 0}, cone{first, 0, 0};
  for (const std::size_t k : {1, 2}) {
    Point3 x{};
    for (const Crossing& c : crossing) {
      const Point3& p = complex_.vertex[ends_of(c)[k - 1]].position;
      for (int i = 0; i < 3; ++i) x[i] += p[i] / static_cast<double>(crossing.size());
    }
    const Point3& p = complex_.vertex[apex].position;
    for (int i = 0; i < 3; ++i) x[i] = std::midpoint(x[i], p[i]);
    x = solid_.frame.to_working(x);
    for (int i = 0; i < 3; ++i) x[i] = std::clamp(x[i], leaf.box.lo[i], leaf.box.hi[i]);
    ring[k] = add_vertex(locator_of(0).anywhere(x, leaf.candidates), ComplexVertex::Kind::kCone);
    cone[k] = static_cast<std::uint32_t>(complex_.cone.size());
    complex_.cone.push_back({.leaf = index, .apex = ring[k], .ring = first});
  }
  const auto add_edge = [&](std::uint32_t v, std::size_t k,
                            const std::array<SiteId, 2>& governors) {
    ComplexEdge e;
    e.vertex = {v, ring[k]};
    e.kind = ComplexEdge::Kind::kCone;
    e.leaf = cone[k];
    e.governors = governors;
    complex_.edge.push_back(e);
    return static_cast<std::uint32_t>(complex_.edge.size() - 1);
  };
  const auto any = complex_.edge[arc[crossing.front().arc]].governors;
  const auto ring01 = add_edge(ring[0], 1, any), ring12 = add_edge(ring[1], 2, any),
             ring02 = add_edge(ring[0], 2, any);
  for (const Crossing& c : crossing) {
    const auto governors = complex_.edge[arc[c.arc]].governors;
    const auto [g, h] = ends_of(c);
    const auto g1 = add_edge(g, 1, governors), g2 = add_edge(g, 2, governors),
               h2 = add_edge(h, 2, governors);
    const auto add = [&](std::uint32_t base, std::uint32_t e1, std::uint32_t e2, std::size_t k) {
      complex_.triangle.push_back({{base, e1, e2}, cone[k], governors});
    };
    // The strip between the arc and the way round: apex, ring[1], ring[2], apex.
    add(spoke.at(g), g1, ring01, 1);
    add(g1, g2, ring12, 2);
    if (c.forward)
      add(arc[c.arc], g2, h2, 2);
    else
      add(arc[c.arc], h2, g2, 2);
    add(spoke.at(h), h2, ring02, 2);
  }
}

void Assembler::add_interfaces() {
  for (EdgeTies& ties : tie_)
    for (const Placed& p : ties.placed)
      ties.vertex.push_back(add_vertex(p, ComplexVertex::Kind::kArcPoint));
  for (Interface& i : interface_) {
    if (stopped()) return;
    const auto kept = [&](std::uint32_t leaf) { return leaf == kNone || !dropped_[leaf]; };
    if (kept(i.low) && kept(i.high)) add_interface(i);
  }
}

void Assembler::add_leaves() {
  const auto& leaves = subdivision_.leaf;
  for (std::uint32_t l = 0; l < leaves.size(); ++l)
    partial_ |= dropped_[l] || leaves[l].theorem == LeafTheorem::kUndecided;
  for (std::uint32_t l = 0; l < leaves.size(); ++l) {
    if (stopped()) return;
    if (is_accepted(leaves[l]) && !dropped_[l]) add_leaf(l);
  }
  for (const auto l : unread_) dropped_[l] = true;
}

/// Ties and events of the side that is not wanted are on no edge.
void Assembler::drop_unused_vertices() {
  std::vector<std::uint32_t> number(complex_.vertex.size(), kNone);
  for (const ComplexEdge& e : complex_.edge)
    for (const auto v : e.vertex) number[v] = 0;
  std::uint32_t n = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == kNone) continue;
    if (n != v) complex_.vertex[n] = std::move(complex_.vertex[v]);
    number[v] = n++;
  }
  complex_.vertex.resize(n);
  for (ComplexEdge& e : complex_.edge)
    for (auto& v : e.vertex) v = number[v];
  for (ComplexCone& c : complex_.cone) c.apex = number[c.apex];
}

Assembly Assembler::run() {
  graph_.resize(subdivision_.leaf.size());
  dropped_.assign(subdivision_.leaf.size(), false);
  Assembly assembly;
  for (const auto step :
       {&Assembler::pair_cells, &Assembler::solve_interfaces, &Assembler::cut_lines,
        &Assembler::solve_ties, &Assembler::add_interfaces, &Assembler::add_leaves}) {
    (this->*step)();
    if (stopped()) {
      assembly.stopped = true;
      return assembly;
    }
  }
  if (one_sided_) drop_unused_vertices();
  for (std::uint32_t l = 0; l < dropped_.size(); ++l)
    if (dropped_[l]) assembly.undecided.push_back(l);
  for (const Interface& i : interface_)
    if (medial_ && i.decided())
      assembly.interface.push_back(
          {i.diagram, i.low, i.high,
           static_cast<std::uint32_t>(&donor(i) - subdivision_.leaf.data()), i.first_edge});
  assembly.complex = std::move(complex_);
  return assembly;
}

}  // namespace

Assembly assemble(const SiteGeometry& geometry, const Subdivision& subdivision,
                  EngineSet& engines) {
  return Assembler(geometry, subdivision, engines).run();
}

CellComplex leaf_complex(const SiteGeometry& geometry, const Leaf& leaf, EngineSet& engines,
                         int thread) {
  Subdivision alone;
  alone.node.push_back({leaf.box});
  alone.leaf.push_back(leaf);
  return Assembler(geometry, alone, engines, thread).run().complex;
}

}  // namespace blum
