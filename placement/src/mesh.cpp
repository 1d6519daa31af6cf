#include "blum/placement/mesh.hpp"

#include <algorithm>
#include <cmath>

#include "blum/kernel/check.hpp"
#include "blum/kernel/closest_point.hpp"
#include "blum/kernel/parallel.hpp"
#include "blum/kernel/point_algebra.hpp"
#include "equal_distance.hpp"

namespace blum {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;
constexpr int kMostRounds = 40;
/// A new point is not moved by more than this part of its edge.
constexpr double kMostMove = 0.3;

class Mesher {
 public:
  Mesher(const SiteGeometry& geometry, const InsideOracle& inside, const CellComplex& complex,
         const Parts& parts, const ConeSides& sides)
      : geometry_(geometry),
        frame_(geometry.solid().frame),
        inside_(inside),
        parts_(parts),
        sides_(sides) {
    mesh_.complex = complex;
    for (std::uint32_t v = 0; v < complex.vertex.size(); ++v) {
      mesh_.vertex.push_back({0, v});
      position_.push_back(frame_.to_working(complex.vertex[v].position));
    }
    for (std::uint32_t e = 0; e < complex.edge.size(); ++e) mesh_.edge.push_back({1, e});
    for (std::uint32_t t = 0; t < complex.triangle.size(); ++t) mesh_.triangle.push_back(t);
  }

  AxisMesh run(const MeshOptions& options) {
    const auto may_go_on = [&] {
      return mesh_.complex.triangle.size() <= options.most_triangles &&
             (options.stop == nullptr || !*options.stop);
    };
    mesh_.complete = false;
    for (int round = 0; round < kMostRounds && !mesh_.complete && may_go_on(); ++round)
      mesh_.complete = !halve_edges(options);
    return std::move(mesh_);
  }

 private:
  struct Halves {
    std::uint32_t vertex = kNone;         ///< in the middle
    std::array<std::uint32_t, 2> edge{};  ///< towards the edge's vertex[0] and vertex[1]
  };

  /// Those that are too long; false: none is. All or, when it is stopped, none.
  bool halve_edges(const MeshOptions& options);
  void find_neighbours();
  [[nodiscard]] bool on_rim(std::uint32_t edge) const;
  struct Middle {
    Point3 position;  ///< working frame
    ComplexVertex vertex;
    bool unconverged = false;
  };
  [[nodiscard]] Middle middle_of(std::uint32_t edge) const;
  std::uint32_t add_edge(std::uint32_t a, std::uint32_t b, const ComplexTriangle& in,
                         std::uint32_t origin);
  void divide(std::uint32_t triangle);
  void put(std::uint32_t slot, const ComplexTriangle& like, std::uint32_t origin,
           std::array<std::uint32_t, 3> corner, std::array<std::uint32_t, 3> edge);

