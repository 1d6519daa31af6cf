#include "blum/show/visible.hpp"

#include <algorithm>

namespace blum {
namespace {

/// Visible triangles at each edge of the complex.
std::vector<std::uint32_t> degrees(const Scene& scene, const std::vector<std::uint32_t>& visible) {
  std::uint32_t edges = 0;
  for (const auto& t : scene.triangle_edge) {
    for (const std::uint32_t e : t) edges = std::max(edges, e + 1);
  }
  for (const std::uint32_t e : scene.line_edge) edges = std::max(edges, e + 1);
  std::vector<std::uint32_t> degree(edges, 0);
  for (const std::uint32_t t : visible) {
    for (const std::uint32_t e : scene.triangle_edge[t]) ++degree[e];
  }
  return degree;
}

}  // namespace

VisibleCells visible_cells(const Scene& scene, double theta_deg) {
  VisibleCells visible;
  for (std::uint32_t t = 0; t < scene.triangle.size(); ++t) {
    if (scene.triangle_theta.empty() || scene.triangle_theta[t] >= theta_deg) {
      visible.triangle.push_back(t);
    }
  }
  const bool has_edges = !scene.triangle_edge.empty() || !scene.line_edge.empty();
  std::vector<std::uint32_t> degree;
  if (has_edges) degree = degrees(scene, visible.triangle);
  for (std::uint32_t i = 0; i < scene.line.size(); ++i) {
    if (!scene.line_theta.empty() && !(scene.line_theta[i] >= theta_deg)) continue;
    const std::uint32_t d = has_edges                 ? degree[scene.line_edge[i]]
                            : scene.line_seam[i] >= 0 ? 3
                                                      : 1;
    if (d == 1) visible.rim.push_back(i);
    if (d != 1 && d != 2) visible.seam.push_back(i);
  }
  return visible;
}

}  // namespace blum
