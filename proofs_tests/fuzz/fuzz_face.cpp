// The diagram engine against its exact twin, on solids and rectangles in special position.
#include <cmath>
#include <exception>
#include <optional>
#include <random>

#include "arrangement/coarse_map.hpp"
#include "arrangement/face_scenes.hpp"
#include "blum/arrangement/brute_engine.hpp"
#include "fuzz_target.hpp"

namespace blum::fuzz {
namespace {

constexpr std::size_t kMostCandidates = 16, kMostCurved = 6;  // for the oracle's patience
constexpr double kLeastSide = 0x1p-6;                         // of the extent

// Choices are made one a statement: the order of arguments is the compiler's.

/// A height field over a square grid on a flat base, heights in quarters, and some of them beside.
PolygonMesh terrain(Choices& choices) {
  const int n = choices.between(1, 3), m = choices.between(1, 3);
  PolygonMesh mesh;
  const auto top = [&](int i, int j) { return static_cast<std::uint32_t>(i * (m + 1) + j); };
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j) {
      const int choice = choices.below(256);
      const double beside = choice < 128 ? 0 : choice < 192 ? 0x1p-52 : 0x1p-20;
      mesh.points.push_back({1.0 * i, 1.0 * j, 1 + (choice % 4) / 4.0 + beside});
    }
  const auto base = static_cast<std::uint32_t>(mesh.points.size());
  for (std::uint32_t v = 0; v < base; ++v)
    mesh.points.push_back({mesh.points[v].x, mesh.points[v].y, 0});
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const auto a = top(i, j), b = top(i + 1, j), c = top(i + 1, j + 1), d = top(i, j + 1);
      mesh.faces.push_back({base + a, base + d, base + c, base + b});
      if (choices.coin()) {
        mesh.faces.insert(mesh.faces.end(), {{a, b, c}, {a, c, d}});
      } else {
        mesh.faces.insert(mesh.faces.end(), {{a, b, d}, {b, c, d}});
      }
    }
  const auto wall = [&](std::uint32_t a, std::uint32_t b) {
    mesh.faces.push_back({base + a, base + b, b, a});
  };
  for (int i = 0; i < n; ++i) {
    wall(top(i, 0), top(i + 1, 0));
    wall(top(i + 1, m), top(i, m));
  }
  for (int j = 0; j < m; ++j) {
    wall(top(n, j), top(n, j + 1));
    wall(top(0, j + 1), top(0, j));
  }
  return mesh;
}

PolygonMesh shape(Choices& choices) {
  const auto length = [&] { return choices.between(1, 16) / 4.0; };
  switch (choices.below(8)) {
    case 0: {
      const double a = length(), b = length();
      return shapes::cuboid(a, b, length());
    }
    case 1: {
      const double thickness = choices.between(1, 11) / 4.0;
      return shapes::lbracket(4, 3, thickness, length());
    }
    case 2: {
      const double w = length(), d = length();
      return shapes::lpocket(w, d, length());
    }
    case 3: {
      const int n = choices.between(3, 8);
      const double height = length();
      return shapes::prism(n, 1, height, {choices.coin() ? 0x1p-20 : 0, choices.between(-2, 2)});
    }
    case 4: {
      const int holes = choices.between(0, 1), sides = choices.between(3, 6);
      return shapes::plate(holes, sides, 2, length());
    }
    case 5:
      return shapes::nested_voids(1);
    case 6:
      return test::cube_minus_octant();
    default:
      return terrain(choices);
  }
}

/// A multiple of a sixteenth of the extent, a vertex's coordinate or the middle of two; as it is or
/// a few units in the last place beside.
double special(Choices& choices, const test::Scene& scene, int axis) {
  const auto vertex = [&] {
    const auto n = static_cast<int>(std::min<std::size_t>(scene.solid->point.size(), 256));
    return scene.solid->point[static_cast<std::size_t>(choices.below(n))][axis];
  };
  const double lo = scene.bounds.lo[axis], hi = scene.bounds.hi[axis];
  double x = 0;
  switch (choices.below(4)) {
    case 0:
      x = vertex();
      break;
    case 1: {
      const double a = vertex();
      x = (a + vertex()) / 2;
      break;
    }
    case 2:
      x = lo + (hi - lo) * choices.between(-2, 18) / 16;
      break;
    default: {
      const int coarse = choices.below(256);
      x = lo + (hi - lo) * (coarse + choices.below(256) / 256.0) / 256;
    }
  }
  // Beside 0 the oracle takes hours over polynomials with coefficients of 2^-1074.
  constexpr double kLeast = 0x1p-100;
  for (int ulps = choices.between(-2, 2); ulps != 0; ulps += ulps < 0 ? 1 : -1)
    x = std::abs(x) < kLeast ? x + (ulps < 0 ? -kLeast : kLeast)
                             : std::nextafter(x, ulps < 0 ? -10 : 10);
  return x;
}

std::optional<Rect> rectangle(Choices& choices, const test::Scene& scene) {
  Rect r;
  r.axis = choices.below(3);
  r.level = special(choices, scene, r.axis);
  const auto range = [&](int axis, double& lo, double& hi) {
    lo = special(choices, scene, axis);
    hi = special(choices, scene, axis);
    if (lo > hi) std::swap(lo, hi);
    return hi - lo > kLeastSide * scene.extent();
  };
  const bool is_wide = range(u_axis(r.axis), r.u0, r.u1);
  return range(v_axis(r.axis), r.v0, r.v1) && is_wide ? std::optional(r) : std::nullopt;
}

template <class Run>
FaceDiagram run(const char* name, const test::Scene& scene, const Rect& rect, Run&& engine) {
  try {
    return engine();
  } catch (const std::exception& error) {
    fail(std::string(name) + " throws: " + error.what() + "\n" + test::describe(scene, rect));
  }
}

void compare(const test::Scene& scene, const Rect& rect, bool with_all_candidates) {
  const auto near = scene.near(rect);
  if (near.size() > kMostCandidates || scene.curved(near) > kMostCurved) return;
  const auto triangles = scene.all_triangles();
  const auto all = scene.all_candidates();
  const FaceDiagram production = run("production", scene, rect, [&] {
    ProductionEngine engine = scene.engine();
    return engine.face({scene.solid.get(), rect, with_all_candidates ? all : near, triangles});
  });
  if (production.status != FaceStatus::kDecided) return;
  const FaceDiagram brute = run("brute", scene, rect, [&] {
    return brute_face({scene.solid.get(), rect, near, triangles});
  });
  if (brute.status == FaceStatus::kUndecided)
    fail("the oracle is undecided\n" + test::describe(scene, rect));
  if (brute.status != FaceStatus::kDecided) return;  // production may not need to notice
  const std::string difference = test::coarse_map_difference(production, brute);
  if (!difference.empty()) fail(difference + "\n" + test::describe(scene, rect));
}

}  // namespace
}  // namespace blum::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace blum;
  fuzz::Choices choices(data, size);
  PolygonMesh mesh = fuzz::shape(choices);
  if (choices.below(4) == 0)
    mesh = shapes::rotate_rounded(mesh, static_cast<std::uint64_t>(choices.below(256)));
  Result<Solid> solid = build_solid(mesh);
  if (!solid) return 0;
  const test::Scene scene("fuzz", std::move(solid.value()));
  const bool with_all_candidates = choices.coin();
  if (const auto rect = fuzz::rectangle(choices, scene))
    fuzz::compare(scene, *rect, with_all_candidates);
  return 0;
}
