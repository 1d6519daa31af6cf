#include "partners.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "blum/kernel/site_tree.hpp"

namespace blum::detail {
namespace {

std::array<Point3, 3> positions(const CellComplex& k, const ComplexTriangle& t) {
  const auto [a, b, c] = corners(k, t);
  return {k.vertex[a].position, k.vertex[b].position, k.vertex[c].position};
}

void make_set(std::vector<SiteId>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

Partners::Partners(const Solid& solid, const MedialResult& axis)
    : solid_(solid), axis_(axis), sites_(solid), partner_(solid.triangle.size()) {
  const auto add = [this](SiteId a, SiteId b) {
    if (a != b && sites_.kind(a) == SiteKind::kFace) partner_[sites_.element(a)].push_back(b);
  };
  for (std::uint32_t t = 0; t < axis.complex.triangle.size(); ++t) {
    const auto [a, b] = axis.complex.triangle[t].governors;
    add(a, b);
    add(b, a);
    Between& between = between_[std::minmax(key(a), key(b))];
    between.triangle.push_back(t);
    between.one_sheet &=
        axis.parts.triangle_sheet[t] == axis.parts.triangle_sheet[between.triangle.front()];
  }
  for (const ComplexVertex& v : axis.complex.vertex) {
    for (const SiteId a : v.governors) {
      for (const SiteId b : v.governors) add(a, b);
    }
  }
  for (auto& list : partner_) make_set(list);
}

Partners::Key Partners::key(SiteId site) const {
  const std::uint32_t element = sites_.element(site);
  const auto of_facet = [this](std::uint32_t triangle) {
    return sites_.size() + solid_.triangle[triangle].facet;
  };
  if (sites_.kind(site) == SiteKind::kFace) return of_facet(element);
  if (sites_.kind(site) == SiteKind::kEdge && solid_.edge[element].kind == EdgeKind::kFlat) {
    return of_facet(solid_.edge[element].triangle[0]);
  }
  return site.value;
}

std::int32_t Partners::sheet(std::uint32_t face, SiteId site, const Point3& x) const {
  const auto found = between_.find(std::minmax(key(sites_.face(face)), key(site)));
  if (found == between_.end()) return -1;
  const auto sheet_of = [this](std::uint32_t t) {
    return static_cast<std::int32_t>(axis_.parts.triangle_sheet[t]);
  };
  const Between& between = found->second;
  if (between.one_sheet) return sheet_of(between.triangle.front());
  double least = std::numeric_limits<double>::infinity();
  std::int32_t nearest = -1;
  for (const std::uint32_t t : between.triangle) {
    const CellComplex& k = axis_.complex;
    const double d = squared_distance_to_triangle(x, positions(k, k.triangle[t])).hi;
    if (d < least) {
      least = d;
      nearest = sheet_of(t);
    }
  }
  return nearest;
}

}  // namespace blum::detail
