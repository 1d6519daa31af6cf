/// The base graph of one cone, and what it looks like once its nodes of degree 2 are suppressed.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "blum/medial/complex.hpp"
#include "blum/medial/parts.hpp"

namespace blum::detail {

/// One object reads cone after cone and keeps its memory.
class BaseGraph {
 public:
  explicit BaseGraph(const CellComplex& complex)
      : complex_(complex), local_(complex.vertex.size(), kNone) {}

  /// The graph of the base edges of `triangles`, all of one cone.
  void read(std::span<const std::uint32_t> triangles);

  /// Number of arc ends at a vertex of the complex that is a node of this graph.
  [[nodiscard]] std::uint32_t degree(std::uint32_t vertex) const { return degree_[local_[vertex]]; }

  /// Requires a connected graph (BLUM_CHECK): a cone belongs to one component.
  [[nodiscard]] ConeShape shape(bool at_boundary_vertex);

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  /// Half-arc h belongs to arc h / 2 and starts at its end h % 2; h ^ 1 is its twin.
  using Half = std::uint32_t;

  [[nodiscard]] std::uint32_t tail(Half h) const { return arc_[h / 2][h % 2]; }
  [[nodiscard]] std::uint32_t local_node(std::uint32_t vertex);
  [[nodiscard]] bool is_connected() const;
  void suppress_degree_two();

  const CellComplex& complex_;
  std::vector<std::uint32_t> local_;  ///< vertex -> node, kNone for vertices of other cones
  std::vector<std::uint32_t> node_;   ///< node -> vertex
  std::vector<std::uint32_t> degree_;
  std::vector<Half> half_xor_;  ///< xor of the half-arcs that start here: at a node of degree 2 it
                                ///< gives the one from the other
  std::vector<std::array<std::uint32_t, 2>> arc_;
  std::vector<std::array<std::uint32_t, 2>> long_arc_;  ///< between nodes of degree other than 2
  std::vector<bool> walked_;
};

}  // namespace blum::detail
