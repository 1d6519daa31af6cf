#include "cell.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "blum/kernel/union_find.hpp"
#include "failure.hpp"

namespace blum::verify {
namespace {

/// Sides of two faces that are one edge of the cell.
struct EdgePair {
  std::array<std::size_t, 2> face, side;
};
std::vector<EdgePair> edge_pairs() {
  const Box3 box{{0, 0, 0}, {1, 2, 3}};
  std::vector<EdgePair> found;
  for (std::size_t f = 0; f < 6; ++f)
    for (std::size_t g = f + 1; g < 6; ++g)
      for (int s = 0; s < 4; ++s)
        for (int t = 0; t < 4; ++t)
          if (side_of(face_of(box, f), s) == side_of(face_of(box, g), t))
            found.push_back({{f, g}, {static_cast<std::size_t>(s), static_cast<std::size_t>(t)}});
  return found;
}

/// The closed surface of the parts of cell ∩ O, cut along the graph: regions of the faces, then
/// triangles; nodes of the faces, then vertices of ∂O.
class Surface {
 public:
  Surface(const Sites& sites, const Box3& box, std::span<const std::uint32_t> triangles,
          const std::array<FaceMap, 6>& face)
      : sites_(sites),
        shape_(sites.shape()),
        face_(face),
        pairs_(edge_pairs()),
        vertex_(vertices_in(shape_, box, triangles)) {
    number();
    for (std::size_t f = 0; f < 6; ++f)
      for (const FaceMap::Arc& a : face_[f].arc) connect(node(f, a.node[0]), node(f, a.node[1]));
    glue_edges();
  }
  void check_trees() const { require(!loop_, "Theorem B: the graph on the cell has a loop"); }
  void check() {
    for (const auto v : vertex_)
      require(shape_.cone[v].axis_connected,
              "Theorem C: the axis near a vertex may be disconnected");
    glue_surface();
    check_euler();
    check_graph();
    check_labels();
  }

 private:
  void number();
  void glue_edges();
  void glue_surface();
  void check_euler();
  void check_graph();
  void check_labels();
  [[nodiscard]] std::uint32_t region(std::size_t f, std::uint32_t r) const { return first_[f] + r; }
  [[nodiscard]] std::uint32_t node(std::size_t f, std::uint32_t n) const { return nodes_[f] + n; }
  /// Sign s such that s (x - foot of x) . (outward normal) > 0 on the whole face, or 0.
  [[nodiscard]] int flow(std::size_t f, Site label) const;
  void connect(std::uint32_t a, std::uint32_t b) {
    loop_ |= graph_.find(a) == graph_.find(b);
    graph_.unite(a, b);
    arc_.push_back({a, b});
  }
  void join(std::uint32_t a, std::uint32_t b) {
    cut_.unite(a, b);
    whole_.unite(a, b);
  }
  /// Calls f(region, region, label) for the pieces on edges of the cell that are inside.
  template <class F>
  void for_pieces(F&& f) const {
    for (const EdgePair& p : pairs_) {
      const auto &a = face_[p.face[0]].side[p.side[0]].piece,
                 &b = face_[p.face[1]].side[p.side[1]].piece;
      require(a.size() == b.size(), "cell: two faces disagree about their common edge");
      for (std::size_t k = 0; k < a.size(); ++k) {
        require(a[k].inside == b[k].inside, "cell: two faces disagree about what is inside");
        if (a[k].inside) f(region(p.face[0], a[k].id), region(p.face[1], b[k].id));
      }
    }
  }

