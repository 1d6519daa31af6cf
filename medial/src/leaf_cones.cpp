#include "leaf_cones.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "blum/kernel/check.hpp"
#include "blum/kernel/strictly_inside.hpp"

namespace blum {
namespace {

Point3 clamped(Point3 x, const Box3& box) {
  for (int k = 0; k < 3; ++k) x[k] = std::clamp(x[k], box.lo[k], box.hi[k]);
  return x;
}

}  // namespace

std::uint32_t add_vertex(const Solid& solid, const Placed& placed, ComplexVertex::Kind kind,
                         CellComplex& complex) {
  ComplexVertex v;
  v.position = solid.frame.to_model(placed.position);
  v.radius = solid.frame.length_to_model(placed.radius);
  v.on_axis = placed.on_axis;
  v.kind = kind;
  v.governors = placed.governors;
  complex.vertex.push_back(std::move(v));
  return static_cast<std::uint32_t>(complex.vertex.size() - 1);
}

struct LeafCones::Pieces {
  Pieces(const CellComplex& complex, const LeafBase& base) {
    for (const auto e : base.arc) {
      for (const auto v : complex.edge[e].vertex)
        if (local.try_emplace(v, component.size()).second) {
          component.add();
          vertex.push_back(v);
        }
      component.unite(local.at(complex.edge[e].vertex[0]), local.at(complex.edge[e].vertex[1]));
    }
  }

  [[nodiscard]] std::uint32_t component_of(std::uint32_t v) { return component.find(local.at(v)); }
  [[nodiscard]] std::uint32_t cone_over(std::uint32_t v) { return cone.at(component_of(v)); }

