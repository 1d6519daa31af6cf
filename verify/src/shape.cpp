#include "shape.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "blum/kernel/union_find.hpp"

namespace blum::verify {

Shape::Shape(std::span<const Point3> points,
             std::span<const std::array<std::uint32_t, 3>> triangles)
    : point(points.begin(), points.end()), numbers_(points.size()) {
  std::iota(numbers_.begin(), numbers_.end(), 0u);
  for (const auto& t : triangles) triangle.push_back({t, {}});
  for (const Point3& p : point)
    for (int k = 0; k < 3; ++k)
      if (!(std::abs(p[k]) <= 1)) defect_ = "a coordinate is larger than 1";
  if (defect_.empty()) find_edges();
  for (std::uint32_t v = 0; v < point.size() && defect_.empty(); ++v) {
    UnionFind fan = chains(v, true);
    for (std::uint32_t k = 1; k < fan.size(); ++k)
      if (fan.find(k) != fan.find(0)) defect_ = "two fans at vertex " + std::to_string(v);
    cone.push_back(cone_of(v));
    if (cone[v].interior && has(v, Bend::kReflex)) candidates_.push_back(vertex_site(v));
  }
  for (std::uint32_t e = 0; e < edge.size(); ++e)
    if (edge[e].bend == Bend::kReflex) candidates_.push_back(edge_site(e));
  for (std::uint32_t t = 0; t < triangle.size(); ++t) candidates_.push_back(face_site(t));
}

void Shape::find_edges() {
  edges_at.resize(point.size());
  triangles_at.resize(point.size());
  std::map<std::set<std::uint32_t>, std::uint32_t> found;
  std::vector<int> uses;
  for (std::uint32_t t = 0; t < triangle.size(); ++t) {
    const std::string name = "triangle " + std::to_string(t);
    for (int k = 0; k < 3; ++k) {
      const auto a = triangle[t].vertex[k], b = triangle[t].vertex[(k + 1) % 3];
      if (a >= point.size() || b >= point.size() || a == b)
        return void(defect_ = name + " has a bad vertex");
      const auto [it, fresh] = found.try_emplace({a, b}, edges());
      if (fresh) {
        edge.push_back({{a, b}, {t, t}});
        uses.push_back(1);
        edges_at[a].push_back(it->second);
        edges_at[b].push_back(it->second);
      } else if (++uses[it->second] > 2 || edge[it->second].vertex[0] == a) {
        return void(defect_ = name + " has an edge that is not between two triangles");
      } else {
        edge[it->second].triangle[1] = t;
      }
      triangle[t].edge[k] = it->second;
      triangles_at[a].push_back(t);
    }
    const auto& v = triangle[t].vertex;
    normal_.push_back(outer(along<Rational>(v[0], v[1]), along<Rational>(v[0], v[2])));
    if (is_zero(normal<Rational>(t))) return void(defect_ = name + " is degenerate");
  }
  if (std::ranges::find(uses, 1) != uses.end()) return void(defect_ = "the surface has a border");
  for (Edge& e : edge)
    for (const auto v : triangle[e.triangle[1]].vertex)
      if (v != e.vertex[0] && v != e.vertex[1])
        e.bend = static_cast<Bend>(side_of_plane(e.triangle[0], point[v]));
}

UnionFind Shape::chains(std::uint32_t v, bool across_convex) const {
  const auto& around = triangles_at[v];
  UnionFind chain;
  chain.resize(static_cast<std::uint32_t>(around.size()));
  for (const auto e : edges_at[v])
    if (across_convex || edge[e].bend != Bend::kConvex)
      chain.unite(place(v, edge[e].triangle[0]), place(v, edge[e].triangle[1]));
  return chain;
}

VertexCone Shape::cone_of(std::uint32_t v) const {
  // A pointed cone is spanned by its extreme rays, which are cross products of two edges; their
  // sum lies in its relative interior. A cone without rays is the vertex alone: edges span space.
  std::vector<Vec<Rational>> tip, ray;
  for (const auto e : edges_at[v]) tip.push_back(along<Rational>(v, other_end(e, v)));
  Vec<Rational> middle{};
  for (const auto& a : tip)
    for (const auto& b : tip) {
      const Vec<Rational> r = outer(a, b);
      if (is_zero(r) ||
          std::ranges::any_of(tip, [&](const auto& e) { return sgn(inner(r, e)) > 0; }) ||
          std::ranges::any_of(
              ray, [&](const auto& x) { return is_zero(outer(x, r)) && sgn(inner(x, r)) > 0; }))
        continue;
      ray.push_back(r);
      middle = plus(middle, r);
    }
  VertexCone cone;
  cone.interior =
      std::ranges::all_of(tip, [&](const auto& e) { return sgn(inner(middle, e)) < 0; });
  cone.axis_connected = true;
  if (!has(v, Bend::kConvex)) return cone;
  cone.never_foot = !has(v, Bend::kReflex) || ray.empty();
  if (cone.never_foot || ray.size() == 1) return cone;
  // The edges that bound the cone: tight on two extreme rays. If it is a sector of a plane, that
  // are the edges that go straight on across it.
  UnionFind chain = chains(v, false);
  std::set<std::uint32_t> beside;
  for (std::size_t k = 0; k < tip.size(); ++k) {
    const Edge& e = edge[edges_at[v][k]];
    const auto tight =
        std::ranges::count_if(ray, [&](const auto& r) { return sgn(inner(r, tip[k])) == 0; });
    if (tight < (cone.interior ? 2 : std::ssize(ray))) continue;
    cone.never_foot |= e.bend == Bend::kConvex;
    beside.insert(chain.find(place(v, e.triangle[0])));
  }
  cone.axis_connected = cone.never_foot || (cone.interior && beside.size() == 1);
  return cone;
}

std::span<const std::uint32_t> Shape::corners(Site s) const {
  const auto i = element(s);
  if (kind(s) == Kind::kVertex) return std::span(numbers_).subspan(i, 1);
  if (kind(s) == Kind::kEdge) return edge[i].vertex;
  return triangle[i].vertex;
}

bool Shape::has_corner(Site s, std::uint32_t v) const {
  return std::ranges::find(corners(s), v) != corners(s).end();
}

bool Shape::has(std::uint32_t v, Bend bend) const {
  return std::ranges::any_of(edges_at[v], [&](auto e) { return edge[e].bend == bend; });
}

std::array<long, 3> Shape::betti() const {
  UnionFind shell;
  shell.resize(vertices());
  for (const Edge& e : edge) shell.unite(e.vertex[0], e.vertex[1]);
  std::map<std::uint32_t, std::pair<long, Rational>> found;  // Euler characteristic, volume
  for (std::uint32_t v = 0; v < vertices(); ++v)
    if (!edges_at[v].empty()) ++found[shell.find(v)].first;
  for (const Edge& e : edge) --found[shell.find(e.vertex[0])].first;
  for (const Triangle& t : triangle) {
    const auto corner = [&](int k) { return exactly<Rational>(point[t.vertex[k]]); };
    auto& [euler, volume] = found[shell.find(t.vertex[0])];
    ++euler;
    volume += inner(corner(0), outer(corner(1), corner(2)));
  }
  std::array<long, 3> betti{};
  for (const auto& [root, of] : found) {
    betti[1] += (2 - of.first) / 2;
    ++betti[sgn(of.second) > 0 ? 0 : 2];
  }
  return betti;
}

std::optional<std::uint32_t> Shape::edge_between(std::uint32_t a, std::uint32_t b) const {
  for (const auto e : edges_at[a])
    if (other_end(e, a) == b) return e;
  return std::nullopt;
}

int Shape::side_of_plane(std::uint32_t t, const Point3& x) const {
  return decide([&]<class N>(const N&) {
    return sign_of(inner(normal<N>(t), from<N>(triangle[t].vertex[0], x)));
  });
}

std::optional<std::vector<std::uint32_t>> triangles_crossed(
    const Shape& shape, const Segment& segment, std::span<const std::uint32_t> triangles) {
  const int axis = segment.axis, u = u_axis(axis), v = v_axis(axis);
  const Point3 first = point_on(axis, segment.t0, segment.u, segment.v),
               last = point_on(axis, segment.t1, segment.u, segment.v);
  std::vector<std::uint32_t> crossed;
  for (const auto t : triangles) {
    const auto corner = [&](int k) { return shape.point[shape.triangle[t].vertex[k % 3]]; };
    const auto apart = [&](int a) {
      const double p = corner(0)[a], q = corner(1)[a], r = corner(2)[a];
      return std::max({p, q, r}) < first[a] || std::min({p, q, r}) > last[a];
    };
    if (apart(0) || apart(1) || apart(2)) continue;
    int left = 0, right = 0;
    for (int k = 0; k < 3; ++k) {
      const Point3 p = corner(k), q = corner(k + 1);
      const int turn = decide([&]<class N>(const N&) {
        return sign_of(N((N(q[u]) - N(p[u])) * (N(segment.v) - N(p[v])) -
                         (N(q[v]) - N(p[v])) * (N(segment.u) - N(p[u]))));
      });
      left += turn > 0;
      right += turn < 0;
    }
    if (left > 0 && right > 0) continue;
    const int s0 = shape.side_of_plane(t, first), s1 = shape.side_of_plane(t, last);
    if (s0 * s1 > 0) continue;
    if (left + right < 3 || s0 * s1 == 0) return std::nullopt;
    crossed.push_back(t);
  }
  return crossed;
}

std::optional<bool> is_inside(const Shape& shape, const Point3& x) {
  std::vector<std::uint32_t> all(shape.triangle.size());
  std::iota(all.begin(), all.end(), 0u);
  for (int axis = 0; axis < 3; ++axis)
    if (const auto crossed =
            triangles_crossed(shape, {axis, x[u_axis(axis)], x[v_axis(axis)], x[axis], 2}, all))
      return crossed->size() % 2 == 1;
  return std::nullopt;
}

}  // namespace blum::verify
