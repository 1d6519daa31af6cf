/// Triangles by columns over the (x, y) plane, and exact crossings of vertical rays with them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "blum/kernel/point.hpp"
#include "exact_geometry.hpp"

namespace blum {

/// How the ray from p in direction +z meets a triangle.
enum class RayHit : std::uint8_t { kNone, kCrosses, kOnTriangle };

/// Exact. p stands for p + (t, t^2, 0), t infinitesimal, once it is known not to lie on the
/// triangle: so a ray through edges or vertices crosses a closed surface in a consistent way.
[[nodiscard]] RayHit hit_above(const Point3& p, const exact::Triangle& t, const Box3& box);
/// The same by exact arithmetic alone, without box tests.
[[nodiscard]] RayHit hit_above_exact(const Point3& p, const exact::Triangle& t);

class Columns {
 public:
  explicit Columns(std::vector<exact::Triangle> triangles);

  /// Calls crossed(i) for each triangle i that the ray from p upwards crosses. Returns true, at
  /// once, if p lies on a triangle.
  template <class Crossed>
  bool cast_up(const Point3& p, Crossed&& crossed) const {
    if (!(p.x >= box_.lo.x && p.x <= box_.hi.x && p.y >= box_.lo.y && p.y <= box_.hi.y &&
          p.z <= box_.hi.z)) {
      return false;
    }
    const std::size_t cell = cell_of(p.x, p.y);
    for (std::uint32_t k = cell_begin_[cell]; k < cell_begin_[cell + 1]; ++k) {
      const Item& item = items_[cell_item_[k]];
      if (item.box.hi.z < p.z) break;  // the cell's triangles go from high to low
      switch (hit_above(p, item.triangle, item.box)) {
        case RayHit::kNone:
          break;
        case RayHit::kOnTriangle:
          return true;
        case RayHit::kCrosses:
          crossed(cell_item_[k]);
          break;
      }
    }
    return false;
  }

  /// cast_up for a point that lies on triangles which do not matter: goes on past them.
  template <class Crossed>
  void cast_up_past(const Point3& p, Crossed&& crossed) const {
    const std::size_t cell = cell_of(p.x, p.y);
    for (std::uint32_t k = cell_begin_[cell]; k < cell_begin_[cell + 1]; ++k) {
      const Item& item = items_[cell_item_[k]];
      if (hit_above(p, item.triangle, item.box) == RayHit::kCrosses) crossed(cell_item_[k]);
    }
  }

  [[nodiscard]] std::size_t size() const { return items_.size(); }
  [[nodiscard]] const exact::Triangle& triangle(std::size_t i) const { return items_[i].triangle; }

 private:
  struct Item {
    exact::Triangle triangle;
    Box3 box;
  };
  void choose_grid(double cells);
  [[nodiscard]] int column(double x) const;
  [[nodiscard]] int row(double y) const;
  [[nodiscard]] std::size_t cell_of(double x, double y) const {
    return static_cast<std::size_t>(row(y)) * nx_ + column(x);
  }

  std::vector<Item> items_;
  std::vector<std::uint32_t> cell_begin_, cell_item_;
  int nx_ = 1, ny_ = 1;
  double scale_x_ = 0, scale_y_ = 0;
  Box3 box_;
};

}  // namespace blum
