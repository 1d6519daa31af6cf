#include "cell_names.hpp"

#include <algorithm>

#include "blum/kernel/check.hpp"

namespace blum {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

}  // namespace

CellNames::CellNames(const SiteGeometry& geometry, const CellComplex& complex,
                     const std::vector<std::uint32_t>& edge_number, const std::vector<ArcName>& arc)
    : geometry_(geometry),
      complex_(complex),
      edge_number_(edge_number),
      arc_(arc),
      edge_at_(complex.vertex.size(), kNone),
      leaf_of_edge_(complex.edge.size(), kNone) {
  for (std::uint32_t e = 0; e < complex.edge.size(); ++e) {
    const ComplexEdge& edge = complex.edge[e];
    if (edge.kind == ComplexEdge::Kind::kArc)
      for (const auto v : edge.vertex) edge_at_[v] = e;
    if (edge.kind == ComplexEdge::Kind::kCone) edge_at_[edge.vertex[1]] = e;
  }
  for (const ComplexTriangle& t : complex.triangle)
    if (complex.edge[t.edge[0]].kind == ComplexEdge::Kind::kConvexEdge)
      leaf_of_edge_[t.edge[0]] = complex.cone[t.cone].leaf;
}

nlohmann::json CellNames::over(const char* kind, std::uint32_t cone, const Json& base) const {
  Json name = Json::array({kind, complex_.cone[cone].leaf});
  name.insert(name.end(), base.begin(), base.end());
  return name;
}

nlohmann::json CellNames::vertex(std::uint32_t v) const {
  using Kind = ComplexVertex::Kind;
  const ComplexVertex& vertex = complex_.vertex[v];
  if (vertex.kind == Kind::kBoundary)
    return Json::array({"corner", geometry_.index().element(vertex.governors.front())});
  BLUM_CHECK(edge_at_[v] != kNone);
  const ComplexEdge& e = complex_.edge[edge_at_[v]];
  if (vertex.kind == Kind::kCone) return over("apex", e.leaf, this->vertex(e.vertex[0]));
  const ArcName& name = arc_[edge_at_[v]];
  const bool second = (e.vertex[0] != v) != name.reversed;
  return Json::array({"end", name.diagram, name.arc, second ? 1 : 0});
}

nlohmann::json CellNames::edge(std::uint32_t e) const {
  const ComplexEdge& edge = complex_.edge[e];
  switch (edge.kind) {
    case ComplexEdge::Kind::kArc:
      return Json::array({"arc", arc_[e].diagram, arc_[e].arc});
    case ComplexEdge::Kind::kCone:
      return over("cone", edge.leaf, vertex(edge.vertex[0]));
    case ComplexEdge::Kind::kConvexEdge:
      break;
  }
  // The boundary edge between the two triangles beside it.
  const SiteIndex& index = geometry_.index();
  const auto common = geometry_.solid().common_edge(index.element(edge.governors[0]),
                                                    index.element(edge.governors[1]));
  BLUM_CHECK(common.has_value());
  return Json::array({"edge", edge_number_[*common], leaf_of_edge_[e]});
}

nlohmann::json CellNames::pair(const ElementaryCollapse& c) const {
  if (c.dimension == 1) return Json::array({vertex(c.face), edge(c.cell)});
  const ComplexTriangle& t = complex_.triangle[c.cell];
  return Json::array({edge(c.face), over("cone", t.cone, edge(t.edge[0]))});
}

}  // namespace blum
