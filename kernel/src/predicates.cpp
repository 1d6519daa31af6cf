#include "blum/kernel/predicates.hpp"

#include <algorithm>

#include "blum/kernel/check.hpp"
#include "exact_number.hpp"
#include "site_expressions.hpp"

namespace blum {

namespace ex = detail::expression;
using detail::Exact;
using detail::Wide;

template <class F>
int Predicates::decide(F&& expression) {
  if (const int s = expression.template operator()<Ball>().sign(); s != 2) {
    stages_.count(Stage::kFilter);
    return s;
  }
  if (const int s = expression.template operator()<Wide>().sign(); s != 2) {
    stages_.count(Stage::kExtended);
    return s;
  }
  stages_.count(Stage::kExact);
  return expression.template operator()<Exact>().sign();
}

int Predicates::compare_distance(const Point3& x, SiteId a, SiteId b) {
  if (a == b) return 0;
  return decide([&]<class N>() {
    const auto fa = ex::squared_distance<N>(*geometry_, a, x);
    const auto fb = ex::squared_distance<N>(*geometry_, b, x);
    return fa.numerator * fb.denominator - fb.numerator * fa.denominator;
  });
}

bool Predicates::in_domain(const Point3& x, SiteId s) {
  const Solid& solid = geometry_->solid();
  for (const HalfSpace& h : geometry_->domain(s)) {
    const Point3& p = solid.point[h.base];
    const int quick = dot(h.w, difference(x, p)).sign();
    if (quick == 1) {
      stages_.count(Stage::kFilter);
      return false;
    }
    if (quick != 2) {
      stages_.count(Stage::kFilter);
      continue;
    }
    const int sign = decide([&]<class N>() {
      return ex::inner<N>(ex::half_space_direction<N>(solid, h), ex::minus<N>(x, p));
    });
    if (sign > 0) return false;
  }
  return true;
}

int Predicates::plane_side(const Point3& x, std::uint32_t triangle) {
  const Solid& s = geometry_->solid();
  return decide([&]<class N>() {
    return ex::inner<N>(ex::normal<N>(s, triangle),
                        ex::minus<N>(x, s.point[s.triangle[triangle].vertex[0]]));
  });
}

std::optional<int> Predicates::pierces(std::uint32_t triangle, int axis, double u, double v) {
  const Solid& s = geometry_->solid();
  const int ua = u_axis(axis), va = v_axis(axis);
  const auto& t = s.triangle[triangle].vertex;
  // Signs of the three projected orientations, and of the projected area (the normal's component).
  std::array<int, 3> side{};
  for (int k = 0; k < 3; ++k) {
    const Point3 &p = s.point[t[k]], &q = s.point[t[(k + 1) % 3]];
    side[k] = decide([&]<class N>() {
      return (N(q[ua]) - N(p[ua])) * (N(v) - N(p[va])) - (N(q[va]) - N(p[va])) * (N(u) - N(p[ua]));
    });
  }
  if ((side[0] > 0 && side[1] > 0 && side[2] > 0)) return 1;
  if ((side[0] < 0 && side[1] < 0 && side[2] < 0)) return -1;
  const bool has_positive = side[0] > 0 || side[1] > 0 || side[2] > 0;
  const bool has_negative = side[0] < 0 || side[1] < 0 || side[2] < 0;
  if (has_positive && has_negative) return 0;
  return std::nullopt;
}

int Predicates::compare_crossing(std::uint32_t first, std::uint32_t second, int axis, double u,
                                 double v) {
  if (first == second) return 0;
  const Solid& s = geometry_->solid();
  const Point3 origin = point_on(axis, 0, u, v);
  return decide([&]<class N>() {
    // Along the line x = origin + t e_axis the plane of a triangle is met at t = -h / n[axis].
    const auto n1 = ex::normal<N>(s, first), n2 = ex::normal<N>(s, second);
    const N h1 = ex::inner<N>(n1, ex::minus<N>(origin, s.point[s.triangle[first].vertex[0]]));
    const N h2 = ex::inner<N>(n2, ex::minus<N>(origin, s.point[s.triangle[second].vertex[0]]));
    const N& d1 = n1[axis];
    const N& d2 = n2[axis];
    return (h2 * d1 - h1 * d2) * (d1 * d2);
  });
}

int Predicates::compare_edge_crossing(std::uint32_t edge, int axis, double level, int along,
                                      double value) {
  const Solid& s = geometry_->solid();
  const Point3 &a = s.point[s.edge[edge].vertex[0]], &b = s.point[s.edge[edge].vertex[1]];
  BLUM_REQUIRE((a[axis] < level) != (b[axis] < level));
  const int sign = decide([&]<class N>() {
    return (N(a[along]) - N(value)) * (N(b[axis]) - N(a[axis])) +
           (N(b[along]) - N(a[along])) * (N(level) - N(a[axis]));
  });
  return b[axis] > a[axis] ? sign : -sign;
}

bool Predicates::redundant(SiteId a, SiteId b) {
  if (a == b) return true;
  const SiteIndex& index = geometry_->index();
  const Solid& s = geometry_->solid();
  if (index.kind(a) > index.kind(b)) std::swap(a, b);  // vertex <= edge <= face
  const auto ia = index.element(a), ib = index.element(b);
  const auto on_line = [&](const Point3& p, std::uint32_t edge) {
    const auto [v0, v1] = s.edge[edge].vertex;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      if (decide([&]<class N>() {
            return (N(p[i]) - N(s.point[v0][i])) * (N(s.point[v1][j]) - N(s.point[v0][j])) -
                   (N(p[j]) - N(s.point[v0][j])) * (N(s.point[v1][i]) - N(s.point[v0][i]));
          }) != 0)
        return false;
    }
    return true;
  };
  if (index.kind(b) == SiteKind::kVertex) return false;
  if (index.kind(b) == SiteKind::kEdge) {
    if (index.kind(a) == SiteKind::kVertex) return on_line(s.point[ia], ib);
    return on_line(s.point[s.edge[ia].vertex[0]], ib) && on_line(s.point[s.edge[ia].vertex[1]], ib);
  }
  if (index.kind(a) == SiteKind::kFace && s.triangle[ia].facet == s.triangle[ib].facet) return true;
  int count = 0;
  const auto corner = geometry_->corners(a, count);
  const auto& tv = s.triangle[ib].vertex;
  for (int k = 0; k < count; ++k) {
    if (corner[k] == tv[0] || corner[k] == tv[1] || corner[k] == tv[2]) continue;
    if (plane_side(s.point[corner[k]], ib) != 0) return false;
  }
  return true;
}

