#include "cell.hpp"

#include <algorithm>
#include <set>

#include "blum/kernel/union_find.hpp"
#include "failure.hpp"

namespace blum::verify {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

bool strictly_inside(const Point3& p, const Box3& box) {
  for (int k = 0; k < 3; ++k)
    if (!(p[k] > box.lo[k] && p[k] < box.hi[k])) return false;
  return true;
}

std::set<std::uint32_t> vertices_in(const Shape& shape, const Box3& box,
                                    std::span<const std::uint32_t> triangles) {
  std::set<std::uint32_t> found;
  for (const auto t : triangles)
    for (const auto v : shape.triangle[t].vertex)
      if (strictly_inside(shape.point[v], box)) found.insert(v);
  return found;
}

/// Sides of two faces that are one edge of the cell.
struct EdgePair {
  std::array<std::size_t, 2> face, side;
};
const std::vector<EdgePair>& edge_pairs() {
  static const std::vector<EdgePair> pairs = [] {
    const Box3 box{{0, 0, 0}, {1, 2, 3}};
    std::vector<EdgePair> found;
    for (int f = 0; f < 6; ++f)
      for (int g = f + 1; g < 6; ++g)
        for (int s = 0; s < 4; ++s)
          for (int t = 0; t < 4; ++t)
            if (side_of(face_of(box, f), s) == side_of(face_of(box, g), t))
              found.push_back({{static_cast<std::size_t>(f), static_cast<std::size_t>(g)},
                               {static_cast<std::size_t>(s), static_cast<std::size_t>(t)}});
    return found;
  }();
  return pairs;
}

/// Calls f(face, node, face, node) for each tie on an edge of the cell.
template <class F>
void for_shared_nodes(const std::array<FaceMap, 6>& face, F&& f) {
  for (const EdgePair& p : edge_pairs()) {
    const auto &low = face[p.face[0]].node, &high = face[p.face[1]].node;
    const auto on = [](const FaceMap::Node& n, std::size_t side) {
      return n.kind == FaceMap::Node::Kind::kSide && n.side == static_cast<int>(side);
    };
    for (std::uint32_t i = 0; i < low.size(); ++i)
      for (std::uint32_t j = 0; j < high.size(); ++j)
        if (on(low[i], p.side[0]) && on(high[j], p.side[1]) && low[i].change == high[j].change)
          f(p.face[0], i, p.face[1], j);
  }
}

/// The closed surface of the parts of cell ∩ O, cut along the graph: regions of the faces, then
/// triangles; nodes of the faces, then vertices of ∂O.
class Surface {
 public:
  Surface(const Sites& sites, const Box3& box, std::span<const std::uint32_t> triangles,
          const std::array<FaceMap, 6>& face)
      : sites_(sites), shape_(sites.shape()), face_(face) {
    number(box, triangles);
    glue();
  }
  void check();

 private:
  void number(const Box3& box, std::span<const std::uint32_t> triangles);
  void glue();
  void check_vertices() const;
  void check_euler();
  void check_graph();
  void check_labels();
  [[nodiscard]] std::uint32_t region(std::size_t f, std::uint32_t r) const { return first_[f] + r; }
  [[nodiscard]] std::uint32_t node(std::size_t f, std::uint32_t n) const { return nodes_[f] + n; }
  /// Sign s such that s (x - foot of x) . (outward normal) > 0 on the whole face, or 0.
  [[nodiscard]] int flow(std::size_t f, Site label) const;

