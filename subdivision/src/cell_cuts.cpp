// Theorem E: planes that miss the axis in the cell and part the components of its graph.

#include <algorithm>
#include <cmath>
#include <limits>

#include "blum/kernel/check.hpp"
#include "cell_surface.hpp"

namespace blum {
namespace {

// Measured on couplingdown: of 325 planes that missed the axis 322 lay in a slab of a 25th of the
// cell or more, and 316 were among the first six; of 3000 that did not, 2100 lay in a thinner one.
constexpr double kThinnestSlab = 0.04;
constexpr std::size_t kMaxGivenUp = 6;
constexpr std::size_t kMaxUnits = 6;

double squared_distance(const Point3& a, const Point3& b) {
  double d = 0;
  for (int k = 0; k < 3; ++k) d += (a[k] - b[k]) * (a[k] - b[k]);
  return d;
}

bool before(const Point3& a, const Point3& b) {
  return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
}

/// Does the segment from a to b cross the plane strictly inside the box? 1: yes, -1: it crosses it
/// outside, 0: undecided. Requires: its ends lie on different sides for certain.
int crossing_inside(const CutPlane& plane, const Point3& a, const Point3& b, const Box3& box) {
  const auto height = [&](const Point3& x) {
    Ball h(-plane.offset);
    for (int k = 0; k < 3; ++k)
      h = h + Ball(plane.normal[static_cast<std::size_t>(k)]) * Ball(x[k]);
    return h;
  };
  const Ball s = divide(height(a), height(a) - height(b));
  bool inside = true;
  for (int k = 0; k < 3; ++k) {
    const Ball x = Ball(a[k]) + s * (Ball(b[k]) - Ball(a[k]));
    const int low = (x - Ball(box.lo[k])).sign(), high = (Ball(box.hi[k]) - x).sign();
    if (low == -1 || high == -1) return -1;
    inside = inside && low == 1 && high == 1;
  }
  return inside ? 1 : 0;
}

}  // namespace

Box3 CellSurface::enclosure(int f, const FaceNode& node) const {
  const Rect& r = face_[f]->rect;
  return {point_on(r.axis, r.level, node.u0, node.v0), point_on(r.axis, r.level, node.u1, node.v1)};
}

void CellSurface::describe(Components& component) {
  node_box_.resize(graph_.size());
  for (int f = 0; f < 6; ++f)
    for (std::uint32_t n = 0; n < face_[f]->node.size(); ++n)
      node_box_[node(f, n)] = enclosure(f, face_[f]->node[n]);
  for (const auto& [at, n] : vertex_node_)
    node_box_[n] = {solid_.point[at[0]], solid_.point[at[0]]};
  for (Component& c : component) {
    for (std::uint32_t n = 0; n < graph_.size(); ++n) {
      if (graph_.find(n) != c.root) continue;
      const Box3& b = node_box_[n];
      c.node.push_back(b);
      Point3 middle;
      for (int k = 0; k < 3; ++k) middle[k] = 0.5 * b.lo[k] + 0.5 * b.hi[k];
      c.seen.push_back(middle);
    }
    std::sort(c.seen.begin(), c.seen.end(), before);
    for (int f = 0; f < 6; ++f)
      for (const FaceArc& a : face_[f]->arc)
        if (graph_.find(node(f, a.from)) == c.root) c.tie.push_back({a.left, a.right});
    for (const auto& [e, nodes] : edge_)
      if (nodes.size() == 2 && solid_.edge[e].kind == EdgeKind::kConvex &&
          graph_.find(nodes[0]) == c.root) {
        const auto& t = solid_.edge[e].triangle;
        c.tie.push_back({geometry_.index().face(t[0]), geometry_.index().face(t[1])});
      }
  }
}

bool CellSurface::is_transversal(const CutPlane& plane) const {
  // Every piece of the section is a disk unless ∂O crosses the plane in a loop inside the cell: in
  // a chain of triangles whose traces all end inside.
  std::map<std::uint32_t, int> side;
  const auto side_at = [&](std::uint32_t v) {
    const auto [it, fresh] = side.try_emplace(v, 0);
    if (fresh) it->second = side_of(plane, solid_.point[v]);
    return it->second;
  };
  for (const auto v : vertex_)
    if (std::abs(side_at(v)) != 1) return false;
  UnionFind chain;
  std::vector<bool> reaches;                      // the cell's faces
  std::map<std::uint32_t, std::uint32_t> end_of;  // boundary edge -> a triangle's link
  for (const auto& [t, element] : triangle_) {
    const SolidTriangle& triangle = solid_.triangle[t];
    const std::uint32_t link = chain.add();
    reaches.push_back(false);
    for (const auto v : triangle.vertex)
      if (std::abs(side_at(v)) != 1) return false;
    bool crossed = false;
    for (const auto e : triangle.edge) {
      const auto [v, w] = solid_.edge[e].vertex;
      if (side_at(v) == side_at(w)) continue;
      crossed = true;
      const int inside = crossing_inside(plane, solid_.point[v], solid_.point[w], box_);
      if (inside == 0) return false;
      if (inside < 0) {
        reaches[link] = true;
      } else if (solid_.edge[e].kind == EdgeKind::kConvex) {
        return false;  // the axis reaches the convex edge
      } else if (const auto [it, fresh] = end_of.try_emplace(e, link); !fresh) {
        chain.unite(it->second, link);
      }
    }
    if (!crossed) reaches[link] = true;  // no trace
  }
  std::vector<bool> open(reaches.size(), false);
  for (std::uint32_t l = 0; l < reaches.size(); ++l)
    if (reaches[l]) open[chain.find(l)] = true;
  for (std::uint32_t l = 0; l < reaches.size(); ++l)
    if (!open[chain.find(l)]) return false;
  return true;
}

bool CellSurface::take_sides(Components& component, const CutPlane& plane) const {
  std::vector<int> of(component.size(), 0);
  for (std::size_t i = 0; i < component.size(); ++i) {
    for (const Box3& b : component[i].node) {
      const int s = side_of(plane, b);
      if (s != 1 && s != -1) continue;
      // The plane misses the axis, so a component cannot lie on both sides.
      BLUM_CHECK(of[i] == 0 || of[i] == s);
      of[i] = s;
    }
    if (of[i] == 0) return false;
  }
  for (std::size_t i = 0; i < component.size(); ++i) component[i].side.push_back(of[i]);
  return true;
}

bool CellSurface::part(Components& component, std::span<const Members> unit, CellAnswer& answer) {
  if (unit.size() > kMaxUnits) return false;
  double size = 0;
  for (int k = 0; k < 3; ++k) size = std::max(size, box_.hi[k] - box_.lo[k]);
  while (static_cast<std::size_t>(answer.planes_tried) < answer.cut.size() + kMaxGivenUp) {
    std::optional<PlaneBetween> best;
    for (std::uint32_t set = 1; set < (1u << (unit.size() - 1)); ++set) {
      std::array<std::vector<Point3>, 2> points;
      for (std::size_t u = 0; u < unit.size(); ++u)
        for (const Component* c : unit[u]) {
          auto& p = points[(set >> u) & 1u];
          p.insert(p.end(), c->seen.begin(), c->seen.end());
        }
      const auto between = plane_between(points[0], points[1]);
      if (between && (!best || between->gap > best->gap)) best = between;
    }
    if (!best || best->gap < kThinnestSlab * size) return false;
    ++answer.planes_tried;
    if (!is_transversal(best->plane)) return false;
    const SectionAnswer section = oracles_.section(best->plane);
    if (section.clear) {
      if (!take_sides(component, best->plane)) return false;
      answer.cut.push_back(best->plane);
      const int first = unit.front().front()->side.back();
      return std::ranges::any_of(unit, [&](const Members& members) {
        return std::ranges::any_of(members,
                                   [&](const Component* c) { return c->side.back() != first; });
      });
    }
    // What was met belongs to the nearest component, of those with the same tie if there are any.
    Component* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const bool same_tie : {true, false}) {
      for (const Members& members : unit)
        for (Component* c : members) {
          const auto& [a, b] = section.tie;
          if (same_tie && std::ranges::none_of(c->tie, [&](const auto& t) {
                return (t[0] == a && t[1] == b) || (t[0] == b && t[1] == a);
              }))
            continue;
          for (const Point3& p : c->seen)
            if (const double d = squared_distance(p, section.near); d < least) {
              least = d;
              nearest = c;
            }
        }
      if (nearest != nullptr) break;
    }
    nearest->seen.insert(
        std::upper_bound(nearest->seen.begin(), nearest->seen.end(), section.near, before),
        section.near);
  }
  return false;
}

