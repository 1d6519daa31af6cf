/// The complex that the leaves give (docs/proofs.md, "Gluing"), and its Betti numbers.
#pragma once

#include <functional>

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
  std::array<FaceMap, 6> face;
};

/// Asked for the diagram on a rectangle between two leaves that is no face of either.
using InterfaceMap = std::function<const FaceMap&(const Rect&)>;

struct Complex {
  std::size_t vertices = 0;
  std::vector<std::array<std::uint32_t, 2>> edge;
  std::vector<std::array<std::uint32_t, 3>> triangle;  ///< edges
  std::vector<std::size_t> cones;                      ///< by leaf
  std::map<const char*, std::size_t> cells;            ///< by origin, as named in certificates
};

/// Glues the cones of all leaves. Throws Failure where two leaves disagree.
[[nodiscard]] Complex glue(const Exclusion& exclusion, std::span<const CellNode> node,
                           std::span<const Leaf> leaf, const InterfaceMap& interface_map);

/// Over Z/2.
[[nodiscard]] std::array<long, 3> betti_numbers(const Complex& complex);

}  // namespace blum::verify
