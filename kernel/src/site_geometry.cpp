#include "blum/kernel/site_geometry.hpp"

#include <algorithm>

#include "blum/kernel/check.hpp"
#include "site_expressions.hpp"

namespace blum {
namespace expression = detail::expression;

namespace {

BallVector negative(const BallVector& w) { return {-w[0], -w[1], -w[2]}; }

}  // namespace

SiteGeometry::SiteGeometry(const Solid& solid, DiagramKind kind)
    : solid_(&solid), kind_(kind), index_(solid) {
  const bool medial = kind == DiagramKind::kMedial;
  half_begin_.reserve(index_.size() + 1);
  unit_.resize(index_.size());
  for (std::uint32_t e = 0; e < solid.edge.size(); ++e)
    unit_[index_.edge(e).value] = expression::unit_direction(solid, e);
  for (std::uint32_t t = 0; t < solid.triangle.size(); ++t)
    unit_[index_.face(t).value] = expression::unit_normal(solid, t);
  // Directions from the unit vectors have a small relative error, in slivers too.
  const auto add = [&](HalfSpace h, const BallVector& w) {
    h.w = w;
    half_.push_back(h);
  };
  using Kind = HalfSpace::Kind;
  for (std::uint32_t v = 0; v < solid.point.size(); ++v) {
    half_begin_.push_back(static_cast<std::uint32_t>(half_.size()));
    bool has_reflex = false;
    for (const auto e : solid.edges_at(v)) has_reflex |= solid.edge[e].kind == EdgeKind::kReflex;
    if ((medial && !has_reflex) || solid.vertex_degenerate[v]) continue;
    candidates_.push_back(index_.vertex(v));
    for (const auto e : solid.edges_at(v)) {
      const auto& ends = solid.edge[e].vertex;
      const BallVector& u = unit_[index_.edge(e).value];
      if (ends[0] == v)
        add({Kind::kAlong, v, ends[1], 0, v, {}}, u);
      else
        add({Kind::kAlong, v, ends[0], 0, v, {}}, negative(u));
    }
  }
  for (std::uint32_t e = 0; e < solid.edge.size(); ++e) {
    half_begin_.push_back(static_cast<std::uint32_t>(half_.size()));
    const SolidEdge& edge = solid.edge[e];
    const auto [a, b] = edge.vertex;
    const SiteId site = index_.edge(e);
    if (edge.kind == EdgeKind::kFlat || (medial && edge.kind == EdgeKind::kConvex)) continue;
    candidates_.push_back(site);
    const BallVector& u = unit_[site.value];
    add({Kind::kAlong, a, b, 0, b, {}}, u);
    add({Kind::kAlong, b, a, 0, a, {}}, negative(u));
    for (const auto t : edge.triangle) {
      std::uint32_t opposite = 0;
      for (const auto v : solid.triangle[t].vertex)
        if (v != a && v != b) opposite = v;
      // n x u points into triangle[0], where the edge runs from a to b.
      const BallVector in = cross(unit_[index_.face(t).value], u);
      add({Kind::kInFace, a, b, opposite, a, {}}, t == edge.triangle[0] ? in : negative(in));
    }
  }
  for (std::uint32_t t = 0; t < solid.triangle.size(); ++t) {
    half_begin_.push_back(static_cast<std::uint32_t>(half_.size()));
    const auto [a, b, c] = solid.triangle[t].vertex;
    candidates_.push_back(index_.face(t));
    const BallVector& n = unit_[index_.face(t).value];
    const auto out = [&](int k) {
      const auto e = solid.triangle[t].edge[k];
      const BallVector w = cross(unit_[index_.edge(e).value], n);
      return solid.edge[e].vertex[0] == solid.triangle[t].vertex[k] ? w : negative(w);
    };
    add({Kind::kPrism, a, b, c, a, {}}, out(0));
    add({Kind::kPrism, b, c, a, b, {}}, out(1));
    add({Kind::kPrism, c, a, b, c, {}}, out(2));
    if (medial) add({Kind::kPlane, a, b, c, a, {}}, n);
  }
  half_begin_.push_back(static_cast<std::uint32_t>(half_.size()));
}

std::uint32_t SiteGeometry::own_conditions(SiteId s) const {
  switch (index_.kind(s)) {
    case SiteKind::kVertex:
      return 0;
    case SiteKind::kEdge:
      return 2;
    case SiteKind::kFace:
      return 3;
  }
  return 0;
}

const Point3& SiteGeometry::base(SiteId s) const {
  const auto i = index_.element(s);
  switch (index_.kind(s)) {
    case SiteKind::kVertex:
      return solid_->point[i];
    case SiteKind::kEdge:
      return solid_->point[solid_->edge[i].vertex[0]];
    case SiteKind::kFace:
      break;
  }
  return solid_->point[solid_->triangle[i].vertex[0]];
}

std::array<std::uint32_t, 3> SiteGeometry::corners(SiteId s, int& count) const {
  const auto i = index_.element(s);
  switch (index_.kind(s)) {
    case SiteKind::kVertex:
      count = 1;
      return {i, 0, 0};
    case SiteKind::kEdge:
      count = 2;
      return {solid_->edge[i].vertex[0], solid_->edge[i].vertex[1], 0};
    case SiteKind::kFace:
      break;
  }
  count = 3;
  return solid_->triangle[i].vertex;
}

bool SiteGeometry::has_corner(SiteId s, std::uint32_t vertex) const {
  int count = 0;
  const auto corner = corners(s, count);
  return std::find(corner.begin(), corner.begin() + count, vertex) != corner.begin() + count;
}

SiteCounts count_sites(const Solid& solid) {
  SiteCounts n;
  for (std::size_t v = 0; v < solid.point.size(); ++v) n.vertices += !solid.vertex_degenerate[v];
  for (const auto& e : solid.edge) n.edges += e.kind != EdgeKind::kFlat;
  n.faces = solid.triangle.size();
  return n;
}

}  // namespace blum
