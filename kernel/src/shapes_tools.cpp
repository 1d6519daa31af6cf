// Two hand tools with the counts of the models in Sud's thesis (figures 5.14 and 5.15): rings of
// points along the x axis.
#include <cmath>
#include <span>
#include <vector>

#include "blum/kernel/check.hpp"
#include "blum/kernel/shapes.hpp"
#include "shapes_circle.hpp"
#include "shapes_random.hpp"

namespace blum::shapes {
namespace {

using Ring = std::vector<std::uint32_t>;

Ring add_ring(PolygonMesh& mesh, std::span<const Point3> points) {
  Ring ring;
  for (const Point3& p : points) {
    ring.push_back(static_cast<std::uint32_t>(mesh.points.size()));
    mesh.points.push_back(p);
  }
  return ring;
}

/// Triangles around one point, on the low or high side of a ring (counter-clockwise seen from +x).
void add_fan(PolygonMesh& mesh, const Ring& ring, const Point3& tip, bool low) {
  const auto at = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.push_back(tip);
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const auto a = ring[k], b = ring[(k + 1) % ring.size()];
    if (low)
      mesh.faces.push_back({b, a, at});
    else
      mesh.faces.push_back({a, b, at});
  }
}

double rounded(double x) { return std::nearbyint(std::ldexp(x, 20)) * 0x1p-20; }

}  // namespace

PolygonMesh spoon() {
  // Corners of a ring, seen from +x: rim, two of the hollow (or the handle's top), rim, two below.
  // The rim and the hull are convex, the hollow is a convex pit: no vertex is a saddle whose edges
  // lie in no half-space.
  struct Section {
    double x, width, rim, top, top_width, bottom, bottom_width;
  };
  constexpr std::array<Section, 7> kSections{{{0.5, 0.59, 0.0, -0.12, 0.27, -0.31, 0.24},
                                              {1.2, 0.91, 0.11, -0.27, 0.3, -0.46, 0.31},
                                              {2.1, 1.02, 0.11, -0.31, 0.38, -0.56, 0.43},
                                              {3.0, 0.97, 0.13, -0.32, 0.31, -0.52, 0.41},
                                              {4.1, 0.72, 0.14, 0.29, 0.13, -0.44, 0.33},
                                              {6.2, 0.41, 0.09, 0.19, 0.12, -0.27, 0.19},
                                              {8.0, 0.17, 0.02, 0.1, 0.05, -0.12, 0.15}}};
  PolygonMesh mesh;
  std::vector<Ring> rings;
  for (std::size_t i = 0; i < kSections.size(); ++i) {
    const Section& s = kSections[i];
    const double skew = 0.004 * (static_cast<double>(i) - 3);  // no two triangles in one plane
    rings.push_back(
        add_ring(mesh, std::array<Point3, 6>{{{s.x, s.width, s.rim + skew},
                                              {s.x + 0.01, s.top_width, s.top},
                                              {s.x - 0.01, -s.top_width + skew, s.top + 0.003},
                                              {s.x, -s.width + skew, s.rim},
                                              {s.x + 0.02, -s.bottom_width, s.bottom + skew},
                                              {s.x, s.bottom_width + 0.005, s.bottom}}}));
  }
  for (std::size_t i = 0; i + 1 < rings.size(); ++i)
    for (std::size_t k = 0; k < 6; ++k) {
      const auto a = rings[i][k], b = rings[i][(k + 1) % 6], c = rings[i + 1][k],
                 d = rings[i + 1][(k + 1) % 6];
      mesh.faces.push_back({a, b, d});
      mesh.faces.push_back({a, d, c});
    }
  add_fan(mesh, rings.front(), {0.02, 0.01, -0.06}, true);
  add_fan(mesh, rings.back(), {8.21, 0.005, -0.01}, false);
  return mesh;
}

