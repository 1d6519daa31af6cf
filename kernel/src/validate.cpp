#include "blum/kernel/validate.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "blum/kernel/triangulate.hpp"
#include "blum/kernel/union_find.hpp"
#include "validate_surface.hpp"

namespace blum {
namespace {

constexpr std::size_t kMaxExamples = 5;
constexpr double kMaxCoordinate = 0x1p200;

std::string text(double x) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, x).ptr};
}

}  // namespace

const char* defect_kind_name(DefectKind kind) {
  switch (kind) {
    case DefectKind::kNoFaces:
      return "no_faces";
    case DefectKind::kNonFiniteCoordinate:
      return "non_finite_coordinate";
    case DefectKind::kCoordinateOutOfRange:
      return "coordinate_out_of_range";
    case DefectKind::kIndexOutOfRange:
      return "index_out_of_range";
    case DefectKind::kDegenerateFace:
      return "degenerate_face";
    case DefectKind::kNonSimplePolygon:
      return "non_simple_polygon";
    case DefectKind::kNonPlanarPolygon:
      return "non_planar_polygon";
    case DefectKind::kDuplicateFace:
      return "duplicate_face";
    case DefectKind::kDuplicateVertex:
      return "duplicate_vertex";
    case DefectKind::kIsolatedVertex:
      return "isolated_vertex";
    case DefectKind::kBoundaryEdge:
      return "boundary_edge";
    case DefectKind::kNonManifoldEdge:
      return "nonmanifold_edge";
    case DefectKind::kNonManifoldVertex:
      return "nonmanifold_vertex";
    case DefectKind::kInconsistentOrientation:
      return "inconsistent_orientation";
    case DefectKind::kSelfIntersection:
      return "self_intersection";
    case DefectKind::kShellNesting:
      return "shell_nesting";
    case DefectKind::kInvertedSolid:
      return "inverted_solid";
  }
  return "unknown";
}

const char* severity_name(Severity severity) {
  return severity == Severity::kError ? "error" : "warning";
}

Severity defect_severity(DefectKind kind) {
  switch (kind) {
    case DefectKind::kNonPlanarPolygon:
    case DefectKind::kDuplicateVertex:
    case DefectKind::kIsolatedVertex:
    case DefectKind::kInvertedSolid:
      return Severity::kWarning;
    default:
      return Severity::kError;
  }
}

const char* defect_element_name(DefectKind kind) {
  switch (kind) {
    case DefectKind::kNoFaces:
      return "mesh";
    case DefectKind::kNonFiniteCoordinate:
    case DefectKind::kCoordinateOutOfRange:
    case DefectKind::kDuplicateVertex:
    case DefectKind::kIsolatedVertex:
    case DefectKind::kNonManifoldVertex:
      return "vertex";
    case DefectKind::kBoundaryEdge:
    case DefectKind::kNonManifoldEdge:
    case DefectKind::kInconsistentOrientation:
      return "edge";
    case DefectKind::kSelfIntersection:
      return "face_pair";
    case DefectKind::kShellNesting:
    case DefectKind::kInvertedSolid:
      return "shell";
    default:
      return "face";
  }
}

bool ValidationReport::valid() const {
  return std::none_of(defects.begin(), defects.end(),
                      [](const Defect& d) { return defect_severity(d.kind) == Severity::kError; });
}

const Defect* ValidationReport::find(DefectKind kind) const {
  for (const Defect& d : defects) {
    if (d.kind == kind) return &d;
  }
  return nullptr;
}

std::string ValidationReport::summary(Severity severity) const {
  std::string out;
  for (const Defect& d : defects) {
    if (defect_severity(d.kind) != severity) continue;
    if (!out.empty()) out += ", ";
    if (d.count_is_lower_bound) out += "at least ";
    out += std::to_string(d.count);
    out += ' ';
    out += defect_kind_name(d.kind);
    if (d.examples.empty() || d.examples[0].elements.empty()) continue;
    const DefectExample& e = d.examples[0];
    out += " (";
    out += defect_element_name(d.kind);
    for (const std::size_t i : e.elements) {
      out += ' ';
      out += std::to_string(i);
    }
    if (!e.points.empty()) {
      const Point3& p = e.points[0];
      out += " at (" + text(p.x) + ", " + text(p.y) + ", " + text(p.z) + ")";
    }
    out += ")";
  }
  return out;
}

Defect& DefectCollector::of(DefectKind kind) {
  const auto at = std::lower_bound(defects_.begin(), defects_.end(), kind,
                                   [](const Defect& d, DefectKind k) { return d.kind < k; });
  if (at != defects_.end() && at->kind == kind) return *at;
  Defect fresh;
  fresh.kind = kind;
  return *defects_.insert(at, std::move(fresh));
}

