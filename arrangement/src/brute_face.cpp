// The oracle on a rectangle: names the parts of the map as FaceDiagram wants them.
#include <algorithm>
#include <map>

#include "blum/arrangement/brute_engine.hpp"
#include "blum/kernel/check.hpp"
#include "brute_map.hpp"

namespace blum {

using namespace brute;

namespace {

using Kind = Element::Kind;
using NodeKind = FaceNode::Kind;

std::size_t at(int k) { return static_cast<std::size_t>(k); }

/// Throws if a boundary vertex or edge lies on the rectangle.
void require_general_position(const Solid& solid, const Rect& r,
                              std::span<const std::uint32_t> triangles) {
  const int u = u_axis(r.axis), v = v_axis(r.axis);
  for (const std::uint32_t t : triangles)
    for (const std::uint32_t k : solid.triangle[t].vertex) {
      const Point3& p = solid.point[k];
      if (p[r.axis] == r.level && r.u0 <= p[u] && p[u] <= r.u1 && r.v0 <= p[v] && p[v] <= r.v1)
        throw BadPosition("a boundary vertex lies on the rectangle");
    }
}

class Assembler {
 public:
  Assembler(const FaceProblem& problem, FaceDiagram& out)
      : problem_(problem),
        solid_(*problem.solid),
        out_(out),
        s_(rect_setting(solid_, problem.rect, problem.candidates, problem.triangles,
                        problem.interior, problem.kind)),
        sweep_(sweep(s_)),
        map_(make_map(s_, sweep_)),
        node_of_(sweep_.element.size(), -1) {}

  void run() {
    regions();
    for (int side = 0; side < 4; ++side) walk(side);
    inner_nodes();
    boundary_nodes();
    arcs();
    traces();
  }

 private:
  const Element& element(int e) const { return sweep_.element[at(e)]; }
  int count() const { return static_cast<int>(sweep_.element.size()); }
  std::size_t degree(int e) const { return map_.sections[at(e)].size(); }

  void regions() {
    for (std::size_t r = 0; r < map_.labels.size(); ++r)
      out_.region.push_back({s_.ids(map_.labels[r]), map_.region_piece[r]});
    for (const std::uint32_t c : map_.circles) out_.piece.push_back({c});
  }

  /// The piece that holds the point or, for a point of the boundary, touches it there.
  std::uint32_t piece_at(int point) const {
    if (element(point).inside) return map_.piece[at(point)];
    for (int i = 0; i < count(); ++i) {
      const Element& e = element(i);
      if (e.kind == Kind::kSection && (e.beside[0] == point || e.beside[1] == point))
        for (const int k : {i, e.beside[2], e.beside[3]})
          if (k >= 0 && map_.piece[at(k)] != Map::kNone) return map_.piece[at(k)];
    }
    BLUM_CHECK(!"a node that touches no piece");
    return 0;
  }

  int add_node(int point, NodeKind kind) {
    const Element& e = element(point);
    const Fiber& fiber = *sweep_.critical[at(e.column)];
    FaceNode node;
    node.kind = kind;
    node.governors = s_.ids(e.governor);
    node.piece = piece_at(point);
    const Real& v = fiber.value(e.place);
    Real u;  // u = s - shear * v
    arb_mul(u.get(), v.get(), enclose(s_.shear, fiber.precision()).get(), fiber.precision());
    arb_sub(u.get(), fiber.abscissa().enclosure(fiber.precision()).get(), u.get(),
            fiber.precision());
    std::tie(node.u0, node.u1) = bounds(u);
    std::tie(node.v0, node.v1) = bounds(v);
    node_of_[at(point)] = static_cast<int>(out_.node.size());
    out_.node.push_back(std::move(node));
    return node_of_[at(point)];
  }

