#include "blum/kernel/info.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "blum/kernel/point_algebra.hpp"
#include "blum/kernel/solid.hpp"
#include "validate_surface.hpp"

namespace blum {
namespace {

constexpr double kNearlyFlatDeg = 1e-4;
constexpr double kShortEdge = 1e-6;  // of the diagonal

/// Interior dihedral angle in degrees, rounded; 180 exactly for flat edges.
double dihedral_deg(const Solid& solid, const SolidEdge& e) {
  if (e.kind == EdgeKind::kFlat) return 180;
  const auto normal = [&](std::uint32_t t) {
    const auto& v = solid.triangle[t].vertex;
    const Point3& a = solid.point[v[0]];
    return cross(solid.point[v[1]] - a, solid.point[v[2]] - a);
  };
  const Point3 n0 = normal(e.triangle[0]), n1 = normal(e.triangle[1]);
  const double turn = std::atan2(length(cross(n0, n1)), inner(n0, n1)) * 180 / std::numbers::pi;
  return e.kind == EdgeKind::kConvex ? 180 - turn : 180 + turn;
}

double volume(const Solid& solid) {
  double sum = 0;
  for (const SolidTriangle& t : solid.triangle) {
    sum +=
        inner(solid.point[t.vertex[0]], cross(solid.point[t.vertex[1]], solid.point[t.vertex[2]]));
  }
  return std::ldexp(sum / 6, 3 * solid.frame.exponent);
}

/// Solid vertices are the mesh's that have a triangle, in order.
std::vector<std::uint32_t> mesh_vertices(const PolygonMesh& mesh, const Surface& surface) {
  std::vector<bool> used(mesh.points.size(), false);
  for (const auto& t : surface.triangle) {
    for (const std::uint32_t v : t) used[v] = true;
  }
  std::vector<std::uint32_t> out;
  for (std::uint32_t v = 0; v < used.size(); ++v) {
    if (used[v]) out.push_back(v);
  }
  return out;
}

MeshInfo::SolidInfo solid_info(const PolygonMesh& mesh, const Surface& surface,
                               const Solid& solid) {
  const std::vector<std::uint32_t> vertex = mesh_vertices(mesh, surface);
  MeshInfo::SolidInfo info;
  info.triangle_edges = solid.edge.size();
  info.components = solid.components;
  info.shells = solid.shell.size();
  info.facets = solid.facets;
  for (const Shell& s : solid.shell) {
    info.genus_per_shell.push_back(s.genus);
    info.voids += s.is_void;
  }
  info.betti = solid.betti();
  info.min_dihedral_deg = 360;
  for (const SolidEdge& e : solid.edge) {
    const double angle = dihedral_deg(solid, e);
    info.convex_edges += e.kind == EdgeKind::kConvex;
    info.reflex_edges += e.kind == EdgeKind::kReflex;
    // A planar face's own diagonals say nothing about the mesh.
    if (surface.face_edges.degree(vertex[e.vertex[0]], vertex[e.vertex[1]]) == 0) continue;
    info.min_dihedral_deg = std::min(info.min_dihedral_deg, angle);
    info.max_dihedral_deg = std::max(info.max_dihedral_deg, angle);
    info.coplanar_pairs += e.kind == EdgeKind::kFlat;
    info.nearly_coplanar_pairs += std::abs(angle - 180) <= kNearlyFlatDeg;
  }
  info.degenerate_vertices = static_cast<std::size_t>(
      std::count(solid.vertex_degenerate.begin(), solid.vertex_degenerate.end(), true));
  info.volume = volume(solid);
  info.frame_exponent = solid.frame.exponent;
  info.frame_origin = solid.frame.origin;
  return info;
}

std::optional<Box3> bounding_box(const PolygonMesh& mesh) {
  std::optional<Box3> box;
  for (const Point3& p : mesh.points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) continue;
    if (!box) box = Box3{p, p};
    for (int axis = 0; axis < 3; ++axis) {
      box->lo[axis] = std::min(box->lo[axis], p[axis]);
      box->hi[axis] = std::max(box->hi[axis], p[axis]);
    }
  }
  return box;
}

}  // namespace

MeshInfo mesh_info(const PolygonMesh& mesh) {
  MeshInfo info;
  const Surface surface = analyse_surface(mesh);
  info.vertices = mesh.points.size();
  info.faces = mesh.faces.size();
  info.polygon_faces = static_cast<std::size_t>(std::count_if(
      mesh.faces.begin(), mesh.faces.end(), [](const auto& f) { return f.size() > 3; }));
  info.triangles = surface.triangle.size();
  info.bounding_box = bounding_box(mesh);
  const double diagonal =
      info.bounding_box ? distance_between(info.bounding_box->hi, info.bounding_box->lo) : 0;
  double shortest = std::numeric_limits<double>::infinity();
  surface.face_edges.for_each_edge([&](std::span<const HalfEdge> e) {
    ++info.edges;
    const double length = distance_between(mesh.points[e[0].low], mesh.points[e[0].high]);
    if (std::isnan(length)) return;
    shortest = std::min(shortest, length);
    info.short_edges += length < kShortEdge * diagonal;
  });
  if (info.edges > 0 && diagonal > 0) info.shortest_edge_over_diagonal = shortest / diagonal;
  info.validation = surface.report;
  if (!surface.report.valid()) return info;
  const Result<Solid> solid = build_solid(mesh, surface);
  if (!solid.ok()) {
    info.warnings.push_back(solid.error().message);
    return info;
  }
  info.solid = solid_info(mesh, surface, solid.value());
  info.warnings = solid.value().warnings;
  return info;
}

}  // namespace blum
