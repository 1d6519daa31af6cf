#include "blum/medial/graph.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

namespace blum {
namespace {

using Kind = GraphNode::Kind;

const char* kind_name(Kind kind) {
  switch (kind) {
    case Kind::kFace:
      return "face";
    case Kind::kEdge:
      return "edge";
    case Kind::kVertex:
      return "vertex";
    case Kind::kSubgraph:
      break;
  }
  return "subgraph";
}

std::string site_name(const SiteIndex& index, SiteId s) {
  constexpr std::array kLetter{"v", "e", "f"};
  return kLetter[static_cast<std::size_t>(index.kind(s))] + std::to_string(index.element(s));
}

}  // namespace

DiagramGraph read_graph(const MedialResult& result) {
  const CellComplex& c = result.complex;
  const Parts& parts = result.parts;
  constexpr std::uint32_t kNone = 0xffffffffu;
  DiagramGraph graph;
  graph.node.resize(parts.sheets + parts.seams);
  for (std::uint32_t s = 0; s < parts.seams; ++s) graph.node[parts.sheets + s].kind = Kind::kEdge;
  std::vector<std::uint32_t> of_cone(c.cone.size(), kNone);
  for (std::uint32_t k = 0; k < c.cone.size(); ++k) {
    const ConeShape shape = parts.cone_shape[k];
    if (shape == ConeShape::kRing) of_cone[k] = of_cone[c.cone[k].ring];
    if (shape != ConeShape::kJunction && shape != ConeShape::kCluster &&
        shape != ConeShape::kBoundaryEnd)
      continue;
    of_cone[k] = static_cast<std::uint32_t>(graph.node.size());
    GraphNode node;
    node.kind = shape == ConeShape::kJunction ? Kind::kVertex : Kind::kSubgraph;
    node.position = c.vertex[c.cone[k].apex].position;
    graph.node.push_back(std::move(node));
  }
  std::vector<std::set<SiteId>> governors(graph.node.size());
  std::set<std::array<std::uint32_t, 2>> arcs;
  const auto govern = [&](std::uint32_t node, const ComplexTriangle& t) {
    governors[node].insert(t.governors.begin(), t.governors.end());
  };
  for (std::uint32_t k = 0; k < c.triangle.size(); ++k) {
    const ComplexTriangle& t = c.triangle[k];
    const std::uint32_t sheet = parts.triangle_sheet[k], vertex = of_cone[t.cone];
    govern(sheet, t);
    if (vertex != kNone) {
      govern(vertex, t);
      arcs.insert({sheet, vertex});
    }
    for (const auto e : t.edge) {
      if (parts.edge_seam[e] == Parts::kNoSeam) continue;
      const std::uint32_t seam = parts.sheets + parts.edge_seam[e];
      govern(seam, t);
      arcs.insert({sheet, seam});
      if (vertex != kNone && c.edge[e].kind == ComplexEdge::Kind::kCone)
        arcs.insert({seam, vertex});
    }
  }
  for (std::size_t n = 0; n < graph.node.size(); ++n)
    graph.node[n].governors.assign(governors[n].begin(), governors[n].end());
  graph.arc.assign(arcs.begin(), arcs.end());
  return graph;
}

std::string graph_json(const DiagramGraph& graph, const Solid& solid) {
  using Json = nlohmann::ordered_json;
  const SiteIndex index(solid);
  Json nodes = Json::array();
  for (std::size_t n = 0; n < graph.node.size(); ++n) {
    const GraphNode& node = graph.node[n];
    Json governors = Json::array();
    for (const SiteId s : node.governors) governors.push_back(site_name(index, s));
    Json position = nullptr;
    if (node.position) position = {node.position->x, node.position->y, node.position->z};
    nodes.push_back({{"id", n},
                     {"type", kind_name(node.kind)},
                     {"governors", std::move(governors)},
                     {"position", std::move(position)}});
  }
  return Json{{"nodes", std::move(nodes)}, {"arcs", graph.arc}}.dump(1) + '\n';
}

std::string graph_graphml(const DiagramGraph& graph, const Solid& solid) {
  const SiteIndex index(solid);
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  text << R"(<?xml version="1.0" encoding="UTF-8"?>
<graphml xmlns="http://graphml.graphdrawing.org/xmlns">
<key id="type" for="node" attr.name="type" attr.type="string"/>
<key id="governors" for="node" attr.name="governors" attr.type="string"/>
<key id="position" for="node" attr.name="position" attr.type="string"/>
<graph edgedefault="undirected">
)";
  for (std::size_t n = 0; n < graph.node.size(); ++n) {
    const GraphNode& node = graph.node[n];
    text << "<node id=\"n" << n << "\"><data key=\"type\">" << kind_name(node.kind)
         << "</data><data key=\"governors\">";
    for (std::size_t k = 0; k < node.governors.size(); ++k)
      text << (k > 0 ? " " : "") << site_name(index, node.governors[k]);
    text << "</data>";
    if (node.position)
      text << "<data key=\"position\">" << node.position->x << ' ' << node.position->y << ' '
           << node.position->z << "</data>";
    text << "</node>\n";
  }
  for (const auto& [a, b] : graph.arc)
    text << "<edge source=\"n" << a << "\" target=\"n" << b << "\"/>\n";
  text << "</graph>\n</graphml>\n";
  return text.str();
}

}  // namespace blum