  /// Follows a side from its low end to its high end: the sweep goes along with it.
  void walk(int side) {
    std::map<int, int> points, sections;  // by column
    for (int i = 0; i < count(); ++i) {
      const Element& e = element(i);
      if ((e.sides >> side & 1u) == 0) continue;
      BLUM_CHECK(e.kind == Kind::kPoint || e.kind == Kind::kSection);
      (e.kind == Kind::kPoint ? points : sections)[e.column] = i;
    }
    BLUM_CHECK(points.size() == sections.size() + 1);
    const SegmentDiagram& diagram = *out_.side[at(side)];
    std::vector<std::uint32_t>& regions = out_.side_region[at(side)];
    for (const auto& [column, section] : sections) {
      const std::uint32_t region = map_.region[at(section)];
      const int point = points.at(column);
      const bool boundary = !element(point).triangle.empty();
      if (regions.empty() || map_.in_g[at(point)] || boundary) {
        if (!regions.empty()) {
          BLUM_CHECK(regions.size() <= diagram.breakpoint.size());
          const Breakpoint& b = diagram.breakpoint[regions.size() - 1];
          BLUM_CHECK((b.kind == Breakpoint::Kind::kBoundary) == boundary);
          if (!boundary) add_side_node(point, side, regions.size() - 1);
        }
        regions.push_back(region);
      }
      BLUM_CHECK(regions.back() == region);
    }
    BLUM_CHECK(regions.size() == diagram.interval.size());
    for (std::size_t k = 0; k < regions.size(); ++k)
      BLUM_CHECK((regions[k] != FaceDiagram::kOutside) == diagram.interval[k].inside);
  }

  void add_side_node(int point, int side, std::size_t breakpoint) {
    if (degree(point) != 1) throw BadPosition("a sheet touches a side");
    FaceNode& node = out_.node[at(add_node(point, NodeKind::kSide))];
    node.side = static_cast<std::uint8_t>(side);
    node.breakpoint = static_cast<std::uint32_t>(breakpoint);
    const Breakpoint& b = out_.side[at(side)]->breakpoint[breakpoint];
    const Rect& r = problem_.rect;
    if (side == kLowV || side == kHighV) {
      node.v0 = node.v1 = side == kLowV ? r.v0 : r.v1;
      node.u0 = b.lo;
      node.u1 = b.hi;
    } else {
      node.u0 = node.u1 = side == kLowU ? r.u0 : r.u1;
      node.v0 = b.lo;
      node.v1 = b.hi;
    }
  }

  void inner_nodes() {
    for (int i = 0; i < count(); ++i) {
      const Element& e = element(i);
      if (e.kind != Kind::kPoint || e.sides != 0 || !e.inside || !map_.in_g[at(i)]) continue;
      if (degree(i) != 2) add_node(i, degree(i) == 1 ? NodeKind::kRim : NodeKind::kEvent);
    }
  }

  void boundary_nodes() {
    for (int i = 0; i < count(); ++i) {
      const Element& e = element(i);
      if (e.kind != Kind::kPoint || e.triangle.size() < 2) {
        BLUM_CHECK(e.kind != Kind::kPoint || e.triangle.empty() || degree(i) == 0);
        continue;
      }
      const std::uint32_t edge = common_edge(e.triangle);
      const bool convex = solid_.edge[edge].kind == EdgeKind::kConvex;
      BLUM_CHECK(convex || degree(i) == 0);
      if (e.sides != 0) throw BadPosition("a boundary edge crosses a side");
      out_.trace_point.push_back({edge});
      if (convex) out_.node[at(add_node(i, NodeKind::kConvexEdge))].boundary_edge = edge;
    }
  }

  std::uint32_t common_edge(const std::vector<int>& triangles) const {
    if (triangles.size() == 2)
      for (const std::uint32_t a : solid_.triangle[s_.triangle[at(triangles[0])]].edge)
        for (const std::uint32_t b : solid_.triangle[s_.triangle[at(triangles[1])]].edge)
          if (a == b) return a;
    throw BadPosition("boundary triangles without a common edge meet on the rectangle");
  }