  const SiteGeometry& geometry_;
  const Frame& frame_;
  const InsideOracle& inside_;
  const Parts& parts_;
  const ConeSides& sides_;
  AxisMesh mesh_;
  std::vector<Point3> position_;                    // working frame
  std::vector<std::vector<std::uint32_t>> beside_;  // triangles at each edge
  std::vector<Halves> half_;
};

void Mesher::find_neighbours() {
  beside_.assign(mesh_.complex.edge.size(), {});
  for (std::uint32_t t = 0; t < mesh_.complex.triangle.size(); ++t)
    for (const auto e : mesh_.complex.triangle[t].edge) beside_[e].push_back(t);
}

bool Mesher::halve_edges(const MeshOptions& options) {
  const auto stopped = [&] { return options.stop != nullptr && *options.stop; };
  find_neighbours();
  const auto edges = static_cast<std::uint32_t>(mesh_.complex.edge.size());
  const auto triangles = static_cast<std::uint32_t>(mesh_.complex.triangle.size());
  half_.assign(edges, {});
  std::vector<std::uint32_t> too_long;
  for (std::uint32_t e = 0; e < edges; ++e) {
    const auto [a, b] = mesh_.complex.edge[e].vertex;
    if (distance_between(position_[a], position_[b]) > options.edge_length) too_long.push_back(e);
  }
  if (too_long.empty()) return false;
  std::vector<Middle> middles(too_long.size());
  for_each_in_parallel(options.threads, too_long.size(), [&](int, std::size_t k) {
    if (!stopped()) middles[k] = middle_of(too_long[k]);
  });
  if (stopped()) return true;
  for (std::size_t k = 0; k < too_long.size(); ++k) {
    const auto e = too_long[k];
    half_[e].vertex = static_cast<std::uint32_t>(position_.size());
    position_.push_back(middles[k].position);
    mesh_.vertex.push_back(mesh_.edge[e]);
    mesh_.complex.vertex.push_back(std::move(middles[k].vertex));
    mesh_.unconverged += middles[k].unconverged ? 1 : 0;
  }
  for (std::uint32_t e = 0; e < edges; ++e) {
    if (half_[e].vertex == kNone) continue;
    ComplexEdge first = mesh_.complex.edge[e], second = first;
    first.vertex[1] = second.vertex[0] = half_[e].vertex;
    mesh_.complex.edge[e] = first;
    half_[e].edge = {e, static_cast<std::uint32_t>(mesh_.complex.edge.size())};
    mesh_.complex.edge.push_back(second);
    mesh_.edge.push_back(mesh_.edge[e]);
  }
  for (std::uint32_t t = 0; t < triangles; ++t) divide(t);
  return true;
}

/// On the solid's convex edges, which bound the axis.
bool Mesher::on_rim(std::uint32_t edge) const {
  const ComplexEdge& e = mesh_.complex.edge[edge];
  if (e.kind == ComplexEdge::Kind::kConvexEdge) return true;
  if (beside_[edge].size() != 1) return false;
  const auto& vertex = mesh_.complex.vertex;
  return vertex[e.vertex[0]].radius == 0 && vertex[e.vertex[1]].radius == 0;
}

Mesher::Middle Mesher::middle_of(std::uint32_t edge) const {
  const auto [a, b] = mesh_.complex.edge[edge].vertex;
  const CellOrigin origin = mesh_.edge[edge];
  Middle result{middle(position_[a], position_[b]), {}};
  Point3& x = result.position;
  ComplexVertex& v = result.vertex;
  v.kind = ComplexVertex::Kind::kMesh;
  if (on_rim(edge)) {
    v.on_axis = true;
    for (const auto t : beside_[edge])
      v.governors.assign(mesh_.complex.triangle[t].governors.begin(),
                         mesh_.complex.triangle[t].governors.end());
    std::sort(v.governors.begin(), v.governors.end());
  } else if (!beside_[edge].empty()) {
    // Where leaves meet the point stays on their common face. Seams have the sides of all sheets.
    const bool seam = origin.dimension == 1 && parts_.edge_seam[origin.cell] != Parts::kNoSeam;
    const LeafSides& leaf = *sides_[mesh_.complex.triangle[beside_[edge].front()].cone];
    Box3 box = leaf.box();
    std::vector<SiteId> governors;
    for (const auto t : beside_[edge]) {
      const ComplexTriangle& triangle = mesh_.complex.triangle[t];
      const LeafSides& other = *sides_[triangle.cone];
      for (int k = 0; k < 3; ++k) {
        box.lo[k] = std::max(box.lo[k], other.box().lo[k]);
        box.hi[k] = std::min(box.hi[k], other.box().hi[k]);
      }
      if (&other == &leaf && (seam || governors.empty()))
        governors.insert(governors.end(), triangle.governors.begin(), triangle.governors.end());
    }
    const auto candidates = leaf.candidates();
    const auto found =
        equal_distance_point(geometry_, inside_, leaf.sides_of(governors), candidates, box, x);
    const double length = distance_between(position_[a], position_[b]);
    v.on_axis = found && distance_between(found->position, x) <= kMostMove * length;
    if (v.on_axis) {
      x = found->position;
      v.radius = frame_.length_to_model(found->radius);
      v.governors = found->governors;
    } else {
      result.unconverged = true;
      const double radius = nearest_foot(geometry_, candidates, x).distance;
      v.radius = frame_.length_to_model(radius);
      for (const SiteId s : candidates)
        if (distance_estimate(geometry_, s, x) <= radius) v.governors.push_back(s);
    }
  }
  v.position = frame_.to_model(x);
  return result;
}

std::uint32_t Mesher::add_edge(std::uint32_t a, std::uint32_t b, const ComplexTriangle& in,
                               std::uint32_t origin) {
  ComplexEdge e;
  e.vertex = {a, b};
  e.kind = ComplexEdge::Kind::kCone;
  e.leaf = in.cone;
  e.governors = in.governors;
  mesh_.complex.edge.push_back(e);
  mesh_.edge.push_back({2, origin});
  return static_cast<std::uint32_t>(mesh_.complex.edge.size() - 1);
}

/// corner 0, 1, 2; edges 01, 02, 12.
void Mesher::put(std::uint32_t slot, const ComplexTriangle& like, std::uint32_t origin,
                 std::array<std::uint32_t, 3> corner, std::array<std::uint32_t, 3> edge) {
  if (mesh_.complex.edge[edge[0]].vertex[0] != corner[0]) std::swap(edge[1], edge[2]);
  ComplexTriangle t = like;
  t.edge = edge;
  if (slot != kNone) {
    mesh_.complex.triangle[slot] = t;
    return;
  }
  mesh_.complex.triangle.push_back(t);
  mesh_.triangle.push_back(origin);
}

void Mesher::divide(std::uint32_t triangle) {
  const ComplexTriangle t = mesh_.complex.triangle[triangle];
  const std::uint32_t origin = mesh_.triangle[triangle];
  // Ends of an edge before it was halved.
  const auto end = [&](std::uint32_t e, std::size_t k) {
    const Halves& h = half_[e];
    return h.vertex == kNone ? mesh_.complex.edge[e].vertex[k]
                             : mesh_.complex.edge[h.edge[k]].vertex[k];
  };
  std::array<std::uint32_t, 3> c{end(t.edge[0], 0), end(t.edge[0], 1), 0};
  c[2] = end(t.edge[1], 0) == c[0] ? end(t.edge[1], 1) : end(t.edge[1], 0);
  // Edges opposite to the corners, their middles, and their halves at a corner.
  std::array<std::uint32_t, 3> e{t.edge[2], t.edge[1], t.edge[0]}, m{};
  int count = 0;
  for (std::size_t k = 0; k < 3; ++k) count += (m[k] = half_[e[k]].vertex) != kNone ? 1 : 0;
  if (count == 0) return;
  const auto half = [&](std::size_t k, std::size_t corner) {
    // The base of a closed arc has both ends at one vertex: its order tells.
    const std::size_t side = k == 2 ? corner : end(e[k], 0) == c[corner] ? 0 : 1;
    return half_[e[k]].edge[side];
  };
  if (count == 1) {
    const std::size_t k = m[0] != kNone ? 0 : m[1] != kNone ? 1 : 2;
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const auto cut = add_edge(c[k], m[k], t, origin);
    put(triangle, t, origin, {c[k], c[i], m[k]}, {e[j], cut, half(k, i)});
    put(kNone, t, origin, {c[k], c[j], m[k]}, {e[i], cut, half(k, j)});
    return;
  }
  if (count == 2) {
    const std::size_t k = m[0] == kNone ? 0 : m[1] == kNone ? 1 : 2;  // not halved
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    // The corner k between the halved edges ki (opposite j) and kj (opposite i).
    const auto across = add_edge(m[j], m[i], t, origin);
    put(triangle, t, origin, {c[k], m[j], m[i]}, {half(j, k), half(i, k), across});
    const bool from_i = distance_between(position_[c[i]], position_[m[i]]) <=
                        distance_between(position_[c[j]], position_[m[j]]);
    if (from_i) {
      const auto diagonal = add_edge(c[i], m[i], t, origin);
      put(kNone, t, origin, {c[i], m[j], m[i]}, {half(j, i), diagonal, across});
      put(kNone, t, origin, {c[i], c[j], m[i]}, {e[k], diagonal, half(i, j)});
    } else {
      const auto diagonal = add_edge(c[j], m[j], t, origin);
      put(kNone, t, origin, {c[j], m[i], m[j]}, {half(i, j), diagonal, across});
      put(kNone, t, origin, {c[j], c[i], m[j]}, {e[k], diagonal, half(j, i)});
    }
    return;
  }
  const std::array<std::uint32_t, 3> inner{add_edge(m[1], m[2], t, origin),
                                           add_edge(m[2], m[0], t, origin),
                                           add_edge(m[0], m[1], t, origin)};
  put(triangle, t, origin, {m[0], m[1], m[2]}, {inner[2], inner[1], inner[0]});
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    put(kNone, t, origin, {c[k], m[j], m[i]}, {half(j, k), half(i, k), inner[k]});
  }
}

}  // namespace