bool CellSurface::parted_by_planes(Components& component, CellAnswer& answer) {
  if (!oracles_.section) return false;
  describe(component);
  // In the order of their places: no choice below depends on how sites are numbered.
  std::ranges::stable_sort(component, [](const Component& a, const Component& b) {
    return a.surface != b.surface ? a.surface < b.surface : before(a.seen.front(), b.seen.front());
  });
  for (std::size_t first = 0, end = 0; first < component.size(); first = end) {
    while (end < component.size() && component[end].surface == component[first].surface) ++end;
    // One class of joined components need not be parted: the largest.
    std::map<std::uint32_t, int> size;
    for (std::size_t i = first; i < end; ++i) ++size[component[i].joined];
    std::uint32_t spared = component[first].joined;
    for (std::size_t i = first; i < end; ++i)
      if (size[component[i].joined] > size[spared]) spared = component[i].joined;
    for (bool done = false; !done;) {
      done = true;
      std::map<std::vector<int>, std::vector<Members>> together;
      for (std::size_t i = first; i < end; ++i) {
        auto& units = together[component[i].side];
        Component& c = component[i];
        const auto same = std::ranges::find_if(units, [&](const Members& m) {
          return c.joined == spared && m.front()->joined == spared;
        });
        if (same != units.end())
          same->push_back(&c);
        else
          units.push_back({&c});
      }
      for (const auto& [side, units] : together) {
        if (units.size() < 2) continue;
        if (!part(component, units, answer)) return false;
        done = false;
        break;
      }
    }
  }
  return true;
}

}  // namespace blum
