// Walks the sheets of a medial axis: which pair of boundary features each lies between, its area,
// and how thick the solid is there.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <set>
#include <vector>

#include "blum/kernel/shapes.hpp"
#include "blum/kernel/solid.hpp"
#include "blum/medial/medial_axis.hpp"

namespace {

double area(const blum::Point3& a, const blum::Point3& b, const blum::Point3& c) {
  const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
  const double vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  return std::hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2;
}

struct Sheet {
  std::set<blum::SiteId> governors;
  double area = 0;
  double least_radius = std::numeric_limits<double>::infinity(), greatest_radius = 0;
};

std::vector<Sheet> collect_sheets(const blum::MedialResult& result) {
  const blum::CellComplex& complex = result.complex;
  std::vector<Sheet> sheets(result.parts.sheets);
  for (std::size_t t = 0; t < complex.triangle.size(); ++t) {
    const blum::ComplexTriangle& triangle = complex.triangle[t];
    Sheet& sheet = sheets[result.parts.triangle_sheet[t]];
    sheet.governors.insert(triangle.governors.begin(), triangle.governors.end());
    std::vector<blum::Point3> points;
    for (const std::uint32_t v : corners(complex, triangle)) {
      const blum::ComplexVertex& vertex = complex.vertex[v];
      points.push_back(vertex.position);
      if (!vertex.on_axis) continue;  // an apex inside its leaf: its radius is that of no sheet
      sheet.least_radius = std::min(sheet.least_radius, vertex.radius);
      sheet.greatest_radius = std::max(sheet.greatest_radius, vertex.radius);
    }
    sheet.area += area(points[0], points[1], points[2]);
  }
  return sheets;
}

}  // namespace

int main() {
  const blum::Result<blum::Solid> solid = blum::build_solid(blum::shapes::lbracket());
  if (!solid) return 2;
  blum::MedialOptions options;
  options.resolve = true;  // refine until the sheets can be counted
  const auto axis = blum::compute_medial_axis(solid.value(), options);
  if (!axis || !axis.value().certified) {
    std::cerr << (axis ? "not certified" : axis.error().message) << '\n';
    return 3;
  }

  const blum::SiteIndex sites(solid.value());
  const char* const names[] = {"vertex", "edge", "face"};
  for (const Sheet& sheet : collect_sheets(axis.value())) {
    std::cout << "area " << sheet.area << ", radius " << sheet.least_radius << " to "
              << sheet.greatest_radius << ", between";
    for (const blum::SiteId site : sheet.governors) {
      std::cout << ' ' << names[static_cast<int>(sites.kind(site))] << ' ' << sites.element(site);
    }
    std::cout << '\n';
  }
  return 0;
}