void DefectCollector::add(DefectKind kind, std::vector<std::size_t> elements,
                          std::span<const std::uint32_t> at_vertices) {
  Defect& d = of(kind);
  ++d.count;
  if (d.examples.size() >= kMaxExamples) return;
  DefectExample e;
  e.elements = std::move(elements);
  for (const std::uint32_t v : at_vertices) e.points.push_back(points_[v]);
  d.examples.push_back(std::move(e));
}

void DefectCollector::mark_as_lower_bound(DefectKind kind) { of(kind).count_is_lower_bound = true; }

bool DefectCollector::any_error() const {
  return std::any_of(defects_.begin(), defects_.end(),
                     [](const Defect& d) { return defect_severity(d.kind) == Severity::kError; });
}

ValidationReport DefectCollector::take() { return {std::move(defects_)}; }

namespace {

using Vertex = std::array<std::uint32_t, 1>;

/// Marks the vertices whose coordinates can be computed with.
std::vector<bool> check_vertices(const PolygonMesh& mesh, DefectCollector& defects) {
  std::vector<bool> good(mesh.points.size(), true);
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    const Point3& p = mesh.points[v];
    const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      defects.add(DefectKind::kNonFiniteCoordinate, {v}, Vertex{v});
    } else if (largest > kMaxCoordinate) {
      defects.add(DefectKind::kCoordinateOutOfRange, {v}, Vertex{v});
    } else {
      continue;
    }
    good[v] = false;
  }
  return good;
}

void find_duplicate_vertices(const PolygonMesh& mesh, const std::vector<bool>& good,
                             DefectCollector& defects) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    if (good[v]) order.push_back(v);
  }
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    const Point3 &p = mesh.points[i], &q = mesh.points[j];
    if (p.x != q.x) return p.x < q.x;
    if (p.y != q.y) return p.y < q.y;
    return p.z != q.z ? p.z < q.z : i < j;
  });
  std::vector<std::pair<std::uint32_t, std::uint32_t>> later;  // (vertex, the first at its place)
  for (std::size_t k = 0, first = 0; k < order.size(); ++k) {
    if (!(mesh.points[order[k]] == mesh.points[order[first]])) first = k;
    if (k != first) later.emplace_back(order[k], order[first]);
  }
  std::sort(later.begin(), later.end());
  for (const auto& [v, first] : later) {
    defects.add(DefectKind::kDuplicateVertex, {v, first}, Vertex{v});
  }
}

void find_duplicate_faces(const PolygonMesh& mesh, const std::vector<std::uint32_t>& faces,
                          DefectCollector& defects) {
  std::vector<std::vector<std::uint32_t>> key(mesh.faces.size());
  for (const std::uint32_t f : faces) {
    key[f] = mesh.faces[f];
    std::sort(key[f].begin(), key[f].end());
  }
  std::vector<std::uint32_t> order = faces;
  std::sort(order.begin(), order.end(), [&](std::uint32_t f, std::uint32_t g) {
    return key[f] != key[g] ? key[f] < key[g] : f < g;
  });
  std::vector<std::pair<std::uint32_t, std::uint32_t>> later;
  for (std::size_t k = 0, first = 0; k < order.size(); ++k) {
    if (key[order[k]] != key[order[first]]) first = k;
    if (k != first) later.emplace_back(order[k], order[first]);
  }
  std::sort(later.begin(), later.end());
  for (const auto& [f, first] : later) {
    defects.add(DefectKind::kDuplicateFace, {f, first}, Vertex{mesh.faces[f][0]});
  }
}

void check_edges(const EdgeTable& edges, DefectCollector& defects) {
  edges.for_each_edge([&](std::span<const HalfEdge> e) {
    const std::array<std::uint32_t, 2> ends = {e[0].low, e[0].high};
    const auto report = [&](DefectKind kind) { defects.add(kind, {ends[0], ends[1]}, ends); };
    if (e.size() == 1)
      report(DefectKind::kBoundaryEdge);
    else if (e.size() > 2)
      report(DefectKind::kNonManifoldEdge);
    else if (e[0].forward == e[1].forward)
      report(DefectKind::kInconsistentOrientation);
  });
}

/// Diagonals cut into polygons can coincide with one another or with an edge.
void check_diagonals(const Surface& surface, DefectCollector& defects) {
  EdgeTable edges;
  edges.reserve(3 * surface.triangle.size());
  for (std::uint32_t t = 0; t < surface.triangle.size(); ++t) {
    edges.add_face(t, surface.triangle[t], 3 * t);
  }
  edges.finish();
  edges.for_each_edge([&](std::span<const HalfEdge> e) {
    if (e.size() <= 2 || surface.face_edges.degree(e[0].low, e[0].high) > 2) return;
    defects.add(DefectKind::kNonManifoldEdge, {e[0].low, e[0].high},
                std::array{e[0].low, e[0].high});
  });
}

