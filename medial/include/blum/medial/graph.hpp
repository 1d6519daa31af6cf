/// The graph of a diagram (thesis section 5.4.3): its faces, edges and vertices, and what lies on
/// what.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "blum/medial/medial_axis.hpp"

namespace blum {

struct GraphNode {
  enum class Kind : std::uint8_t {
    kFace,      ///< a sheet
    kEdge,      ///< a seam
    kVertex,    ///< a junction
    kSubgraph,  ///< a cluster: several edges and vertices, or a degenerate vertex, as one node
  };
  Kind kind = Kind::kFace;
  std::vector<SiteId> governors;   ///< sorted: the sites of all sheets that meet there
  std::optional<Point3> position;  ///< kVertex, kSubgraph: model units
};

/// Undirected: an arc joins a face with an edge on its border, and either with a vertex or subgraph
/// there.
struct DiagramGraph {
  std::vector<GraphNode> node;                    ///< faces, edges, then vertices and subgraphs
  std::vector<std::array<std::uint32_t, 2>> arc;  ///< sorted, without repetition
};

[[nodiscard]] DiagramGraph read_graph(const MedialResult& result);

/// {"nodes": [{"id", "type": "face"|"edge"|"vertex"|"subgraph", "governors": ["v3", "e5", "f7"],
/// "position": [x, y, z] or null}], "arcs": [[id, id], ...]}. Governors: vertex, edge or triangle
/// of the solid with its number.
[[nodiscard]] std::string graph_json(const DiagramGraph& graph, const Solid& solid);
/// The same as GraphML (graphml.graphdrawing.org), governors separated by blanks.
[[nodiscard]] std::string graph_graphml(const DiagramGraph& graph, const Solid& solid);

}  // namespace blum
