/// The complex that the leaves give (docs/proofs.md, "Gluing"), and its Betti numbers.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <tuple>

#include "cell.hpp"

namespace blum::verify {

/// A node of the tree of cells; children are low, low + 1. Leaves have axis == -1.
struct CellNode {
  Box3 box;
  int axis = -1;
  double cut = 0;
  std::uint32_t low = 0;
  std::uint32_t leaf = 0;
};

struct Leaf {
  Box3 box;
  bool outside = false;
  bool conical = false;
  std::uint32_t vertex = 0;  ///< conical
  std::vector<Site> candidates;
  std::vector<std::uint32_t> triangles;
  std::array<FaceMap, 6> face;  ///< unless outside
};

/// Asked for the diagram on a rectangle between two leaves that is no face of either.
using InterfaceMap = std::function<const FaceMap&(const Rect&)>;

/// Cells are numbered; the faces of a cell before it.
struct Complex {
  struct Cell {
    const char* origin;                   ///< as named in certificates
    std::array<std::uint32_t, 3> face{};  ///< an edge's ends, a triangle's edges
    std::uint32_t dimension = 0;
    [[nodiscard]] std::span<const std::uint32_t> faces() const {
      return std::span(face).first(dimension == 0 ? 0 : dimension + 1);
    }
  };
  /// What certificates name: arcs by diagram and place in it, convex edges by boundary edge and
  /// leaf, corners by vertex, spokes and triangles by leaf and base.
  enum class Name : std::uint8_t { kArc, kConvexEdge, kCorner, kCone };
  using Key = std::tuple<Name, std::uint32_t, std::uint32_t>;

  std::vector<Cell> cell;
  std::vector<std::size_t> cones;  ///< by leaf
  std::map<Key, std::uint32_t> named;
  std::map<std::uint32_t, const FaceMap*> diagram;  ///< those that arcs are named by
};

/// Cells that are not gone, by origin.
[[nodiscard]] std::map<std::string, std::size_t> count_cells(const Complex& complex,
                                                             const std::vector<bool>& gone);

/// Glues the cones of all leaves. Throws Failure where two leaves disagree.
[[nodiscard]] Complex glue(const Exclusion& exclusion, const Algebra& algebra,
                           std::span<const CellNode> node, std::span<const Leaf> leaf,
                           const InterfaceMap& interface_map);

/// Over Z/2, of the cells that are not gone: a closed set.
[[nodiscard]] std::array<long, 3> betti_numbers(const Complex& complex,
                                                const std::vector<bool>& gone);

}  // namespace blum::verify
