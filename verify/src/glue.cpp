#include "glue.hpp"

#include <algorithm>
#include <set>
#include <tuple>

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

constexpr const char *kTie = "ties", *kEvent = "events", *kRim = "rims",
                     *kConvexPoint = "convex points", *kConvexVertex = "convex vertices",
                     *kApex = "apices", *kArc = "arcs", *kConvexEdge = "convex edges",
                     *kSpoke = "spokes", *kTriangle = "triangles";
using Name = Complex::Name;

using LineKey = std::tuple<int, double, double>;
LineKey key_of(const Segment& s) { return {s.axis, s.u, s.v}; }

class Gluer {
 public:
  Gluer(const Exclusion& exclusion, std::span<const CellNode> node, std::span<const Leaf> leaf,
        const InterfaceMap& interface_map)
      : shape_(exclusion.sites().shape()),
        lines_(exclusion),
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
  std::uint32_t edge(std::uint32_t a, std::uint32_t b, const char* origin) {
    return add({origin, {a, b}, 1});
  }

  const Shape& shape_;
  LineSolver lines_;
  std::span<const CellNode> node_;
  std::span<const Leaf> leaf_;
  const InterfaceMap& interface_map_;
  std::vector<Interface> interface_;
  std::map<LineKey, std::vector<double>> points_;  // ends of sides along each line
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
    const FaceMap* map = a.face[side + 1].rect == rect ? &a.face[side + 1]
                         : b.face[side].rect == rect   ? &b.face[side]
                                                       : &interface_map_(rect);
    interface_.push_back({l.leaf, h.leaf, map});
    return;
  }
  const bool split_low = l.axis >= 0;
  const CellNode& n = split_low ? l : h;
  const auto descend = [&](std::uint32_t child, const Rect& part) {
    if (split_low)
      pair(child, high, part);
    else
      pair(low, child, part);
  };
  if (n.axis == rect.axis) return descend(split_low ? n.low + 1 : n.low, rect);
  Rect first = rect, second = rect;
  const bool along_u = n.axis == u_axis(rect.axis);
  (along_u ? first.u1 : first.v1) = std::min(along_u ? rect.u1 : rect.v1, n.cut);
  (along_u ? second.u0 : second.v0) = std::max(along_u ? rect.u0 : rect.v0, n.cut);
  if (first.u0 < first.u1 && first.v0 < first.v1) descend(n.low, first);
  if (second.u0 < second.u1 && second.v0 < second.v1) descend(n.low + 1, second);
}

/// One vertex for each tie on an edge of the subdivision, whatever sides hold it: sides are cut
/// where others end, and the ties of a part are known by their order.
void Gluer::number_ties() {
  for (const Interface& i : interface_)
    for (const Line& line : i.map->side) {
      auto& points = points_[key_of(line.segment)];
      points.push_back(line.segment.t0);
      points.push_back(line.segment.t1);
    }
  for (auto& [key, points] : points_) {
    std::ranges::sort(points);
    points.erase(std::ranges::unique(points).begin(), points.end());
  }
  for (const Interface& i : interface_)
    for (const Line& side : i.map->side) {
      const auto key = key_of(side.segment);
      const auto& points = points_.at(key);
      Line rest = side;
      for (auto it = std::ranges::lower_bound(points, side.segment.t0); *it != side.segment.t1;
           ++it) {
        const double end = *std::next(it);
        Line part = rest;
        if (end != side.segment.t1) {
          auto halves = lines_.cut(rest, end, leaf_[i.low].candidates);
          part = std::move(halves[0]);
          rest = std::move(halves[1]);
        }
        const auto ties = static_cast<std::size_t>(
            std::ranges::count_if(part.change, [](const Change& c) { return !c.boundary; }));
        const auto [slot, fresh] = ties_.try_emplace({key, *it});
        for (std::size_t k = 0; fresh && k < ties; ++k) slot->second.push_back(vertex(kTie));
        require(slot->second.size() == ties, "gluing: two faces disagree about an edge");
      }
    }
}

