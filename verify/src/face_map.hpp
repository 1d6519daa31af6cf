/// The diagram on a cell face, and how it grows from that of its parts.
#pragma once

#include "border.hpp"

namespace blum::verify {

/// Terms as in the glossary: nodes and arcs of G; regions and pieces of (rectangle ∩ O).
struct FaceMap {
  struct Node {
    enum class Kind : std::uint8_t { kSide, kEvent, kRim, kConvexEdge } kind = Kind::kEvent;
    int side = 0;                 ///< kSide
    std::uint32_t change = 0;     ///< kSide: index in the side's line
    std::uint32_t edge = 0;       ///< kConvexEdge
    std::array<double, 4> box{};  ///< kEvent, kRim: u0, u1, v0, v1: holds it and no other
    std::uint32_t piece = kNone;
  };
  struct Arc {
    std::array<std::uint32_t, 2> node, region;
  };
  struct Region {
    std::vector<Site> labels;  ///< sorted, all governors of its points
    std::uint32_t piece = 0;
  };
  std::uint32_t number = 0;  ///< among the diagrams of the certificate
  Rect rect;
  std::array<Line, 4> side;  ///< as Box::side; pieces have their regions for ids
  std::vector<Node> node;
  std::vector<Arc> arc;
  std::vector<Region> region;
  std::vector<std::uint32_t> circles;               ///< by piece
  std::vector<std::array<std::uint32_t, 2>> trace;  ///< triangle, region
  std::vector<std::uint32_t> trace_point;           ///< boundary edges
};

/// Regions and pieces are made of elements: pieces of sides of parts, traces of triangles, and
/// regions that touch neither.
class MapBuilder {
 public:
  /// `traces` must outlive it.
  explicit MapBuilder(const Traces& traces) : traces_(traces) {}

  [[nodiscard]] std::uint32_t new_element();
  /// Of a piece or a trace.
  [[nodiscard]] std::uint32_t element_of(const Step& step);
  [[nodiscard]] std::uint32_t new_node(const FaceMap::Node& node, bool through = false);
  /// The node of a tie or a convex edge.
  [[nodiscard]] std::uint32_t node_of(const Step& separator);
  /// Gives ties and pieces their nodes and elements. side: 0 to 3, or -1 for a line inside the
  /// rectangle, where two parts meet.
  [[nodiscard]] Line name(Line line, int side);

  void same_piece(std::uint32_t a, std::uint32_t b) { piece_.unite(a, b); }
  void same_region(std::uint32_t a, std::uint32_t b) {
    region_.unite(a, b);
    piece_.unite(a, b);
  }
  [[nodiscard]] bool in_same_region(std::uint32_t a, std::uint32_t b) {
    return region_.find(a) == region_.find(b);
  }
  void label(std::uint32_t element, Site site) { labels_[element].push_back(site); }
  /// An element beside the node.
  void place(std::uint32_t node, std::uint32_t element) { node_[node].piece = element; }
  /// From node to node, between two elements.
  void add_arc(const FaceMap::Arc& arc) { arc_.push_back(arc); }

  /// The map of the rectangle; ends the builder. Throws Failure where an arc ends at a border of
  /// two parts.
  [[nodiscard]] FaceMap finish(const Box& root);

 private:
  void splice();

  const Traces& traces_;
  std::map<std::uint32_t, std::uint32_t> trace_element_, convex_node_;  // by triangle, edge
  std::vector<FaceMap::Node> node_;  // their pieces: elements; kNone where there is no node left
  std::vector<bool> through_;        // nodes inside the rectangle where two parts meet
  std::vector<FaceMap::Arc> arc_;
  UnionFind region_, piece_;  // of elements
  std::vector<std::vector<Site>> labels_;
};

}  // namespace blum::verify