  const Sites& sites_;
  const Shape& shape_;
  const std::array<FaceMap, 6>& face_;
  std::array<std::uint32_t, 6> first_{}, nodes_{};
  std::uint32_t regions_ = 0;
  std::set<std::uint32_t> vertex_;
  std::map<std::uint32_t, std::uint32_t> triangle_, vertex_node_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> edge_;  // boundary edges -> nodes of convex
  UnionFind cut_, whole_, graph_;
  std::vector<std::array<std::uint32_t, 2>> arc_;
  std::vector<std::uint32_t> beside_;  // an element beside each node
};

void Surface::number(const Box3& box, std::span<const std::uint32_t> triangles) {
  std::uint32_t nodes = 0;
  for (std::size_t f = 0; f < 6; ++f) {
    first_[f] = regions_;
    nodes_[f] = nodes;
    regions_ += static_cast<std::uint32_t>(face_[f].region.size());
    nodes += static_cast<std::uint32_t>(face_[f].node.size());
    for (const auto e : face_[f].trace_point) edge_[e];
  }
  auto elements = regions_;
  const auto number_triangle = [&](std::uint32_t t) {
    if (triangle_.try_emplace(t, elements).second) ++elements;
  };
  for (const FaceMap& m : face_)
    for (const auto& [t, r] : m.trace) number_triangle(t);
  vertex_ = vertices_in(shape_, box, triangles);
  for (const auto v : vertex_) {
    for (const auto t : shape_.triangles_at[v]) number_triangle(t);
    for (const auto e : shape_.edges_at[v]) {
      edge_[e];
      if (shape_.edge[e].bend == Bend::kConvex && vertex_node_.try_emplace(v, nodes).second)
        ++nodes;
    }
  }
  cut_.resize(elements);
  whole_.resize(elements);
  graph_.resize(nodes);
  beside_.assign(nodes, kNone);
}

void Surface::glue() {
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    cut_.unite(a, b);
    whole_.unite(a, b);
  };
  const auto connect = [&](std::uint32_t a, std::uint32_t b) {
    graph_.unite(a, b);
    arc_.push_back({a, b});
  };
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
    for (const FaceMap::Arc& a : m.arc) connect(node(f, a.node[0]), node(f, a.node[1]));
  }
  for (const EdgePair& p : edge_pairs()) {
    const FaceMap &m = face_[p.face[0]], &o = face_[p.face[1]];
    const auto &a = m.side_region[p.side[0]], &b = o.side_region[p.side[1]];
    require(a.size() == b.size(), "cell: two faces disagree about their common edge");
    for (std::size_t k = 0; k < a.size(); ++k) {
      require((a[k] == FaceMap::kOutside) == (b[k] == FaceMap::kOutside),
              "cell: two faces disagree about what is inside");
      if (a[k] != FaceMap::kOutside) join(region(p.face[0], a[k]), region(p.face[1], b[k]));
    }
  }
  // One point, two names.
  for_shared_nodes(face_, [&](std::size_t f, std::uint32_t i, std::size_t g, std::uint32_t j) {
    connect(node(f, i), node(g, j));
  });
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
  Vec<Rational> normal{};
  normal[r.axis] = f % 2 == 0 ? -1 : 1;
  // x - foot is a negative multiple of a face's normal inside, and of those of both faces at a
  // reflex edge a sum.
  const auto inwards = [&](std::uint32_t t) {
    return -decide([&]<class N>(const N&) {
      return sign_of(N(shape_.normal<N>(t)[r.axis] * N(f % 2 == 0 ? -1.0 : 1.0)));
    });
  };
  if (shape_.kind(label) == Kind::kFace) return inwards(shape_.element(label));
  if (shape_.kind(label) == Kind::kEdge) {
    const auto& beside = shape_.edge[shape_.element(label)].triangle;
    const int first = inwards(beside[0]);
    if (first != 0 && first == inwards(beside[1])) return first;
  }
  int sign = 2;
  for (const Point3& x :
       BoxCorners({point_on(r.axis, r.level, r.u0, r.v0), point_on(r.axis, r.level, r.u1, r.v1)})) {
    const int s = sites_.outward(x, label, normal);
    if (s == 0 || (sign != 2 && s != sign)) return 0;
    sign = s;
  }
  return sign;
}

void Surface::check_vertices() const {
  for (const auto v : vertex_)
    require(sites_.cone(v).axis_connected, "Theorem C: the axis near a vertex may be disconnected");
}

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
  for (const EdgePair& p : edge_pairs()) {
    const Line& line = face_[p.face[0]].side[p.side[0]];
    const auto& regions = face_[p.face[0]].side_region[p.side[0]];
    bool open = false;  // inside a stretch of the edge in O that has been counted
    for (std::size_t k = 0; k < regions.size(); ++k) {
      if (k > 0 && line.change[k - 1].boundary) {
        open = false;
        add(triangle_.at(line.change[k - 1].triangle), 1);
      }
      if (regions[k] == FaceMap::kOutside) continue;
      if (!open) add(region(p.face[0], regions[k]), -1);
      open = true;
    }
    const auto end = [&](double t, std::uint32_t r) {
      const Point3 x = at(line.segment, t);
      if (r != FaceMap::kOutside) corner.try_emplace({x.x, x.y, x.z}, region(p.face[0], r));
    };
    end(line.segment.t0, regions.front());
    end(line.segment.t1, regions.back());
  }
  for (const auto& [x, element] : corner) add(element, 1);
  for (const auto& [s, chi] : euler) {
    require(shown.contains(s), "Theorem C: a shell of the boundary inside the cell");
    require(chi == 2, "Theorem C: a part of the solid in the cell is no ball");
  }
}

