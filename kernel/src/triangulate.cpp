#include "blum/kernel/triangulate.hpp"

#include <algorithm>
#include <numeric>

#include "blum/kernel/check.hpp"
#include "exact_geometry.hpp"
#include "exact_geometry_number.hpp"

namespace blum {
namespace {

using Loop = std::vector<std::uint32_t>;

std::array<exact::Dyadic, 3> newell_normal(std::span<const Point3> points, const Loop& loop) {
  std::array<exact::Dyadic, 3> n;
  const Point3& o = points[loop[0]];
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
    const Point3 &a = points[loop[k]], &b = points[loop[k + 1]];
    for (int axis = 0; axis < 3; ++axis) {
      const int u = u_axis(axis), v = v_axis(axis);
      const exact::Dyadic ou(o[u]), ov(o[v]);
      n[axis] += (exact::Dyadic(a[u]) - ou) * (exact::Dyadic(b[v]) - ov) -
                 (exact::Dyadic(a[v]) - ov) * (exact::Dyadic(b[u]) - ou);
    }
  }
  return n;
}

bool is_planar(std::span<const Point3> points, const Loop& loop) {
  const Point3& a = points[loop[0]];
  const Point3& b = points[loop[1]];
  for (std::size_t k = 2; k < loop.size(); ++k) {
    if (exact::collinear(a, b, points[loop[k]])) continue;
    const Point3& c = points[loop[k]];
    return std::all_of(loop.begin(), loop.end(),
                       [&](std::uint32_t v) { return exact::orient3d(a, b, c, points[v]) == 0; });
  }
  return true;
}

bool all_collinear(std::span<const Point3> points, const Loop& loop) {
  for (std::size_t k = 2; k < loop.size(); ++k) {
    if (!exact::collinear(points[loop[0]], points[loop[1]], points[loop[k]])) return false;
  }
  return true;
}

/// Does the projected boundary meet itself nowhere but in common ends of neighbours?
bool is_simple_along(int axis, std::span<const Point3> points, const Loop& loop) {
  const std::size_t n = loop.size();
  const int u = u_axis(axis), v = v_axis(axis);
  const auto start = [&](std::size_t k) -> const Point3& { return points[loop[k % n]]; };
  for (std::size_t k = 0; k < n; ++k) {
    const Point3 &a = start(k), &b = start(k + 1), &c = start(k + 2);
    if (a[u] == b[u] && a[v] == b[v]) return false;
    if (exact::orient2d_along(axis, a, b, c) != 0) continue;
    // In line: the next edge must go on, not back.
    const int w = a[u] != b[u] ? u : v;
    if ((a[w] < b[w]) != (b[w] < c[w])) return false;
  }
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto low = [&](std::size_t k) { return std::min(start(k)[u], start(k + 1)[u]); };
  const auto high = [&](std::size_t k) { return std::max(start(k)[u], start(k + 1)[u]); };
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return low(i) < low(j) || (low(i) == low(j) && i < j);
  });
  std::vector<std::size_t> active;
  for (const std::size_t i : order) {
    std::erase_if(active, [&](std::size_t j) { return high(j) < low(i); });
    for (const std::size_t j : active) {
      if ((i + 1) % n == j || (j + 1) % n == i) continue;
      if (exact::segments_meet_along(axis, start(i), start(i + 1), start(j), start(j + 1))) {
        return false;
      }
    }
    active.push_back(i);
  }
  return true;
}

/// Requires: the projection along `axis` is a simple polygon of turning sense `sense`.
void cut_ears(int axis, int sense, std::span<const Point3> points, const Loop& loop,
              std::vector<std::array<std::uint32_t, 3>>& out) {
  const std::size_t n = loop.size();
  std::vector<std::size_t> next(n), previous(n);
  for (std::size_t k = 0; k < n; ++k) {
    next[k] = (k + 1) % n;
    previous[k] = (k + n - 1) % n;
  }
  const auto at = [&](std::size_t k) -> const Point3& { return points[loop[k]]; };
  const auto turn = [&](std::size_t a, std::size_t b, std::size_t c) {
    return sense * exact::orient2d_along(axis, at(a), at(b), at(c));
  };
  const auto is_ear = [&](std::size_t k) {
    const std::size_t a = previous[k], c = next[k];
    if (turn(a, k, c) <= 0) return false;
    // Of the vertices in the triangle, the one nearest to k would not be strictly convex: it is
    // enough to look at those.
    for (std::size_t j = next[c]; j != a; j = next[j]) {
      if (turn(a, k, j) >= 0 && turn(k, c, j) >= 0 && turn(c, a, j) >= 0 &&
          turn(previous[j], j, next[j]) <= 0) {
        return false;
      }
    }
    return true;
  };
  std::size_t left = n, at_vertex = 0, tried = 0;
  while (left > 3) {
    if (is_ear(at_vertex)) {
      const std::size_t a = previous[at_vertex], c = next[at_vertex];
      out.push_back({loop[a], loop[at_vertex], loop[c]});
      next[a] = c;
      previous[c] = a;
      --left;
      tried = 0;
      // Going on behind the ear avoids a fan of slivers around one vertex.
      at_vertex = next[c];
    } else {
      at_vertex = next[at_vertex];
      BLUM_CHECK(++tried <= left);  // a simple polygon has two ears
    }
  }
  out.push_back({loop[previous[at_vertex]], loop[at_vertex], loop[next[at_vertex]]});
}

}  // namespace

FaceShape triangulate_face(std::span<const Point3> points, std::span<const std::uint32_t> face,
                           std::vector<std::array<std::uint32_t, 3>>& out) {
  if (face.size() == 3) {
    if (exact::collinear(points[face[0]], points[face[1]], points[face[2]])) {
      return FaceShape::kDegenerate;
    }
    out.push_back({face[0], face[1], face[2]});
    return FaceShape::kGood;
  }
  Loop loop(face.begin(), face.end());
  Loop sorted = loop;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
    return FaceShape::kDegenerate;
  }
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  for (std::size_t k = 0; k < loop.size(); ++k) {
    if (points[loop[k]] == points[loop[(k + 1) % loop.size()]]) return FaceShape::kDegenerate;
  }
  if (all_collinear(points, loop)) return FaceShape::kDegenerate;
  const std::array<exact::Dyadic, 3> normal = newell_normal(points, loop);
  std::array<int, 3> order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](int i, int j) { return compare_absolute(normal[i], normal[j]) > 0; });
  for (const int axis : order) {
    const int sense = normal[axis].sign();
    if (sense == 0) break;
    if (!is_simple_along(axis, points, loop)) continue;
    cut_ears(axis, sense, points, loop, out);
    return is_planar(points, loop) ? FaceShape::kGood : FaceShape::kGoodNonPlanar;
  }
  return FaceShape::kNonSimple;
}

}  // namespace blum
