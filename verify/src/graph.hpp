/// The graph on a rectangle as a certificate states it, compared with the one that was found.
#pragma once

#include "face.hpp"

namespace blum::verify {

struct GraphEnd {
  enum class Kind : std::uint8_t { kSide, kConvexEdge, kEvent, kLoop } kind = Kind::kLoop;
  std::uint32_t a = 0;  ///< side; boundary edge; event
  std::uint32_t b = 0;  ///< kSide: which of the side's changes
  auto operator<=>(const GraphEnd&) const = default;
};

struct GraphArc {
  std::array<GraphEnd, 2> end;  ///< both kLoop: closed, without an event
  std::array<Site, 2> site{};   ///< a governor on each side
};

struct GraphEvent {
  bool rim = false;
  std::array<double, 4> box{};  ///< u0, u1, v0, v1: holds this event and no other
};

struct Graph {
  std::vector<GraphEvent> event;
  std::vector<GraphArc> arc;
};

/// Is this the graph of `map`: the same arcs between the same ends, with governors of the regions
/// beside them, and boxes that isolate the events? Throws Failure. The arcs of `map` get the order
/// and the directions claimed, which the rest of the certificate refers to.
void check_graph(FaceMap& map, const Graph& claimed);

}  // namespace blum::verify
