#include "assemble.hpp"

#include <array>
#include <map>
#include <optional>
#include <span>

#include "blum/kernel/check.hpp"
#include "blum/medial/leaf_complex.hpp"
#include "interfaces.hpp"
#include "leaf_cones.hpp"
#include "leaf_surface.hpp"

namespace blum {
namespace {

constexpr std::uint32_t kNone = Interface::kNone;

/// Vertices and edges on interfaces, then the leaves' cones over them.
class Assembler {
 public:
  explicit Assembler(const AssemblyInput& input) : in_(input), interfaces_(in_) {}
  Assembler(const Assembler&) = delete;

  Assembly run();

 private:
  void add_ties();
  void add_interfaces();
  void add_leaves();

  void add_interface(std::size_t k);
  /// Where a one-sided diagram is cut: crossings of the boundary's edges, in nodes and arcs.
  struct Crossings {
    std::vector<std::uint32_t> on_node, on_arc;  // vertices, or kNone
  };
  [[nodiscard]] Crossings add_crossings(const Interface& interface);
  /// Vertices of the diagram's nodes.
  [[nodiscard]] std::vector<std::uint32_t> add_nodes(const Interface& interface,
                                                     const Crossings& crossing);
  void add_arcs(const Interface& interface, const Crossings& crossing,
                std::span<const std::uint32_t> vertex);
  void add_crossing(const Interface& interface, std::uint32_t boundary_edge, std::uint32_t vertex);
  /// Vertices by breakpoint of each side's own diagram.
  [[nodiscard]] std::array<std::map<std::uint32_t, std::uint32_t>, 4> ties_of(
      const Interface& interface) const;
  [[nodiscard]] std::optional<std::vector<Crossing>> tube_of(std::uint32_t leaf) const;
  void drop_unused_vertices();
  [[nodiscard]] Assembly result();
  [[nodiscard]] std::uint32_t add_vertex(const Placed& placed, ComplexVertex::Kind kind) {
    return blum::add_vertex(in_.solid(), placed, kind, complex_);
  }

