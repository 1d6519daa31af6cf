#include "blum/medial/leaf_groups.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <set>

#include "blum/kernel/check.hpp"
#include "blum/kernel/strictly_inside.hpp"
#include "blum/kernel/union_find.hpp"

namespace blum {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

/// The components of a leaf's surface, from its regions and boundary triangles.
class Components {
 public:
  explicit Components(const Leaf& leaf) : leaf_(leaf) {
    std::uint32_t regions = 0;
    for (std::size_t f = 0; f < 6; ++f) {
      base_[f] = regions;
      regions += static_cast<std::uint32_t>(leaf.face[f]->region.size());
    }
    sets_.resize(regions);
    join_across_edges();
  }
  [[nodiscard]] std::uint32_t region(std::size_t f, std::uint32_t r) const { return base_[f] + r; }
  [[nodiscard]] std::uint32_t triangle(std::uint32_t t) {
    const auto [it, fresh] = triangle_.try_emplace(t, 0);
    if (fresh) it->second = sets_.add();
    return it->second;
  }
  void unite(std::uint32_t a, std::uint32_t b) { sets_.unite(a, b); }
  /// Components are numbered as they are asked for.
  [[nodiscard]] GroupSet bit(std::uint32_t element) {
    const int next = std::min<int>(static_cast<int>(bit_.size()), 63);
    return GroupSet{1} << bit_.try_emplace(sets_.find(element), next).first->second;
  }

 private:
  void join_across_edges();

  const Leaf& leaf_;
  std::array<std::uint32_t, 6> base_{};
  std::map<std::uint32_t, std::uint32_t> triangle_;
  std::map<std::uint32_t, int> bit_;
  UnionFind sets_;
};

void Components::join_across_edges() {
  for (std::size_t f = 0; f < 6; ++f)
    for (std::size_t g = f + 1; g < 6; ++g)
      for (int s = 0; s < 4; ++s)
        for (int t = 0; t < 4; ++t) {
          const FaceDiagram &a = *leaf_.face[f], &b = *leaf_.face[g];
          if (!(side_segment(a.rect, s) == side_segment(b.rect, t))) continue;
          const auto &at_a = a.side_region[static_cast<std::size_t>(s)],
                     &at_b = b.side_region[static_cast<std::size_t>(t)];
          BLUM_CHECK(at_a.size() == at_b.size());
          for (std::size_t k = 0; k < at_a.size(); ++k)
            if (at_a[k] != FaceDiagram::kOutside && at_b[k] != FaceDiagram::kOutside)
              unite(region(f, at_a[k]), region(g, at_b[k]));
        }
}

/// Of the boundary.
std::set<std::uint32_t> vertices_in(const Solid& solid, const Leaf& leaf) {
  std::set<std::uint32_t> vertices;
  for (const auto t : leaf.triangles)
    for (const auto v : solid.triangle[t].vertex)
      if (strictly_inside(solid.point[v], leaf.box)) vertices.insert(v);
  return vertices;
}

}  // namespace

LeafGroups::LeafGroups(const SiteGeometry& geometry, const Leaf& leaf) {
  const Solid& solid = geometry.solid();
  const SiteIndex& index = geometry.index();
  // A conical leaf is a cone over its surface: only what is connected there counts.
  const bool conical = leaf.theorem == LeafTheorem::kConical;
  Components components(leaf);
  std::set<std::uint32_t> edges, vertices;  // of the boundary, in the leaf
  if (!conical) {
    for (std::size_t f = 0; f < 6; ++f) {
      for (const FaceTrace& t : leaf.face[f]->trace)
        components.unite(components.region(f, t.region), components.triangle(t.triangle));
      for (const FaceTracePoint& p : leaf.face[f]->trace_point) edges.insert(p.boundary_edge);
    }
    vertices = vertices_in(solid, leaf);
    for (const auto v : vertices)
      for (const auto e : solid.edges_at(v)) edges.insert(e);
  }
  for (const auto e : edges)
    if (solid.edge[e].kind != EdgeKind::kConvex)
      components.unite(components.triangle(solid.edge[e].triangle[0]),
                       components.triangle(solid.edge[e].triangle[1]));

  std::map<SiteId, GroupSet> set;
  for (std::size_t f = 0; f < 6; ++f)
    for (std::uint32_t r = 0; r < leaf.face[f]->region.size(); ++r)
      for (const SiteId s : leaf.face[f]->region[r].labels)
        set[s] |= components.bit(components.region(f, r));
  for (const auto e : edges)
    for (const auto t : solid.edge[e].triangle) {
      const GroupSet bit = components.bit(components.triangle(t));
      set[index.face(t)] |= bit;
      if (solid.edge[e].kind == EdgeKind::kReflex) set[index.edge(e)] |= bit;
    }
  if (!conical)
    for (const auto& face : leaf.face)
      for (const FaceTrace& t : face->trace)
        set[index.face(t.triangle)] |= components.bit(components.triangle(t.triangle));
  for (const auto v : vertices)
    for (const auto t : solid.triangles_at(v)) {
      const GroupSet bit = components.bit(components.triangle(t));
      set[index.face(t)] |= bit;
      set[index.vertex(v)] |= bit;
    }
  set_.assign(set.begin(), set.end());
  for (const auto& [site, bits] : set_) all_ |= bits;
}

