#include "blum/placement/smooth.hpp"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <cmath>
#include <map>

#include "blum/kernel/point_algebra.hpp"
#include "blum/kernel/site_tree.hpp"

namespace blum {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

/// One sheet as an OpenMesh mesh; no faces where it is no oriented surface.
struct SheetMesh {
  Mesh mesh;
  std::vector<std::uint32_t> vertex;  // of the complex, by handle
};

/// Corners of a sheet's triangles, turned so that neighbours agree; empty: impossible.
std::vector<std::array<std::uint32_t, 3>> oriented(const CellComplex& complex,
                                                   const std::vector<std::uint32_t>& triangles,
                                                   const std::vector<bool>& seam) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> beside;  // edge -> triangles, by their place
  for (std::uint32_t k = 0; k < triangles.size(); ++k)
    for (const auto e : complex.triangle[triangles[k]].edge)
      if (!seam[e]) beside[e].push_back(k);
  std::vector<std::array<std::uint32_t, 3>> face(triangles.size());
  for (std::uint32_t k = 0; k < triangles.size(); ++k)
    face[k] = corners(complex, complex.triangle[triangles[k]]);
  const auto runs = [&](std::uint32_t k, std::uint32_t a, std::uint32_t b) {
    for (std::size_t i = 0; i < 3; ++i)
      if (face[k][i] == a && face[k][(i + 1) % 3] == b) return true;
    return false;
  };
  std::vector<bool> done(triangles.size(), false);
  for (std::uint32_t root = 0; root < triangles.size(); ++root) {
    if (done[root]) continue;
    done[root] = true;
    std::vector<std::uint32_t> stack{root};
    while (!stack.empty()) {
      const auto k = stack.back();
      stack.pop_back();
      for (const auto e : complex.triangle[triangles[k]].edge) {
        if (seam[e]) continue;
        const auto [a, b] = complex.edge[e].vertex;
        for (const auto other : beside[e]) {
          if (other == k) continue;
          const bool agrees = runs(k, a, b) != runs(other, a, b);
          if (!done[other]) {
            done[other] = true;
            if (!agrees) std::swap(face[other][0], face[other][1]);
            stack.push_back(other);
          } else if (!agrees) {
            return {};
          }
        }
      }
    }
  }
  return face;
}

bool build(const CellComplex& complex, const std::vector<std::array<std::uint32_t, 3>>& faces,
           SheetMesh& sheet) {
  std::map<std::uint32_t, Mesh::VertexHandle> handle;
  for (const auto& face : faces)
    for (const auto v : face) {
      const auto [it, fresh] = handle.try_emplace(v);
      if (!fresh) continue;
      const Point3& p = complex.vertex[v].position;
      it->second = sheet.mesh.add_vertex({p.x, p.y, p.z});
      sheet.vertex.push_back(v);
    }
  // OpenMesh says on its error stream what it refuses.
  omerr().disable();
  bool good = !faces.empty();
  for (const auto& [a, b, c] : faces)
    good = good && a != b && b != c && c != a &&
           sheet.mesh.add_face(handle.at(a), handle.at(b), handle.at(c)).is_valid();
  omerr().enable();
  return good;
}

void filter_step(Mesh& mesh, const std::vector<bool>& fixed, double part) {
  std::vector<Mesh::Point> next(mesh.n_vertices());
  for (const auto v : mesh.vertices()) {
    const auto k = static_cast<std::size_t>(v.idx());
    next[k] = mesh.point(v);
    if (fixed[k]) continue;
    Mesh::Point sum(0, 0, 0);
    for (const auto w : mesh.vv_range(v)) sum += mesh.point(w);
    next[k] += part * (sum / static_cast<double>(mesh.valence(v)) - next[k]);
  }
  for (const auto v : mesh.vertices()) mesh.set_point(v, next[static_cast<std::size_t>(v.idx())]);
}

}  // namespace

SmoothReport smooth_sheets(MedialResult& result, const Solid& solid, const SmoothOptions& options) {
  CellComplex& complex = result.complex;
  result.smoothed = true;
  const SiteTree tree(solid);
  std::vector<std::vector<std::uint32_t>> triangles(result.parts.sheets);
  std::vector<std::uint32_t> sheet_of(complex.vertex.size(), kNone);
  std::vector<int> count(complex.edge.size(), 0);
  std::vector<bool> keep(complex.vertex.size(), false), seam(complex.edge.size(), false);
  for (std::uint32_t t = 0; t < complex.triangle.size(); ++t) {
    const auto sheet = result.parts.triangle_sheet[t];
    triangles[sheet].push_back(t);
    for (const auto e : complex.triangle[t].edge) ++count[e];
    for (const auto v : corners(complex, complex.triangle[t])) {
      if (sheet_of[v] != kNone && sheet_of[v] != sheet) keep[v] = true;
      sheet_of[v] = sheet;
    }
  }
  for (std::size_t e = 0; e < complex.edge.size(); ++e) {
    seam[e] = result.parts.edge_seam[e] != Parts::kNoSeam;
    if (seam[e] || count[e] != 2)
      for (const auto v : complex.edge[e].vertex) keep[v] = true;
  }
  SmoothReport report;
  for (const auto& list : triangles) {
    if (list.empty()) continue;
    SheetMesh sheet;
    if (!build(complex, oriented(complex, list, seam), sheet)) {
      ++report.skipped;
      continue;
    }
    ++report.sheets;
    std::vector<bool> fixed(sheet.vertex.size());
    for (const auto v : sheet.mesh.vertices()) {
      const auto k = static_cast<std::size_t>(v.idx());
      fixed[k] = keep[sheet.vertex[k]] || sheet.mesh.is_boundary(v);
    }
    for (int step = 0; step < options.steps; ++step)
      filter_step(sheet.mesh, fixed, step % 2 == 0 ? options.lambda : options.mu);
    for (const auto v : sheet.mesh.vertices()) {
      const auto k = static_cast<std::size_t>(v.idx());
      if (fixed[k]) continue;
      ComplexVertex& vertex = complex.vertex[sheet.vertex[k]];
      const Mesh::Point p = sheet.mesh.point(v);
      const Point3 moved{p[0], p[1], p[2]};
      report.largest_displacement =
          std::max(report.largest_displacement, distance_between(moved, vertex.position));
      ++report.points;
      vertex.position = moved;
      vertex.on_axis = false;
      const double squared = tree.squared_distance(solid.frame.to_working(moved)).hi;
      vertex.radius = solid.frame.length_to_model(std::sqrt(squared));
    }
  }
  return report;
}

}  // namespace blum