bool Predicates::behind(SiteId site, SiteId other) {
  const SiteIndex& index = geometry_->index();
  const Solid& s = geometry_->solid();
  const auto i = index.element(site);
  int count = 0;
  const auto corner = geometry_->corners(other, count);
  const auto behind_plane = [&](std::uint32_t t) {
    const auto& tv = s.triangle[t].vertex;
    for (int k = 0; k < count; ++k) {
      if (corner[k] == tv[0] || corner[k] == tv[1] || corner[k] == tv[2]) continue;
      if (plane_side(s.point[corner[k]], t) < 0) return false;
    }
    return true;
  };
  switch (index.kind(site)) {
    case SiteKind::kFace:
      return behind_plane(i);
    case SiteKind::kEdge:
      return s.edge[i].kind == EdgeKind::kReflex && behind_plane(s.edge[i].triangle[0]) &&
             behind_plane(s.edge[i].triangle[1]);
    case SiteKind::kVertex:
      break;
  }
  for (const auto e : s.edges_at(i))
    if (s.edge[e].kind == EdgeKind::kConvex) return false;
  for (const auto t : s.triangles_at(i))
    if (!behind_plane(t)) return false;
  return true;
}

bool Predicates::never_essential(SiteId a, SiteId b) {
  return behind(a, b) || behind(b, a) || redundant(a, b);
}

