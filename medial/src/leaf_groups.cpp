#include "leaf_groups.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <set>

#include "blum/kernel/check.hpp"
#include "blum/kernel/union_find.hpp"

namespace blum {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

/// Sets of sites, numbered as they come.
class SiteSets {
 public:
  void unite(SiteId a, SiteId b) { sets_.unite(number(a), number(b)); }
  void add(SiteId a) { (void)number(a); }
  [[nodiscard]] std::vector<std::pair<SiteId, GroupSet>> bits() {
    std::vector<std::pair<SiteId, GroupSet>> list;
    std::map<std::uint32_t, int> bit;
    for (const auto& [site, n] : number_) {
      const int next = std::min<int>(static_cast<int>(bit.size()), 63);
      list.emplace_back(site, GroupSet{1} << bit.try_emplace(sets_.find(n), next).first->second);
    }
    return list;
  }

 private:
  std::uint32_t number(SiteId s) {
    const auto [it, fresh] = number_.try_emplace(s, sets_.size());
    if (fresh) sets_.add();
    return it->second;
  }
  std::map<SiteId, std::uint32_t> number_;
  UnionFind sets_;
};

bool strictly_inside(const Box3& box, const Point3& p) {
  for (int k = 0; k < 3; ++k)
    if (!(p[k] > box.lo[k] && p[k] < box.hi[k])) return false;
  return true;
}

}  // namespace

LeafGroups::LeafGroups(const SiteGeometry& geometry, const Leaf& leaf) {
  const Solid& solid = geometry.solid();
  const SiteIndex& index = geometry.index();
  SiteSets sets;
  const bool conical = leaf.theorem == LeafTheorem::kConical;
  std::set<std::uint32_t> edges;  // of the boundary, that meet the leaf
  for (const auto& face : leaf.face) {
    for (const FaceRegion& r : face->region)
      for (const SiteId s : r.labels) sets.unite(r.labels.front(), s);
    for (int s = 0; s < 4; ++s)
      for (std::size_t k = 0; k < face->side_region[s].size(); ++k) {
        const auto r = face->side_region[s][k];
        if (r == FaceDiagram::kOutside || face->region[r].labels.empty()) continue;
        sets.unite(face->region[r].labels.front(), face->side[s]->interval[k].witness);
      }
    if (conical) continue;  // a cone over its surface: only what is connected there counts
    for (const FaceTrace& t : face->trace)
      if (!face->region[t.region].labels.empty())
        sets.unite(face->region[t.region].labels.front(), index.face(t.triangle));
    for (const FaceTracePoint& p : face->trace_point) edges.insert(p.boundary_edge);
  }
  for (const auto t : leaf.triangles)
    for (const auto v : solid.triangle[t].vertex) {
      if (conical || !strictly_inside(leaf.box, solid.point[v])) continue;
      for (const auto e : solid.edges_at(v)) edges.insert(e);
      // A vertex governs pieces beside all of its triangles, if it governs anything.
      if (std::binary_search(leaf.candidates.begin(), leaf.candidates.end(), index.vertex(v)))
        for (const auto beside : solid.triangles_at(v))
          sets.unite(index.vertex(v), index.face(beside));
    }
  for (const auto e : edges) {
    const SolidEdge& edge = solid.edge[e];
    if (edge.kind == EdgeKind::kConvex) continue;
    sets.unite(index.face(edge.triangle[0]), index.face(edge.triangle[1]));
    if (edge.kind == EdgeKind::kReflex) sets.unite(index.face(edge.triangle[0]), index.edge(e));
  }
  set_ = sets.bits();
  for (const auto& [site, bit] : set_) all_ |= bit;
}

GroupSet LeafGroups::of(SiteId s) const {
  const auto it = std::lower_bound(set_.begin(), set_.end(), s,
                                   [](const auto& entry, SiteId x) { return entry.first < x; });
  return it != set_.end() && it->first == s ? it->second : all_;
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

  void add_seams(const std::vector<std::uint32_t>& triangles, LeafParts& leaf) const {
    // Groups around each node, by the spoke over it.
    std::map<std::uint32_t, GroupSet> around;
    for (const auto t : triangles)
      for (const int end : {1, 2}) {
        const auto spoke = complex.triangle[t].edge[static_cast<std::size_t>(end)];
        if (parts.edge_seam[spoke] == Parts::kNoSeam) continue;
        for (const SiteId s : complex.triangle[t].governors) around[spoke] |= leaf.groups.of(s);
      }
    for (const auto& [spoke, groups] : around) {
      const auto seam = parts.edge_seam[spoke];
      const bool known = std::any_of(leaf.seam.begin(), leaf.seam.end(), [&](const auto& s) {
        return s.seam == seam && s.groups == groups;
      });
      if (!known) leaf.seam.push_back({groups, seam});
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
      list.back().groups = LeafGroups(geometry, subdivision.leaf[cone.leaf]);
      list.back().conical = cone.boundary_vertex != ComplexCone::kNone;
      list.back().junction = parts.cone_shape[c] == ConeShape::kJunction;
    } else {
      list.back().junction = false;
    }
    LeafParts& leaf = list.back();
    for (const auto t : triangles[c])
      reader.add_triangle(complex.triangle[t], parts.triangle_sheet[t], leaf);
    reader.add_seams(triangles[c], leaf);
    const auto part = reader.vertex.part[cone.apex];
    if (!leaf.conical && part != VertexParts::kNone) leaf.rest.push_back(part);
  }
  return list;
}

}  // namespace blum
