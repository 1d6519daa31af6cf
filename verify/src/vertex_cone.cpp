#include "vertex_cone.hpp"

#include <algorithm>

#include "blum/kernel/union_find.hpp"

namespace blum::verify {

VertexCone vertex_cone(const Shape& shape, std::uint32_t vertex) {
  using Foot = VertexCone::Foot;
  const auto& edges = shape.edges_at[vertex];
  const auto has = [&](Bend bend) {
    return std::ranges::any_of(edges, [&](auto e) { return shape.edge[e].bend == bend; });
  };
  if (!has(Bend::kConvex)) return {Foot::kMaybe, true};
  if (!has(Bend::kReflex)) return {Foot::kNever, true};
  // Extreme rays of the polar cone. A cone without is the vertex alone: edges span space here.
  std::vector<Vec<Rational>> tip, ray;
  for (const auto e : edges) {
    const auto& ends = shape.edge[e].vertex;
    tip.push_back(shape.along<Rational>(vertex, ends[ends[0] == vertex ? 1 : 0]));
  }
  const auto parallel = [](const Vec<Rational>& a, const Vec<Rational>& b) {
    return std::ranges::all_of(outer(a, b), [](const Rational& x) { return sgn(x) == 0; }) &&
           sgn(inner(a, b)) > 0;
  };
  for (std::size_t i = 0; i < tip.size(); ++i)
    for (std::size_t j = 0; j < tip.size(); ++j) {
      const Vec<Rational> r = outer(tip[i], tip[j]);
      if (sgn(inner(r, r)) == 0 ||
          std::ranges::any_of(tip, [&](const auto& e) { return sgn(inner(r, e)) > 0; }) ||
          std::ranges::any_of(ray, [&](const auto& x) { return parallel(x, r); }))
        continue;
      ray.push_back(r);
    }
  if (ray.empty()) return {Foot::kNever, true};
  if (ray.size() == 1) return {Foot::kRay, true};
  Vec<Rational> middle{};
  for (const auto& r : ray) middle = plus(middle, r);
  if (!std::ranges::all_of(tip, [&](const auto& e) { return sgn(inner(middle, e)) < 0; })) {
    // A sector of a plane, bounded by the edges that go straight on across it.
    for (std::size_t k = 0; k < tip.size(); ++k)
      if (shape.edge[edges[k]].bend == Bend::kConvex &&
          std::ranges::all_of(ray, [&](const auto& r) { return sgn(inner(r, tip[k])) == 0; }))
        return {Foot::kNever, true};
    return {Foot::kMaybe, false};
  }
  std::vector<std::uint32_t> bounding;  // edges tight on two extreme rays
  for (std::size_t k = 0; k < tip.size(); ++k)
    if (std::ranges::count_if(ray, [&](const auto& r) { return sgn(inner(r, tip[k])) == 0; }) >= 2)
      bounding.push_back(edges[k]);
  if (std::ranges::any_of(bounding, [&](auto e) { return shape.edge[e].bend == Bend::kConvex; }))
    return {Foot::kNever, true};
  const auto& triangles = shape.triangles_at[vertex];
  const auto place = [&](std::uint32_t t) {
    return static_cast<std::uint32_t>(std::ranges::find(triangles, t) - triangles.begin());
  };
  UnionFind chain;
  chain.resize(static_cast<std::uint32_t>(triangles.size()));
  for (const auto e : edges)
    if (shape.edge[e].bend != Bend::kConvex)
      chain.unite(place(shape.edge[e].triangle[0]), place(shape.edge[e].triangle[1]));
  const auto chain_of = [&](std::uint32_t e) {
    return chain.find(place(shape.edge[e].triangle[0]));
  };
  return {Foot::kMaybe, std::ranges::all_of(bounding, [&](auto e) {
            return chain_of(e) == chain_of(bounding.front());
          })};
}

bool polar_cone_meets(const Shape& shape, std::uint32_t v, const Box3& box) {
  std::vector<Vec<Rational>> polygon;  // clipped by one condition after the other
  int flat = 0;
  while (flat < 2 && box.lo[flat] != box.hi[flat]) ++flat;
  const int a = u_axis(flat), b = v_axis(flat);
  for (const auto& [s, t] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    Point3 p = box.lo;
    if (s == 1) p[a] = box.hi[a];
    if (t == 1) p[b] = box.hi[b];
    polygon.push_back(exactly<Rational>(p));
  }
  for (const auto e : shape.edges_at[v]) {
    const auto& ends = shape.edge[e].vertex;
    const Vec<Rational> along = shape.along<Rational>(v, ends[ends[0] == v ? 1 : 0]);
    const auto height = [&](const Vec<Rational>& x) {
      return inner(along, minus(x, exactly<Rational>(shape.point[v])));
    };
    std::vector<Vec<Rational>> kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const auto &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
      const Rational hp = height(p), hq = height(q);
      if (hp <= 0) kept.push_back(p);
      if (hp * hq < 0) kept.push_back(plus(p, times(minus(q, p), Rational(hp / (hp - hq)))));
    }
    polygon = std::move(kept);
    if (polygon.empty()) return false;
  }
  return true;
}

}  // namespace blum::verify
