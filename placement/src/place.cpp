#include "place.hpp"

#include <algorithm>
#include <map>

#include "blum/kernel/point_algebra.hpp"
#include "equal_distance.hpp"

namespace blum {
namespace {

using Governors = std::vector<SiteId>;

/// What the apex of a cone may lie on, the most special first: all sheets over the base, each seam,
/// each sheet.
std::vector<Governors> choices_of(const CellComplex& complex, const Parts& parts,
                                  const std::vector<std::uint32_t>& triangles) {
  Governors all;
  std::map<std::uint32_t, Governors> seam;
  std::vector<Governors> sheet;
  for (const auto t : triangles) {
    const ComplexTriangle& triangle = complex.triangle[t];
    const Governors pair(triangle.governors.begin(), triangle.governors.end());
    all.insert(all.end(), pair.begin(), pair.end());
    for (const std::size_t spoke : {1u, 2u})
      if (parts.edge_seam[triangle.edge[spoke]] != Parts::kNoSeam) {
        Governors& around = seam[triangle.edge[spoke]];
        around.insert(around.end(), pair.begin(), pair.end());
      }
    if (std::find(sheet.begin(), sheet.end(), pair) == sheet.end()) sheet.push_back(pair);
  }
  std::vector<Governors> choices{all};
  for (const auto& [spoke, around] : seam) choices.push_back(around);
  choices.insert(choices.end(), sheet.begin(), sheet.end());
  return choices;
}

}  // namespace

PlacedPoints place_apexes(const SiteGeometry& geometry, const InsideOracle& inside,
                          const Parts& parts, const ConeSides& sides, CellComplex& complex) {
  const Frame& frame = geometry.solid().frame;
  std::vector<std::vector<std::uint32_t>> triangles(complex.cone.size());
  for (std::uint32_t t = 0; t < complex.triangle.size(); ++t)
    triangles[complex.triangle[t].cone].push_back(t);
  PlacedPoints count;
  for (std::uint32_t c = 0; c < complex.cone.size(); ++c) {
    if (complex.cone[c].boundary_vertex != ComplexCone::kNone) continue;
    ComplexVertex& apex = complex.vertex[complex.cone[c].apex];
    const LeafSides& leaf = *sides[c];
    const auto choices = choices_of(complex, parts, triangles[c]);
    for (std::size_t k = 0; k < choices.size(); ++k) {
      const auto found =
          equal_distance_point(geometry, inside, leaf.sides_of(choices[k]), leaf.candidates(),
                               leaf.box(), frame.to_working(apex.position));
      if (!found) continue;
      apex.position = frame.to_model(found->position);
      apex.radius = frame.length_to_model(found->radius);
      apex.governors = found->governors;
      apex.on_axis = true;
      ++(k == 0 ? count.moved : count.on_part);
      break;
    }
  }
  for (const ComplexVertex& v : complex.vertex) count.unconverged += v.on_axis ? 0 : 1;
  return count;
}

}  // namespace blum