  /// Follows G from every node; what remains are loops, which get a node.
  void arcs() {
    std::vector<char> used(sweep_.element.size(), 0);
    const auto follow = [&](int start, int first) {
      int point = start, section = first;
      do {
        used[at(section)] = 1;
        const auto& ends = element(section).beside;
        point = ends[0] == point ? ends[1] : ends[0];
        if (node_of_[at(point)] >= 0) break;
        const auto& two = map_.sections[at(point)];
        BLUM_CHECK(two.size() == 2);
        section = two[0] == section ? two[1] : two[0];
      } while (true);
      const Element& e = element(first);
      const auto pair =
          s_.essential_pair(element(e.beside[2]).governor, element(e.beside[3]).governor);
      out_.arc.push_back({static_cast<std::uint32_t>(node_of_[at(start)]),
                          static_cast<std::uint32_t>(node_of_[at(point)]),
                          s_.site[at(pair->first)],
                          s_.site[at(pair->second)],
                          {map_.region[at(e.beside[2])], map_.region[at(e.beside[3])]}});
    };
    for (const bool loops : {false, true}) {
      for (int i = 0; i < count(); ++i) {
        if (loops && node_of_[at(i)] < 0 && degree(i) == 2 && !used[at(map_.sections[at(i)][0])])
          add_node(i, NodeKind::kEvent);
        if (node_of_[at(i)] < 0) continue;
        for (const int section : map_.sections[at(i)])
          if (!used[at(section)]) follow(i, section);
      }
    }
  }

  void traces() {
    std::map<int, std::uint32_t> region;  // by triangle
    for (int i = 0; i < count(); ++i) {
      const Element& e = element(i);
      if (e.kind != Kind::kSection || e.triangle.empty()) continue;
      BLUM_CHECK(e.sides == 0);
      const int inner = element(e.beside[2]).inside ? e.beside[2] : e.beside[3];
      BLUM_CHECK(element(e.beside[2]).inside != element(e.beside[3]).inside);
      const auto [it, fresh] = region.try_emplace(e.triangle[0], map_.region[at(inner)]);
      BLUM_CHECK(it->second == map_.region[at(inner)]);
    }
    for (const auto& [t, r] : region) out_.trace.push_back({s_.triangle[at(t)], r});
    std::sort(out_.trace_point.begin(), out_.trace_point.end(),
              [](const auto& a, const auto& b) { return a.boundary_edge < b.boundary_edge; });
  }

  const FaceProblem& problem_;
  const Solid& solid_;
  FaceDiagram& out_;
  const Setting s_;
  const Sweep sweep_;
  const Map map_;
  std::vector<int> node_of_;
};

}  // namespace

namespace {

FaceDiagram failed(const Rect& rect, FaceStatus status, const char* reason) {
  FaceDiagram d;
  d.rect = rect;
  d.status = status;
  d.reason = reason;
  return d;
}

}  // namespace

FaceDiagram brute_face(const FaceProblem& problem) {
  FaceDiagram out;
  out.rect = problem.rect;
  try {
    BLUM_CHECK(problem.rect.u0 < problem.rect.u1 && problem.rect.v0 < problem.rect.v1);
    require_general_position(*problem.solid, problem.rect, problem.triangles);
    for (int side = 0; side < 4; ++side) {
      auto diagram =
          brute_segment(*problem.solid, side_segment(problem.rect, side), problem.candidates,
                        problem.triangles, problem.interior, problem.kind);
      if (!diagram) throw BadPosition("side " + std::to_string(side) + " is in bad position");
      out.side[at(side)] = std::make_shared<const SegmentDiagram>(std::move(*diagram));
    }
    Assembler(problem, out).run();
  } catch (const BadPosition& e) {
    return failed(problem.rect, FaceStatus::kBadPosition, e.what());
  } catch (const PrecisionSpent& e) {
    return failed(problem.rect, FaceStatus::kUndecided, e.what());
  }
  return out;
}

}  // namespace blum
