#include "place.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "blum/kernel/parallel.hpp"
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

class Placer {
 public:
  Placer(const SiteGeometry& geometry, const InsideOracle& inside, const Parts& parts,
         const ConeSides& sides, CellComplex& complex)
      : geometry_(geometry), inside_(inside), parts_(parts), sides_(sides), complex_(complex) {}

  PlacedPoints run(const PlaceOptions& options) {
    std::vector<std::vector<std::uint32_t>> of_cone(complex_.cone.size()),
        at(complex_.vertex.size());
    for (std::uint32_t t = 0; t < complex_.triangle.size(); ++t) {
      of_cone[complex_.triangle[t].cone].push_back(t);
      for (const auto v : corners(complex_, complex_.triangle[t])) at[v].push_back(t);
    }
    struct Task {
      std::uint32_t vertex;
      const std::vector<std::uint32_t>* triangles;
      bool is_apex;
      std::optional<std::size_t> choice = {};
    };
    std::vector<Task> tasks;
    // Clusters of events on faces of leaves: these stay on their face.
    for (std::uint32_t v = 0; v < complex_.vertex.size(); ++v)
      if (!complex_.vertex[v].on_axis && complex_.vertex[v].kind != ComplexVertex::Kind::kCone &&
          !at[v].empty())
        tasks.push_back({v, &at[v], false});
    for (std::uint32_t c = 0; c < complex_.cone.size(); ++c)
      if (complex_.cone[c].boundary_vertex == ComplexCone::kNone)
        tasks.push_back({complex_.cone[c].apex, &of_cone[c], true});
    // A task reads and writes no vertex but its own.
    for_each_in_parallel(options.threads, tasks.size(), [&](int, std::size_t k) {
      if (options.stop != nullptr && *options.stop) return;
      tasks[k].choice = place(tasks[k].vertex, *tasks[k].triangles);
    });
    PlacedPoints count;
    for (const Task& task : tasks)
      if (task.choice) ++(task.is_apex && *task.choice == 0 ? count.moved : count.on_part);
    for (const ComplexVertex& v : complex_.vertex) count.unconverged += v.on_axis ? 0 : 1;
    return count;
  }

 private:
  /// Returns which of the choices it was.
  std::optional<std::size_t> place(std::uint32_t vertex,
                                   const std::vector<std::uint32_t>& triangles) {
    if (triangles.empty()) return std::nullopt;
    const Frame& frame = geometry_.solid().frame;
    const LeafSides& leaf = *sides_[complex_.triangle[triangles.front()].cone];
    Box3 box = leaf.box();
    std::vector<std::uint32_t> of_leaf;
    for (const auto t : triangles) {
      const LeafSides& other = *sides_[complex_.triangle[t].cone];
      for (int k = 0; k < 3; ++k) {
        box.lo[k] = std::max(box.lo[k], other.box().lo[k]);
        box.hi[k] = std::min(box.hi[k], other.box().hi[k]);
      }
      if (&other == &leaf) of_leaf.push_back(t);
    }
    ComplexVertex& v = complex_.vertex[vertex];
    const auto choices = choices_of(complex_, parts_, of_leaf);
    for (std::size_t k = 0; k < choices.size(); ++k) {
      const auto found = equal_distance_point(geometry_, inside_, leaf.sides_of(choices[k]),
                                              leaf.candidates(), box, frame.to_working(v.position));
      if (!found) continue;
      v.position = frame.to_model(found->position);
      v.radius = frame.length_to_model(found->radius);
      v.governors = found->governors;
      v.on_axis = true;
      return k;
    }
    return std::nullopt;
  }

  const SiteGeometry& geometry_;
  const InsideOracle& inside_;
  const Parts& parts_;
  const ConeSides& sides_;
  CellComplex& complex_;
};

}  // namespace

PlacedPoints place_points(const SiteGeometry& geometry, const InsideOracle& inside,
                          const Parts& parts, const ConeSides& sides, CellComplex& complex,
                          const PlaceOptions& options) {
  return Placer(geometry, inside, parts, sides, complex).run(options);
}

}  // namespace blum
