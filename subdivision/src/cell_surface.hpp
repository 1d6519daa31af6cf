/// The closed surface of the components of cell ∩ O, cut along the graph of the axis on it.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "blum/kernel/union_find.hpp"
#include "blum/subdivision/cell_test.hpp"

namespace blum {

/// Elements of the surface are the regions of the six diagrams, then the boundary triangles that
/// meet the cell. Nodes of the graph are those of the six diagrams, then the boundary vertices
/// inside the cell that have convex edges: once for each tree of the axis there.
class CellSurface {
 public:
  /// The arguments must outlive it; see test_cell.
  CellSurface(const SiteGeometry& geometry, const Box3& box,
              std::span<const std::uint32_t> triangles,
              const std::array<std::shared_ptr<const FaceDiagram>, 6>& face,
              const CellOracles& oracles);

  [[nodiscard]] const std::vector<std::uint32_t>& vertices() const { return vertex_; }
  /// Theorem B about the one boundary vertex in the cell.
  [[nodiscard]] CellAnswer conical(std::uint32_t vertex);
  /// Theorem C.
  [[nodiscard]] CellAnswer test(bool resolve);

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  void number_elements(std::span<const std::uint32_t> triangles);
  void glue();
  /// Of a convex edge at a vertex inside the cell.
  [[nodiscard]] std::uint32_t tree_at(std::uint32_t vertex, std::uint32_t edge) const;
  [[nodiscard]] std::uint32_t region(int f, std::uint32_t r) const { return region_base_[f] + r; }
  [[nodiscard]] std::uint32_t node(int f, std::uint32_t n) const { return node_base_[f] + n; }

  /// kAccepted: every component is a ball.
  [[nodiscard]] CellVerdict are_balls();
  [[nodiscard]] bool pieces_are_separate();

  /// A component of the graph.
  struct Component {
    std::uint32_t root = 0;     ///< of its nodes
    std::uint32_t surface = 0;  ///< that it lies on
    std::uint32_t joined = 0;   ///< equal: joined by paths that the flow does not meet
    // For planes:
    std::vector<Box3> node;    ///< each encloses a node
    std::vector<Point3> seen;  ///< points on it or near it, or near the axis in the cell
    std::vector<std::array<SiteId, 2>> tie;  ///< governors beside its arcs
    std::vector<int> side;                   ///< of the planes of the answer
  };
  using Components = std::vector<Component>;
  /// Those of one surface follow each other.
  [[nodiscard]] Components components();
  [[nodiscard]] static bool connected(const Components& component);
  /// Theorem E': are those of each surface joined?
  [[nodiscard]] bool joined_by_flow(Components& component);

  /// Theorem E: adds planes to the answer that part the components of each surface.
  [[nodiscard]] bool parted_by_planes(Components& component, CellAnswer& answer);
  void describe(Components& component);
  [[nodiscard]] Box3 enclosure(int f, const FaceNode& node) const;
  /// Finds a plane that does not leave all members on one side.
  using Members = std::vector<Component*>;
  [[nodiscard]] bool part(Components& component, std::span<const Members> unit, CellAnswer& answer);
  [[nodiscard]] bool is_transversal(const CutPlane& plane) const;
  [[nodiscard]] bool take_sides(Components& component, const CutPlane& plane) const;

  const SiteGeometry& geometry_;
  const Solid& solid_;
  const Box3& box_;
  const std::array<std::shared_ptr<const FaceDiagram>, 6>& face_;
  const CellOracles& oracles_;

  std::array<std::uint32_t, 6> region_base_{}, node_base_{};
  std::map<std::uint32_t, std::uint32_t> triangle_;           // triangle -> element
  std::map<std::uint32_t, std::vector<std::uint32_t>> edge_;  // boundary edge in the cell -> nodes
  std::vector<std::uint32_t> vertex_;                         // boundary vertices in the cell
  // Those with convex edges, and the tree there: see Predicates::AxisAtVertex.
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> vertex_node_;
  std::map<std::uint32_t, const Predicates::AxisAtVertex*> axis_at_;  // with several trees
  bool vertices_known_ = true;
  UnionFind cut_;      // components of the surface minus the graph
  UnionFind surface_;  // components of the surface
  UnionFind graph_;
  std::vector<std::uint32_t> node_element_;  // some element beside each node
  std::vector<std::array<std::uint32_t, 2>> arc_;
  std::vector<Box3> node_box_;  // encloses each node; filled by describe()
};

}  // namespace blum
