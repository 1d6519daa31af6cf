#include "blum/kernel/solid.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "blum/kernel/check.hpp"
#include "blum/kernel/union_find.hpp"
#include "exact_geometry.hpp"
#include "frame_choice.hpp"
#include "validate_surface.hpp"

namespace blum {

std::optional<std::uint32_t> Solid::common_edge(std::uint32_t a, std::uint32_t b) const {
  for (const auto e : triangle[a].edge)
    if (std::ranges::find(triangle[b].edge, e) != triangle[b].edge.end()) return e;
  return std::nullopt;
}

std::array<long, 3> Solid::betti() const {
  std::array<long, 3> b = {static_cast<long>(components), 0, 0};
  for (const Shell& s : shell) {
    b[1] += s.genus;
    b[2] += s.is_void;
  }
  return b;
}

namespace {

Error invalid_solid(const ValidationReport& report) {
  Error error;
  error.code = ErrorCode::kInvalidSolid;
  error.message = "not a valid solid: " + report.summary(Severity::kError);
  // A warning on its own harms nobody, but next to errors it often is their cause.
  if (const std::string warnings = report.summary(Severity::kWarning); !warnings.empty()) {
    error.message += "; besides: " + warnings;
  }
  for (const Defect& d : report.defects) {
    if (defect_severity(d.kind) != Severity::kError) continue;
    switch (d.kind) {
      case DefectKind::kNoFaces:
        error.code = ErrorCode::kNoFaces;
        break;
      case DefectKind::kNonFiniteCoordinate:
        error.code = ErrorCode::kNonFiniteCoordinate;
        break;
      case DefectKind::kCoordinateOutOfRange:
        error.code = ErrorCode::kCoordinateOutOfRange;
        break;
      case DefectKind::kIndexOutOfRange:
        error.code = ErrorCode::kIndexOutOfRange;
        break;
      default:
        break;
    }
    if (!d.examples.empty() && !d.examples[0].elements.empty()) {
      error.element = d.examples[0].elements[0];
    }
    break;
  }
  return error;
}

/// Edges in the order of their vertex pairs; triangle[0] is the one that runs from the smaller
/// vertex to the larger.
void build_edges(Solid& solid) {
  EdgeTable table;
  table.reserve(3 * solid.triangle.size());
  for (std::uint32_t t = 0; t < solid.triangle.size(); ++t) {
    table.add_face(t, solid.triangle[t].vertex, 3 * t);
  }
  table.finish();
  solid.edge.reserve(3 * solid.triangle.size() / 2);
  table.for_each_edge([&](std::span<const HalfEdge> pair) {
    BLUM_CHECK(pair.size() == 2 && pair[0].forward != pair[1].forward);
    const auto e = static_cast<std::uint32_t>(solid.edge.size());
    const HalfEdge& out = pair[0].forward ? pair[0] : pair[1];
    const HalfEdge& back = pair[0].forward ? pair[1] : pair[0];
    solid.edge.push_back({{out.low, out.high}, {out.face, back.face}, EdgeKind::kFlat});
    // A side is numbered by the corner it starts from.
    solid.triangle[out.face].edge[out.corner_low % 3] = e;
    solid.triangle[back.face].edge[back.corner_high % 3] = e;
  });
}

std::uint32_t opposite_vertex(const SolidTriangle& t, const SolidEdge& e) {
  for (const std::uint32_t v : t.vertex) {
    if (v != e.vertex[0] && v != e.vertex[1]) return v;
  }
  broken_invariant("a triangle without a vertex opposite its edge", __FILE__, __LINE__);
}

/// The far vertex of the second triangle lies under the plane of the first at convex edges. (On it
/// only when flat: a fold of 0 degrees is a self-intersection.)
void classify_edges(Solid& solid) {
  for (SolidEdge& e : solid.edge) {
    const SolidTriangle& t = solid.triangle[e.triangle[0]];
    const int side = exact::orient3d(
        solid.point[t.vertex[0]], solid.point[t.vertex[1]], solid.point[t.vertex[2]],
        solid.point[opposite_vertex(solid.triangle[e.triangle[1]], e)]);
    e.kind = side < 0 ? EdgeKind::kConvex : side > 0 ? EdgeKind::kReflex : EdgeKind::kFlat;
  }
}

void number_facets(Solid& solid) {
  UnionFind joined;
  joined.resize(static_cast<std::uint32_t>(solid.triangle.size()));
  for (const SolidEdge& e : solid.edge) {
    if (e.kind == EdgeKind::kFlat) joined.unite(e.triangle[0], e.triangle[1]);
  }
  solid.facets = 0;
  for (std::uint32_t t = 0; t < solid.triangle.size(); ++t) {
    const std::uint32_t root = joined.find(t);  // the smallest triangle of the facet
    solid.triangle[t].facet = root == t ? solid.facets++ : solid.triangle[root].facet;
  }
}

/// Compressed rows of (vertex, item) pairs that come in increasing order of items.
template <class ForEachPair>
void build_rows(std::size_t rows, std::vector<std::uint32_t>& item,
                std::vector<std::uint32_t>& begin, ForEachPair&& for_each_pair) {
  begin.assign(rows + 1, 0);
  for_each_pair([&](std::uint32_t v, std::uint32_t) { ++begin[v + 1]; });
  for (std::size_t v = 0; v < rows; ++v) begin[v + 1] += begin[v];
  item.resize(begin[rows]);
  std::vector<std::uint32_t> fill(begin.begin(), begin.end() - 1);
  for_each_pair([&](std::uint32_t v, std::uint32_t i) { item[fill[v]++] = i; });
}

void build_incidences(Solid& solid) {
  build_rows(solid.point.size(), solid.vertex_edge, solid.vertex_edge_begin, [&](auto&& add) {
    for (std::uint32_t e = 0; e < solid.edge.size(); ++e) {
      for (const std::uint32_t v : solid.edge[e].vertex) add(v, e);
    }
  });
  build_rows(solid.point.size(), solid.vertex_triangle, solid.vertex_triangle_begin,
             [&](auto&& add) {
               for (std::uint32_t t = 0; t < solid.triangle.size(); ++t) {
                 for (const std::uint32_t v : solid.triangle[t].vertex) add(v, t);
               }
             });
}

void find_degenerate_vertices(Solid& solid) {
  solid.vertex_degenerate.assign(solid.point.size(), false);
  std::vector<Point3> tips;
  for (std::uint32_t v = 0; v < solid.point.size(); ++v) {
    tips.clear();
    for (const std::uint32_t e : solid.edges_at(v)) {
      const SolidEdge& edge = solid.edge[e];
      tips.push_back(solid.point[edge.vertex[0] == v ? edge.vertex[1] : edge.vertex[0]]);
    }
    solid.vertex_degenerate[v] = exact::polar_cone_sides(solid.point[v], tips).empty();
  }
}

void build_shells(const Surface& surface, Solid& solid) {
  std::vector<long> euler(surface.shell.size(), 0);
  for (std::uint32_t v = 0; v < solid.point.size(); ++v) {
    ++euler[solid.triangle[solid.triangles_at(v)[0]].shell];
  }
  for (const SolidEdge& e : solid.edge) --euler[solid.triangle[e.triangle[0]].shell];
  for (const SolidTriangle& t : solid.triangle) ++euler[t.shell];
  for (std::size_t s = 0; s < surface.shell.size(); ++s) {
    BLUM_CHECK(euler[s] <= 2 && euler[s] % 2 == 0);
    solid.shell.push_back({static_cast<int>((2 - euler[s]) / 2), surface.shell[s].depth % 2 == 1,
                           surface.shell[s].component});
  }
  solid.components = surface.components;
}

std::string count_of(std::size_t n, const char* one, const char* many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

void add_warnings(const Surface& surface, Solid& solid) {
  for (const Defect& d : surface.report.defects) {
    switch (d.kind) {
      case DefectKind::kNonPlanarPolygon:
        solid.warnings.push_back(
            count_of(d.count, "polygon is not exactly planar; its triangulation is the solid",
                     "polygons are not exactly planar; their triangulation is the solid"));
        break;
      case DefectKind::kIsolatedVertex:
        solid.warnings.push_back(
            count_of(d.count, "vertex is in no face; dropped", "vertices are in no face; dropped"));
        break;
      case DefectKind::kInvertedSolid:
        solid.warnings.push_back("all normals point inwards; the solid was turned round");
        break;
      default:
        break;
    }
  }
}

}  // namespace

Result<Solid> build_solid(const PolygonMesh& mesh) {
  return build_solid(mesh, analyse_surface(mesh));
}

Result<Solid> build_solid(const PolygonMesh& mesh, const Surface& surface) {
  if (!surface.report.valid()) return invalid_solid(surface.report);

  constexpr std::uint32_t kNone = ~0u;
  std::vector<std::uint32_t> new_index(mesh.points.size(), kNone);
  for (const auto& t : surface.triangle) {
    for (const std::uint32_t v : t) new_index[v] = 0;
  }
  std::vector<Point3> used;
  std::vector<std::size_t> old_index;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (new_index[v] == kNone) continue;
    new_index[v] = static_cast<std::uint32_t>(used.size());
    used.push_back(mesh.points[v]);
    old_index.push_back(v);
  }
  Result<FramedPoints> framed = choose_frame(used);
  if (!framed.ok()) {
    Error error = framed.error();
    if (error.element) error.element = old_index[*error.element];
    return error;
  }

  Solid solid;
  solid.frame = framed.value().frame;
  solid.point = std::move(framed.value().working);
  solid.triangle.resize(surface.triangle.size());
  for (std::size_t i = 0; i < surface.triangle.size(); ++i) {
    SolidTriangle& t = solid.triangle[i];
    for (int k = 0; k < 3; ++k) t.vertex[k] = new_index[surface.triangle[i][k]];
    if (surface.inverted) std::swap(t.vertex[1], t.vertex[2]);
    t.shell = surface.shell_of_triangle[i];
  }
  build_edges(solid);
  classify_edges(solid);
  number_facets(solid);
  build_incidences(solid);
  find_degenerate_vertices(solid);
  build_shells(surface, solid);
  add_warnings(surface, solid);
  return solid;
}

}  // namespace blum
