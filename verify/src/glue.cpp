#include "glue.hpp"

#include <algorithm>
#include <set>

#include <phat/algorithms/twist_reduction.h>
#include <phat/boundary_matrix.h>
#include <phat/representations/default_representations.h>

#include "blum/kernel/union_find.hpp"
#include "failure.hpp"

namespace blum::verify {
namespace {

struct Interface {
  std::uint32_t low, high;  // leaves
  const FaceMap* map;
};

using Name = Complex::Name;

using LineKey = std::tuple<int, double, double>;
LineKey key_of(const Segment& s) { return {s.axis, s.u, s.v}; }

class Gluer {
 public:
  Gluer(const Exclusion& exclusion, const Algebra& algebra, std::span<const CellNode> node,
        std::span<const Leaf> leaf, const InterfaceMap& interface_map)
      : shape_(exclusion.sites().shape()),
        lines_(exclusion, algebra),
        node_(node),
        leaf_(leaf),
        interface_map_(interface_map) {}
  Complex run();

 private:
  void pair(std::uint32_t low, std::uint32_t high, const Rect& rect);
  void number_ties();
  void add_interface(const Interface& i);
  void add_leaf(std::uint32_t index);
  std::uint32_t add(const Complex::Cell& cell) {
    complex_.cell.push_back(cell);
    return static_cast<std::uint32_t>(complex_.cell.size() - 1);
  }
  std::uint32_t vertex(const char* origin) { return add({origin}); }