  const Sites& sites_;
  const Shape& shape_;
  const std::array<FaceMap, 6>& face_;
  std::vector<EdgePair> pairs_;
  std::vector<std::uint32_t> vertex_;
  std::array<std::uint32_t, 6> first_{}, nodes_{};
  std::uint32_t regions_ = 0;
  std::map<std::uint32_t, std::uint32_t> triangle_, vertex_node_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> edge_;  // boundary edges -> nodes of convex
  UnionFind cut_, whole_, graph_;
  std::vector<std::array<std::uint32_t, 2>> arc_;
  std::vector<std::uint32_t> beside_;  // an element beside each node
  bool loop_ = false;                  // in the graph
};

void Surface::number() {
  std::uint32_t nodes = 0;
  for (std::size_t f = 0; f < 6; ++f) {
    first_[f] = regions_;
    nodes_[f] = nodes;
    regions_ += static_cast<std::uint32_t>(face_[f].region.size());
    nodes += static_cast<std::uint32_t>(face_[f].node.size());
    for (const auto e : face_[f].trace_point) edge_[e];
  }
  std::set<std::uint32_t> triangles;
  for (const FaceMap& m : face_)
    for (const auto& [t, r] : m.trace) triangles.insert(t);
  for (const auto v : vertex_) {
    triangles.insert(shape_.triangles_at[v].begin(), shape_.triangles_at[v].end());
    for (const auto e : shape_.edges_at[v]) {
      edge_[e];
      if (shape_.edge[e].bend == Bend::kConvex && vertex_node_.try_emplace(v, nodes).second)
        ++nodes;
    }
  }
  auto elements = regions_;
  for (const auto t : triangles) triangle_[t] = elements++;
  cut_.resize(elements);
  whole_.resize(elements);
  graph_.resize(nodes);
  beside_.assign(nodes, kNone);
}

/// Ties on an edge of the cell are one point with two names.
void Surface::glue_edges() {
  for (const EdgePair& p : pairs_) {
    const auto &low = face_[p.face[0]].node, &high = face_[p.face[1]].node;
    const auto on = [](const FaceMap::Node& n, std::size_t side) {
      return n.kind == FaceMap::Node::Kind::kSide && std::cmp_equal(n.side, side);
    };
    for (std::uint32_t i = 0; i < low.size(); ++i)
      for (std::uint32_t j = 0; j < high.size(); ++j)
        if (on(low[i], p.side[0]) && on(high[j], p.side[1]) && low[i].change == high[j].change)
          connect(node(p.face[0], i), node(p.face[1], j));
  }
}

void Surface::glue_surface() {
  for (std::size_t f = 0; f < 6; ++f) {
    const FaceMap& m = face_[f];
    std::vector<std::uint32_t> of_piece(m.circles.size(), kNone);
    for (std::uint32_t r = 0; r < m.region.size(); ++r) {
      auto& first = of_piece[m.region[r].piece];
      if (first == kNone) first = region(f, r);
      whole_.unite(first, region(f, r));
    }
    for (const auto& [t, r] : m.trace) join(region(f, r), triangle_.at(t));
    for (std::uint32_t n = 0; n < m.node.size(); ++n) {
      beside_[node(f, n)] = of_piece[m.node[n].piece];
      if (m.node[n].kind == FaceMap::Node::Kind::kConvexEdge)
        edge_.at(m.node[n].edge).push_back(node(f, n));
    }
  }
  for_pieces([&](std::uint32_t a, std::uint32_t b) { join(a, b); });
  for (auto& [e, nodes] : edge_) {
    const Edge& edge = shape_.edge[e];
    require(triangle_.contains(edge.triangle[0]) && triangle_.contains(edge.triangle[1]),
            "cell: a boundary edge meets it, and a triangle beside it does not");
    const auto a = triangle_.at(edge.triangle[0]), b = triangle_.at(edge.triangle[1]);
    whole_.unite(a, b);
    if (edge.bend != Bend::kConvex) {
      cut_.unite(a, b);
      continue;
    }
    for (const auto v : edge.vertex)
      if (const auto it = vertex_node_.find(v); it != vertex_node_.end()) {
        nodes.push_back(it->second);
        beside_[it->second] = a;
      }
    require(nodes.size() == 2, "cell: a convex edge has not two ends in it");
    connect(nodes[0], nodes[1]);
  }
}

int Surface::flow(std::size_t f, Site label) const {
  const Rect& r = face_[f].rect;
  const double outward = f % 2 == 0 ? -1 : 1;
  // x - foot is a negative multiple of a face's normal inside, and of those of both faces at a
  // reflex edge a sum.
  const auto against_normal = [&](std::uint32_t t) {
    return -decide(
        [&]<class N>(const N&) { return sign_of(N(shape_.normal<N>(t)[r.axis] * N(outward))); });
  };
  if (shape_.kind(label) == Kind::kFace) return against_normal(shape_.element(label));
  if (shape_.kind(label) == Kind::kEdge) {
    const auto& beside = shape_.edge[shape_.element(label)].triangle;
    const int first = against_normal(beside[0]);
    if (first != 0 && first == against_normal(beside[1])) return first;
  }
  Vec<Rational> normal{};
  normal[r.axis] = outward;
  std::set<int> signs;
  for (const Point3& x : corners_of(box_of(r))) signs.insert(sites_.outward(x, label, normal));
  return signs.size() == 1 ? *signs.begin() : 0;
}

/// Every part of cell ∩ O is a ball: its surface is connected, and a sphere.
void Surface::check_euler() {
  std::map<std::uint32_t, long> euler;
  std::set<std::uint32_t> shown;
  const auto add = [&](std::uint32_t element, long n) { euler[whole_.find(element)] += n; };
  for (std::size_t f = 0; f < 6; ++f) {
    const FaceMap& m = face_[f];
    std::set<std::uint32_t> counted;
    for (std::uint32_t r = 0; r < m.region.size(); ++r) {
      shown.insert(whole_.find(region(f, r)));
      if (counted.insert(m.region[r].piece).second)
        add(region(f, r), 2 - static_cast<long>(m.circles[m.region[r].piece]));
    }
    for (const auto& [t, r] : m.trace) add(triangle_.at(t), -1);
    for (const auto e : m.trace_point) add(triangle_.at(shape_.edge[e].triangle[0]), 1);
  }
  for (const auto& [t, element] : triangle_) add(element, 1);
  for (const auto& [e, nodes] : edge_) add(triangle_.at(shape_.edge[e].triangle[0]), -1);
  for (const auto v : vertex_) add(triangle_.at(shape_.triangles_at[v].front()), 1);
  std::map<std::array<double, 3>, std::uint32_t> corner;
  for (const EdgePair& p : pairs_) {
    const Line& line = face_[p.face[0]].side[p.side[0]];
    const auto element = [&](std::size_t k) { return region(p.face[0], line.piece[k].id); };
    // A stretch of the edge in O, and the points where it ends.
    for (std::size_t k = 0; k < line.piece.size(); ++k) {
      if (k > 0 && line.change[k - 1].boundary) add(triangle_.at(line.change[k - 1].triangle), 1);
      if (line.piece[k].inside && (k == 0 || line.change[k - 1].boundary)) add(element(k), -1);
    }
    for (const bool high : {false, true}) {
      const std::size_t k = high ? line.piece.size() - 1 : 0;
      const Point3 x = at(line.segment, high ? line.segment.t1 : line.segment.t0);
      if (line.piece[k].inside) corner.try_emplace({x.x, x.y, x.z}, element(k));
    }
  }
  for (const auto& [x, element] : corner) add(element, 1);
  for (const auto& [s, chi] : euler) {
    require(shown.contains(s), "Theorem C: a shell of the boundary inside the cell");
    require(chi == 2, "Theorem C: a part of the solid in the cell is no ball");
  }
}

void Surface::check_graph() {
  // Theorem E': paths in regions through which no flow leaves.
  std::vector<bool> closed(regions_);
  UnionFind joined;
  joined.resize(graph_.size() + regions_);
  for (const auto& a : arc_) joined.unite(a[0], a[1]);
  for (std::size_t f = 0; f < 6; ++f) {
    for (std::uint32_t r = 0; r < face_[f].region.size(); ++r)
      closed[region(f, r)] = std::ranges::all_of(face_[f].region[r].labels, [&](Site s) {
        return flow(f, s) > 0 || !sites_.domain_meets(s, box_of(face_[f].rect));
      });
    for (const FaceMap::Arc& a : face_[f].arc)
      for (const auto r : a.region)
        if (closed[region(f, r)]) joined.unite(node(f, a.node[0]), graph_.size() + region(f, r));
  }
  for_pieces([&](std::uint32_t a, std::uint32_t b) {
    if (closed[a] && closed[b]) joined.unite(graph_.size() + a, graph_.size() + b);
  });
  std::map<std::uint32_t, std::uint32_t> graph;  // of each surface
  for (const auto& a : arc_)
    require(graph.try_emplace(whole_.find(beside_[a[0]]), joined.find(a[0])).first->second ==
                joined.find(a[0]),
            "Theorem A, E': the graph on the cell is not connected");
}

void Surface::check_labels() {
  std::set<std::uint32_t> leaves;  // components of the complement where the flow is seen to leave
  std::map<std::array<std::uint32_t, 2>, std::set<std::uint32_t>> governed;  // surface, site
  const auto govern = [&](Site site, std::uint32_t element) {
    governed[{whole_.find(element), site}].insert(cut_.find(element));
  };
  for (std::size_t f = 0; f < 6; ++f) {
    for (const Line& side : face_[f].side)
      for (const Line::Piece& p : side.piece)
        if (p.inside && flow(f, p.label) < 0) leaves.insert(cut_.find(region(f, p.id)));
    for (std::uint32_t r = 0; r < face_[f].region.size(); ++r)
      for (const Site s : face_[f].region[r].labels) govern(s, region(f, r));
  }
  for (const auto& [t, element] : triangle_) {
    leaves.insert(cut_.find(element));
    govern(shape_.face_site(t), element);
  }
  for (const auto& [e, nodes] : edge_)
    if (shape_.edge[e].bend == Bend::kReflex)
      govern(shape_.edge_site(e), triangle_.at(shape_.edge[e].triangle[0]));
  for (const auto v : vertex_)
    for (const auto t : shape_.triangles_at[v]) govern(shape_.vertex_site(v), triangle_.at(t));
  for (const auto& [key, components] : governed)
    require(components.size() == 1 || std::ranges::includes(leaves, components),
            "Theorem A': a site governs two components of the complement");
}

}  // namespace

std::vector<std::uint32_t> vertices_in(const Shape& shape, const Box3& box,
                                       std::span<const std::uint32_t> triangles) {
  std::set<std::uint32_t> found;
  for (const auto t : triangles)
    for (const auto v : shape.triangle[t].vertex) {
      const Point3 &p = shape.point[v], &lo = box.lo, &hi = box.hi;
      if (p.x > lo.x && p.x < hi.x && p.y > lo.y && p.y < hi.y && p.z > lo.z && p.z < hi.z)
        found.insert(v);
    }
  return {found.begin(), found.end()};
}

Rect face_of(const Box3& box, std::size_t face) {
  const int axis = static_cast<int>(face / 2), u = u_axis(axis), v = v_axis(axis);
  return {axis,     face % 2 == 0 ? box.lo[axis] : box.hi[axis], box.lo[u], box.hi[u], box.lo[v],
          box.hi[v]};
}

void check_boundary(const Sites& sites, const Box3& box, std::span<const std::uint32_t> triangles,
                    const std::array<FaceMap, 6>& face) {
  Surface(sites, box, triangles, face).check();
}

void check_conical(const Sites& sites, const Box3& box, std::uint32_t vertex,
                   std::span<const Site> candidates, std::span<const std::uint32_t> triangles,
                   const std::array<FaceMap, 6>& face) {
  require(vertices_in(sites.shape(), box, triangles) == std::vector{vertex},
          "Theorem B: the vertex is not the only one in the cell");
  for (const Site s : candidates)
    require(sites.shape().has_corner(s, vertex), "Theorem B: a site does not meet the vertex");
  Surface(sites, box, triangles, face).check_trees();
}

}  // namespace blum::verify
