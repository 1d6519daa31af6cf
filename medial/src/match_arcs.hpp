/// A diagram that was decided twice, perhaps with other candidates: which arc is which.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "blum/arrangement/face_diagram.hpp"

namespace blum {

struct ArcMatch {
  std::uint32_t arc = 0;
  bool reversed = false;
  friend bool operator==(const ArcMatch&, const ArcMatch&) = default;
};

/// For each arc of `a` the one of `b`; nullopt if the graphs differ. Nodes on sides and on convex
/// edges are told apart by what they are, others by their arcs. Where that leaves a choice, it
/// makes no difference: an exchange that fixes all nodes that other diagrams have too maps the
/// cones over the two graphs, and so the complex, onto itself.
[[nodiscard]] std::optional<std::vector<ArcMatch>> match_arcs(const FaceDiagram& a,
                                                              const FaceDiagram& b);

}  // namespace blum