GroupSet LeafGroups::of(SiteId s) const {
  const auto it = std::ranges::lower_bound(set_, s, {}, &std::pair<SiteId, GroupSet>::first);
  return it != set_.end() && it->first == s ? it->second : all_;
}

bool LeafGroups::labels(SiteId s) const {
  return std::ranges::binary_search(set_, s, {}, &std::pair<SiteId, GroupSet>::first);
}

PartNumbers part_numbers(const CellComplex& complex, const Parts& parts) {
  return {parts.sheets, parts.seams, static_cast<std::uint32_t>(complex.vertex.size())};
}

VertexParts vertex_parts(const CellComplex& complex, const Parts& parts) {
  const PartNumbers number = part_numbers(complex, parts);
  VertexParts result;
  result.is_node.assign(complex.vertex.size(), false);
  std::vector<std::uint32_t> sheet(complex.vertex.size(), kNone),
      seam(complex.vertex.size(), kNone), ends(complex.vertex.size(), 0);
  std::vector<bool> several(complex.vertex.size(), false), boundary(complex.vertex.size(), false);
  for (std::uint32_t t = 0; t < complex.triangle.size(); ++t)
    for (const auto e : complex.triangle[t].edge)
      for (const auto v : complex.edge[e].vertex) {
        several[v] = several[v] || (sheet[v] != kNone && sheet[v] != parts.triangle_sheet[t]);
        sheet[v] = parts.triangle_sheet[t];
      }
  for (std::uint32_t e = 0; e < complex.edge.size(); ++e)
    if (parts.edge_seam[e] != Parts::kNoSeam)
      for (const auto v : complex.edge[e].vertex) {
        ++ends[v];
        if (seam[v] != kNone && seam[v] != parts.edge_seam[e]) ends[v] += 2;  // no passage
        seam[v] = parts.edge_seam[e];
      }
  for (std::size_t v = 0; v < complex.vertex.size(); ++v)
    boundary[v] = complex.vertex[v].kind == ComplexVertex::Kind::kBoundary ||
                  complex.vertex[v].kind == ComplexVertex::Kind::kConvexEdge;
  for (const ComplexCone& c : complex.cone)
    if (c.boundary_vertex != ComplexCone::kNone) boundary[c.apex] = true;
  for (std::uint32_t v = 0; v < complex.vertex.size(); ++v) {
    const bool node = !boundary[v] && (ends[v] > 0 ? ends[v] != 2 : several[v]);
    result.is_node[v] = node;
    result.part.push_back(boundary[v]         ? kNone
                          : node              ? number.vertex(v)
                          : ends[v] == 2      ? number.seam(seam[v])
                          : sheet[v] != kNone ? sheet[v]
                                              : kNone);
  }
  return result;
}

namespace {

struct LeafReader {
  const CellComplex& complex;
  const Parts& parts;
  const PartNumbers number;
  const VertexParts vertex;

  void add_triangle(const ComplexTriangle& t, std::uint32_t sheet, LeafParts& leaf) const {
    GroupSet a = leaf.groups.of(t.governors[0]), b = leaf.groups.of(t.governors[1]);
    if (b < a) std::swap(a, b);
    for (const LeafParts::Arc& arc : leaf.arc)
      if (arc.a == a && arc.b == b && arc.sheet == sheet) return;
    leaf.arc.push_back({a, b, sheet});
  }

  /// Counts an end of an arc between two sites at the node; false: it may be one of several groups.
  static bool add_end(SiteId a, SiteId b, const LeafGroups& groups, LeafParts::Node& node) {
    const GroupSet g = groups.of(a), h = groups.of(b);
    node.arc.push_back(g | h);
    node.groups |= g | h;
    return std::has_single_bit(g) && std::has_single_bit(h);
  }
  static void keep(LeafParts::Node node, LeafParts& leaf) {
    if (node.arc.size() >= 3 && std::cmp_equal(std::popcount(node.groups), node.arc.size()))
      leaf.node.push_back(std::move(node));
  }

