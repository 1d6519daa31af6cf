#include "shape.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "blum/kernel/union_find.hpp"

namespace blum::verify {

Shape::Shape(std::span<const Point3> points,
             std::span<const std::array<std::uint32_t, 3>> triangles)
    : point(points.begin(), points.end()) {
  for (const auto& t : triangles) triangle.push_back({t, {}});
  for (const Point3& p : point)
    for (int k = 0; k < 3; ++k)
      if (!(std::abs(p[k]) <= 1)) defect_ = "a coordinate is larger than 1";
  if (defect_.empty()) find_edges();
  if (defect_.empty()) check_manifold();
  if (defect_.empty()) find_candidates();
}

void Shape::find_edges() {
  edges_at.resize(point.size());
  triangles_at.resize(point.size());
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> found;  // by smaller, larger vertex
  std::vector<int> uses;
  for (std::uint32_t t = 0; t < triangle.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto a = triangle[t].vertex[k], b = triangle[t].vertex[(k + 1) % 3];
      if (a >= point.size() || b >= point.size() || a == b) {
        defect_ = "triangle " + std::to_string(t) + " has a bad vertex";
        return;
      }
      const auto [it, fresh] = found.try_emplace(std::array{std::min(a, b), std::max(a, b)},
                                                 static_cast<std::uint32_t>(edge.size()));
      if (fresh) {
        edge.push_back({{a, b}, {t, t}});
        uses.push_back(1);
      } else if (++uses[it->second] > 2 || edge[it->second].vertex[0] == a) {
        defect_ =
            "edge " + std::to_string(a) + "-" + std::to_string(b) + " is not between two triangles";
        return;
      } else {
        edge[it->second].triangle[1] = t;
      }
      triangle[t].edge[k] = it->second;
      triangles_at[a].push_back(t);
    }
  if (std::ranges::any_of(uses, [](int n) { return n != 2; })) {
    defect_ = "the surface has a border";
    return;
  }
  for (std::uint32_t t = 0; t < triangle.size(); ++t) {
    const Vec<Rational> n = normal<Rational>(t);
    normal_.push_back({enclose(n[0]), enclose(n[1]), enclose(n[2])});
  }
  for (std::uint32_t e = 0; e < edge.size(); ++e) {
    for (const auto v : edge[e].vertex) edges_at[v].push_back(e);
    for (const auto v : triangle[edge[e].triangle[1]].vertex)
      if (v != edge[e].vertex[0] && v != edge[e].vertex[1])
        edge[e].bend = static_cast<Bend>(side_of_plane(edge[e].triangle[0], point[v]));
  }
}

void Shape::check_manifold() {
  for (std::uint32_t t = 0; t < triangle.size(); ++t)
    if (std::ranges::all_of(normal<Rational>(t), [](const Rational& x) { return sgn(x) == 0; }))
      defect_ = "triangle " + std::to_string(t) + " is degenerate";
  for (std::uint32_t v = 0; v < point.size(); ++v) {
    // The triangles at a vertex form one fan.
    const auto& around = triangles_at[v];
    const auto place = [&](std::uint32_t t) {
      return static_cast<std::uint32_t>(std::ranges::find(around, t) - around.begin());
    };
    UnionFind fan;
    fan.resize(static_cast<std::uint32_t>(around.size()));
    for (const auto e : edges_at[v])
      fan.unite(place(edge[e].triangle[0]), place(edge[e].triangle[1]));
    for (std::uint32_t k = 1; k < around.size(); ++k)
      if (fan.find(k) != fan.find(0)) defect_ = "two fans at vertex " + std::to_string(v);
  }
}

void Shape::find_candidates() {
  for (std::uint32_t v = 0; v < point.size(); ++v)
    if (std::ranges::any_of(edges_at[v],
                            [&](std::uint32_t e) { return edge[e].bend == Bend::kReflex; }) &&
        polar_cone_has_interior(v))
      candidates_.push_back(vertex_site(v));
  for (std::uint32_t e = 0; e < edge.size(); ++e)
    if (edge[e].bend == Bend::kReflex) candidates_.push_back(edge_site(e));
  for (std::uint32_t t = 0; t < triangle.size(); ++t) candidates_.push_back(face_site(t));
}

bool Shape::polar_cone_has_interior(std::uint32_t v) const {
  // A pointed cone is spanned by its extreme rays, which are cross products of two edges; their
  // sum lies in its relative interior. Edges in one plane span no pointed cone: the sum is 0 then.
  std::vector<Vec<Rational>> tips;
  for (const auto e : edges_at[v])
    tips.push_back(along<Rational>(v, edge[e].vertex[edge[e].vertex[0] == v ? 1 : 0]));
  Vec<Rational> sum{};
  for (std::size_t i = 0; i < tips.size(); ++i)
    for (std::size_t j = 0; j < tips.size(); ++j) {
      const Vec<Rational> ray = outer(tips[i], tips[j]);
      if (std::ranges::all_of(tips, [&](const auto& e) { return sgn(inner(ray, e)) <= 0; }))
        sum = plus(sum, ray);
    }
  return std::ranges::all_of(tips, [&](const auto& e) { return sgn(inner(sum, e)) < 0; });
}

Corners Shape::corners(Site s) const {
  const auto i = element(s);
  switch (kind(s)) {
    case Kind::kVertex:
      break;
    case Kind::kEdge:
      return {{edge[i].vertex[0], edge[i].vertex[1], 0}, 2};
    case Kind::kFace:
      return {triangle[i].vertex, 3};
  }
  return {{i, 0, 0}, 1};
}

std::array<long, 3> Shape::betti() const {
  UnionFind shell;
  shell.resize(vertices());
  for (const Edge& e : edge) shell.unite(e.vertex[0], e.vertex[1]);
  std::map<std::uint32_t, long> euler;
  std::map<std::uint32_t, Rational> volume;
  for (std::uint32_t v = 0; v < vertices(); ++v)
    if (!edges_at[v].empty()) ++euler[shell.find(v)];
  for (const Edge& e : edge) --euler[shell.find(e.vertex[0])];
  for (const Triangle& t : triangle) {
    const auto corner = [&](int k) { return exactly<Rational>(point[t.vertex[k]]); };
    ++euler[shell.find(t.vertex[0])];
    volume[shell.find(t.vertex[0])] += inner(corner(0), outer(corner(1), corner(2)));
  }
  std::array<long, 3> betti{};
  for (const auto& [root, chi] : euler) {
    betti[1] += (2 - chi) / 2;
    ++betti[sgn(volume[root]) > 0 ? 0 : 2];
  }
  return betti;
}

std::int64_t Shape::edge_between(std::uint32_t a, std::uint32_t b) const {
  if (a < edges_at.size())
    for (const auto e : edges_at[a])
      if (edge[e].vertex[0] == b || edge[e].vertex[1] == b) return e;
  return -1;
}

int Shape::side_of_plane(std::uint32_t t, const Point3& x) const {
  return decide([&]<class N>(const N&) {
    return sign_of(N(
        inner<N>(normal<N>(t), minus<N>(exactly<N>(x), exactly<N>(point[triangle[t].vertex[0]])))));
  });
}

}  // namespace blum::verify