void Gluer::add_interface(const Interface& i) {
  const FaceMap& map = *i.map;
  std::vector<std::uint32_t> vertex_of(map.node.size());
  std::array<std::map<std::uint32_t, std::uint32_t>, 4> tie;
  for (std::size_t s = 0; s < 4; ++s) {
    const Line& line = map.side[s];
    const auto key = key_of(line.segment);
    const auto& points = points_.at(key);
    std::vector<std::uint32_t> vertices;
    for (auto it = std::ranges::lower_bound(points, line.segment.t0); *it != line.segment.t1;
         ++it) {
      const auto& part = ties_.at({key, *it});
      vertices.insert(vertices.end(), part.begin(), part.end());
    }
    std::size_t n = 0;
    for (std::uint32_t k = 0; k < line.change.size(); ++k)
      if (!line.change[k].boundary) {
        require(n < vertices.size(), "gluing: ties on an edge disagree");
        tie[s][k] = vertices[n++];
      }
    require(n == vertices.size(), "gluing: ties on an edge disagree");
  }
  for (std::size_t n = 0; n < map.node.size(); ++n) {
    const FaceMap::Node& node = map.node[n];
    if (node.kind == FaceMap::Node::Kind::kSide) {
      vertex_of[n] = tie[static_cast<std::size_t>(node.side)].at(node.change);
      continue;
    }
    vertex_of[n] = vertex(node.kind == FaceMap::Node::Kind::kEvent ? kEvent
                          : node.kind == FaceMap::Node::Kind::kRim ? kRim
                                                                   : kConvexPoint);
    if (node.kind == FaceMap::Node::Kind::kConvexEdge)
      for (const auto leaf : {i.low, i.high}) crossing_[leaf][node.edge].push_back(vertex_of[n]);
  }
  complex_.diagram[map.number] = &map;
  for (std::uint32_t k = 0; k < map.arc.size(); ++k) {
    const auto& node = map.arc[k].node;
    const auto id = edge(vertex_of[node[0]], vertex_of[node[1]], kArc);
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
    std::set<std::uint32_t> seen;
    for (const auto t : leaf.triangles)
      for (const auto v : shape_.triangle[t].vertex) {
        const Point3& p = shape_.point[v];
        bool inside = true;
        for (int k = 0; k < 3; ++k) inside &= p[k] > leaf.box.lo[k] && p[k] < leaf.box.hi[k];
        if (!inside || !seen.insert(v).second) continue;
        std::uint32_t name = 0;
        bool named = false;
        for (const auto e : shape_.edges_at[v]) {
          if (shape_.edge[e].bend != Bend::kConvex) continue;
          if (!named) name = complex_.named[{Name::kCorner, v, 0}] = vertex(kConvexVertex);
          named = true;
          ends[e].push_back(name);
        }
      }
    for (const auto& [e, list] : ends) {
      require(list.size() == 2, "gluing: a convex edge has not two ends in a leaf");
      arcs.push_back(complex_.named[{Name::kConvexEdge, e, index}] =
                         edge(list[0], list[1], kConvexEdge));
    }
  }
  UnionFind graph;
  std::map<std::uint32_t, std::uint32_t> local, apex, spoke;
  for (const auto a : arcs)
    for (const auto v : complex_.cell[a].faces()) {
      if (local.try_emplace(v, graph.size()).second) graph.add();
      graph.unite(local.at(complex_.cell[a].face[0]), local.at(v));
    }
  for (const auto& [v, l] : local) {
    const auto [it, fresh] = apex.try_emplace(graph.find(l), 0u);
    if (fresh) it->second = vertex(kApex);
    spoke[v] = complex_.named[{Name::kCone, index, v}] = edge(v, it->second, kSpoke);
  }
  complex_.cones[index] = apex.size();
  for (const auto a : arcs) {
    const auto& end = complex_.cell[a].face;
    complex_.named[{Name::kCone, index, a}] =
        add({kTriangle, {a, spoke.at(end[0]), spoke.at(end[1])}, 2});
  }
}

Complex Gluer::run() {
  arcs_.resize(leaf_.size());
  crossing_.resize(leaf_.size());
  complex_.cones.assign(leaf_.size(), 0);
  for (std::uint32_t n = 0; n < node_.size(); ++n) {
    const CellNode& c = node_[n];
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

Complex glue(const Exclusion& exclusion, std::span<const CellNode> node, std::span<const Leaf> leaf,
             const InterfaceMap& interface_map) {
  return Gluer(exclusion, node, leaf, interface_map).run();
}

std::map<std::string, std::size_t> count_cells(const Complex& complex,
                                               const std::vector<bool>& gone) {
  std::map<std::string, std::size_t> count;
  for (const char* origin :
       {kTie, kEvent, kRim, kConvexPoint, kConvexVertex, kApex, kArc, kConvexEdge, kSpoke})
    count[origin] = 0;
  for (std::size_t c = 0; c < complex.cell.size(); ++c)
    if (!gone[c] && complex.cell[c].dimension < 2) ++count[complex.cell[c].origin];
  return count;
}

std::array<long, 3> betti_numbers(const Complex& complex, const std::vector<bool>& gone) {
  phat::boundary_matrix<phat::sparse_pivot_column> matrix;
  matrix.set_num_cols(static_cast<phat::index>(complex.cell.size()));
  std::array<long, 4> cells{}, rank{};  // by dimension
  for (std::size_t c = 0; c < complex.cell.size(); ++c) {
    const Complex::Cell& cell = complex.cell[c];
    phat::column odd;  // over Z/2 two equal faces cancel
    if (!gone[c]) {
      ++cells[cell.dimension];
      phat::column faces(cell.faces().begin(), cell.faces().end());
      std::ranges::sort(faces);
      for (const auto f : faces) {
        if (!odd.empty() && odd.back() == f)
          odd.pop_back();
        else
          odd.push_back(f);
      }
    }
    matrix.set_dim(static_cast<phat::index>(c), static_cast<phat::dimension>(cell.dimension));
    matrix.set_col(static_cast<phat::index>(c), odd);
  }
  phat::twist_reduction()(matrix);
  for (phat::index c = 0; c < matrix.get_num_cols(); ++c)
    if (!matrix.is_empty(c)) ++rank[static_cast<std::size_t>(matrix.get_dim(c))];
  std::array<long, 3> betti{};
  for (std::size_t d = 0; d < 3; ++d) betti[d] = cells[d] - rank[d] - rank[d + 1];
  return betti;
}

}  // namespace blum::verify