  const AssemblyInput in_;
  Interfaces interfaces_;
  std::vector<std::vector<std::uint32_t>> tie_vertex_;   // by part
  std::vector<std::uint32_t> first_edge_;                // by interface: of its arcs
  std::vector<LeafBase> base_;                           // by leaf
  std::vector<std::vector<std::uint32_t>> around_tube_;  // interfaces of leaves with a tube
  std::vector<bool> dropped_;                            // leaves
  CellComplex complex_;
};

std::array<std::map<std::uint32_t, std::uint32_t>, 4> Assembler::ties_of(
    const Interface& interface) const {
  std::array<std::vector<std::uint32_t>, 4> vertices;
  interfaces_.for_each_part(interface, [&](int s, const Segment& part) {
    const auto& v = tie_vertex_[interfaces_.number_of(part)];
    vertices[s].insert(vertices[s].end(), v.begin(), v.end());
  });
  std::array<std::map<std::uint32_t, std::uint32_t>, 4> tie;
  for (int s = 0; s < 4; ++s) {
    const auto& breakpoint = interface.diagram->side[s]->breakpoint;
    std::size_t n = 0;
    for (std::uint32_t k = 0; k < breakpoint.size(); ++k)
      if (breakpoint[k].kind == Breakpoint::Kind::kTie) {
        BLUM_CHECK(n < vertices[s].size());
        tie[s][k] = vertices[s][n++];
      }
    BLUM_CHECK(n == vertices[s].size());
  }
  return tie;
}

void Assembler::add_crossing(const Interface& interface, std::uint32_t boundary_edge,
                             std::uint32_t vertex) {
  interface.for_each_leaf(
      [&](std::uint32_t leaf) { base_[leaf].crossing.emplace_back(boundary_edge, vertex); });
}

Assembler::Crossings Assembler::add_crossings(const Interface& interface) {
  Crossings at{std::vector<std::uint32_t>(interface.diagram->node.size(), kNone),
               std::vector<std::uint32_t>(interface.diagram->arc.size(), kNone)};
  for (std::size_t k = 0; k < interface.crossing.size(); ++k) {
    const SidedFace::Crossing& c = interface.sides.crossing[k];
    const auto v = add_vertex(interface.crossing[k], ComplexVertex::Kind::kConvexEdge);
    (c.node != SidedFace::kNone ? at.on_node[c.node] : at.on_arc[c.arc]) = v;
    add_crossing(interface, c.edge, v);
  }
  return at;
}

std::vector<std::uint32_t> Assembler::add_nodes(const Interface& interface,
                                                const Crossings& crossing) {
  const FaceDiagram& d = *interface.diagram;
  const auto tie = ties_of(interface);
  std::vector<std::uint32_t> vertex(crossing.on_node);
  for (std::size_t n = 0; n < d.node.size(); ++n) {
    if (vertex[n] != kNone) continue;
    const FaceNode& node = d.node[n];
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
        add_crossing(interface, node.boundary_edge, vertex[n]);
        break;
    }
  }
  return vertex;
}

void Assembler::add_arcs(const Interface& interface, const Crossings& crossing,
                         std::span<const std::uint32_t> vertex) {
  const FaceDiagram& d = *interface.diagram;
  const bool wanted = in_.inside_wanted();
  for (std::size_t k = 0; k < d.arc.size(); ++k) {
    const FaceArc& a = d.arc[k];
    ComplexEdge e;
    e.vertex = {vertex[a.from], vertex[a.to]};
    if (in_.one_sided()) {
      const auto [from, to] = interface.sides.inside[k];
      if (from != wanted && to != wanted) continue;
      if (from != to) e.vertex[from == wanted ? 1 : 0] = crossing.on_arc[k];
    }
    e.kind = ComplexEdge::Kind::kArc;
    e.governors = {a.left, a.right};
    const auto id = static_cast<std::uint32_t>(complex_.edge.size());
    complex_.edge.push_back(e);
    interface.for_each_leaf([&](std::uint32_t leaf) { base_[leaf].arc.push_back(id); });
  }
}

void Assembler::add_interface(std::size_t k) {
  const Interface& interface = interfaces_.all()[k];
  const Crossings crossing = add_crossings(interface);
  const auto vertex = add_nodes(interface, crossing);
  first_edge_[k] = static_cast<std::uint32_t>(complex_.edge.size());
  add_arcs(interface, crossing, vertex);
  interface.for_each_leaf([&](std::uint32_t leaf) {
    if (!in_.leaf(leaf).tube.empty()) around_tube_[leaf].push_back(static_cast<std::uint32_t>(k));
  });
}

std::optional<std::vector<Crossing>> Assembler::tube_of(std::uint32_t leaf) const {
  LeafSurface surface;
  for (const auto k : around_tube_[leaf]) {
    const Interface& interface = interfaces_.all()[k];
    surface.add(*interface.diagram);
    for (std::uint32_t a = 0; a < interface.diagram->arc.size(); ++a)
      surface.add_arc(interface.diagram->arc[a], complex_.edge[first_edge_[k] + a].vertex);
    std::array<std::size_t, 4> passed{};
    interfaces_.for_each_part(interface, [&](int s, const Segment& part) {
      const auto ties = interfaces_.ties(interfaces_.number_of(part)).size();
      surface.add_part(Interfaces::key_of(part), s, passed[s], ties);
      passed[s] += ties;
    });
  }
  return surface.tube(in_.leaf(leaf).tube);
}

void Assembler::add_ties() {
  tie_vertex_.resize(interfaces_.parts());
  for (std::size_t p = 0; p < tie_vertex_.size(); ++p)
    for (const Placed& placed : interfaces_.ties(p))
      tie_vertex_[p].push_back(add_vertex(placed, ComplexVertex::Kind::kArcPoint));
}

void Assembler::add_interfaces() {
  first_edge_.assign(interfaces_.all().size(), 0);
  for (std::size_t k = 0; k < first_edge_.size() && !in_.stopped(); ++k) {
    bool kept = true;
    interfaces_.all()[k].for_each_leaf([&](std::uint32_t leaf) { kept &= !dropped_[leaf]; });
    if (kept) add_interface(k);
  }
}

void Assembler::add_leaves() {
  const auto& leaves = in_.subdivision.leaf;
  bool partial = false;
  for (std::uint32_t l = 0; l < leaves.size(); ++l)
    partial |= dropped_[l] || leaves[l].theorem == LeafTheorem::kUndecided;
  LeafCones cones(in_, partial, complex_);
  std::vector<std::uint32_t> unread;
  for (std::uint32_t l = 0; l < leaves.size() && !in_.stopped(); ++l) {
    if (!is_accepted(leaves[l]) || dropped_[l]) continue;
    std::vector<Crossing> tube;  // arcs by their place in the base
    if (!leaves[l].tube.empty() && !base_[l].arc.empty()) {
      if (auto found = tube_of(l))
        tube = *std::move(found);
      else
        unread.push_back(l);
    }
    cones.add(l, base_[l], tube);
  }
  for (const auto l : unread) dropped_[l] = true;
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

Assembly Assembler::result() {
  Assembly assembly;
  for (std::uint32_t l = 0; l < dropped_.size(); ++l)
    if (dropped_[l]) assembly.undecided.push_back(l);
  for (std::size_t k = 0; in_.medial() && k < interfaces_.all().size(); ++k) {
    const Interface& i = interfaces_.all()[k];
    const auto donor = &interfaces_.donor(i) - in_.subdivision.leaf.data();
    if (i.decided())
      assembly.interface.push_back(
          {i.diagram, i.low, i.high, static_cast<std::uint32_t>(donor), first_edge_[k]});
  }
  assembly.complex = std::move(complex_);
  return assembly;
}

Assembly Assembler::run() {
  base_.resize(in_.subdivision.leaf.size());
  around_tube_.resize(base_.size());
  interfaces_.solve();
  if (!in_.stopped()) {
    dropped_ = interfaces_.dropped();
    add_ties();
    add_interfaces();
  }
  if (!in_.stopped()) add_leaves();
  if (in_.stopped()) {
    Assembly none;
    none.stopped = true;
    return none;
  }
  if (in_.one_sided()) drop_unused_vertices();
  return result();
}

}  // namespace

Assembly assemble(const SiteGeometry& geometry, const Subdivision& subdivision,
                  EngineSet& engines) {
  return Assembler({.geometry = geometry,
                    .subdivision = subdivision,
                    .engines = engines,
                    .threads = engines.threads()})
      .run();
}

CellComplex leaf_complex(const SiteGeometry& geometry, const Leaf& leaf, EngineSet& engines,
                         int thread) {
  Subdivision alone;
  alone.node.push_back({leaf.box});
  alone.leaf.push_back(leaf);
  return Assembler({.geometry = geometry,
                    .subdivision = alone,
                    .engines = engines,
                    .alone = true,
                    .first_thread = thread})
      .run()
      .complex;
}

}  // namespace blum