  static void add_nodes(const FaceDiagram& face, LeafParts& leaf) {
    const auto point = [&](double u, double v) {
      return point_on(face.rect.axis, face.rect.level, std::clamp(u, face.rect.u0, face.rect.u1),
                      std::clamp(v, face.rect.v0, face.rect.v1));
    };
    for (std::uint32_t n = 0; n < face.node.size(); ++n) {
      const FaceNode& at = face.node[n];
      if (at.kind != FaceNode::Kind::kEvent) continue;
      LeafParts::Node node;
      node.box = {point(at.u0, at.v0), point(at.u1, at.v1)};
      bool certain = true;
      for (const FaceArc& arc : face.arc)
        for (const auto end : {arc.from, arc.to})
          if (end == n) certain &= add_end(arc.left, arc.right, leaf.groups, node);
      if (certain) keep(std::move(node), leaf);
    }
  }

  static void add_corners(const SiteGeometry& geometry, const Leaf& in, LeafParts& leaf) {
    const Solid& solid = geometry.solid();
    for (const auto v : vertices_in(solid, in)) {
      LeafParts::Node node;
      node.vertex = v;
      bool certain = true;
      for (const auto e : solid.edges_at(v)) {
        const auto& [t, u] = solid.edge[e].triangle;
        if (solid.edge[e].kind == EdgeKind::kConvex)
          certain &= add_end(geometry.index().face(t), geometry.index().face(u), leaf.groups, node);
      }
      if (certain) keep(std::move(node), leaf);
    }
  }

  void add_seams(const std::vector<std::uint32_t>& triangles, LeafParts& leaf) const {
    // Groups around each node, by the spoke over it.
    std::map<std::uint32_t, LeafParts::Seam> around;
    for (const auto t : triangles)
      for (const int end : {1, 2}) {
        const auto spoke = complex.triangle[t].edge[static_cast<std::size_t>(end)];
        if (parts.edge_seam[spoke] == Parts::kNoSeam) continue;
        ++around[spoke].arcs;
        for (const SiteId s : complex.triangle[t].governors) {
          const GroupSet g = leaf.groups.of(s);
          around[spoke].groups |= g;
          if (std::has_single_bit(g)) around[spoke].certain |= g;
        }
      }
    for (auto& [spoke, entry] : around) {
      entry.seam = parts.edge_seam[spoke];
      const bool known = std::any_of(leaf.seam.begin(), leaf.seam.end(), [&](const auto& s) {
        return s.seam == entry.seam && s.groups == entry.groups && s.certain == entry.certain &&
               s.arcs == entry.arcs;
      });
      if (!known) leaf.seam.push_back(entry);
    }
  }
};

}  // namespace

std::vector<LeafParts> leaf_parts(const SiteGeometry& geometry, const Subdivision& subdivision,
                                  const CellComplex& complex, const Parts& parts) {
  const LeafReader reader{complex, parts, part_numbers(complex, parts),
                          vertex_parts(complex, parts)};
  std::vector<std::vector<std::uint32_t>> triangles(complex.cone.size());
  for (std::uint32_t t = 0; t < complex.triangle.size(); ++t)
    triangles[complex.triangle[t].cone].push_back(t);
  std::vector<LeafParts> list;
  for (std::uint32_t c = 0; c < complex.cone.size(); ++c) {
    // Cones of one leaf follow each other.
    const ComplexCone& cone = complex.cone[c];
    if (list.empty() || list.back().leaf != cone.leaf) {
      list.emplace_back();
      list.back().leaf = cone.leaf;
      list.back().box = subdivision.leaf[cone.leaf].box;
      list.back().groups = LeafGroups(geometry, subdivision.leaf[cone.leaf]);
      list.back().conical = cone.boundary_vertex != ComplexCone::kNone;
      list.back().junction = parts.cone_shape[c] == ConeShape::kJunction;
      for (const auto& face : subdivision.leaf[cone.leaf].face)
        LeafReader::add_nodes(*face, list.back());
      if (!list.back().conical)
        LeafReader::add_corners(geometry, subdivision.leaf[cone.leaf], list.back());
    } else {
      list.back().junction = false;
    }
    LeafParts& leaf = list.back();
    for (const auto t : triangles[c])
      reader.add_triangle(complex.triangle[t], parts.triangle_sheet[t], leaf);
    reader.add_seams(triangles[c], leaf);
    const auto part = reader.vertex.part[cone.apex];
    // Nodes have the highest numbers, sheets the lowest.
    if (!leaf.conical && part != VertexParts::kNone &&
        (leaf.rest == LeafParts::kNone || part > leaf.rest))
      leaf.rest = part;
  }
  return list;
}

}  // namespace blum