  const Shape& shape_;
  LineSolver lines_;
  std::span<const CellNode> node_;
  std::span<const Leaf> leaf_;
  const InterfaceMap& interface_map_;
  std::vector<Interface> interface_;
  std::map<LineKey, std::set<double>> points_;  // ends of sides along each line
  std::map<std::pair<LineKey, double>, std::vector<std::uint32_t>> ties_;  // by the part's begin
  std::vector<std::vector<std::uint32_t>> arcs_;                           // of each leaf
  std::vector<std::map<std::uint32_t, std::vector<std::uint32_t>>> crossing_;  // convex edges
  Complex complex_;
};

void Gluer::pair(std::uint32_t low, std::uint32_t high, const Rect& rect) {
  const CellNode &l = node_[low], &h = node_[high];
  if (l.axis < 0 && h.axis < 0) {
    const Leaf &a = leaf_[l.leaf], &b = leaf_[h.leaf];
    if (a.outside || b.outside) return;
    const auto side = static_cast<std::size_t>(2 * rect.axis);
    interface_.push_back({l.leaf, h.leaf,
                          a.face[side + 1].rect == rect ? &a.face[side + 1]
                          : b.face[side].rect == rect   ? &b.face[side]
                                                        : &interface_map_(rect)});
    return;
  }
  const CellNode& n = l.axis >= 0 ? l : h;
  const auto descend = [&](std::uint32_t child, const Rect& part) {
    l.axis >= 0 ? pair(child, high, part) : pair(low, child, part);
  };
  if (n.axis == rect.axis) return descend(l.axis >= 0 ? n.low + 1 : n.low, rect);
  Rect first = rect, second = rect;
  const bool along_u = n.axis == u_axis(rect.axis);
  double &end = along_u ? first.u1 : first.v1, &begin = along_u ? second.u0 : second.v0;
  end = std::min(end, n.cut);
  begin = std::max(begin, n.cut);
  if (first.u0 < first.u1 && first.v0 < first.v1) descend(n.low, first);
  if (second.u0 < second.u1 && second.v0 < second.v1) descend(n.low + 1, second);
}

/// One vertex for each tie on an edge of the subdivision, whatever sides hold it: sides are cut
/// where others end, and the ties of a part are known by their order.
void Gluer::number_ties() {
  for (const Interface& i : interface_)
    for (const Line& line : i.map->side)
      points_[key_of(line.segment)].insert({line.segment.t0, line.segment.t1});
  for (const Interface& i : interface_)
    for (const Line& side : i.map->side) {
      const auto key = key_of(side.segment);
      Line rest = side;
      for (auto it = points_.at(key).find(side.segment.t0); *it != side.segment.t1; ++it) {
        auto parts = *std::next(it) == side.segment.t1
                         ? std::array{rest, Line{}}
                         : lines_.cut(rest, *std::next(it), leaf_[i.low].candidates);
        const auto ties = std::ranges::count(parts[0].change, false, &Line::Change::boundary);
        const auto [slot, fresh] = ties_.try_emplace({key, *it});
        while (fresh && std::ssize(slot->second) < ties) slot->second.push_back(vertex("ties"));
        require(std::ssize(slot->second) == ties, "gluing: two faces disagree about an edge");
        rest = std::move(parts[1]);
      }
    }
}

void Gluer::add_interface(const Interface& i) {
  const FaceMap& map = *i.map;
  std::map<std::pair<int, std::uint32_t>, std::uint32_t> tie;  // by side, change
  for (int s = 0; s < 4; ++s) {
    const Line& line = map.side[static_cast<std::size_t>(s)];
    const auto key = key_of(line.segment);
    std::vector<std::uint32_t> vertices;
    for (auto it = points_.at(key).find(line.segment.t0); *it != line.segment.t1; ++it)
      for (const auto v : ties_.at({key, *it})) vertices.push_back(v);
    std::size_t n = 0;
    for (std::uint32_t k = 0; k < line.change.size(); ++k)
      if (!line.change[k].boundary) {
        require(n < vertices.size(), "gluing: ties on an edge disagree");
        tie[{s, k}] = vertices[n++];
      }
    require(n == vertices.size(), "gluing: ties on an edge disagree");
  }
  std::vector<std::uint32_t> vertex_of;
  for (const FaceMap::Node& node : map.node) {
    using Kind = FaceMap::Node::Kind;
    vertex_of.push_back(node.kind == Kind::kSide    ? tie.at({node.side, node.change})
                        : node.kind == Kind::kEvent ? vertex("events")
                        : node.kind == Kind::kRim   ? vertex("rims")
                                                    : vertex("convex points"));
    for (const auto leaf : {i.low, i.high})
      if (node.kind == Kind::kConvexEdge) crossing_[leaf][node.edge].push_back(vertex_of.back());
  }
  complex_.diagram[map.number] = &map;
  for (std::uint32_t k = 0; k < map.arc.size(); ++k) {
    const auto& [from, to] = map.arc[k].node;
    const auto id = add({"arcs", {vertex_of[from], vertex_of[to]}, 1});
    complex_.named[{Name::kArc, map.number, k}] = id;
    for (const auto leaf : {i.low, i.high}) arcs_[leaf].push_back(id);
  }
}

void Gluer::add_leaf(std::uint32_t index) {
  const Leaf& leaf = leaf_[index];
  auto& arcs = arcs_[index];
  if (!leaf.conical) {
    // Ḡ holds the convex edges inside the leaf.
    auto ends = crossing_[index];
    for (const auto v : vertices_in(shape_, leaf.box, leaf.triangles))
      for (const auto e : shape_.edges_at[v]) {
        if (shape_.edge[e].bend != Bend::kConvex) continue;
        const auto [it, fresh] = complex_.named.try_emplace({Name::kCorner, v, 0}, 0u);
        if (fresh) it->second = vertex("convex vertices");
        ends[e].push_back(it->second);
      }
    for (const auto& [e, list] : ends) {
      require(list.size() == 2, "gluing: a convex edge has not two ends in a leaf");
      arcs.push_back(add({"convex edges", {list[0], list[1]}, 1}));
      complex_.named[{Name::kConvexEdge, e, index}] = arcs.back();
    }
  }
  UnionFind graph;
  std::map<std::uint32_t, std::uint32_t> local, apex, spoke;
  for (const auto a : arcs) {
    const auto end = complex_.cell[a].face;
    for (const auto v : {end[0], end[1]})
      if (local.try_emplace(v, graph.size()).second) graph.add();
    graph.unite(local.at(end[0]), local.at(end[1]));
  }
  for (const auto& [v, l] : local) {
    const auto [it, fresh] = apex.try_emplace(graph.find(l), 0u);
    if (fresh) it->second = vertex("apices");
    spoke[v] = complex_.named[{Name::kCone, index, v}] = add({"spokes", {v, it->second}, 1});
  }
  complex_.cones[index] = apex.size();
  for (const auto a : arcs) {
    const auto& end = complex_.cell[a].face;
    complex_.named[{Name::kCone, index, a}] =
        add({"triangles", {a, spoke.at(end[0]), spoke.at(end[1])}, 2});
  }
}

Complex Gluer::run() {
  arcs_.resize(leaf_.size());
  crossing_.resize(leaf_.size());
  complex_.cones.assign(leaf_.size(), 0);
  for (const CellNode& c : node_) {
    if (c.axis < 0) continue;
    const int u = u_axis(c.axis), v = v_axis(c.axis);
    pair(c.low, c.low + 1, {c.axis, c.cut, c.box.lo[u], c.box.hi[u], c.box.lo[v], c.box.hi[v]});
  }
  number_ties();
  for (const Interface& i : interface_) add_interface(i);
  for (std::uint32_t l = 0; l < leaf_.size(); ++l)
    if (!leaf_[l].outside) add_leaf(l);
  return std::move(complex_);
}

}  // namespace

Complex glue(const Exclusion& exclusion, const Algebra& algebra, std::span<const CellNode> node,
             std::span<const Leaf> leaf, const InterfaceMap& interface_map) {
  return Gluer(exclusion, algebra, node, leaf, interface_map).run();
}

std::map<std::string, std::size_t> count_cells(const Complex& complex,
                                               const std::vector<bool>& gone) {
  std::map<std::string, std::size_t> count;
  for (std::size_t c = 0; c < complex.cell.size(); ++c)
    if (!gone[c]) ++count[complex.cell[c].origin];
  return count;
}

std::array<long, 3> betti_numbers(const Complex& complex, const std::vector<bool>& gone) {
  phat::boundary_matrix<phat::sparse_pivot_column> matrix;
  matrix.set_num_cols(static_cast<phat::index>(complex.cell.size()));
  std::array<long, 4> cells{}, rank{};  // by dimension
  for (std::size_t c = 0; c < complex.cell.size(); ++c) {
    const Complex::Cell& cell = complex.cell[c];
    std::set<phat::index> odd;  // over Z/2 two equal faces cancel
    if (!gone[c]) {
      ++cells[cell.dimension];
      for (const auto f : cell.faces())
        if (!odd.insert(f).second) odd.erase(f);
    }
    matrix.set_dim(static_cast<phat::index>(c), static_cast<phat::dimension>(cell.dimension));
    matrix.set_col(static_cast<phat::index>(c), phat::column(odd.begin(), odd.end()));
  }
  phat::twist_reduction()(matrix);
  for (phat::index c = 0; c < matrix.get_num_cols(); ++c)
    if (!matrix.is_empty(c)) ++rank[static_cast<std::size_t>(matrix.get_dim(c))];
  std::array<long, 3> betti{};
  for (std::size_t d = 0; d < 3; ++d) betti[d] = cells[d] - rank[d] - rank[d + 1];
  return betti;
}

}  // namespace blum::verify