  std::vector<std::uint32_t> vertex;             // in the order of arcs
  std::map<std::uint32_t, std::uint32_t> local;  // their places
  UnionFind component;
  std::map<std::uint32_t, std::uint32_t> cone;   // by component
  std::map<std::uint32_t, std::uint32_t> spoke;  // edges, by vertex
};

void LeafCones::add(std::uint32_t index, LeafBase& base, std::span<const Crossing> tube) {
  const Leaf& leaf = in_.leaf(index);
  if ((in_.medial() && leaf.theorem != LeafTheorem::kConical) || in_.one_sided())
    add_boundary_edges(leaf, base);
  if (base.arc.empty()) return;
  Pieces pieces(complex_, base);
  add_apexes(index, pieces);
  add_spokes(base, pieces);
  std::vector<bool> crossed(base.arc.size(), false);
  for (const Crossing& c : tube) crossed[c.arc] = true;
  for (std::size_t k = 0; k < base.arc.size(); ++k) {
    if (crossed[k]) continue;
    const ComplexEdge& arc = complex_.edge[base.arc[k]];
    ComplexTriangle t;
    t.edge = {base.arc[k], pieces.spoke.at(arc.vertex[0]), pieces.spoke.at(arc.vertex[1])};
    t.cone = pieces.cone_over(arc.vertex[0]);
    t.governors = arc.governors;
    complex_.triangle.push_back(t);
  }
  if (!tube.empty()) add_tube(base, tube, pieces.cone.begin()->second, pieces.spoke);
}

void LeafCones::add_boundary_edges(const Leaf& leaf, LeafBase& base) {
  const Solid& solid = in_.solid();
  std::map<std::uint32_t, std::vector<std::uint32_t>> ends;
  for (const auto& [edge, vertex] : base.crossing) ends[edge].push_back(vertex);
  std::set<std::uint32_t> seen;
  for (const auto t : leaf.triangles)
    for (const auto v : solid.triangle[t].vertex) {
      if (!strictly_inside(solid.point[v], leaf.box) || !seen.insert(v).second) continue;
      const auto axis =
          in_.medial() ? in_.engines.production(0).predicates().axis_at(v) : std::nullopt;
      const auto edges = solid.edges_at(v);
      for (std::size_t k = 0; k < edges.size(); ++k) {
        const auto e = edges[k];
        if (in_.medial() && solid.edge[e].kind != EdgeKind::kConvex) continue;
        // Sheets that meet only on the boundary are not joined there.
        ends[e].push_back(boundary_vertex(v, axis && axis->trees > 1 ? axis->tree[k] : 0));
      }
    }
  for (const auto& [edge, list] : ends) {
    // Towards an undecided neighbour there is no interface, so an end may be missing.
    if (list.size() == 1 && partial_) continue;
    BLUM_CHECK(list.size() == 2);
    ComplexEdge e;
    e.vertex = {list[0], list[1]};
    e.kind = ComplexEdge::Kind::kConvexEdge;
    const auto& sides = solid.edge[edge].triangle;
    e.governors = {in_.geometry.index().face(sides[0]), in_.geometry.index().face(sides[1])};
    base.arc.push_back(static_cast<std::uint32_t>(complex_.edge.size()));
    complex_.edge.push_back(e);
  }
}

std::uint32_t LeafCones::boundary_vertex(std::uint32_t v, std::uint32_t tree) {
  const auto [it, fresh] = boundary_vertex_.try_emplace({v, tree}, Interface::kNone);
  if (fresh) {
    Placed placed;
    placed.position = in_.solid().point[v];
    placed.on_axis = true;
    placed.governors = {in_.geometry.index().vertex(v)};
    it->second = add_vertex(placed, ComplexVertex::Kind::kBoundary);
  }
  return it->second;
}

/// Points of the solid, or of its outside where that is wanted.
bool LeafCones::is_wanted(const Point3& x) const {
  const bool outside = in_.one_sided() && !in_.inside_wanted();
  return in_.engines.inside().locate(x) ==
         (outside ? InsideOracle::Where::kOutside : InsideOracle::Where::kInside);
}

Point3 LeafCones::nearest_base(Pieces& pieces, std::uint32_t component, const Point3& x) const {
  Point3 best = x;
  double least = std::numeric_limits<double>::infinity();
  for (const auto v : pieces.vertex) {
    if (pieces.component_of(v) != component || complex_.vertex[v].radius == 0) continue;
    const Point3 y = in_.solid().frame.to_working(complex_.vertex[v].position);
    const double d = std::hypot(y.x - x.x, y.y - x.y, y.z - x.z);
    if (d < least && is_wanted(y)) {
      least = d;
      best = y;
    }
  }
  return best;
}

Placed LeafCones::apex(const Leaf& leaf, Pieces& pieces, std::uint32_t component,
                       const Point3& center) const {
  if (leaf.theorem == LeafTheorem::kConical) {
    Placed placed;
    placed.position = in_.solid().point[leaf.boundary_vertex];
    placed.on_axis = true;
    placed.governors = {in_.geometry.index().vertex(leaf.boundary_vertex)};
    return placed;
  }
  Point3 x = clamped(in_.solid().frame.to_working(center), leaf.box);
  // A leaf that ∂O crosses need not be convex inside O: then the nearest base vertex serves.
  if ((in_.medial() || in_.one_sided()) && !is_wanted(x)) x = nearest_base(pieces, component, x);
  return in_.locator().anywhere(x, leaf.candidates);
}

void LeafCones::add_apexes(std::uint32_t index, Pieces& pieces) {
  const Leaf& leaf = in_.leaf(index);
  std::map<std::uint32_t, std::pair<Point3, double>> center;
  for (const auto v : pieces.vertex) {
    auto& [sum, n] = center[pieces.component_of(v)];
    const Point3& p = complex_.vertex[v].position;
    sum = {sum.x + p.x, sum.y + p.y, sum.z + p.z};
    n += 1;
  }
  for (const auto& [component, c] : center) {
    const auto& [sum, n] = c;
    ComplexCone cone;
    cone.leaf = index;
    cone.apex = add_vertex(apex(leaf, pieces, component, {sum.x / n, sum.y / n, sum.z / n}),
                           ComplexVertex::Kind::kCone);
    if (leaf.theorem == LeafTheorem::kConical) cone.boundary_vertex = leaf.boundary_vertex;
    pieces.cone[component] = static_cast<std::uint32_t>(complex_.cone.size());
    complex_.cone.push_back(cone);
  }
}

void LeafCones::add_spokes(const LeafBase& base, Pieces& pieces) {
  std::map<std::uint32_t, std::array<SiteId, 2>> governors;
  for (const auto e : base.arc)
    for (const auto v : complex_.edge[e].vertex)
      governors.try_emplace(v, complex_.edge[e].governors);
  for (const auto v : pieces.vertex) {
    const auto cone = pieces.cone_over(v);
    ComplexEdge e;
    e.vertex = {v, complex_.cone[cone].apex};
    e.kind = ComplexEdge::Kind::kCone;
    e.leaf = cone;
    e.governors = governors.at(v);
    pieces.spoke[v] = static_cast<std::uint32_t>(complex_.edge.size());
    complex_.edge.push_back(e);
  }
}

void LeafCones::add_tube(const LeafBase& base, std::span<const Crossing> tube, std::uint32_t first,
                         const std::map<std::uint32_t, std::uint32_t>& spoke) {
  const auto index = complex_.cone[first].leaf;
  const Leaf& leaf = in_.leaf(index);
  const auto ends_of = [&](const Crossing& c) {
    auto [g, h] = complex_.edge[base.arc[c.arc]].vertex;
    return c.forward ? std::array{g, h} : std::array{h, g};
  };
  const std::uint32_t apex = complex_.cone[first].apex;
  // Halfway to the ends of the crossed arcs, on either side.
  std::array<std::uint32_t, 3> ring{apex, 0, 0}, cone{first, 0, 0};
  for (const std::size_t k : {1, 2}) {
    Point3 x{};
    for (const Crossing& c : tube) {
      const Point3& p = complex_.vertex[ends_of(c)[k - 1]].position;
      for (int i = 0; i < 3; ++i) x[i] += p[i] / static_cast<double>(tube.size());
    }
    const Point3& p = complex_.vertex[apex].position;
    for (int i = 0; i < 3; ++i) x[i] = std::midpoint(x[i], p[i]);
    x = clamped(in_.solid().frame.to_working(x), leaf.box);
    ring[k] = add_vertex(in_.locator().anywhere(x, leaf.candidates), ComplexVertex::Kind::kCone);
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
  const auto any = complex_.edge[base.arc[tube.front().arc]].governors;
  const auto ring01 = add_edge(ring[0], 1, any), ring12 = add_edge(ring[1], 2, any),
             ring02 = add_edge(ring[0], 2, any);
  for (const Crossing& c : tube) {
    const auto arc = base.arc[c.arc];
    const auto governors = complex_.edge[arc].governors;
    const auto [g, h] = ends_of(c);
    const auto g1 = add_edge(g, 1, governors), g2 = add_edge(g, 2, governors),
               h2 = add_edge(h, 2, governors);
    const auto add = [&](std::uint32_t side, std::uint32_t e1, std::uint32_t e2, std::size_t k) {
      complex_.triangle.push_back({{side, e1, e2}, cone[k], governors});
    };
    // The strip between the arc and the way round: apex, ring[1], ring[2], apex.
    add(spoke.at(g), g1, ring01, 1);
    add(g1, g2, ring12, 2);
    if (c.forward)
      add(arc, g2, h2, 2);
    else
      add(arc, h2, g2, 2);
    add(spoke.at(h), h2, ring02, 2);
  }
}

}  // namespace blum