void Predicates::governors(const Point3& x, std::span<const SiteId> candidates,
                           std::vector<SiteId>& out) {
  scratch_.clear();
  for (const SiteId s : candidates) {
    // Distances through unit vectors: cheaper than the fractions, and only an ordering hint with
    // certain lower and upper ends.
    const BallVector d = difference(x, geometry_->base(s));
    Ball q;
    switch (geometry_->index().kind(s)) {
      case SiteKind::kVertex:
        q = dot(d, d);
        break;
      case SiteKind::kEdge: {
        const BallVector m = cross(d, geometry_->unit(s));
        q = dot(m, m);
        break;
      }
      case SiteKind::kFace:
        q = square(dot(d, geometry_->unit(s)));
        break;
    }
    scratch_.emplace_back(q, s);
  }
  std::sort(scratch_.begin(), scratch_.end(), [](const auto& p, const auto& q) {
    const double lp = p.first.low(), lq = q.first.low();
    return lp != lq ? lp < lq : p.second < q.second;
  });
  out.clear();
  double best_high = 0;
  for (const auto& [q, s] : scratch_) {
    if (!out.empty() && q.low() > best_high) break;
    if (!in_domain(x, s)) continue;
    if (!out.empty()) {
      const int sign = compare_distance(x, s, out.front());
      if (sign > 0) continue;
      if (sign < 0) out.clear();
      best_high = out.empty() ? q.high() : std::min(best_high, q.high());
    } else {
      best_high = q.high();
    }
    out.push_back(s);
  }
  std::sort(out.begin(), out.end());
}

bool Predicates::rim_common(std::uint32_t v, std::uint32_t edge_a, std::uint32_t edge_b,
                            std::span<const SiteId> sites) {
  const Solid& s = geometry_->solid();
  const SiteIndex& index = geometry_->index();
  const auto direction = [&]<class N>(std::uint32_t e) {
    return ex::minus<N>(s.point[s.edge[e].vertex[1]], s.point[s.edge[e].vertex[0]]);
  };
  for (const SiteId site : sites) {
    const auto i = index.element(site);
    switch (index.kind(site)) {
      case SiteKind::kVertex:
        if (i != v) return false;
        break;
      case SiteKind::kEdge:
        if (s.edge[i].vertex[0] != v && s.edge[i].vertex[1] != v) return false;
        if (decide([&]<class N>() {
              return ex::inner<N>(direction.template operator()<N>(i),
                                  ex::outer<N>(direction.template operator()<N>(edge_a),
                                               direction.template operator()<N>(edge_b)));
            }) != 0)
          return false;
        break;
      case SiteKind::kFace: {
        const auto& tv = s.triangle[i].vertex;
        if (tv[0] != v && tv[1] != v && tv[2] != v) return false;
        // Its normal is parallel to a x b iff a and b lie in its plane.
        for (const auto e : {edge_a, edge_b})
          if (decide([&]<class N>() {
                return ex::inner<N>(ex::normal<N>(s, i), direction.template operator()<N>(e));
              }) != 0)
            return false;
        break;
      }
    }
  }
  return true;
}

std::optional<int> Predicates::compare_rim(std::uint32_t v, std::uint32_t edge_a,
                                           std::uint32_t edge_b, int axis, double level, int along,
                                           double value) {
  const Solid& s = geometry_->solid();
  const auto direction = [&]<class N>() {
    const auto of = [&](std::uint32_t e) {
      return ex::minus<N>(s.point[s.edge[e].vertex[1]], s.point[s.edge[e].vertex[0]]);
    };
    return ex::outer<N>(of(edge_a), of(edge_b));
  };
  const int d = decide([&]<class N>() { return direction.template operator()<N>()[axis]; });
  if (d == 0) return std::nullopt;
  const Point3& p = s.point[v];
  return d * decide([&]<class N>() {
           const auto r = direction.template operator()<N>();
           return (N(p[along]) - N(value)) * r[axis] + (N(level) - N(p[axis])) * r[along];
         });
}

}  // namespace blum