/// A vertex is pinched when the faces around it fall into several fans joined by edges.
void check_fans(const PolygonMesh& mesh, const std::vector<std::uint32_t>& faces,
                const EdgeTable& edges, std::size_t corners, DefectCollector& defects) {
  UnionFind fan;
  fan.resize(static_cast<std::uint32_t>(corners));
  edges.for_each_edge([&](std::span<const HalfEdge> e) {
    for (const HalfEdge& h : e.subspan(1)) {
      fan.unite(e[0].corner_low, h.corner_low);
      fan.unite(e[0].corner_high, h.corner_high);
    }
  });
  constexpr std::uint32_t kNone = ~0u;
  std::vector<std::uint32_t> first_fan(mesh.points.size(), kNone);
  std::vector<bool> pinched(mesh.points.size(), false);
  std::uint32_t corner = 0;
  for (const std::uint32_t f : faces) {
    for (const std::uint32_t v : mesh.faces[f]) {
      const std::uint32_t root = fan.find(corner++);
      if (first_fan[v] == kNone)
        first_fan[v] = root;
      else if (first_fan[v] != root)
        pinched[v] = true;
    }
  }
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    if (pinched[v]) defects.add(DefectKind::kNonManifoldVertex, {v}, Vertex{v});
  }
}

bool repeats_a_vertex(std::vector<std::uint32_t> face) {
  std::sort(face.begin(), face.end());
  return std::adjacent_find(face.begin(), face.end()) != face.end();
}

}  // namespace

Surface analyse_surface(const PolygonMesh& mesh) {
  Surface surface;
  DefectCollector defects(mesh.points);
  if (mesh.faces.empty()) defects.add(DefectKind::kNoFaces, {}, {});
  const std::vector<bool> good_vertex = check_vertices(mesh, defects);
  find_duplicate_vertices(mesh, good_vertex, defects);

  // Faces that have edges (combinatorially sound), and the triangles of those that have a shape.
  std::vector<std::uint32_t> sound;
  std::vector<bool> used(mesh.points.size(), false);
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& face = mesh.faces[f];
    const auto bad = std::find_if(face.begin(), face.end(),
                                  [&](std::uint32_t v) { return v >= mesh.points.size(); });
    if (bad != face.end()) {
      defects.add(DefectKind::kIndexOutOfRange, {f, *bad}, {});
      continue;
    }
    for (const std::uint32_t v : face) used[v] = true;
    if (face.size() < 3 || repeats_a_vertex(face)) {
      defects.add(DefectKind::kDegenerateFace, {f}, face);
      continue;
    }
    sound.push_back(f);
    if (!std::all_of(face.begin(), face.end(), [&](std::uint32_t v) { return good_vertex[v]; })) {
      continue;
    }
    switch (triangulate_face(mesh.points, face, surface.triangle)) {
      case FaceShape::kGood:
        break;
      case FaceShape::kGoodNonPlanar:
        ++surface.non_planar_faces;
        defects.add(DefectKind::kNonPlanarPolygon, {f}, face);
        break;
      case FaceShape::kDegenerate:
        defects.add(DefectKind::kDegenerateFace, {f}, face);
        break;
      case FaceShape::kNonSimple:
        defects.add(DefectKind::kNonSimplePolygon, {f}, face);
        break;
    }
    surface.face_of_triangle.resize(surface.triangle.size(), f);
  }
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    if (!used[v]) defects.add(DefectKind::kIsolatedVertex, {v}, Vertex{v});
  }
  find_duplicate_faces(mesh, sound, defects);

  std::uint32_t corners = 0;
  for (const std::uint32_t f : sound) {
    surface.face_edges.add_face(f, mesh.faces[f], corners);
    corners += static_cast<std::uint32_t>(mesh.faces[f].size());
  }
  surface.face_edges.finish();
  check_edges(surface.face_edges, defects);
  if (surface.triangle.size() != sound.size()) check_diagonals(surface, defects);
  check_fans(mesh, sound, surface.face_edges, corners, defects);
  find_self_intersections(mesh.points, surface, defects);
  if (!defects.any_error()) find_shells(mesh.points, surface, defects);
  surface.report = defects.take();
  return surface;
}

ValidationReport validate_mesh(const PolygonMesh& mesh) { return analyse_surface(mesh).report; }

}  // namespace blum
