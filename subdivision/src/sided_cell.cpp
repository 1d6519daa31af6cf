#include "sided_cell.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "blum/kernel/union_find.hpp"
#include "blum/subdivision/sided_face.hpp"
#include "meeting.hpp"

namespace blum {
namespace {

class SidedCell {
 public:
  SidedCell(Predicates& predicates, const Box3& box, std::span<const std::uint32_t> triangles)
      : predicates_(predicates),
        solid_(predicates.geometry().solid()),
        box_(box),
        triangles_(triangles) {}

  /// Condition (4): the boundary in the cell is made of disks.
  [[nodiscard]] bool boundary_is_disks(const std::set<std::uint32_t>& crossing) {
    std::set<std::uint32_t> vertices, edges = crossing, faces;
    for (const auto t : triangles_)
      for (const auto v : solid_.triangle[t].vertex)
        if (is_inside(v)) vertices.insert(v);
    for (const auto v : vertices)
      edges.insert(solid_.edges_at(v).begin(), solid_.edges_at(v).end());
    for (const auto e : edges)
      faces.insert(solid_.edge[e].triangle.begin(), solid_.edge[e].triangle.end());
    // A triangle whose border misses the cell cuts it with its whole plane, or not at all.
    for (const auto t : triangles_)
      if (!faces.contains(t)) {
        const auto cut = is_section(predicates_, t, box_);
        if (!cut) return false;
        if (*cut) faces.insert(t);
      }
    // Components, with their Euler characteristics from their open cells.
    std::map<std::uint32_t, std::uint32_t> number;
    UnionFind patch;
    for (const auto t : faces) number[t] = patch.add();
    std::vector<int> euler(patch.size(), 0);
    for (const auto e : edges)
      patch.unite(number.at(solid_.edge[e].triangle[0]), number.at(solid_.edge[e].triangle[1]));
    for (const auto& [t, n] : number) ++euler[patch.find(n)];
    for (const auto e : edges) --euler[patch.find(number.at(solid_.edge[e].triangle[0]))];
    for (const auto v : vertices) ++euler[patch.find(number.at(solid_.triangles_at(v).front()))];
    for (std::uint32_t n = 0; n < patch.size(); ++n)
      if (patch.find(n) == n && euler[n] != 1) return false;
    return true;
  }

  /// Do all corners of a triangle lie in the cell?
  [[nodiscard]] bool holds(std::uint32_t t) const {
    return std::ranges::all_of(solid_.triangle[t].vertex, [this](auto v) { return is_inside(v); });
  }

 private:
  [[nodiscard]] bool is_inside(std::uint32_t v) const {
    const Point3& p = solid_.point[v];
    for (int k = 0; k < 3; ++k)
      if (!(p[k] > box_.lo[k] && p[k] < box_.hi[k])) return false;
    return true;
  }

  Predicates& predicates_;
  const Solid& solid_;
  const Box3& box_;
  std::span<const std::uint32_t> triangles_;
};

}  // namespace

SidedAnswer test_sided_cell(Predicates& predicates, const InsideOracle& inside, const Box3& box,
                            std::span<const std::uint32_t> triangles,
                            const VoronoiSurface::Faces& face, VoronoiSide side) {
  const bool wanted = side == VoronoiSide::kInside;
  SidedAnswer answer;
  SidedCell cell(predicates, box, triangles);
  std::set<std::uint32_t> crossing, whole;
  for (const auto t : triangles)
    if (cell.holds(t)) whole.insert(t);
  const SiteIndex& index = predicates.geometry().index();
  bool has_graph = false;
  for (const auto& d : face) {
    const SidedFace sides = sided_face(predicates, inside, *d, triangles);
    if (!sides.decided) return answer;
    for (const auto& c : sides.crossing) crossing.insert(c.edge);
    has_graph = has_graph || !d->arc.empty();
    for (std::size_t k = 0; k < d->arc.size(); ++k) {
      if (sides.inside[k][0] != wanted && sides.inside[k][1] != wanted) continue;
      answer.has_diagram = true;
      // Condition (5): the region of a triangle within the cell shows on the other side only.
      for (const SiteId s : {d->arc[k].left, d->arc[k].right})
        if (index.kind(s) == SiteKind::kFace && whole.contains(index.element(s))) return answer;
    }
  }
  if (!has_graph && !whole.empty() &&
      (inside.locate(box.lo) == InsideOracle::Where::kInside) == wanted)
    return answer;
  answer.has_diagram = answer.has_diagram || !crossing.empty();
  answer.accepted = cell.boundary_is_disks(crossing);
  return answer;
}

}  // namespace blum
