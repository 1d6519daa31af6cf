#include "blum/arrangement/touching.hpp"

#include <algorithm>

#include "groups.hpp"
#include "local_form.hpp"

namespace blum {
namespace {

using Kind = Touch::Kind;

BallVector minus(const BallVector& a) { return {-a[0], -a[1], -a[2]}; }
BallVector sum(const BallVector& a, const BallVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

class Toucher {
 public:
  explicit Toucher(Predicates& predicates)
      : predicates_(predicates),
        geometry_(predicates.geometry()),
        solid_(geometry_.solid()),
        index_(geometry_.index()) {}

  /// Requires kind(a) >= kind(b): faces before edges before vertices.
  Touch of(SiteId a, SiteId b) {
    const CommonCorners common = common_corners(geometry_, a, b);
    switch (index_.kind(a)) {
      case SiteKind::kVertex:
        return {};
      case SiteKind::kEdge:
        return index_.kind(b) == SiteKind::kVertex ? edge_vertex(a, b, common)
                                                   : edge_edge(a, b, common);
      case SiteKind::kFace:
        break;
    }
    switch (index_.kind(b)) {
      case SiteKind::kVertex:
        return face_vertex(a, b, common);
      case SiteKind::kEdge:
        if (common.count == 2) return by_prism(a, common);
        break;
      case SiteKind::kFace:
        return face_face(a, b, common);
    }
    return apart_or_ordinary(a, b, common);
  }

 private:
  Touch apart_or_ordinary(SiteId a, SiteId b, const CommonCorners& common) {
    Touch t;
    if (common.count == 0 && predicates_.redundant(a, b)) t.kind = Kind::kNever;
    return t;
  }

  /// The plane through the common edge, orthogonal to the face.
  Touch by_prism(SiteId face, const CommonCorners& common) {
    const auto& v = solid_.triangle[index_.element(face)].vertex;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto p = v[k], q = v[(k + 1) % 3];
      if ((p == common.vertex[0] && q == common.vertex[1]) ||
          (p == common.vertex[1] && q == common.vertex[0]))
        return {Kind::kPlane, geometry_.domain(face)[k].w, p};
    }
    return {};
  }

  /// Of unit vectors u, v in the faces, across the common edge, both have a foot of a tie at the
  /// same distance from it: the tie lies on the plane across u - v.
  Touch by_bisector(SiteId a, SiteId b, const CommonCorners& common) {
    const Touch out_a = by_prism(a, common), out_b = by_prism(b, common);  // w = -u, -v
    return {Kind::kBisector, sum(out_a.w, minus(out_b.w)), out_a.base};
  }

  BallVector away(std::uint32_t edge, std::uint32_t v) const {
    return away_from(geometry_, edge, v);
  }

  /// The two edges of a triangle that meet in its corner v.
  std::array<std::uint32_t, 2> edges_at(std::uint32_t triangle, std::uint32_t v) const {
    const auto& t = solid_.triangle[triangle];
    const auto k = static_cast<std::size_t>(std::ranges::find(t.vertex, v) - t.vertex.begin());
    return {t.edge[k], t.edge[(k + 2) % 3]};
  }

  Touch face_vertex(SiteId a, SiteId b, const CommonCorners& common) {
    if (common.count == 0) return apart_or_ordinary(a, b, common);
    // Across the bisector of the corner: it is acute to both edges.
    const auto v = index_.element(b);
    const auto [e, f] = edges_at(index_.element(a), v);
    return {Kind::kPlane, minus(sum(away(e, v), away(f, v))), v};
  }

  Touch edge_vertex(SiteId a, SiteId b, const CommonCorners& common) {
    if (common.count == 0) return apart_or_ordinary(a, b, common);
    const auto v = index_.element(b);
    return {Kind::kPlane, minus(away(index_.element(a), v)), v};
  }

  Touch edge_edge(SiteId a, SiteId b, const CommonCorners& common) {
    if (common.count != 1) return apart_or_ordinary(a, b, common);
    const auto v = common.vertex[0];
    const auto e = index_.element(a), f = index_.element(b);
    if (predicates_.redundant(a, b)) return {Kind::kPlane, minus(away(e, v)), v};
    // Edges of one triangle tie on the line across it in their corner alone.
    for (const auto t : solid_.edge[e].triangle)
      if (std::ranges::find(solid_.triangle[t].edge, f) != solid_.triangle[t].edge.end())
        return {Kind::kPlane, sum(away(f, v), minus(away(e, v))), v};
    return {};
  }

  Touch face_face(SiteId a, SiteId b, const CommonCorners& common) {
    if (!predicates_.redundant(a, b))
      return common.count == 2 ? by_bisector(a, b, common) : Touch{};
    if (common.count == 0) return {Kind::kNever, {}, 0};
    if (common.count == 2) return by_prism(a, common);
    // Two triangles of one plane with a common corner: the line of some edge there parts them.
    const auto v = common.vertex[0];
    const auto beyond = [&](const BallVector& w, SiteId site) {
      const auto& corner = solid_.triangle[index_.element(site)].vertex;
      return std::ranges::all_of(corner, [&](auto p) {
        return p == v || dot(w, difference(solid_.point[p], solid_.point[v])).sign() == 1;
      });
    };
    for (const bool first : {true, false}) {
      const SiteId own = first ? a : b, other = first ? b : a;
      for (const auto e : edges_at(index_.element(own), v)) {
        const auto& ends = solid_.edge[e].vertex;
        Touch t = by_prism(own, {{ends[0], ends[1], 0}, 2});
        t.base = v;
        if (!beyond(t.w, other)) continue;
        if (!first) t.w = minus(t.w);
        return t;
      }
    }
    return {};
  }

  Predicates& predicates_;
  const SiteGeometry& geometry_;
  const Solid& solid_;
  const SiteIndex& index_;
};

}  // namespace

Touch touch(Predicates& predicates, SiteId a, SiteId b) {
  const SiteIndex& index = predicates.geometry().index();
  if (index.kind(a) >= index.kind(b)) return Toucher(predicates).of(a, b);
  Touch t = Toucher(predicates).of(b, a);
  t.w = minus(t.w);
  return t;
}

}  // namespace blum