void Surface::check_graph() {
  std::map<std::uint32_t, std::set<std::uint32_t>> graphs;  // of each surface
  for (const auto& a : arc_) graphs[whole_.find(beside_[a[0]])].insert(graph_.find(a[0]));
  if (std::ranges::all_of(graphs, [](const auto& g) { return g.second.size() == 1; })) return;
  // Theorem E': paths in regions through which no flow leaves.
  std::vector<bool> closed(regions_);
  UnionFind joined;
  joined.resize(graph_.size() + regions_);
  for (const auto& a : arc_) joined.unite(a[0], a[1]);
  for (std::size_t f = 0; f < 6; ++f) {
    for (std::uint32_t r = 0; r < face_[f].region.size(); ++r)
      closed[region(f, r)] =
          std::ranges::all_of(face_[f].region[r].labels, [&](Site s) { return flow(f, s) > 0; });
    for (const FaceMap::Arc& a : face_[f].arc)
      for (const auto r : a.region)
        if (closed[region(f, r)]) joined.unite(node(f, a.node[0]), graph_.size() + region(f, r));
  }
  for (const EdgePair& p : edge_pairs()) {
    const auto &a = face_[p.face[0]].side_region[p.side[0]],
               &b = face_[p.face[1]].side_region[p.side[1]];
    for (std::size_t k = 0; k < a.size(); ++k) {
      if (a[k] == FaceMap::kOutside) continue;
      const auto ra = region(p.face[0], a[k]), rb = region(p.face[1], b[k]);
      if (closed[ra] && closed[rb]) joined.unite(graph_.size() + ra, graph_.size() + rb);
    }
  }
  for (const auto& [s, parts] : graphs)
    for (const auto g : parts)
      require(joined.find(g) == joined.find(*parts.begin()),
              "Theorem A, E': the graph on the cell is not connected");
}

void Surface::check_labels() {
  std::set<std::uint32_t> leaves;  // components of the complement where the flow is seen to leave
  for (const auto& [t, element] : triangle_) leaves.insert(cut_.find(element));
  for (std::size_t f = 0; f < 6; ++f)
    for (std::size_t s = 0; s < 4; ++s)
      for (std::size_t k = 0; k < face_[f].side_region[s].size(); ++k) {
        const auto r = face_[f].side_region[s][k];
        if (r != FaceMap::kOutside && flow(f, face_[f].side[s].piece[k].label) < 0)
          leaves.insert(cut_.find(region(f, r)));
      }
  std::map<std::array<std::uint32_t, 2>, std::set<std::uint32_t>> governed;  // surface, site
  const auto govern = [&](Site site, std::uint32_t element) {
    governed[{whole_.find(element), site}].insert(cut_.find(element));
  };
  for (std::size_t f = 0; f < 6; ++f)
    for (std::uint32_t r = 0; r < face_[f].region.size(); ++r)
      for (const Site s : face_[f].region[r].labels) govern(s, region(f, r));
  for (const auto& [t, element] : triangle_) govern(shape_.face_site(t), element);
  for (const auto& [e, nodes] : edge_)
    if (shape_.edge[e].bend == Bend::kReflex)
      govern(shape_.edge_site(e), triangle_.at(shape_.edge[e].triangle[0]));
  for (const auto v : vertex_)
    for (const auto t : shape_.triangles_at[v]) govern(shape_.vertex_site(v), triangle_.at(t));
  for (const auto& [key, components] : governed)
    require(components.size() == 1 ||
                std::ranges::all_of(components, [&](auto c) { return leaves.contains(c); }),
            "Theorem A': a site governs two components of the complement");
}

void Surface::check() {
  check_vertices();
  check_euler();
  check_graph();
  check_labels();
}

}  // namespace

Rect face_of(const Box3& box, int face) {
  const int axis = face / 2, u = u_axis(axis), v = v_axis(axis);
  return {axis,     face % 2 == 0 ? box.lo[axis] : box.hi[axis], box.lo[u], box.hi[u], box.lo[v],
          box.hi[v]};
}

void check_boundary(const Sites& sites, const Box3& box, std::span<const std::uint32_t> triangles,
                    const std::array<FaceMap, 6>& face) {
  Surface(sites, box, triangles, face).check();
}

void check_conical(const Shape& shape, const Box3& box, std::uint32_t vertex,
                   std::span<const Site> candidates, std::span<const std::uint32_t> triangles,
                   const std::array<FaceMap, 6>& face) {
  const auto inside = vertices_in(shape, box, triangles);
  require(inside.size() == 1 && *inside.begin() == vertex,
          "Theorem B: the vertex is not the only one in the cell");
  for (const Site s : candidates)
    require(shape.corners(s).has(vertex), "Theorem B: a site does not meet the vertex");
  // The components of the graph are trees.
  std::array<std::uint32_t, 6> first{};
  UnionFind graph;
  for (std::size_t f = 0; f < 6; ++f) {
    first[f] = graph.size();
    graph.resize(graph.size() + static_cast<std::uint32_t>(face[f].node.size()));
  }
  const auto connect = [&](std::uint32_t a, std::uint32_t b) {
    require(graph.find(a) != graph.find(b), "Theorem B: the graph on the cell has a loop");
    graph.unite(a, b);
  };
  for (std::size_t f = 0; f < 6; ++f)
    for (const FaceMap::Arc& a : face[f].arc) connect(first[f] + a.node[0], first[f] + a.node[1]);
  for_shared_nodes(face, [&](std::size_t f, std::uint32_t i, std::size_t g, std::uint32_t j) {
    connect(first[f] + i, first[g] + j);
  });
}

}  // namespace blum::verify
