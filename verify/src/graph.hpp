/// The graph on a rectangle as a certificate states it, compared with the one that was found.
#pragma once

#include "face_map.hpp"

namespace blum::verify {

struct Graph {
  /// Kind; side, boundary edge or event; which of the side's changes.
  using End = std::array<std::uint32_t, 3>;
  enum Kind : std::uint32_t { kSide, kConvexEdge, kEvent, kLoop };
  struct Event {
    bool rim = false;
    /// u0, u1, v0, v1: holds this event, or a tree of events, and no other of its kind, unless
    /// these are nearer to each other than doubles, or as many claimed ones have this very box:
    /// such events are told by their arcs.
    std::array<double, 4> box{};
  };
  struct Arc {
    std::array<End, 2> end;    ///< both kLoop: closed, without an event
    std::array<Site, 2> site;  ///< a governor on each side
  };
  std::vector<Event> event;
  std::vector<Arc> arc;
};

/// Is this the graph of `map`: the same arcs between the same ends, with governors of the regions
/// beside them, and boxes that isolate the events? Throws Failure. Of `map`, trees of events
/// become one where that is claimed, and arcs get the order and the directions claimed, which the
/// rest of the certificate refers to.
void check_graph(FaceMap& map, const Graph& claimed);

}  // namespace blum::verify
