#include "mesh_box_tree.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace blum {

Box3 box_of(const Point3& a, const Point3& b, const Point3& c) {
  return {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
          {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}};
}

Box3 box_union(const Box3& a, const Box3& b) {
  return {{std::min(a.lo.x, b.lo.x), std::min(a.lo.y, b.lo.y), std::min(a.lo.z, b.lo.z)},
          {std::max(a.hi.x, b.hi.x), std::max(a.hi.y, b.hi.y), std::max(a.hi.z, b.hi.z)}};
}

BoxTree::BoxTree(std::vector<Box3> boxes) : box_(std::move(boxes)), item_(box_.size()) {
  std::iota(item_.begin(), item_.end(), 0u);
  if (!item_.empty()) {
    node_.reserve(box_.size());
    build(0, static_cast<std::uint32_t>(item_.size()));
  }
}

std::uint32_t BoxTree::build(std::uint32_t begin, std::uint32_t end) {
  constexpr std::uint32_t kLeafSize = 4;
  const auto at = static_cast<std::uint32_t>(node_.size());
  Box3 all = box_[item_[begin]];
  for (std::uint32_t k = begin + 1; k < end; ++k) all = box_union(all, box_[item_[k]]);
  node_.push_back({all, begin, end, 0});
  if (end - begin <= kLeafSize) return at;
  const auto middle_of = [&](std::uint32_t i, int axis) {
    return 0.5 * box_[i].lo[axis] + 0.5 * box_[i].hi[axis];
  };
  int axis = 0;
  double widest = -1;
  for (int k = 0; k < 3; ++k) {
    const double width = all.hi[k] - all.lo[k];
    if (width > widest) {
      widest = width;
      axis = k;
    }
  }
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(item_.begin() + begin, item_.begin() + middle, item_.begin() + end,
                   [&](std::uint32_t i, std::uint32_t j) {
                     const double x = middle_of(i, axis), y = middle_of(j, axis);
                     return x < y || (x == y && i < j);
                   });
  build(begin, middle);
  const std::uint32_t right = build(middle, end);
  node_[at].right = right;
  return at;
}

}  // namespace blum
