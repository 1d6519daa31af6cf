#include "face_engine.hpp"

#include <map>
#include <vector>

#include "blum/kernel/check.hpp"

namespace blum {

// Where ∂O crosses the plane, and the border of box ∩ O.

Trouble FaceEngine::find_traces(Box& root) {
  const Solid& solid = context_.geometry.solid();
  const Rect& r = problem_.rect;
  if (context_.voronoi()) return find_corners_in_plane();
  std::map<std::uint32_t, std::uint32_t> point_of_edge;
  for (const auto t : problem_.triangles) {
    const auto& tri = solid.triangle[t];
    for (const auto v : tri.vertex)
      if (solid.point[v][r.axis] == r.level)
        return {FaceStatus::kBadPosition, "boundary vertex in the plane of a face"};
    std::array<std::uint32_t, 2> ends{};
    int n = 0;
    for (const auto e : tri.edge) {
      const Point3 &a = solid.point[solid.edge[e].vertex[0]],
                   &b = solid.point[solid.edge[e].vertex[1]];
      if ((a[r.axis] < r.level) == (b[r.axis] < r.level)) continue;
      const auto [it, fresh] =
          point_of_edge.try_emplace(e, static_cast<std::uint32_t>(trace_point_.size()));
      if (fresh) {
        const Ball s = divide(Ball(r.level) - Ball(a[r.axis]), Ball(b[r.axis]) - Ball(a[r.axis]));
        const auto coordinate = [&](int k) { return Ball(a[k]) + s * (Ball(b[k]) - Ball(a[k])); };
        trace_point_.push_back({e, coordinate(u_), coordinate(v_)});
      }
      ends[n++] = it->second;
    }
    if (n == 0) continue;
    BLUM_CHECK(n == 2);
    trace_[t] = ends;
    root.triangles.push_back(t);
  }
  return {};
}

bool FaceEngine::in_box(const TracePoint& p, const Box& box) {
  const Rect& r = problem_.rect;
  const auto side = [&](int axis, const Ball& approx, double value) {
    const int quick = (approx - Ball(value)).sign();
    return quick != 2
               ? quick
               : context_.predicates.compare_edge_crossing(p.edge, r.axis, r.level, axis, value);
  };
  return side(u_, p.u, box.u0) > 0 && side(u_, p.u, box.u1) < 0 && side(v_, p.v, box.v0) > 0 &&
         side(v_, p.v, box.v1) < 0;
}

FaceEngine::Border FaceEngine::border_of(const Box& box) {
  // The border as a cyclic sequence, counter-clockwise in (u, v).
  struct Item {
    bool interval = false;
    const Piece1* piece = nullptr;
    const Break* brk = nullptr;
    std::uint8_t side = 0;
  };
  std::vector<Item> item;
  for (const std::uint8_t s : {kLowV, kHighU, kHighV, kLowU}) {
    const Line& line = box.side[s];
    const bool forward = s == kLowV || s == kHighU;
    const auto n = line.piece.size();
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = forward ? k : n - 1 - k;
      if (k > 0) item.push_back({false, nullptr, &line.brk[forward ? i - 1 : i]});
      item.push_back({true, &line.piece[i], nullptr, s});
    }
  }
  const std::size_t n = item.size();

  // Where each triangle's trace leaves the box, and which of its ends lie inside.
  std::map<std::uint32_t, std::vector<std::size_t>> crossing_of;
  for (std::size_t i = 0; i < n; ++i)
    if (!item[i].interval && item[i].brk->point.kind == Breakpoint::Kind::kBoundary)
      crossing_of[item[i].brk->point.triangle].push_back(i);
  std::map<std::uint32_t, std::array<std::uint32_t, 2>> triangle_of_point;  // both sides of a point
  std::map<std::uint32_t, bool> used;
  const Solid& solid = context_.geometry.solid();
  std::map<std::uint32_t, bool> inside_point;
  const auto is_inside = [&](std::uint32_t p) {
    const auto [it, fresh] = inside_point.try_emplace(p, false);
    if (fresh) it->second = in_box(trace_point_[p], box);
    return it->second;
  };
  constexpr auto kNone = Breakpoint::kNone;
  std::map<std::uint32_t, bool> visited;
  // Follows ∂O from a crossing through the box; appends its triangles and convex edges.
  const auto follow = [&](std::size_t start, Circle& circle) -> std::size_t {
    std::uint32_t t = item[start].brk->point.triangle, came_from = kNone;
    for (;;) {
      visited[t] = true;
      circle.push_back({Step::Kind::kTrace, t, context_.geometry.index().face(t)});
      std::uint32_t next = kNone;
      for (const auto p : trace_.at(t))
        if (p != came_from && is_inside(p)) next = p;
      if (next == kNone) {
        const auto& c = crossing_of.at(t);
        for (const auto i : c)
          if (i != start) return i;
        broken_invariant("trace enters a box and does not leave it", __FILE__, __LINE__);
      }
      const auto e = trace_point_[next].edge;
      if (solid.edge[e].kind == EdgeKind::kConvex)
        circle.push_back({Step::Kind::kConvexEdge, e, {}});
      t = solid.edge[e].triangle[0] == t ? solid.edge[e].triangle[1] : solid.edge[e].triangle[0];
      came_from = next;
    }
  };

  Border border;
  std::vector<bool> done(n, false);
  for (std::size_t first = 0; first < n; ++first) {
    if (done[first] || !item[first].interval || !item[first].piece->inside) continue;
    Circle circle;
    std::size_t i = first;
    do {
      if (item[i].interval) {
        BLUM_CHECK(item[i].piece->inside && !done[i]);
        done[i] = true;
        circle.push_back(
            {Step::Kind::kInterval, item[i].piece->element, item[i].piece->witness, item[i].side});
      } else if (item[i].brk->point.kind == Breakpoint::Kind::kTie) {
        circle.push_back({Step::Kind::kTie, item[i].brk->id, {}});
      } else {
        i = follow(i, circle);
      }
      i = (i + 1) % n;
    } while (i != first);
    border.circle.push_back(std::move(circle));
  }
  for (const auto t : box.triangles) {
    if (visited[t]) continue;
    // A trace whose crossings were not walked: a closed loop, or a triangle outside this box.
    std::uint32_t x = t, came_from = kNone;
    bool loop = false;
    for (;;) {
      visited[x] = true;
      std::uint32_t next = kNone;
      for (const auto p : trace_.at(x))
        if (p != came_from && is_inside(p)) next = p;
      if (next == kNone) break;
      const auto e = trace_point_[next].edge;
      x = solid.edge[e].triangle[0] == x ? solid.edge[e].triangle[1] : solid.edge[e].triangle[0];
      came_from = next;
      if (x == t) {
        loop = true;
        break;
      }
    }
    if (loop) border.loop.push_back(t);
  }
  return border;
}

}  // namespace blum
