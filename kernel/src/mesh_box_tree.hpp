/// A bounding volume hierarchy over boxes: which of them meet a given box?
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "blum/kernel/point.hpp"

namespace blum {

[[nodiscard]] inline bool boxes_meet(const Box3& a, const Box3& b) {
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y &&
         a.lo.z <= b.hi.z && b.lo.z <= a.hi.z;
}

[[nodiscard]] Box3 box_of(const Point3& a, const Point3& b, const Point3& c);
[[nodiscard]] Box3 box_union(const Box3& a, const Box3& b);

/// Built by median splits of the longest side; the shape depends on the boxes alone.
class BoxTree {
 public:
  struct Node {
    Box3 box;
    std::uint32_t begin = 0, end = 0;  ///< items of the subtree, in item()
    std::uint32_t right = 0;           ///< 0: a leaf; the left child is the next node
  };

  explicit BoxTree(std::vector<Box3> boxes);

  /// Calls visit(i) for each box i that meets `query` (closed boxes), in no particular order.
  template <class Visit>
  void visit_meeting(const Box3& query, Visit&& visit) const {
    if (node_.empty()) return;
    std::uint32_t stack[64];
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const Node& n = node_[stack[--top]];
      if (!boxes_meet(n.box, query)) continue;
      if (n.right == 0) {
        for (std::uint32_t k = n.begin; k < n.end; ++k) {
          if (boxes_meet(box_[item_[k]], query)) visit(item_[k]);
        }
      } else {
        stack[top++] = n.right;
        stack[top++] = static_cast<std::uint32_t>(&n - node_.data()) + 1;
      }
    }
  }

  [[nodiscard]] std::span<const Node> nodes() const { return node_; }
  [[nodiscard]] std::span<const std::uint32_t> items() const { return item_; }
  [[nodiscard]] std::span<const Box3> boxes() const { return box_; }

 private:
  std::uint32_t build(std::uint32_t begin, std::uint32_t end);

  std::vector<Box3> box_;
  std::vector<std::uint32_t> item_;
  std::vector<Node> node_;
};

}  // namespace blum
