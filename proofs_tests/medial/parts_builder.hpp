/// Builds cell complexes by hand, for tests and benchmarks: nodes, arcs, and cones over sets of
/// arcs; and the complex of a grid of planes, whose parts are known in closed form.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <span>
#include <vector>

#include "blum/medial/complex.hpp"

namespace blum::fixtures {

class ConeComplexBuilder {
 public:
  using Kind = ComplexVertex::Kind;

  std::uint32_t node(Kind kind = Kind::kArcPoint, Point3 position = {}) {
    ComplexVertex v;
    v.position = position;
    v.kind = kind;
    v.on_axis = kind != Kind::kCone;
    complex_.vertex.push_back(v);
    return static_cast<std::uint32_t>(complex_.vertex.size() - 1);
  }

  std::uint32_t arc(std::uint32_t a, std::uint32_t b,
                    ComplexEdge::Kind kind = ComplexEdge::Kind::kArc) {
    ComplexEdge e;
    e.vertex = {a, b};
    e.kind = kind;
    complex_.edge.push_back(e);
    return static_cast<std::uint32_t>(complex_.edge.size() - 1);
  }

  std::uint32_t convex_edge(std::uint32_t a, std::uint32_t b) {
    return arc(a, b, ComplexEdge::Kind::kConvexEdge);
  }

  /// Adds apex, cone edges and triangles; returns the index of the cone.
  std::uint32_t cone(std::span<const std::uint32_t> arcs,
                     std::uint32_t boundary_vertex = ComplexCone::kNone, Point3 position = {}) {
    const auto index = static_cast<std::uint32_t>(complex_.cone.size());
    complex_.cone.push_back({index, node(Kind::kCone, position), boundary_vertex});
    above_.clear();
    for (const std::uint32_t a : arcs) {
      const auto ends = complex_.edge[a].vertex;
      ComplexTriangle t;
      t.edge = {a, edge_above(ends[0]), edge_above(ends[1])};
      t.cone = index;
      t.governors = complex_.edge[a].governors;
      complex_.triangle.push_back(t);
    }
    return index;
  }
  std::uint32_t cone(std::initializer_list<std::uint32_t> arcs,
                     std::uint32_t boundary_vertex = ComplexCone::kNone) {
    return cone(std::span(arcs.begin(), arcs.size()), boundary_vertex);
  }

  [[nodiscard]] CellComplex& complex() { return complex_; }

 private:
  std::uint32_t edge_above(std::uint32_t node) {
    for (const auto& [n, e] : above_) {
      if (n == node) return e;
    }
    const std::uint32_t e = arc(node, complex_.cone.back().apex, ComplexEdge::Kind::kCone);
    complex_.edge[e].leaf = static_cast<std::uint32_t>(complex_.cone.size() - 1);
    above_.push_back({node, e});
    return e;
  }

  CellComplex complex_;
  std::vector<std::array<std::uint32_t, 2>> above_;  ///< node, cone edge of the current cone
};

/// The union of axis-parallel planes through the middles of the cells of an n[0] x n[1] x n[2] grid
/// of leaves, cut off by the grid's box: has[a][i] says whether the i-th layer along axis a holds a
/// plane orthogonal to a. Leaves with one plane are loops, with two seams, with three clusters.
struct PlaneGrid {
  std::array<std::vector<bool>, 3> has;

  [[nodiscard]] long planes(int axis) const {
    long count = 0;
    for (const bool b : has[axis]) count += b ? 1 : 0;
    return count;
  }
  [[nodiscard]] long sheets() const {
    const long x = planes(0), y = planes(1), z = planes(2);
    return x * (y + 1) * (z + 1) + y * (x + 1) * (z + 1) + z * (x + 1) * (y + 1);
  }
  [[nodiscard]] long seams() const {
    const long x = planes(0), y = planes(1), z = planes(2);
    return x * y * (z + 1) + y * z * (x + 1) + z * x * (y + 1);
  }
  [[nodiscard]] long clusters() const { return planes(0) * planes(1) * planes(2); }
  /// For at least two families with planes in them: the union is connected.
  [[nodiscard]] std::array<long, 3> betti() const {
    const long x = planes(0), y = planes(1), z = planes(2);
    const long chi = x + y + z - (x * y + y * z + z * x) + x * y * z;  // all parts contractible
    const long b2 = x > 0 && y > 0 && z > 0 ? (x - 1) * (y - 1) * (z - 1) : 0;
    return {1, 1 + b2 - chi, b2};
  }

  [[nodiscard]] CellComplex build() const;

 private:
  using Key = std::array<int, 3>;
  class Assembly;
};

/// Positions on the doubled grid: even coordinates on cell faces, odd ones in cell middles.
class PlaneGrid::Assembly {
 public:
  explicit Assembly(const PlaneGrid& grid) : grid_(grid) {}

  CellComplex build() {
    std::vector<std::uint32_t> arcs;
    const auto size = [&](int a) { return static_cast<int>(grid_.has[a].size()); };
    for (int i = 0; i < size(0); ++i) {
      for (int j = 0; j < size(1); ++j) {
        for (int k = 0; k < size(2); ++k) {
          arcs.clear();
          const Key middle{2 * i + 1, 2 * j + 1, 2 * k + 1};
          for (int normal = 0; normal < 3; ++normal) {
            for (const int side : {-1, 1}) arcs_on_face(middle, normal, side, arcs);
          }
          if (!arcs.empty()) {
            builder_.cone(arcs, ComplexCone::kNone, position(middle));
          }
        }
      }
    }
    return std::move(builder_.complex());
  }

 private:
  [[nodiscard]] bool plane_at(const Key& middle, int axis) const {
    return grid_.has[axis][static_cast<std::size_t>(middle[axis] / 2)];
  }
  static Point3 position(const Key& k) { return {k[0] * 0.5, k[1] * 0.5, k[2] * 0.5}; }

  std::uint32_t node(const Key& key, ComplexVertex::Kind kind) {
    const auto [place, added] = nodes_.try_emplace(key, 0);
    if (added) place->second = builder_.node(kind, position(key));
    return place->second;
  }

  /// On the face, each plane `axis` leaves a line through the middle along the third axis, in one
  /// arc or, where the other plane crosses it, in two.
  void arcs_on_face(const Key& middle, int normal, int side, std::vector<std::uint32_t>& arcs) {
    Key centre = middle;
    centre[normal] += side;
    for (const int axis : {u_axis(normal), v_axis(normal)}) {
      const int along = 3 - normal - axis;
      if (!plane_at(middle, axis)) continue;
      Key lo = centre, hi = centre;
      --lo[along];
      ++hi[along];
      const std::uint32_t a = node(lo, ComplexVertex::Kind::kArcPoint);
      const std::uint32_t b = node(hi, ComplexVertex::Kind::kArcPoint);
      if (plane_at(middle, along)) {
        const std::uint32_t event = node(centre, ComplexVertex::Kind::kEvent);
        arcs.push_back(arc(a, event));
        arcs.push_back(arc(event, b));
      } else {
        arcs.push_back(arc(a, b));
      }
    }
  }

  std::uint32_t arc(std::uint32_t a, std::uint32_t b) {
    const auto [place, added] = arcs_.try_emplace({a, b}, 0);
    if (added) place->second = builder_.arc(a, b);
    return place->second;
  }

  const PlaneGrid& grid_;
  ConeComplexBuilder builder_;
  std::map<Key, std::uint32_t> nodes_;
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> arcs_;
};

inline CellComplex PlaneGrid::build() const { return Assembly(*this).build(); }

}  // namespace blum::fixtures
