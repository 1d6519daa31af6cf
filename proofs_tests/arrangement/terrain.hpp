/// Blocks whose top is a height field: reflex edges wherever one wants them.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "blum/kernel/mesh.hpp"

namespace blum::test {

/// Over a grid, triangulated: x increases, and y, for each x; the first and last y are the same for
/// all x. z, at (i, j), is above `bottom`.
inline PolygonMesh terrain(const std::vector<double>& x, const std::vector<std::vector<double>>& y,
                           double bottom,
                           const std::function<double(std::size_t, std::size_t)>& z) {
  PolygonMesh mesh;
  const auto m = static_cast<std::uint32_t>(x.size() - 1),
             n = static_cast<std::uint32_t>(y[0].size() - 1);
  for (std::size_t i = 0; i <= m; ++i)
    for (std::size_t j = 0; j <= n; ++j) mesh.points.push_back({x[i], y[i][j], z(i, j)});
  const auto low = static_cast<std::uint32_t>(mesh.points.size());
  for (const auto& [u, v] :
       {std::pair{x[0], y[0][0]}, {x[m], y[0][0]}, {x[m], y[0][n]}, {x[0], y[0][n]}})
    mesh.points.push_back({u, v, bottom});
  const auto at = [n](std::uint32_t i, std::uint32_t j) { return i * (n + 1) + j; };
  for (std::uint32_t i = 0; i < m; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  mesh.faces.push_back({low, low + 3, low + 2, low + 1});
  std::vector<std::vector<std::uint32_t>> wall(4);
  for (std::uint32_t i = 0; i <= m; ++i) {
    wall[0].push_back(at(m - i, 0));
    wall[2].push_back(at(i, n));
  }
  for (std::uint32_t j = 0; j <= n; ++j) {
    wall[1].push_back(at(m, n - j));
    wall[3].push_back(at(0, j));
  }
  for (std::uint32_t k = 0; k < 4; ++k) {
    wall[k].push_back(low + k);
    wall[k].push_back(low + (k + 1) % 4);
    mesh.faces.push_back(wall[k]);
  }
  return mesh;
}

}  // namespace blum::test
