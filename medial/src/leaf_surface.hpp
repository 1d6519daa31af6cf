/// The surface of a leaf, glued from the diagrams on its interfaces.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "blum/arrangement/face_diagram.hpp"
#include "blum/kernel/union_find.hpp"
#include "blum/subdivision/tube.hpp"

namespace blum {

/// Diagrams are added one by one, each followed by its arcs in order and by the parts of its sides.
class LeafSurface {
 public:
  /// Identifies a part of a line that no end of an interface's side divides.
  using Part = std::tuple<std::tuple<int, double, double>, double>;

  void add(const FaceDiagram& diagram);
  /// Of the last diagram; `node`: names of its ends that all diagrams share.
  void add_arc(const FaceArc& arc, const std::array<std::uint32_t, 2>& node);
  /// A part of side `side` of the last diagram, after `passed` ties of it, with `ties` on it.
  /// Requires: all of the side is inside.
  void add_part(const Part& part, int side, std::size_t passed, std::size_t ties);

  /// See tube_crossings, between the two pieces that have a label among these; arcs are numbered as
  /// they were added. Null, too, if there are not two such pieces.
  [[nodiscard]] std::optional<std::vector<Crossing>> tube(std::span<const SiteId> labels);

 private:
  const FaceDiagram* last_ = nullptr;
  std::uint32_t base_ = 0;                  // of its regions
  std::vector<std::vector<SiteId>> label_;  // of regions
  UnionFind piece_;
  std::vector<SphereArc> arc_;
  std::map<Part, std::vector<std::uint32_t>> part_;  // regions beside it
};

}  // namespace blum
