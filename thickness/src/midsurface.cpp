#include "blum/thickness/midsurface.hpp"

#include <algorithm>

#include "blum/kernel/check.hpp"
#include "blum/kernel/point_algebra.hpp"
#include "blum/medial/subcomplex.hpp"

namespace blum {
namespace {

std::vector<bool> chosen_sheets(const MedialResult& axis, const MidsurfaceOptions& options) {
  const CellComplex& k = axis.complex;
  std::vector<double> most(axis.parts.sheets, 0);
  for (std::size_t t = 0; t < k.triangle.size(); ++t) {
    double& thickness = most[axis.parts.triangle_sheet[t]];
    for (const std::uint32_t v : corners(k, k.triangle[t])) {
      thickness = std::max(thickness, 2 * k.vertex[v].radius);
    }
  }
  std::vector<bool> chosen(axis.parts.sheets);
  for (std::size_t s = 0; s < chosen.size(); ++s) {
    chosen[s] =
        axis.angles->sheet[s].lo >= options.opposite_deg && most[s] <= options.most_thickness;
  }
  return chosen;
}

}  // namespace

Midsurface midsurface(const MedialResult& axis, const MidsurfaceOptions& options) {
  BLUM_CHECK(axis.angles.has_value());
  const std::vector<bool> chosen = chosen_sheets(axis, options);
  CellMask mask = all_cells(axis.complex);
  std::fill(mask.vertex.begin(), mask.vertex.end(), false);
  std::fill(mask.edge.begin(), mask.edge.end(), false);
  for (std::size_t t = 0; t < mask.triangle.size(); ++t) {
    mask.triangle[t] = chosen[axis.parts.triangle_sheet[t]];
    if (!mask.triangle[t]) continue;
    for (const std::uint32_t e : axis.complex.triangle[t].edge) {
      mask.edge[e] = true;
      for (const std::uint32_t v : axis.complex.edge[e].vertex) mask.vertex[v] = true;
    }
  }
  const Subcomplex part = subcomplex(axis.complex, mask);
  Midsurface m;
  m.sheets = static_cast<std::size_t>(std::count(chosen.begin(), chosen.end(), true));
  m.least = std::numeric_limits<double>::infinity();
  for (const ComplexVertex& v : part.complex.vertex) {
    m.point.push_back(v.position);
    m.thickness.push_back(2 * v.radius);
    m.on_axis.push_back(v.on_axis);
    m.least = std::min(m.least, 2 * v.radius);
    m.most = std::max(m.most, 2 * v.radius);
  }
  if (m.point.empty()) m.least = 0;
  std::vector<std::int32_t> degree(part.complex.edge.size(), 0);
  for (std::size_t t = 0; t < part.complex.triangle.size(); ++t) {
    const auto corner = corners(part.complex, part.complex.triangle[t]);
    m.triangle.push_back(corner);
    m.sheet.push_back(static_cast<std::int32_t>(axis.parts.triangle_sheet[part.triangle[t]]));
    for (const std::uint32_t e : part.complex.triangle[t].edge) ++degree[e];
    m.area += length(cross(m.point[corner[1]] - m.point[corner[0]],
                           m.point[corner[2]] - m.point[corner[0]])) /
              2;
  }
  for (std::size_t e = 0; e < degree.size(); ++e) {
    if (degree[e] == 2) continue;
    m.line.push_back(part.complex.edge[e].vertex);
    m.line_sheets.push_back(degree[e]);
    if (degree[e] >= 3) ++m.junction_lines;
  }
  return m;
}

}  // namespace blum
