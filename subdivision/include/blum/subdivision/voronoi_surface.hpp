/// The Voronoi diagram on the surface of a box: its graph, and the pieces of regions between.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "blum/arrangement/face_diagram.hpp"
#include "blum/kernel/point.hpp"
#include "blum/kernel/union_find.hpp"
#include "blum/subdivision/tube.hpp"

namespace blum {

/// Glued from the diagrams of the six faces. Requires: all decided, Voronoi, from equal segment
/// diagrams along common edges.
class VoronoiSurface {
 public:
  using Faces = std::array<std::shared_ptr<const FaceDiagram>, 6>;
  explicit VoronoiSurface(const Faces& face);

  /// Number of a region or node of a face's diagram.
  [[nodiscard]] std::uint32_t region(int face, std::uint32_t r) const {
    return region_base_[face] + r;
  }
  [[nodiscard]] std::uint32_t node(int face, std::uint32_t n) const { return node_base_[face] + n; }
  [[nodiscard]] std::uint32_t regions() const { return pieces_.size(); }
  [[nodiscard]] std::uint32_t nodes() const { return graph_.size(); }

  /// Pieces: components of the surface minus the graph. Each belongs to one site.
  [[nodiscard]] std::uint32_t piece(std::uint32_t region) { return pieces_.find(region); }
  [[nodiscard]] std::uint32_t component(std::uint32_t node) { return graph_.find(node); }
  [[nodiscard]] SiteId site(std::uint32_t region) const { return site_[region]; }

  /// Arcs as pairs of nodes; a node on an edge of the box has a name on either face, which a
  /// further arc joins.
  [[nodiscard]] const std::vector<std::array<std::uint32_t, 2>>& arcs() const { return arc_; }
  /// The graph with one name for each node: arcs() but for the further ones.
  [[nodiscard]] std::vector<SphereArc> sphere_arcs(const Faces& face);
  [[nodiscard]] bool has_graph() const { return !arc_.empty(); }

  [[nodiscard]] std::uint32_t count_pieces();
  [[nodiscard]] std::uint32_t count_components();
  /// Sum of the Euler characteristics of the pieces (a disk: 1, a ring: 0, the whole sphere: 2).
  /// Checked against Euler's formula for the graph on the sphere.
  [[nodiscard]] long pieces_euler();

  /// Is the closure of the piece a disk with a simple closed curve as border? Requires a connected
  /// graph.
  [[nodiscard]] bool border_is_simple(const Faces& face, std::uint32_t piece);

 private:
  std::array<std::uint32_t, 6> region_base_{}, node_base_{};
  std::vector<SiteId> site_;
  UnionFind pieces_, graph_;
  std::vector<std::array<std::uint32_t, 2>> arc_;
};

}  // namespace blum
