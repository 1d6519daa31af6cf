/// Small meshes, transformations and files for the tests of mesh input, validation and solids.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "blum/kernel/mesh.hpp"
#include "blum/kernel/solid.hpp"
#include "blum/kernel/validate.hpp"
#include "test_folder.hpp"

namespace blum::test {

inline PolygonMesh box_mesh(Point3 lo = {0, 0, 0}, Point3 hi = {1, 1, 1}) {
  PolygonMesh m;
  for (int i = 0; i < 8; ++i) {
    m.points.push_back({i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z});
  }
  m.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return m;
}

inline PolygonMesh tetrahedron(Point3 at = {0, 0, 0}, double size = 1) {
  PolygonMesh m;
  m.points = {at, {at.x + size, at.y, at.z}, {at.x, at.y + size, at.z}, {at.x, at.y, at.z + size}};
  m.faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return m;
}

inline PolygonMesh reversed(PolygonMesh m) {
  for (auto& f : m.faces) std::reverse(f.begin(), f.end());
  return m;
}

inline PolygonMesh merged(PolygonMesh a, const PolygonMesh& b) {
  const auto shift = static_cast<std::uint32_t>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (auto f : b.faces) {
    for (auto& v : f) v += shift;
    a.faces.push_back(std::move(f));
  }
  return a;
}

/// Fans from the first vertex; for convex faces.
inline PolygonMesh triangulated(const PolygonMesh& m) {
  PolygonMesh out;
  out.points = m.points;
  for (const auto& f : m.faces) {
    for (std::size_t k = 1; k + 1 < f.size(); ++k) out.faces.push_back({f[0], f[k], f[k + 1]});
  }
  return out;
}

/// n x m quads, ring radius R, tube radius r.
inline PolygonMesh torus(int n, int m, double R, double r) {
  PolygonMesh out;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      const double a = 2 * std::numbers::pi * i / n, b = 2 * std::numbers::pi * j / m;
      const double d = R + r * std::cos(b);
      out.points.push_back({d * std::cos(a), d * std::sin(a), r * std::sin(b)});
    }
  }
  const auto id = [&](int i, int j) { return static_cast<std::uint32_t>((i % n) * m + j % m); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      out.faces.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      out.faces.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  return out;
}

/// The prism over a polygon in the (x, y) plane, counter-clockwise.
inline PolygonMesh prism(const std::vector<std::pair<double, double>>& polygon, double z0 = 0,
                         double z1 = 1) {
  PolygonMesh m;
  const auto n = static_cast<std::uint32_t>(polygon.size());
  for (const double z : {z0, z1}) {
    for (const auto& [x, y] : polygon) m.points.push_back({x, y, z});
  }
  std::vector<std::uint32_t> bottom, top;
  for (std::uint32_t k = 0; k < n; ++k) {
    bottom.push_back(n - 1 - k);
    top.push_back(n + k);
    m.faces.push_back({k, (k + 1) % n, n + (k + 1) % n, n + k});
  }
  m.faces.push_back(bottom);
  m.faces.push_back(top);
  return m;
}

template <class Map>
PolygonMesh mapped(PolygonMesh m, Map&& map) {
  for (Point3& p : m.points) p = map(p);
  return m;
}

/// The same mesh with its vertices and faces in another order and faces begun elsewhere.
inline PolygonMesh shuffled(const PolygonMesh& m, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint32_t> to(m.points.size());
  for (std::uint32_t i = 0; i < to.size(); ++i) to[i] = i;
  std::shuffle(to.begin(), to.end(), random);
  PolygonMesh out;
  out.points.resize(m.points.size());
  for (std::size_t i = 0; i < to.size(); ++i) out.points[to[i]] = m.points[i];
  for (auto f : m.faces) {
    for (auto& v : f) v = to[v];
    std::rotate(f.begin(), f.begin() + random() % f.size(), f.end());
    out.faces.push_back(std::move(f));
  }
  std::shuffle(out.faces.begin(), out.faces.end(), random);
  return out;
}

inline std::size_t count_of(const PolygonMesh& m, DefectKind kind) {
  const ValidationReport report = validate_mesh(m);
  const Defect* d = report.find(kind);
  return d == nullptr ? 0 : d->count;
}

/// Names of all defects, as "name:count name:count".
inline std::string defects_of(const PolygonMesh& m) {
  std::string out;
  for (const Defect& d : validate_mesh(m).defects) {
    out += (out.empty() ? "" : " ") + std::string(defect_kind_name(d.kind)) + ":" +
           std::to_string(d.count);
  }
  return out;
}

inline Solid solid_of(const PolygonMesh& m) {
  Result<Solid> s = build_solid(m);
  EXPECT_TRUE(s.ok()) << (s.ok() ? "" : s.error().message);
  return s.ok() ? std::move(s).value() : Solid{};
}

}  // namespace blum::test

/// Skips a test that needs the model files; the message says why.
#define BLUM_NEED_MODELS()                                                     \
  if (!std::filesystem::exists(BLUM_MODELS_DIR "/MANIFEST.csv")) {             \
    GTEST_SKIP() << "needs the model files, not found in " << BLUM_MODELS_DIR; \
  }