PolygonMesh chisel(double noise, std::uint64_t seed) {
  BLUM_CHECK(noise >= 0 && noise <= 0.05);
  Random random(seed);
  PolygonMesh mesh;
  std::vector<Ring> rings;
  constexpr int kHandleRings = 16, kHandlePoints = 16, kShankRings = 4, kShankPoints = 8,
                kBladeRings = 7;
  for (int i = 0; i < kHandleRings; ++i) {
    const double s = static_cast<double>(i) / (kHandleRings - 1);
    const double radius = 0.8 + 0.5 * std::sin(3.1 * s + 0.2) - 0.25 * s;
    std::vector<Point3> points;
    for (int k = 0; k < kHandlePoints; ++k) {
      const auto [c, sine] = unit_circle(k, kHandlePoints);
      const auto shake = [&] { return i == 0 ? 0.0 : noise * radius * (2 * random.unit() - 1); };
      const double x = 5 * s + shake(), y = radius * c + shake(), z = 0.5 * radius * sine + shake();
      points.push_back({rounded(x), rounded(y), rounded(z)});
    }
    rings.push_back(add_ring(mesh, points));
  }
  for (int i = 0; i < kShankRings; ++i) {
    constexpr std::array<double, kShankRings> kX{5.25, 5.5, 6.25, 6.5},
        kRadius{0.5, 0.3125, 0.28125, 0.34375};
    std::vector<Point3> points;
    for (int k = 0; k < kShankPoints; ++k) {
      const auto [c, sine] = unit_circle(k, kShankPoints);
      const auto n = static_cast<std::size_t>(i);
      points.push_back({kX[n], kRadius[n] * rounded(c), 0.5 * kRadius[n] * rounded(sine)});
    }
    rings.push_back(add_ring(mesh, points));
  }
  for (int i = 0; i < kBladeRings; ++i) {
    constexpr std::array<double, kBladeRings> kThickness{0.25,     0.234375, 0.21875, 0.1953125,
                                                         0.171875, 0.140625, 0.109375};
    const double x = 6.75 + 0.5 * i, h = kThickness[static_cast<std::size_t>(i)];
    rings.push_back(add_ring(
        mesh, std::array<Point3, 4>{{{x, 0.5, h}, {x, -0.5, h}, {x, -0.5, -h}, {x, 0.5, -h}}}));
  }
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    // As many triangles as points on both rings; where one has twice the points, two to one.
    const Ring &a = rings[i], &b = rings[i + 1];
    const std::size_t n = b.size(), each = a.size() / n;
    for (std::size_t k = 0; k < n; ++k) {
      const auto q = b[k], next = b[(k + 1) % n];
      if (each == 1) {
        mesh.faces.push_back({a[k], a[(k + 1) % n], next, q});
        continue;
      }
      for (std::size_t j = 0; j < each; ++j)
        mesh.faces.push_back({a[k * each + j], a[(k * each + j + 1) % a.size()], q});
      mesh.faces.push_back({a[(k + 1) * each % a.size()], next, q});
    }
  }
  // The flat end of the handle, and the edge of the blade.
  mesh.faces.emplace_back(rings.front().rbegin(), rings.front().rend());
  const Ring& last = rings.back();
  const auto left = static_cast<std::uint32_t>(mesh.points.size()), right = left + 1;
  mesh.points.push_back({10.125, 0.5, -0.09375});
  mesh.points.push_back({10.125, -0.5, -0.09375});
  mesh.faces.push_back({last[3], last[0], left});
  mesh.faces.push_back({last[1], last[2], right});
  mesh.faces.push_back({last[0], last[1], right, left});
  mesh.faces.push_back({last[2], last[3], left, right});
  // Four points of a shaken handle are in no plane.
  PolygonMesh out{mesh.points, {}};
  const auto handle = static_cast<std::uint32_t>(kHandleRings * kHandlePoints);
  for (const auto& f : mesh.faces) {
    const bool on_handle = f.size() == 4 && f[0] < handle && f[2] < handle;
    if (on_handle) {
      out.faces.push_back({f[0], f[1], f[2]});
      out.faces.push_back({f[0], f[2], f[3]});
    } else {
      out.faces.push_back(f);
    }
  }
  return out;
}

}  // namespace blum::shapes