AxisMesh mesh_of(const SiteGeometry& geometry, const InsideOracle& inside,
                 const CellComplex& complex, const Parts& parts, const ConeSides& sides,
                 const MeshOptions& options) {
  BLUM_REQUIRE(options.edge_length > 0);
  return Mesher(geometry, inside, complex, parts, sides).run(options);
}

MedialResult with_mesh(const MedialResult& result, const AxisMesh& mesh) {
  // Halving an edge adds a vertex: this mesh is the complex.
  if (mesh.vertex.size() == result.complex.vertex.size()) return result;
  MedialResult r = result;
  r.complex = mesh.complex;
  std::vector<std::uint32_t> sheet_at(result.complex.edge.size(), kNone);
  for (std::size_t t = 0; t < result.complex.triangle.size(); ++t)
    for (const auto e : result.complex.triangle[t].edge)
      sheet_at[e] = result.parts.triangle_sheet[t];
  r.parts.triangle_sheet.clear();
  for (const auto t : mesh.triangle)
    r.parts.triangle_sheet.push_back(result.parts.triangle_sheet[t]);
  r.parts.edge_seam.clear();
  for (const CellOrigin& o : mesh.edge)
    r.parts.edge_seam.push_back(o.dimension == 1 ? result.parts.edge_seam[o.cell] : Parts::kNoSeam);
  if (result.certified) {
    r.betti = betti_numbers(r.complex);
    BLUM_CHECK(r.betti == result.betti);
  }
  if (!result.angles) return r;
  const auto angle_of = [&](const CellOrigin& o) -> AngleInterval {
    const PartAngles& angles = *result.angles;
    if (o.dimension == 0) return angles.vertex[o.cell];
    if (o.dimension == 2) return angles.sheet[result.parts.triangle_sheet[o.cell]];
    const auto seam = result.parts.edge_seam[o.cell];
    if (seam != Parts::kNoSeam) return angles.seam[seam];
    if (result.complex.edge[o.cell].kind == ComplexEdge::Kind::kConvexEdge ||
        sheet_at[o.cell] == kNone)
      return {0, 0};
    return angles.sheet[sheet_at[o.cell]];
  };
  r.angles->vertex.clear();
  for (const CellOrigin& o : mesh.vertex) r.angles->vertex.push_back(angle_of(o));
  r.angles->is_node.resize(mesh.vertex.size(), false);
  if (!result.filtration) return r;
  const CellValues& value = result.filtration->value;
  const auto value_of = [&](const CellOrigin& o) {
    return o.dimension == 0   ? value.vertex[o.cell]
           : o.dimension == 1 ? value.edge[o.cell]
                              : value.triangle[o.cell];
  };
  r.filtration->collapse.clear();
  r.filtration->step.clear();
  r.filtration->value = {};
  for (const CellOrigin& o : mesh.vertex) r.filtration->value.vertex.push_back(value_of(o));
  for (const CellOrigin& o : mesh.edge) r.filtration->value.edge.push_back(value_of(o));
  for (const auto t : mesh.triangle) r.filtration->value.triangle.push_back(value.triangle[t]);
  return r;
}

}  // namespace blum
