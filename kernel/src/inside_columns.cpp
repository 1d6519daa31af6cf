#include "inside_columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mesh_box_tree.hpp"

namespace blum {
namespace {

/// Side of p of the directed line ab in the (x, y) plane, p perturbed when it is on the line: the
/// derivatives of orient2d along x, then y.
int perturbed(int side, const Point3& a, const Point3& b) {
  if (side != 0) return side;
  if (a.y != b.y) return a.y > b.y ? 1 : -1;
  return a.x < b.x ? 1 : -1;
}

template <class Orient2d, class Orient3d>
RayHit hit(const Point3& p, const exact::Triangle& t, Orient2d&& orient2d, Orient3d&& orient3d) {
  const auto side = [&](int i, int j) {
    return orient2d(t[i].x, t[i].y, t[j].x, t[j].y, p.x, p.y);
  };
  const int s0 = side(0, 1);
  const int s1 = side(1, 2);
  if (s0 * s1 < 0) return RayHit::kNone;
  const int s2 = side(2, 0);
  if (s0 * s2 < 0 || s1 * s2 < 0) return RayHit::kNone;
  const int up = orient2d(t[0].x, t[0].y, t[1].x, t[1].y, t[2].x, t[2].y);
  if (up == 0) {
    // Upright: the perturbed ray misses it, p itself may lie on it.
    return exact::point_in_triangle(p, t) ? RayHit::kOnTriangle : RayHit::kNone;
  }
  // The triangle's normal points up iff up > 0; p is below iff it is on the other side.
  const int above = orient3d(t[0], t[1], t[2], p) * up;
  if (above == 0) return RayHit::kOnTriangle;
  if (above > 0) return RayHit::kNone;
  const bool in = perturbed(s0, t[0], t[1]) == up && perturbed(s1, t[1], t[2]) == up &&
                  perturbed(s2, t[2], t[0]) == up;
  return in ? RayHit::kCrosses : RayHit::kNone;
}

}  // namespace

RayHit hit_above(const Point3& p, const exact::Triangle& t, const Box3& box) {
  if (p.x < box.lo.x || p.x > box.hi.x || p.y < box.lo.y || p.y > box.hi.y || p.z > box.hi.z) {
    return RayHit::kNone;
  }
  return hit(p, t, exact::orient2d, exact::orient3d);
}

RayHit hit_above_exact(const Point3& p, const exact::Triangle& t) {
  return hit(p, t, exact::orient2d_exact, exact::orient3d_exact);
}

Columns::Columns(std::vector<exact::Triangle> triangles) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  box_ = {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  items_.reserve(triangles.size());
  for (const exact::Triangle& t : triangles) {
    items_.push_back({t, box_of(t[0], t[1], t[2])});
    box_ = box_union(box_, items_.back().box);
  }
  if (items_.empty()) {
    cell_begin_ = {0, 0};
    return;
  }
  const auto for_each_cell = [&](const Item& item, auto&& visit) {
    const int x0 = column(item.box.lo.x), x1 = column(item.box.hi.x);
    const int y0 = row(item.box.lo.y), y1 = row(item.box.hi.y);
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) visit(static_cast<std::size_t>(y) * nx_ + x);
    }
  };
  // Cells about square, a few a triangle, fewer when triangles are wide: the lists stay linear.
  // Column and row are monotone in the coordinate, rounding included, so a point in the box of a
  // triangle falls in one of the cells that list it.
  const auto n = static_cast<double>(items_.size());
  for (double target = std::min(4.0 * n + 1, 4e6);; target /= 4) {
    choose_grid(target);
    double entries = 0;
    for (const Item& item : items_) {
      entries += (1.0 + column(item.box.hi.x) - column(item.box.lo.x)) *
                 (1.0 + row(item.box.hi.y) - row(item.box.lo.y));
    }
    if (entries <= 40 * n + 1000 || nx_ * ny_ == 1) break;
  }
  const auto cells = static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_);
  cell_begin_.assign(cells + 1, 0);
  std::vector<std::uint32_t> order(items_.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    return items_[i].box.hi.z > items_[j].box.hi.z;
  });
  for (const Item& item : items_) for_each_cell(item, [&](std::size_t c) { ++cell_begin_[c + 1]; });
  for (std::size_t c = 0; c < cells; ++c) cell_begin_[c + 1] += cell_begin_[c];
  cell_item_.resize(cell_begin_.back());
  std::vector<std::uint32_t> fill(cell_begin_.begin(), cell_begin_.end() - 1);
  for (const std::uint32_t i : order) {
    for_each_cell(items_[i], [&](std::size_t c) { cell_item_[fill[c]++] = i; });
  }
}

void Columns::choose_grid(double cells) {
  nx_ = ny_ = 1;
  scale_x_ = scale_y_ = 0;
  const double width = box_.hi.x - box_.lo.x, height = box_.hi.y - box_.lo.y;
  if (!(width > 0 && height > 0)) return;
  const auto nx = static_cast<int>(std::clamp(std::sqrt(cells * (width / height)), 1.0, 4096.0));
  const auto ny = static_cast<int>(std::clamp(cells / nx, 1.0, 4096.0));
  if (!std::isfinite(nx / width) || !std::isfinite(ny / height)) return;  // a tiny model
  nx_ = nx;
  ny_ = ny;
  scale_x_ = nx / width;
  scale_y_ = ny / height;
}

int Columns::column(double x) const {
  return static_cast<int>(std::clamp((x - box_.lo.x) * scale_x_, 0.0, nx_ - 1.0));
}

int Columns::row(double y) const {
  return static_cast<int>(std::clamp((y - box_.lo.y) * scale_y_, 0.0, ny_ - 1.0));
}

}  // namespace blum
