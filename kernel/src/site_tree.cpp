#include "blum/kernel/site_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "blum/kernel/check.hpp"
#include "exact_geometry.hpp"
#include "mesh_box_tree.hpp"
#include "site_tree_distance.hpp"

namespace blum {
namespace {

/// A lower bound: each difference errs by a factor 1 + u, and products that underflow are dropped.
double squared_distance_below(const Point3& q, const Box3& box) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = std::max({box.lo[axis] - q[axis], q[axis] - box.hi[axis], 0.0});
    sum += d * d;
  }
  return std::max(0.0, sum * (1 - 1e-15) - 1e-300);
}

}  // namespace

struct SiteTree::Impl {
  TreeEngine engine;
  std::vector<exact::Triangle> triangle;
  BoxTree tree;

  Impl(TreeEngine e, std::vector<exact::Triangle> t, std::vector<Box3> boxes)
      : engine(e), triangle(std::move(t)), tree(std::move(boxes)) {}

  /// Calls at_leaf(triangle) for the triangles of all nodes that may hold one at a squared distance
  /// <= limit(), nearer nodes first.
  template <class Limit, class AtLeaf>
  void search(const Point3& q, Limit&& limit, AtLeaf&& at_leaf) const {
    const auto nodes = tree.nodes();
    std::pair<double, std::uint32_t> stack[64];
    int top = 0;
    stack[top++] = {squared_distance_below(q, nodes[0].box), 0};
    while (top > 0) {
      const auto [below, at] = stack[--top];
      if (below > limit()) continue;
      const BoxTree::Node& n = nodes[at];
      if (n.right == 0) {
        for (std::uint32_t k = n.begin; k < n.end; ++k) {
          const std::uint32_t t = tree.items()[k];
          if (squared_distance_below(q, tree.boxes()[t]) <= limit()) at_leaf(t);
        }
        continue;
      }
      std::pair<double, std::uint32_t> near = {squared_distance_below(q, nodes[at + 1].box),
                                               at + 1};
      std::pair<double, std::uint32_t> far = {squared_distance_below(q, nodes[n.right].box),
                                              n.right};
      if (far.first < near.first) std::swap(near, far);
      stack[top++] = far;
      stack[top++] = near;
    }
  }

  /// All triangles that the double bounds do not rule out as nearest.
  std::vector<TriangleDistance> candidates(const Point3& q) const {
    std::vector<TriangleDistance> out;
    double best = std::numeric_limits<double>::infinity();
    search(
        q, [&] { return best; },
        [&](std::uint32_t t) {
          const SquaredDistanceBounds b = squared_distance_to_triangle(q, triangle[t]);
          if (b.lo > best) return;
          best = std::min(best, b.hi);
          out.push_back({t, b});
        });
    std::erase_if(out, [&](const TriangleDistance& c) { return c.squared.lo > best; });
    return out;
  }

  std::vector<std::uint32_t> exactly_nearest(const Point3& q,
                                             const std::vector<std::uint32_t>& among) const {
    if (among.size() == 1) return among;
    std::vector<std::uint32_t> out;
    ExactSquaredDistance least;
    for (const std::uint32_t t : among) {
      ExactSquaredDistance d = exact_squared_distance(q, triangle[t]);
      const int sign = out.empty() ? -1 : compare(d, least);
      if (sign > 0) continue;
      if (sign < 0) {
        out.clear();
        least = std::move(d);
      }
      out.push_back(t);
    }
    std::sort(out.begin(), out.end());
    return out;
  }
};

SiteTree::SiteTree(const Solid& solid, TreeEngine engine) {
  BLUM_REQUIRE(!solid.triangle.empty());
  std::vector<exact::Triangle> triangles;
  std::vector<Box3> boxes;
  for (const SolidTriangle& t : solid.triangle) {
    triangles.push_back(
        {solid.point[t.vertex[0]], solid.point[t.vertex[1]], solid.point[t.vertex[2]]});
    boxes.push_back(box_of(triangles.back()[0], triangles.back()[1], triangles.back()[2]));
  }
  impl_ = std::make_shared<const Impl>(engine, std::move(triangles), std::move(boxes));
}

SquaredDistanceBounds SiteTree::squared_distance(const Point3& q) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  SquaredDistanceBounds out = {kInfinity, kInfinity};
  const auto take = [&](std::uint32_t t) {
    const SquaredDistanceBounds b = squared_distance_to_triangle(q, impl_->triangle[t]);
    out = {std::min(out.lo, b.lo), std::min(out.hi, b.hi)};
  };
  if (impl_->engine == TreeEngine::kBruteForce) {
    for (std::uint32_t t = 0; t < impl_->triangle.size(); ++t) take(t);
  } else {
    // Skipped triangles are farther than out.hi, so they do not lower out.lo below the truth.
    impl_->search(
        q, [&] { return out.hi; }, take);
  }
  return out;
}

std::vector<TriangleDistance> SiteTree::possibly_nearest(const Point3& q) const {
  if (impl_->engine == TreeEngine::kTree) return impl_->candidates(q);
  std::vector<TriangleDistance> out;
  for (const auto t : all_nearest(q))
    out.push_back({t, squared_distance_to_triangle(q, impl_->triangle[t])});
  return out;
}

std::vector<std::uint32_t> SiteTree::all_nearest(const Point3& q) const {
  std::vector<std::uint32_t> among;
  if (impl_->engine == TreeEngine::kBruteForce) {
    for (std::uint32_t t = 0; t < impl_->triangle.size(); ++t) among.push_back(t);
  } else {
    for (const TriangleDistance& c : impl_->candidates(q)) among.push_back(c.triangle);
  }
  return impl_->exactly_nearest(q, among);
}

NearestTriangle SiteTree::nearest(const Point3& q) const {
  NearestTriangle out;
  out.triangle = all_nearest(q).front();
  out.squared_distance = squared_distance_to_triangle(q, impl_->triangle[out.triangle], &out.foot);
  return out;
}

std::vector<std::uint32_t> SiteTree::within(const Point3& q, double squared_radius) const {
  std::vector<std::uint32_t> out;
  const auto exactly_within = [&](std::uint32_t t) {
    return compare(exact_squared_distance(q, impl_->triangle[t]), squared_radius) <= 0;
  };
  if (impl_->engine == TreeEngine::kBruteForce) {
    for (std::uint32_t t = 0; t < impl_->triangle.size(); ++t) {
      if (exactly_within(t)) out.push_back(t);
    }
    return out;
  }
  impl_->search(
      q, [&] { return squared_radius; },
      [&](std::uint32_t t) {
        const auto b = squared_distance_to_triangle(q, impl_->triangle[t]);
        if (b.lo > squared_radius) return;
        if (b.hi <= squared_radius || exactly_within(t)) out.push_back(t);
      });
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<std::uint32_t> SiteTree::boxes_meeting(const Box3& box) const {
  std::vector<std::uint32_t> out;
  if (impl_->engine == TreeEngine::kBruteForce) {
    for (std::uint32_t t = 0; t < impl_->triangle.size(); ++t) {
      if (boxes_meet(impl_->tree.boxes()[t], box)) out.push_back(t);
    }
    return out;
  }
  impl_->tree.visit_meeting(box, [&](std::uint32_t t) { out.push_back(t); });
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace blum
