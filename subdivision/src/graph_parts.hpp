/// Shapes of the components of a cell's graph.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "blum/kernel/union_find.hpp"
#include "blum/subdivision/graph_shape.hpp"

namespace blum {

/// Has every component the shape of a part of a sheet, a seam or a junction? `graph` joins the ends
/// of the arcs.
[[nodiscard]] inline bool shapes_are_simple(UnionFind& graph,
                                            std::span<const std::array<std::uint32_t, 2>> arcs) {
  std::map<std::uint32_t, std::vector<std::array<std::uint32_t, 2>>> arcs_of;
  for (const auto& a : arcs) arcs_of[graph.find(a[0])].push_back(a);
  for (auto& [root, list] : arcs_of) {
    std::map<std::uint32_t, std::uint32_t> local;
    for (auto& a : list)
      for (auto& n : a)
        n = local.try_emplace(n, static_cast<std::uint32_t>(local.size())).first->second;
    if (graph_shape(static_cast<std::uint32_t>(local.size()), list) == GraphShape::kOther)
      return false;
  }
  return true;
}

}  // namespace blum
