#include "face_map.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace blum::cgal {
namespace {

constexpr int kNone = -1;
std::size_t at(int k) { return static_cast<std::size_t>(k); }

void check(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

/// Numbers the components of a graph on all cells: vertices, then edges, then faces.
class Components {
 public:
  explicit Components(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  int find(int a) {
    while (parent_[at(a)] != a) a = parent_[at(a)] = parent_[at(parent_[at(a)])];
    return a;
  }
  void join(int a, int b) { parent_[at(find(a))] = find(b); }

 private:
  std::vector<int> parent_;
};

class Reader {
 public:
  Reader(const Forms& forms, const PlanarCells& cells, const LabelledCells& labels,
         FaceDiagram& out)
      : f_(forms), cells_(cells), labels_(labels), out_(out) {
    for (const auto* part : {&labels.vertex, &labels.edge, &labels.face})
      for (const Cell& c : *part) cell_.push_back(&c);
    edge0_ = static_cast<int>(cells.vertex.size());
    face0_ = edge0_ + static_cast<int>(cells.edge.size());
    in_g_.assign(cell_.size(), 0);
    arcs_at_.resize(cells.vertex.size());
    node_of_.assign(cells.vertex.size(), kNone);
  }

  void run() {
    find_graph();
    find_regions();
    for (int side = 0; side < 4; ++side) walk(side);
    inner_nodes();
    boundary_nodes();
    follow_arcs();
    traces();
  }

 private:
  const PlanarCells::Edge& edge(int e) const { return cells_.edge[at(e)]; }
  const Cell& edge_label(int e) const { return labels_.edge[at(e)]; }
  const Cell& vertex_label(int v) const { return labels_.vertex[at(v)]; }
  int edges() const { return static_cast<int>(cells_.edge.size()); }
  int vertices() const { return static_cast<int>(cells_.vertex.size()); }
  std::vector<SiteId> ids(const std::vector<int>& sites) const {
    std::vector<SiteId> out;
    for (const int i : sites) out.push_back(f_.site[at(i)].id);
    std::sort(out.begin(), out.end());
    return out;
  }
  bool tie(const Cell& c) const { return c.inside && f_.essential_pair(c.governor, c.governor); }
  const std::vector<int>& face_governor(int e, int side) const {
    return labels_.face[at(edge(e).face[at(side)])].governor;
  }

  void find_graph() {
    for (const Cell& c : labels_.face)
      if (tie(c)) throw BadPosition("a sheet lies in the plane");
    for (int e = 0; e < edges(); ++e) {
      const Cell& c = edge_label(e);
      if (!tie(c)) continue;
      if (c.sides != 0) throw BadPosition("a tie lies along a side");
      if (!f_.essential_pair(face_governor(e, 0), face_governor(e, 1)))
        throw BadPosition("a sheet touches the plane along an arc");
      if (!c.feet_differ) throw BadPosition("a rim lies in the plane");
      in_g_[at(edge0_ + e)] = 1;
      for (const int v : edge(e).vertex) {
        arcs_at_[at(v)].push_back(e);
        if (vertex_label(v).inside) in_g_[at(v)] = 1;
      }
    }
    // A sheet that touches the plane in a point.
    for (int v = 0; v < vertices(); ++v)
      if (tie(vertex_label(v)) && vertex_label(v).feet_differ) in_g_[at(v)] = 1;
  }

  std::vector<int> components(const auto& in, std::uint32_t& count) {
    Components classes(cell_.size());
    const auto join = [&](int a, int b) {
      if (a >= 0 && b >= 0 && in(a) && in(b)) classes.join(a, b);
    };
    for (int e = 0; e < edges(); ++e) {
      for (const int v : edge(e).vertex) join(v, edge0_ + e);
      for (const int f : edge(e).face)
        if (f >= 0) join(edge0_ + e, face0_ + f);
    }
    for (int v = 0; v < vertices(); ++v)
      if (cells_.vertex[at(v)].face >= 0) join(v, face0_ + cells_.vertex[at(v)].face);
    std::vector<int> number(cell_.size(), kNone), out(cell_.size(), kNone);
    count = 0;
    for (int c = 0; c < static_cast<int>(cell_.size()); ++c) {
      if (!in(c)) continue;
      int& k = number[at(classes.find(c))];
      if (k == kNone) k = static_cast<int>(count++);
      out[at(c)] = k;
    }
    return out;
  }

  void find_regions() {
    std::uint32_t regions = 0, pieces = 0;
    region_ = components([&](int c) { return cell_[at(c)]->inside && !in_g_[at(c)]; }, regions);
    piece_ = components([&](int c) { return cell_[at(c)]->inside; }, pieces);
    std::vector<std::set<int>> governors(regions);
    out_.region.resize(regions);
    for (std::size_t c = 0; c < cell_.size(); ++c) {
      if (region_[c] == kNone) continue;
      governors[at(region_[c])].insert(cell_[c]->governor.begin(), cell_[c]->governor.end());
      out_.region[at(region_[c])].piece = static_cast<std::uint32_t>(piece_[c]);
    }
    for (std::size_t r = 0; r < regions; ++r)
      out_.region[r].labels = ids({governors[r].begin(), governors[r].end()});
    // A face of the arrangement may have holes: subtract their number (V - E + F counts it as one).
    std::vector<long> euler(pieces, 0);
    for (std::size_t c = 0; c < cell_.size(); ++c)
      if (piece_[c] != kNone && cell_[c]->sides == 0)
        euler[at(piece_[c])] +=
            static_cast<int>(c) >= edge0_ && static_cast<int>(c) < face0_ ? -1 : 1;
    for (std::size_t f = 0; f < cells_.face.size(); ++f)
      if (const int p = piece_[at(face0_) + f]; p != kNone) euler[at(p)] -= cells_.face[f].holes;
    for (const long chi : euler) out_.piece.push_back({static_cast<std::uint32_t>(2 - chi)});
  }

  std::uint32_t piece_at(int v) const {
    if (piece_[at(v)] != kNone) return static_cast<std::uint32_t>(piece_[at(v)]);
    for (const int e : cells_.vertex[at(v)].edge) {
      if (piece_[at(edge0_ + e)] != kNone)
        return static_cast<std::uint32_t>(piece_[at(edge0_ + e)]);
      for (const int f : edge(e).face)
        if (f >= 0 && piece_[at(face0_ + f)] != kNone)
          return static_cast<std::uint32_t>(piece_[at(face0_ + f)]);
    }
    throw std::logic_error("a node that touches no piece");
  }

  FaceNode& add_node(int v, FaceNode::Kind kind) {
    FaceNode node;
    node.kind = kind;
    node.governors = ids(vertex_label(v).governor);
    node.piece = piece_at(v);
    constexpr int kBits = 80;
    const Window box = cells_.vertex[at(v)].point->box(kBits);
    node.u0 = double_below(box.u.lo);
    node.u1 = double_above(box.u.hi);
    node.v0 = double_below(box.v.lo);
    node.v1 = double_above(box.v.hi);
    node_of_[at(v)] = static_cast<int>(out_.node.size());
    out_.node.push_back(std::move(node));
    return out_.node.back();
  }

  /// The vertices and edges on a side, from its low end to its high end.
  void walk(int side) {
    std::map<int, std::vector<int>> edges_at;  // by vertex, on this side
    for (int e = 0; e < edges(); ++e)
      if ((edge_label(e).sides >> side & 1u) != 0)
        for (const int v : edge(e).vertex) edges_at[v].push_back(e);
    const bool along_u = side == kLowV || side == kHighV;
    const auto low = [&](int v) {
      const Window b = cells_.vertex[at(v)].point->box(64);
      return along_u ? b.u.lo : b.v.lo;
    };
    int v = kNone;
    for (const auto& [end, own] : edges_at)
      if (own.size() == 1 && (v == kNone || low(end) < low(v))) v = end;
    check(v != kNone, "a side without ends");
    const SegmentDiagram& diagram = *out_.side[at(side)];
    auto& regions = out_.side_region[at(side)];
    for (int last = kNone;;) {
      const auto& own = edges_at.at(v);
      const auto next = std::find_if(own.begin(), own.end(), [&](int e) { return e != last; });
      if (next == own.end()) break;
      const bool boundary = !vertex_label(v).triangle.empty();
      if (regions.empty() || in_g_[at(v)] || boundary) {
        if (!regions.empty()) {
          check(regions.size() <= diagram.breakpoint.size(), "more breakpoints than the side has");
          const Breakpoint& b = diagram.breakpoint[regions.size() - 1];
          check((b.kind == Breakpoint::Kind::kBoundary) == boundary, "kind of a breakpoint");
          if (!boundary) add_side_node(v, side, b);
        }
        const int r = region_[at(edge0_ + *next)];
        regions.push_back(r == kNone ? FaceDiagram::kOutside : static_cast<std::uint32_t>(r));
      }
      last = *next;
      v = edge(last).vertex[edge(last).vertex[0] == v ? 1 : 0];
    }
    check(regions.size() == diagram.interval.size(), "fewer breakpoints than the side has");
  }

  void add_side_node(int v, int side, const Breakpoint& b) {
    if (arcs_at_[at(v)].size() != 1) throw BadPosition("a sheet touches a side");
    const auto index = static_cast<std::uint32_t>(out_.side_region[at(side)].size() - 1);
    FaceNode& node = add_node(v, FaceNode::Kind::kSide);
    node.side = static_cast<std::uint8_t>(side);
    node.breakpoint = index;
    const Rect& r = out_.rect;
    if (side == kLowV || side == kHighV) {
      node.v0 = node.v1 = side == kLowV ? r.v0 : r.v1;
      node.u0 = b.lo;
      node.u1 = b.hi;
    } else {
      node.u0 = node.u1 = side == kLowU ? r.u0 : r.u1;
      node.v0 = b.lo;
      node.v1 = b.hi;
    }
  }

  void inner_nodes() {
    for (int v = 0; v < vertices(); ++v) {
      const std::size_t degree = arcs_at_[at(v)].size();
      if (in_g_[at(v)] && vertex_label(v).sides == 0 && degree != 2)
        add_node(v, degree == 1 ? FaceNode::Kind::kRim : FaceNode::Kind::kEvent);
    }
  }

  void boundary_nodes() {
    for (int v = 0; v < vertices(); ++v) {
      const Cell& c = vertex_label(v);
      if (c.triangle.size() < 2) {
        check(c.triangle.empty() || arcs_at_[at(v)].empty(), "an arc ends within a trace");
        continue;
      }
      const std::uint32_t shared = common_edge(c.triangle);
      const bool convex = f_.solid->edge[shared].kind == EdgeKind::kConvex;
      check(convex || arcs_at_[at(v)].empty(), "an arc ends on an edge that is not convex");
      if (c.sides != 0) throw BadPosition("a boundary edge crosses a side");
      out_.trace_point.push_back({shared});
      if (convex) add_node(v, FaceNode::Kind::kConvexEdge).boundary_edge = shared;
    }
    std::sort(out_.trace_point.begin(), out_.trace_point.end(),
              [](const auto& a, const auto& b) { return a.boundary_edge < b.boundary_edge; });
  }

  std::uint32_t common_edge(const std::vector<int>& triangles) const {
    if (triangles.size() == 2)
      for (const std::uint32_t a : f_.solid->triangle[f_.triangle[at(triangles[0])].id].edge)
        for (const std::uint32_t b : f_.solid->triangle[f_.triangle[at(triangles[1])].id].edge)
          if (a == b) return a;
    throw BadPosition("boundary triangles without a common edge meet on the rectangle");
  }

  void follow_arcs() {
    std::vector<char> used(cells_.edge.size(), 0);
    for (const bool loops : {false, true})
      for (int v = 0; v < vertices(); ++v) {
        if (loops && node_of_[at(v)] == kNone && arcs_at_[at(v)].size() == 2 &&
            !used[at(arcs_at_[at(v)][0])])
          add_node(v, FaceNode::Kind::kEvent);
        if (node_of_[at(v)] == kNone) continue;
        for (const int e : arcs_at_[at(v)])
          if (!used[at(e)]) follow(v, e, used);
      }
  }

  void follow(int start, int first, std::vector<char>& used) {
    int v = start, e = first;
    while (true) {
      used[at(e)] = 1;
      v = edge(e).vertex[edge(e).vertex[0] == v ? 1 : 0];
      if (node_of_[at(v)] != kNone) break;
      const auto& two = arcs_at_[at(v)];
      check(two.size() == 2, "an arc that ends without a node");
      e = two[0] == e ? two[1] : two[0];
    }
    FaceArc arc;
    arc.from = static_cast<std::uint32_t>(node_of_[at(start)]);
    arc.to = static_cast<std::uint32_t>(node_of_[at(v)]);
    const auto [left, right] = edge(first).face;
    for (const int i : labels_.face[at(left)].governor)
      for (const int j : labels_.face[at(right)].governor)
        if (f_.essential[at(i)][at(j)]) {
          arc.left = f_.site[at(i)].id;
          arc.right = f_.site[at(j)].id;
        }
    arc.region = {static_cast<std::uint32_t>(region_[at(face0_ + left)]),
                  static_cast<std::uint32_t>(region_[at(face0_ + right)])};
    out_.arc.push_back(arc);
  }

  void traces() {
    std::map<int, int> region;  // by triangle
    for (int e = 0; e < edges(); ++e) {
      if (edge_label(e).triangle.empty()) continue;
      if (edge_label(e).sides != 0) throw BadPosition("a boundary triangle along a side");
      const auto [a, b] = edge(e).face;
      check(labels_.face[at(a)].inside != labels_.face[at(b)].inside, "sides of a trace");
      const int r = region_[at(face0_ + (labels_.face[at(a)].inside ? a : b))];
      const auto [it, fresh] = region.try_emplace(edge_label(e).triangle[0], r);
      check(it->second == r, "two regions at one trace");
    }
    for (const auto& [t, r] : region)
      out_.trace.push_back({f_.triangle[at(t)].id, static_cast<std::uint32_t>(r)});
  }

  const Forms& f_;
  const PlanarCells& cells_;
  const LabelledCells& labels_;
  FaceDiagram& out_;
  std::vector<const Cell*> cell_;
  int edge0_ = 0, face0_ = 0;
  std::vector<char> in_g_;
  std::vector<std::vector<int>> arcs_at_;  // per vertex: the edges of G that end there
  std::vector<int> region_, piece_, node_of_;
};

}  // namespace

void read_map(const Forms& forms, const PlanarCells& cells, const LabelledCells& labels,
              FaceDiagram& out) {
  Reader(forms, cells, labels, out).run();
}

}  // namespace blum::cgal
