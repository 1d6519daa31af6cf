#include "blum/medial/subcomplex.hpp"

#include <array>
#include <cmath>

#include "blum/kernel/check.hpp"
#include "blum/kernel/point_algebra.hpp"
#include "parts_numbering.hpp"

namespace blum {
namespace {

using detail::SetNumbering;
constexpr std::uint32_t kNone = 0xffffffffu;

std::vector<std::uint32_t> chosen(const std::vector<bool>& mask) {
  std::vector<std::uint32_t> list;
  for (std::uint32_t i = 0; i < mask.size(); ++i)
    if (mask[i]) list.push_back(i);
  return list;
}

std::vector<std::uint32_t> inverse(const std::vector<std::uint32_t>& list, std::size_t size) {
  std::vector<std::uint32_t> place(size, kNone);
  for (std::uint32_t i = 0; i < list.size(); ++i) place[list[i]] = i;
  return place;
}

double area_of(const CellComplex& k, const ComplexTriangle& t) {
  const auto [p, q, r] = corners(k, t);
  const Point3 &a = k.vertex[p].position, &b = k.vertex[q].position, &c = k.vertex[r].position;
  return 0.5 * length(cross(b - a, c - a));
}

}  // namespace

Subcomplex subcomplex(const CellComplex& complex, const CellMask& cells) {
  Subcomplex s;
  s.vertex = chosen(cells.vertex);
  s.edge = chosen(cells.edge);
  s.triangle = chosen(cells.triangle);
  const auto vertex = inverse(s.vertex, complex.vertex.size());
  const auto edge = inverse(s.edge, complex.edge.size());
  for (const auto v : s.vertex) s.complex.vertex.push_back(complex.vertex[v]);
  for (const auto e : s.edge) {
    s.complex.edge.push_back(complex.edge[e]);
    for (auto& v : s.complex.edge.back().vertex) {
      v = vertex[v];
      BLUM_CHECK(v != kNone);
    }
  }
  for (const auto t : s.triangle) {
    s.complex.triangle.push_back(complex.triangle[t]);
    for (auto& e : s.complex.triangle.back().edge) {
      e = edge[e];
      BLUM_CHECK(e != kNone);
    }
  }
  for (ComplexCone c : complex.cone) {
    c.apex = vertex[c.apex] == kNone ? 0 : vertex[c.apex];
    s.complex.cone.push_back(c);
  }
  return s;
}

Parts restricted(const Parts& parts, const Subcomplex& part) {
  Parts p;
  p.sheets = parts.sheets;
  p.seams = parts.seams;
  p.cone_shape = parts.cone_shape;
  p.junctions = parts.junctions;
  p.clusters = parts.clusters;
  for (const auto t : part.triangle) p.triangle_sheet.push_back(parts.triangle_sheet[t]);
  for (const auto e : part.edge) p.edge_seam.push_back(parts.edge_seam[e]);
  return p;
}

CellMask closure_of_values(const CellComplex& complex, const CellValues& value, double at_least) {
  CellMask mask;
  for (const double v : value.vertex) mask.vertex.push_back(v >= at_least);
  for (const double v : value.edge) mask.edge.push_back(v >= at_least);
  for (const double v : value.triangle) mask.triangle.push_back(v >= at_least);
  for (std::size_t t = 0; t < complex.triangle.size(); ++t)
    if (mask.triangle[t])
      for (const auto e : complex.triangle[t].edge) mask.edge[e] = true;
  for (std::size_t e = 0; e < complex.edge.size(); ++e)
    if (mask.edge[e])
      for (const auto v : complex.edge[e].vertex) mask.vertex[v] = true;
  return mask;
}

ShapeCounts count_shapes(const CellComplex& complex) {
  ShapeCounts counts;
  std::vector<std::uint32_t> degree(complex.edge.size(), 0), first(complex.edge.size(), kNone);
  UnionFind sheets;
  sheets.resize(static_cast<std::uint32_t>(complex.triangle.size()));
  for (const ComplexTriangle& t : complex.triangle) {
    counts.area += area_of(complex, t);
    for (const auto e : t.edge) ++degree[e];
  }
  for (std::uint32_t t = 0; t < complex.triangle.size(); ++t)
    for (const auto e : complex.triangle[t].edge) {
      if (degree[e] != 2) continue;
      if (first[e] != kNone) sheets.unite(first[e], t);
      first[e] = t;
    }
  SetNumbering sheet_number(sheets);
  for (std::uint32_t t = 0; t < complex.triangle.size(); ++t) (void)sheet_number.of(t);
  counts.sheets = sheet_number.count();

  // Curves go on where exactly two ends of the same kind meet.
  const auto on_curve = [&](std::size_t e) { return degree[e] == 0 || degree[e] >= 3; };
  std::vector<std::array<std::uint32_t, 2>> at(complex.vertex.size(), {kNone, kNone});
  std::vector<std::uint32_t> ends(complex.vertex.size(), 0);
  for (std::uint32_t e = 0; e < complex.edge.size(); ++e) {
    if (!on_curve(e)) continue;
    for (const auto v : complex.edge[e].vertex) {
      if (ends[v] < 2) at[v][ends[v]] = e;
      ++ends[v];
    }
  }
  UnionFind curves;
  curves.resize(static_cast<std::uint32_t>(complex.edge.size()));
  for (std::size_t v = 0; v < complex.vertex.size(); ++v) {
    if (ends[v] == 2 && (degree[at[v][0]] == 0) == (degree[at[v][1]] == 0))
      curves.unite(at[v][0], at[v][1]);
    else if (ends[v] > 2)
      ++counts.junctions;
  }
  SetNumbering seam_number(curves), curve_number(curves);
  for (std::uint32_t e = 0; e < complex.edge.size(); ++e)
    if (on_curve(e)) (void)(degree[e] == 0 ? curve_number : seam_number).of(e);
  counts.seams = seam_number.count();
  counts.curves = curve_number.count();
  return counts;
}

}  // namespace blum
